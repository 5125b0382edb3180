#include "app/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <deque>
#include <sstream>

#include "core/data_folder.hpp"
#include "app/cli/streams.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {
namespace {

CLI::Option* option_of(void* pointer) {
  return static_cast<CLI::Option*>(pointer);
}

CLI::App* app_of(void* pointer) {
  return static_cast<CLI::App*>(pointer);
}

// On what was found elsewhere than where it was named; said when the command begins, unless it is to be quiet.
std::vector<std::string>& notes() {
  static std::vector<std::string> list;
  return list;
}

// What a variable of the shell leaves that is not set is no value.
CLI::Option* refusing_empty(CLI::Option* option) {
  return option->check(CLI::Validator(
      [](const std::string& word) { return word.empty() ? std::string("is empty, as a variable of the shell is that is not set: leave it out, or give it a value") : std::string(); }, ""));
}

template <class Target>
Option add_to(void* command, const std::string& name, Target& target, const std::string& help) {
  return Option(app_of(command)->add_option(name, target, help));
}

}  // namespace

Option Option::required() {
  option_of(option_)->required();
  return *this;
}

Option Option::range(int least, int most) {
  option_of(option_)->check(CLI::Range(least, most));
  return *this;
}

Option Option::positive() {
  option_of(option_)->check(CLI::PositiveNumber);
  return *this;
}

Option Option::one_of(std::vector<std::string> words) {
  option_of(option_)->check(CLI::IsMember(std::move(words)));
  return *this;
}

Option Option::show_default() {
  // In words of our own: the library's versions write defaults each in their way.
  CLI::Option* const option = option_of(option_);
  option->capture_default_str();
  option->description(option->get_description() + " (default " + option->get_default_str() + ")");
  option->default_str("");
  return *this;
}

Option Option::names_input(const std::string& ending) {
  option_of(option_)->transform(CLI::Validator(
      [ending](std::string& named) {
        if (named == "-") {
          named = read_standard_input();
          return std::string();
        }
        const std::string found = found_file(named, ending);
        if (const std::string note = found_elsewhere(named, found); !note.empty()) notes().push_back(note);
        named = found;
        return std::string();
      },
      ""));
  return *this;
}

bool Option::given() const {
  return option_of(option_)->count() > 0;
}

Option Command::add_option(const std::string& name, std::string& target, const std::string& help) {
  return Option(refusing_empty(app_of(command_)->add_option(name, target, help)));
}

Option Command::add_option(const std::string& name, int& target, const std::string& help) {
  return add_to(command_, name, target, help);
}

Option Command::add_option(const std::string& name, double& target, const std::string& help) {
  return add_to(command_, name, target, help);
}

Option Command::add_option(const std::string& name, std::vector<std::string>& target, const std::string& help) {
  return Option(refusing_empty(app_of(command_)->add_option(name, target, help)));
}

Option Command::add_repeatable(const std::string& name, std::vector<std::string>& target,
                               const std::string& help) {
  return Option(refusing_empty(app_of(command_)->add_option(name, target, help))
                    ->type_size(1)
                    ->expected(1)
                    ->allow_extra_args(false)
                    ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}

Option Command::add_names(const std::string& name, std::vector<std::string>& target, const std::string& help) {
  return Option(app_of(command_)->add_option(name, target, help)->expected(0, CLI::detail::expected_max_vector_size));
}

Option Command::add_flag(const std::string& name, bool& target, const std::string& help) {
  return Option(app_of(command_)->add_flag(name, target, help));
}

void Command::footer(const std::string& text) {
  app_of(command_)->footer(text);
}

void Command::callback(std::function<void()> run) {
  CLI::App* const app = app_of(command_);
  app->callback([app, run = std::move(run)] {
    const CLI::Option* const quiet = app->get_option_no_throw("--quiet");
    if (quiet == nullptr || quiet->count() == 0)
      for (const std::string& note : notes()) std::fprintf(stderr, "note: %s\n", note.c_str());
    notes().clear();
    run();
  });
}

std::vector<std::string> Command::words() const {
  std::vector<std::string> words;
  for (Word& word : all_words()) words.push_back(std::move(word.text));
  return words;
}

std::vector<std::size_t> Command::files() const {
  std::vector<std::size_t> files;
  const std::vector<Word> words = all_words();
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i].is_file) files.push_back(i);
  return files;
}

