// chainreel help [TOPIC]: the reference, page by page.
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/guide/manual.hpp"
#include "app/guide/reference.hpp"
#include "app/report/version.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "core/json.hpp"
#include "scene/keys/schema.hpp"

namespace chainreel {
namespace {

struct HelpOptions {
  std::string topic;
  bool man = false;
  CommonOptions common;
};

std::string commands_page(const CommandLine& app) {
  std::vector<std::vector<std::string>> table{{"command", "what it is for"}};
  std::string texts;
  for (const CommandLine::CommandText& command : app.texts()) {
    table.push_back({code(command.name), command.about});
    texts += "\n## " + command.name + "\n\n" + code_block("text", command.help);
  }
  return "# Commands\n\n" + markdown_table(table) + texts;
}

// Pages that people wrote, as far as they lie beside the program.
std::vector<GuidePage> written_pages() {
  constexpr std::array<std::pair<const char*, const char*>, 6> kWritten = {
      {{"using", "what the keys of a scene can do together"},
       {"snapshots", "suites of pictures for CI: what verify reads"},
       {"which-method", "which integrator when"},
       {"cluster", "parts of films and sweeps on many machines"},
       {"library", "the same from C++ and Python"},
       {"trust", "what can be trusted, and how it is tested"}}};
  std::vector<GuidePage> pages;
  const std::string folder = data_folder() + "/assets/guide/";
  for (const auto& [topic, about] : kWritten) {
    const std::string path = folder + topic + ".md";
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) pages.push_back({topic, about, [path] { return read_plain_file(path); }});
  }
  return pages;
}

void list_topics(const std::vector<GuidePage>& pages, bool json) {
  Json list = Json::array();
  std::vector<std::vector<std::string>> table{{"topic", "what it tells"}};
  for (const GuidePage& page : pages) {
    table.push_back({page.topic, page.about});
    list.push_back({{"topic", page.topic}, {"about", page.about}});
  }
  if (json)
    print_json({{"topics", list}});
  else
    std::fputs((markdown_table(table) + "\nchainreel help TOPIC prints one of them, or how a command is called.\n").c_str(),
               stdout);
}

void run_help(const HelpOptions& options, const CommandLine& app) {
  if (options.man && options.common.json) throw Error(ExitCode::usage, "--man prints a manual page, --json the same as JSON: take one");
  if (options.man) return void(std::fputs(manual_page(app, program_version(), options.topic).c_str(), stdout));
  std::vector<GuidePage> pages = guide_pages(app);
  for (GuidePage& page : written_pages()) pages.push_back(std::move(page));
  const std::string topic = options.topic == "suite" ? "snapshots" : options.topic;
  if (options.topic.empty()) return list_topics(pages, options.common.json);
  const std::optional<std::size_t> columns = terminal_columns();
  std::vector<std::string> known;
  const auto tell = [&](const std::string& text) {
    if (options.common.json)
      print_json({{"topic", options.topic}, {"text", text}});
    else
      std::fputs((columns ? page_on_terminal(text, *columns) : text).c_str(), stdout);
  };
  for (const GuidePage& page : pages) {
    if (page.topic == topic) return tell(page.text());
    known.push_back(page.topic);
  }
  for (const CommandLine::CommandText& command : app.texts()) {
    if (command.name == options.topic) return tell(command.help);
    known.push_back(command.name);
  }
  throw Error(ExitCode::usage, "there is no help on '" + options.topic + "':" + did_you_mean(options.topic, known) +
                                   " `chainreel help` lists the topics");
}

}  // namespace

std::vector<GuidePage> guide_pages(const CommandLine& app) {
  return {{"scene", "every key of a scene: its values, unit, range and default", scene_page},
          {"layers", "what a picture may show", layers_page},
          {"formulas", "notation of formulas in titles and words", formulas_page},
          {"expressions", "names, operators and functions", expressions_page},
          {"constraints", "what ties a mechanism beyond its joints", constraints_page},
          {"symbols", "what the letters mean, and which sign has what", symbols_page},
          {"methods", "the integrators, and how exact a run is", methods_page},
          {"outputs", "kinds of files, and presets", outputs_page},
          {"json", "what --json prints: the keys of every command", json_page},
          {"commands", "every command with its options", [&app] { return commands_page(app); }},
          {"exit-codes", "what the program's status says", exit_codes_page}};
}

void add_help_command(CommandLine& app) {
  auto options = std::make_shared<HelpOptions>();
  Command* command = app.add_subcommand("help", "the reference and the guide: scene, methods, using, snapshots, ..");
  command->add_option("topic", options->topic, "a topic or a command; without it the topics are listed");
  command->add_flag("--man", options->man, "print chainreel(1), or the manual page of a command: chainreel help render --man | man -l -");
  add_json_option(*command, options->common);
  command->footer("Example: chainreel help scene");
  command->callback([options, &app] { run_help(*options, app); });
}

// chainreel completion SHELL: what makes a shell complete the program's words.

void add_completion_command(CommandLine& app) {
  auto shell = std::make_shared<std::string>();
  Command* command = app.add_subcommand("completion", "a script by which bash, zsh or fish completes words of the command line");
  command->add_option("shell", *shell, "whose script").required().one_of(words_of(names_of(Shell{})));
  command->footer(
      "The Debian package installs all three. By hand: bash reads it by source <(chainreel completion bash).\n"
      "Example: chainreel completion fish > ~/.config/fish/completions/chainreel.fish");
  command->callback([shell, &app] { std::fputs(completion_script(app, *value_named<Shell>(*shell)).c_str(), stdout); });
}

// chainreel schema: the keys of a scene as a JSON Schema, for editors.

void add_schema_command(CommandLine& app) {
  Command* command = app.add_subcommand("schema", "a JSON Schema of scene files, for completion in editors");
  command->footer(
      "Into a file, and with the first line of a scene, editors with a YAML server complete and check it:\n"
      "# yaml-language-server: $schema=scene.schema.json\n"
      "Example: chainreel schema > scene.schema.json");
  command->callback([] { print_json(scene_schema()); });
}

}  // namespace chainreel
