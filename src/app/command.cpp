#include "app/command.hpp"

#include <filesystem>
#include <sstream>

#include "core/error.hpp"
#include "scene/quantity.hpp"

namespace chainreel {

void add_common_options(CLI::App& command, CommonOptions& options) {
  add_repeatable(command, "--set", options.set, "override a scene key: --set video.width=640 (repeatable)");
  command.add_flag("--json", options.json, "print the result as JSON on standard output");
  command.add_flag("--quiet", options.quiet, "no progress, no closing words");
  command.add_flag("--force", options.force, "overwrite files outside a folder named out");
}

CLI::Option* add_repeatable(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                            const std::string& help) {
  return command.add_option(name, values, help)
      ->type_size(1)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<double> parse_list(const std::string& text, const std::string& what) {
  std::vector<double> values;
  std::stringstream stream(text);
  for (std::string entry; std::getline(stream, entry, ',');) {
    try {
      values.push_back(parse_quantity(entry, {}));
    } catch (const Error& error) {
      throw Error(ExitCode::usage, what + " " + text + ": " + error.problems().front().message);
    }
  }
  return values;
}

namespace {

std::vector<double> parse_counted(std::size_t count, const Chain& chain, const std::string& text,
                                  const std::string& what) {
  std::vector<double> values = parse_list(text, what);
  if (values.size() != count)
    throw Error(ExitCode::usage, what + " " + text + " has " + std::to_string(values.size()) +
                                     " numbers, but " + chain.name + " needs " + std::to_string(count));
  return values;
}

}  // namespace

std::vector<double> parse_pose(const Chain& chain, const std::string& text, const std::string& what) {
  if (text.empty()) return zero_configuration(chain);
  return parse_counted(std::size_t(chain.nq), chain, text, what);
}

std::vector<double> parse_freedoms(const Chain& chain, const std::string& text, const std::string& what) {
  if (text.empty()) return std::vector<double>(std::size_t(chain.nv));
  return parse_counted(std::size_t(chain.nv), chain, text, what);
}

bool is_model_file(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".urdf" || ending == ".xml";
}

}  // namespace chainreel
