// Manual pages in roff.
#include <algorithm>

#include "app/guide/manual.hpp"
#include "app/guide/reference.hpp"
#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

using CommandTable = CommandLine::CommandTable;
using OptionTable = CommandLine::OptionTable;

// Text between macros: nothing in it is taken for a command of roff. Lists without spaces may go on in the next line.
std::string roff(const std::string& text) {
  std::string result;
  bool at_start = true;
  for (const char c : text) {
    if (result.ends_with(',') && c != ' ' && c != '\n') result += "\\:";
    if (at_start && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '\'')
      result += "\\(aq";
    else if (c == '`')
      result += "\\(ga";
    else
      result += c;
    at_start = c == '\n';
  }
  return result;
}

// Lines of their own stay so.
std::string roff_lines(const std::string& text) {
  std::string result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    result += (at == 0 ? "" : ".br\n") + roff(text.substr(at, end - at)) + "\n";
    at = end + 1;
  }
  return result;
}

std::string head(const std::string& name, const std::string& about, const std::string& version) {
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return char(c >= 'a' && c <= 'z' ? c - 32 : c); });
  return ".TH " + title + " 1 \"\" \"chainreel " + version + "\" \"User Commands\"\n.SH NAME\n" + roff(name) + " \\- " +
         roff(about) + "\n";
}

std::string options_text(const CommandTable& command) {
  std::string text;
  for (const OptionTable& option : command.options) {
    std::vector<std::string> names;
    for (const std::string& name : option.names) names.push_back("\\fB" + roff(name) + "\\fR");
    text += ".TP\n" + joined(names, ", ");
    if (option.takes_value && !option.is_positional)
      text += " " + (option.words.empty() ? "\\fIvalue\\fR" : roff(joined(option.words, "|")));
    text += "\n" + roff(option.help) + (option.is_required ? " (needed)" : "") + "\n";
  }
  return text;
}

std::string see_also(const std::vector<CommandTable>& commands) {
  std::string text = ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < commands.size(); ++i)
    text += ".BR chainreel\\-" + roff(commands[i].name) + " (1)" + (i + 1 < commands.size() ? "," : "") + "\n";
  return text;
}

std::string page_of_program(const std::vector<CommandTable>& commands, const CommandTable& shared, const std::string& version) {
  // Behind its own name, which the help begins with.
  std::string text = head("chainreel", shared.about.substr(shared.about.find(": ") + 2), version);
  text += ".SH SYNOPSIS\n.B chainreel\n.I command\n[\\fIoptions\\fR] ...\n";
  text += ".SH DESCRIPTION\n" +
          roff("A scene is some ten lines of YAML: a model, what drives it, what the film shows. `chainreel init my_arm` writes one "
               "with comments, `chainreel render my_arm.yaml` makes its film. Scenes that come with the program are known by "
               "their name: `chainreel render rr_free`.") +
          "\n.SH COMMANDS\n";
  for (const CommandTable& command : commands) text += ".TP\n\\fB" + roff(command.name) + "\\fR\n" + roff(command.about) + "\n";
  text += ".SH OPTIONS\n" + options_text(shared);
  text += ".SH EXIT STATUS\n" + roff(exit_code_words()) + ".\n";
  text += ".SH ENVIRONMENT\n.TP\n.B CHAINREEL_GL\nas " + roff("--gl") + "\n.TP\n.B CHAINREEL_WARNINGS\nas " + roff("--warnings") + "\n";
  text += ".SH FILES\n.TP\n.I share/chainreel/assets/scenes\nscenes that are known by their name\n.TP\n.I share/chainreel/models\ntheir "
          "models\n.TP\n.I share/chainreel/assets/guide\nthe guide; its reference is also told by " + roff("`chainreel help`") + "\n";
  return text + see_also(commands);
}

std::string page_of_command(const CommandTable& command, const std::string& version) {
  std::string text = head("chainreel-" + command.name, command.about, version) + ".SH SYNOPSIS\n.B chainreel " + roff(command.name) + "\n[\\fIoptions\\fR]";
  for (const OptionTable& option : command.options)
    if (option.is_positional) text += " \\fI" + roff(option.names.front()) + "\\fR";
  text += "\n.SH OPTIONS\n" + options_text(command);
  text += ".SH NOTES\n" + roff_lines(command.footer);
  return text + ".SH SEE ALSO\n.BR chainreel (1)\n";
}

}  // namespace

std::string manual_page(const CommandLine& app, const std::string& version, const std::string& command) {
  const std::vector<CommandTable> commands = app.tables();
  if (command.empty()) return page_of_program(commands, app.shared_options(), version);
  std::vector<std::string> names;
  for (const CommandTable& one : commands) {
    if (one.name == command) return page_of_command(one, version);
    names.push_back(one.name);
  }
  throw Error(ExitCode::usage, "there is no command '" + command + "':" + did_you_mean(command, names) + " `chainreel help` lists the topics");
}

}  // namespace chainreel