std::vector<Command::Word> Command::all_words() const {
  const CLI::App& app = *app_of(command_);
  std::vector<Word> words{{app.get_name()}};
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_single_name();
    if (option->count() == 0 || name == "output" || name == "force" || name == "quiet" || name == "json" || name == "jobs") continue;
    const bool is_flag = option->get_items_expected_max() == 0;
    for (const std::string& value : is_flag ? std::vector<std::string>{""} : option->results()) {
      if (!option->get_positional()) words.push_back({"--" + name});
      if (!is_flag) words.push_back({value, option->get_positional() || name == "along" || name == "trajectory" || name == "package"});
    }
  }
  return words;
}

namespace {

std::string words_not_expected(const std::vector<std::string>& words) {
  std::string text = words.size() == 1 ? "The following argument was not expected:" : "The following arguments were not expected:";
  for (const std::string& word : words) text += " " + word;
  const auto is_number = [](const std::string& word) {
    const std::size_t digit = word.find_first_not_of("+-.");
    return digit != std::string::npos && digit <= 2 && word[digit] >= '0' && word[digit] <= '9';
  };
  if (std::all_of(words.begin(), words.end(), is_number)) text += "; the numbers of an option stand together, with commas: --q 0,-45deg";
  return text;
}

// " a scene has the key 'video.width': --set video.width=.." where a key's last word is the option's.
std::string key_like(const std::string& name, const CLI::App& command) {
  if (command.get_option_no_throw("--set") == nullptr) return "";
  for (const SceneKey& key : scene_keys())
    if (!key.is_section && key.leaf() == name) return " scenes have the key '" + key.name + "': --set " + key.name + "=VALUE";
  return "";
}

// Of the first option that the command does not have: those that resemble it.
std::string options_like(const std::vector<std::string>& words, const CLI::App& command, const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::App* owner : {&command, &app})
    for (const CLI::Option* option : owner->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back(name);
  for (const std::string& word : words) {
    if (!word.starts_with("--")) continue;
    const std::string name = word.substr(2, word.find('=') - 2);
    std::string near = did_you_mean(name, known);
    for (std::size_t at = 0; (at = near.find(" '", at)) != std::string::npos; at += 4) near.insert(at + 2, "--");
    if (near.empty()) near = key_like(name, command);
    return near.empty() ? "" : ";" + near;
  }
  return "";
}

// The words that a command does not know, in their order.
std::string words_unknown_to(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  const CLI::App& command = *app.get_subcommands().front();
  const bool is_former = std::any_of(words.begin(), words.end(), [](const std::string& word) { return word.starts_with("--threads"); });
  return words_not_expected(words) + (is_former && command.get_option_no_throw("--jobs") != nullptr ? "; --threads is called --jobs"
                                                                                                    : options_like(words, command, app));
}

// A scene in a command's place means its film.
bool names_a_scene(const std::string& word) {
  return word.ends_with(".yaml") || word.ends_with(".yml");
}

int refuse(const std::string& why) {
  std::fprintf(stderr, "%s\nRun with --help for more information.\n", why.c_str());
  return int(ExitCode::usage);
}

}  // namespace

struct CommandLine::Parser {
  CLI::App app;
  std::deque<Command> commands;  // their addresses stay

  explicit Parser(const std::string& about) : app(about) {}
};

CommandLine::CommandLine(const std::string& name, const std::string& about, const std::string& version,
                         const std::string& footer)
    : parser_(std::make_unique<Parser>(about)) {
  parser_->app.name(name);
  parser_->app.require_subcommand(1);
  parser_->app.set_version_flag("--version", version);
  parser_->app.footer(footer);
}

CommandLine::~CommandLine() = default;

