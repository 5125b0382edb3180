// What shells complete. Keys behind --set come from the table of keys.
#include <algorithm>

#include "core/data_folder.hpp"
#include "app/guide/manual.hpp"
#include "core/format.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {
namespace {

constexpr Name kShells[] = {{"bash", "source it, or put it where bash-completion looks"},
                            {"zsh", "a file _chainreel in a folder of fpath"},
                            {"fish", "a file chainreel.fish in fish's completions"}};

using CommandTable = CommandLine::CommandTable;
using OptionTable = CommandLine::OptionTable;

// "video.width=" ..: what --set takes.
std::vector<std::string> keys_to_set() {
  std::vector<std::string> keys;
  for (const SceneKey& key : scene_keys())
    if (!key.is_section) keys.push_back(key.name + "=");
  return keys;
}

// Words that the value of an option may be; none where it is a file, a number or anything.
std::vector<std::string> values_of(const OptionTable& option) {
  if (option.long_name() == "--set") return keys_to_set();
  for (const SceneKey& key : scene_keys())
    if (!key.words.empty() && key.flag == option.long_name()) return words_of(key.words);
  return option.words;
}

std::vector<std::string> names_in(const CommandTable& command) {
  std::vector<std::string> names;
  for (const OptionTable& option : command.options)
    if (!option.is_positional) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::string in_single_quotes(std::string text) {
  for (std::size_t at = text.find('\''); at != std::string::npos; at = text.find('\'', at + 4)) text.replace(at, 1, "'\\''");
  return "'" + text + "'";
}

std::vector<std::string> names_of_commands(const std::vector<CommandTable>& commands) {
  std::vector<std::string> names;
  for (const CommandTable& command : commands) names.push_back(command.name);
  return names;
}

std::string bash_script(const std::vector<CommandTable>& commands, const CommandTable& shared) {
  std::string options, values;
  for (const CommandTable& command : commands) {
    options += "    " + command.name + ") options=" + in_single_quotes(joined(names_in(command), " ")) + " ;;\n";
    for (const OptionTable& option : command.options) {
      const std::vector<std::string> words = values_of(option);
      if (option.is_positional || words.empty()) continue;
      for (const std::string& name : option.names)
        values += "    " + command.name + ":" + name + ") words=" + in_single_quotes(joined(words, " ")) + " ;;\n";
    }
  }
  for (const OptionTable& option : shared.options)
    if (!option.words.empty())
      for (const std::string& name : option.names)
        values += "    *:" + name + ") words=" + in_single_quotes(joined(option.words, " ")) + " ;;\n";
  return "# Completion of chainreel in bash: from the command line's own table.\n"
         "_chainreel() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= options= words= i\n"
         "  local IFS=$' \\t\\n'\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case ${COMP_WORDS[i]} in\n      " +
         joined(names_of_commands(commands), "|") +
         ") command=${COMP_WORDS[i]}; break ;;\n    esac\n  done\n"
         "  if [[ -z $command && $word != -* && $before != --gl ]]; then\n"
         "    COMPREPLY=($(compgen -W " + in_single_quotes(joined(names_of_commands(commands), " ")) + " -- \"$word\"))\n"
         "    return\n  fi\n"
         "  # A key behind --set and its = are words of their own.\n"
         "  [[ $command:$before == *:= ]] && return\n"
         "  case $command:$before in\n" + values + "  esac\n"
         "  if [[ -n $words ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "    [[ ${COMPREPLY[0]} == *= ]] && compopt -o nospace 2> /dev/null\n"
         "    return\n  fi\n"
         "  case $command in\n" + options + "    *) options=" + in_single_quotes(joined(names_in(shared), " ")) + " ;;\n  esac\n"
         "  if [[ $word == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n    return\n  fi\n"
         "  if [[ $command == help ]]; then\n"
         "    COMPREPLY=($(compgen -W " + in_single_quotes(joined(names_of_commands(commands), " ")) + " -- \"$word\"))\n    return\n  fi\n"
         "  compopt -o filenames 2> /dev/null\n"
         "  COMPREPLY=($(compgen -f -- \"$word\") $(compgen -W " + in_single_quotes(joined(shipped_scenes(), " ")) + " -- \"$word\"))\n"
         "}\n"
         "complete -F _chainreel chainreel\n";
}

// In a help between brackets, where : and ] mean something.
std::string zsh_words(const std::string& text) {
  std::string words;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') words += '\\';
    words += c;
  }
  return words;
}

std::string zsh_option(const OptionTable& option) {
  const std::vector<std::string> words = values_of(option);
  const std::string action = words.empty()               ? "_files"
                             : words[0].ends_with("=") ? "{compadd -S \"\" -- " + joined(words, " ") + "}"
                                                       : "(" + joined(words, " ") + ")";
  std::string lines;
  for (const std::string& name : option.names)
    lines += " \\\n        " + in_single_quotes("*" + name + "[" + zsh_words(option.help) + "]" +
                                                (option.takes_value ? ":value:" + action : ""));
  return lines;
}

std::string zsh_script(const std::vector<CommandTable>& commands, const CommandTable& shared) {
  std::string list, cases, general;
  for (const OptionTable& option : shared.options) general += zsh_option(option);
  for (const CommandTable& command : commands) {
    list += "    " + in_single_quotes(zsh_words(command.name) + ":" + command.about) + "\n";
    cases += "    " + command.name + ")\n      _arguments -s";
    for (const OptionTable& option : command.options)
      if (!option.is_positional) cases += zsh_option(option);
    cases += command.name == "help" ? " \\\n        '*:topic:(" + joined(names_of_commands(commands), " ") + ")'"
                                    : " \\\n        '*:file:_chainreel_files'";
    cases += "\n      ;;\n";
  }
  return "#compdef chainreel\n# Completion of chainreel in zsh: from the command line's own table.\n"
         "_chainreel_files() {\n  _files\n  compadd -- " + joined(shipped_scenes(), " ") + "\n}\n"
         "_chainreel() {\n  local -a commands\n  local state line\n  commands=(\n" + list + "  )\n"
         "  _arguments -C" + general + " \\\n    '1:command:->command' '*::argument:->argument'\n"
         "  case $state in\n  command) _describe command commands ;;\n"
         "  argument)\n    case $line[1] in\n" + cases + "    esac\n    ;;\n  esac\n}\n"
         "compdef _chainreel chainreel\n";
}

std::string fish_option(const std::string& condition, const OptionTable& option) {
  std::string line = "complete -c chainreel" + condition;
  for (const std::string& name : option.names) line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  const std::vector<std::string> words = values_of(option);
  if (option.takes_value) line += words.empty() ? " -r" : " -x -a " + in_single_quotes(joined(words, " "));
  return line + " -d " + in_single_quotes(option.help) + "\n";
}

std::string fish_script(const std::vector<CommandTable>& commands, const CommandTable& shared) {
  std::string text = "# Completion of chainreel in fish: from the command line's own table.\n";
  for (const OptionTable& option : shared.options) text += fish_option("", option);
  for (const CommandTable& command : commands) {
    text += "complete -c chainreel -f -n __fish_use_subcommand -a " + command.name + " -d " + in_single_quotes(command.about) + "\n";
    const std::string seen = " -n '__fish_seen_subcommand_from " + command.name + "'";
    for (const OptionTable& option : command.options)
      if (!option.is_positional) text += fish_option(seen, option);
  }
  text += "complete -c chainreel -n '__fish_seen_subcommand_from help' -f -a " + in_single_quotes(joined(names_of_commands(commands), " ")) + "\n";
  return text + "complete -c chainreel -n 'not __fish_use_subcommand; and not __fish_seen_subcommand_from help' -a " +
         in_single_quotes(joined(shipped_scenes(), " ")) + "\n";
}

}  // namespace

std::span<const Name> names_of(Shell) {
  return kShells;
}

std::string completion_script(const CommandLine& app, Shell shell) {
  const std::vector<CommandTable> commands = app.tables();
  const CommandTable shared = app.shared_options();
  switch (shell) {
    case Shell::bash:
      return bash_script(commands, shared);
    case Shell::zsh:
      return zsh_script(commands, shared);
    case Shell::fish:
      break;
  }
  return fish_script(commands, shared);
}

}  // namespace chainreel