Command* CommandLine::add_subcommand(const std::string& name, const std::string& about) {
  return &parser_->commands.emplace_back(parser_->app.add_subcommand(name, about)->fallthrough());
}

void CommandLine::add_choice(const std::string& name, const std::string& variable, std::vector<std::string> words,
                             const std::string& help, std::function<void(const std::string&)> take) {
  parser_->app.add_option_function<std::string>(name, std::move(take), help)
      ->check(CLI::IsMember(std::move(words)))
      ->envname(variable);
}

std::vector<CommandLine::CommandText> CommandLine::texts() const {
  std::vector<CommandText> texts;
  for (const CLI::App* one : parser_->app.get_subcommands([](const CLI::App*) { return true; }))
    texts.push_back({one->get_name(), one->get_description(), one->help(parser_->app.get_name())});
  return texts;
}

namespace {

// The words between braces in what CLI11 calls the type: "TEXT:{rod,point}".
std::vector<std::string> words_of_type(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return separated(type.substr(open + 1, close - open - 1), ',');
}

CommandLine::CommandTable table_of(const CLI::App& app) {
  CommandLine::CommandTable table{app.get_name(), app.get_description(), app.get_footer(), {}};
  for (const CLI::Option* one : app.get_options()) {
    CommandLine::OptionTable option;
    for (const std::string& name : one->get_snames()) option.names.push_back("-" + name);
    for (const std::string& name : one->get_lnames()) option.names.push_back("--" + name);
    option.is_positional = option.names.empty();
    if (option.is_positional) option.names = {one->get_name(true)};
    option.help = one->get_description();
    option.words = words_of_type(one->get_type_name());
    option.takes_value = one->get_items_expected_max() > 0;
    option.is_required = one->get_required();
    table.options.push_back(std::move(option));
  }
  return table;
}

}  // namespace

std::vector<CommandLine::CommandTable> CommandLine::tables() const {
  std::vector<CommandTable> tables;
  for (const CLI::App* one : parser_->app.get_subcommands([](const CLI::App*) { return true; })) tables.push_back(table_of(*one));
  return tables;
}

CommandLine::CommandTable CommandLine::shared_options() const {
  return table_of(parser_->app);
}

int CommandLine::run(int argc, char** argv) {
  std::vector<char*> given(argv, argv + argc);
  std::string render = "render";
  if (argc > 1 && names_a_scene(argv[1])) given.insert(given.begin() + 1, render.data());
  try {
    parser_->app.parse(int(given.size()), given.data());
  } catch (const CLI::ExtrasError&) {
    return refuse(words_unknown_to(parser_->app));
  } catch (const CLI::RequiredError& error) {
    // Of a command without what it needs it says so first, though a word may have been mistyped.
    const auto is_option = [](const std::string& word) { return word.starts_with("--"); };
    const std::vector<std::string> unknown = parser_->app.remaining(true);
    if (!parser_->app.get_subcommands().empty() && std::any_of(unknown.begin(), unknown.end(), is_option))
      return refuse(words_unknown_to(parser_->app));
    // Of an unknown command it says that there is none.
    if (!parser_->app.get_subcommands().empty() || argc < 2) return refuse(error.what());
    const std::vector<std::string> words = parser_->app.remaining();
    if (words.empty()) return refuse(error.what());
    std::vector<std::string> names;
    for (const CLI::App* one : parser_->app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(one->get_name());
    const std::string near = did_you_mean(words.front(), names);
    return refuse("There is no command '" + words.front() + "'" + (near.empty() ? "" : ":" + near));
  } catch (const CLI::ParseError& error) {
    // By way of the C streams, which are guarded; CLI11 would write to those of C++.
    std::ostringstream out, err;
    const int status = parser_->app.exit(error, out, err);
    std::fputs(out.str().c_str(), stdout);
    std::fputs(err.str().c_str(), stderr);
    return status == 0 ? int(ExitCode::good) : int(ExitCode::usage);
  }
  return int(ExitCode::good);
}

}  // namespace chainreel
