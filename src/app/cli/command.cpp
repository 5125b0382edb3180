#include "app/cli/command.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/cli/streams.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/json.hpp"
#include "model/chain.hpp"
#include "model/followers.hpp"
#include "scene/quantity.hpp"
#include "scene/run/grid.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/unread.hpp"
#include "scene/scene.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kMostPanels = 12;

}  // namespace

void add_scene_options(Command& command, CommonOptions& options) {
  command.add_repeatable("--set", options.set, "override a scene key: --set duration=2 (repeatable)");
  command.add_repeatable("--package", options.package,
                 "where package://NAME lies: --package NAME=folder (repeatable)");
  command.add_option("--base", options.base, "how the root link is held")
      .one_of(words_of(names_of(RootLink{})));
}

void add_json_option(Command& command, CommonOptions& options) {
  command.add_flag("--json", options.json, "print the result as JSON on standard output");
}

void add_quiet_option(Command& command, CommonOptions& options) {
  command.add_flag("--quiet", options.quiet, "no progress, no closing words");
}

void add_force_option(Command& command, CommonOptions& options) {
  command.add_flag("--force", options.force, "overwrite files outside a folder named out");
}

void add_panel_option(Command& command, int& panel) {
  command.add_option("--panel", panel, "one panel of a scene that compares several, from 1").range(1, int(kMostPanels));
}

void add_result_options(Command& command, CommonOptions& options) {
  add_json_option(command, options);
  add_quiet_option(command, options);
  add_force_option(command, options);
}

namespace {

// name=folder; folders are relative to where the program runs.
std::pair<std::string, std::string> parse_package(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(ExitCode::usage, "--package takes name=folder, not '" + text + "'");
  std::error_code code;
  const std::filesystem::path folder = std::filesystem::absolute(text.substr(equals + 1), code);
  if (code) throw Error(ExitCode::usage, "--package " + text + ": " + code.message());
  return {text.substr(0, equals), folder.string()};
}

}  // namespace

std::vector<std::string> overrides_of(const CommonOptions& options) {
  std::vector<std::string> overrides = options.set;
  if (!options.base.empty()) overrides.push_back("base=" + options.base);
  for (const std::string& text : options.package) {
    const auto [name, folder] = parse_package(text);
    overrides.push_back("packages." + name + "=" + Json(folder).dump());  // a JSON text is YAML too
  }
  add_overrides(options.flags, overrides);
  return overrides;
}

void add_vary_option(Command& command, std::vector<std::string>& vary) {
  command.add_repeatable("--vary", vary,
                 "show variants of the scene side by side: KEY=a,b,c or KEY=from:to:count, like "
                 "method=explicit_euler,rk4,taylor");
}

namespace {

// A layout that a scene has for its one run, where none is asked for: panels need another one.
PageLayout own_layout(const std::string& scene, const std::vector<std::string>& overrides) {
  if (std::ranges::any_of(overrides, [](const std::string& one) { return one.starts_with("layout="); })) return PageLayout::automatic;
  try {
    return read_scene(scene, overrides).layout;
  } catch (const Error&) {
    return PageLayout::automatic;  // what is wrong is told when the scene is read with its panels
  }
}

}  // namespace

void add_comparison(const std::vector<std::string>& vary, const std::string& scene, bool quiet, std::vector<std::string>& overrides) {
  if (vary.empty()) return;
  const Grid grid(vary, "--vary");
  if (grid.size() > kMostPanels)
    throw Error(ExitCode::usage, "--vary makes " + std::to_string(grid.size()) + " panels; no more than " +
                                     std::to_string(kMostPanels) + " fit a page: give fewer values");
  std::string list;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const std::vector<std::size_t> at = grid.places(k);
    std::string panel;
    for (std::size_t i = 0; i < at.size(); ++i)
      panel += (i == 0 ? "" : ", ") + Json(grid.axes()[i].key).dump() + ": " + grid.axes()[i].values[at[i]] + grid.axes()[i].unit;
    list += (list.empty() ? "{" : ", {") + panel + "}";
  }
  for (const std::string& one : overrides)
    if (one.starts_with("compare=")) throw Error(ExitCode::usage, "--vary makes the panels that --set compare= lists: leave one of them out");
  if (const PageLayout own = own_layout(scene, overrides); own != PageLayout::automatic && !is_of_panels(own)) {
    overrides.insert(overrides.begin(), "layout=");
    if (!quiet) std::fprintf(stderr, "note: layout '%s' shows one run: that of a comparison is taken instead\n", to_string(own).c_str());
  }
  overrides.insert(overrides.begin(), "compare=[" + list + "]");  // what else is set may be of its panels
}

void require_varied_read(const std::vector<std::string>& vary, const Scene& scene) {
  if (vary.empty()) return;
  const Grid grid(vary, "--vary");
  for (const Sweep& axis : grid.axes()) require_read(axis.key, scene, "--vary");
}

std::vector<double> parse_list(const std::string& text, const std::string& what, const std::string& in) {
  std::vector<double> values;
  for (const std::string& entry : separated(text, ',')) {
    try {
      values.push_back(parse_quantity(entry, {}, in));
    } catch (const Error& error) {
      throw Error(ExitCode::usage, what + " " + text + ": " + error.problems().front().message);
    }
  }
  return values;
}

std::optional<std::size_t> coordinate_of(const Chain& chain, const std::string& name) {
  const std::vector<std::string> names = position_names(chain);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (name == names[i] || name == "q" + std::to_string(i + 1)) return i;
  return std::nullopt;
}

namespace {

std::string after_semicolon(const std::string& words) {
  return words.empty() ? "" : "; " + words;
}

// A number for each of `names`. `written`: the same as they stand in the text, one each.
std::vector<double> parse_counted(const std::vector<std::string>& names, const Chain& chain, const std::string& text,
                                  const std::string& what, StateNumbers numbers, std::vector<std::string>& written) {
  constexpr std::size_t kMostNamed = 300;  // bytes
  std::vector<double> values = parse_list(text, what);
  const auto [repeated, contradiction] =
      numbers == StateNumbers::tau ? FollowerNumbers{} : numbers_of_followers(chain, values, numbers == StateNumbers::qd);
  take_out(values, repeated);
  if (written.size() == values.size() + repeated.size()) take_out(written, repeated);
  if (values.size() != names.size())
    throw Error(ExitCode::usage, what + " " + text + " has " + std::to_string(values.size()) +
                                     (values.size() == 1 ? " number" : " numbers") + ", but " + chain.name + " needs " +
                                     std::to_string(names.size()) + ": of " + shortened(joined(names), kMostNamed) +
                                     after_semicolon(contradiction.empty() ? shortened(followers_of(chain), kMostNamed) : contradiction));
  return values;
}

// `written`: the numbers as they stand in the text, "" where they do not.
std::vector<double> pose_by_name(const Chain& chain, const std::vector<std::string>& entries, const std::string& text,
                                 const std::string& what, std::vector<std::string>& written) {
  const std::vector<std::string> names = position_names(chain);
  std::vector<double> q = zero_configuration(chain);
  std::vector<bool> is_set(q.size());
  written.assign(q.size(), "");
  for (const std::string& entry : entries) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos)
      throw Error(ExitCode::usage, what + " " + text + ": '" + entry + "' names no joint: name all or none, like " + names[0] + "=90deg");
    const std::string name = entry.substr(0, equals), number = entry.substr(equals + 1);
    const std::optional<std::size_t> at = coordinate_of(chain, name);
    if (!at)
      throw Error(ExitCode::usage, what + " " + text + ": " + chain.name + " has no coordinate '" + name + "':" +
                                       did_you_mean(name, names) + " It has " + joined(names) + after_semicolon(followers_of(chain)));
    if (is_set[*at]) throw Error(ExitCode::usage, what + " " + text + ": names " + name + " twice");
    is_set[*at] = true;
    const std::vector<double> value = parse_list(number, what);
    if (value.empty()) throw Error(ExitCode::usage, what + " " + text + ": " + name + " has no number behind the =");
    q[*at] = value[0];
    written[*at] = number;
  }
  return q;
}

}  // namespace

double parse_seconds(const std::string& text, const std::string& option) {
  try {
    return parse_quantity(text, {}, "s");
  } catch (const Error& error) {
    throw Error(ExitCode::usage, option + " takes seconds, like 1.2, 1.2s or 20ms: " + error.problems().front().message);
  }
}

double parse_positive_seconds(const std::string& text, const std::string& option, const std::string& example) {
  const double seconds = parse_seconds(text, option);
  if (!(seconds > 0)) throw Error(ExitCode::usage, option + " takes seconds above 0, like " + example + "; not '" + text + "'");
  return seconds;
}

std::vector<double> parse_pose(const Chain& chain, const std::string& text, const std::string& what) {
  if (text.empty()) return zero_configuration(chain);
  const std::vector<std::string> entries = separated(text, ',');
  std::vector<std::string> written = entries;
  const std::vector<double> q = text.find('=') != std::string::npos ? pose_by_name(chain, entries, text, what, written)
                                                                    : parse_counted(position_names(chain), chain, text, what, StateNumbers::q, written);
  if (const std::string trouble = trouble_of_units(chain, written, StateNumbers::q); !trouble.empty())
    throw Error(ExitCode::usage, what + " " + text + ": " + trouble);
  for (const std::string& doubt : doubts_of_pose(chain, q, written))
    tell_warning(what + ": " + doubt);
  if (const std::string trouble = trouble_of_pose(chain, q); !trouble.empty())
    throw Error(ExitCode::usage, what + " " + text + ": " + trouble);
  return q;
}

std::vector<std::vector<double>> parse_poses(const Chain& chain, const std::vector<std::string>& texts,
                                             const std::string& what) {
  std::vector<std::vector<double>> poses;
  for (const std::string& text : texts) poses.push_back(parse_pose(chain, text, what));
  return poses;
}

std::vector<double> parse_freedoms(const Chain& chain, const std::string& text, const std::string& what, StateNumbers numbers) {
  if (text.empty()) return std::vector<double>(std::size_t(chain.nv));
  std::vector<std::string> written = separated(text, ',');
  const std::vector<double> values = parse_counted(chain.coordinate_names, chain, text, what, numbers, written);
  if (const std::string trouble = trouble_of_units(chain, written, numbers); !trouble.empty())
    throw Error(ExitCode::usage, what + " " + text + ": " + trouble);
  return values;
}

std::string gravity_override(const std::string& text) {
  const std::vector<double> g = parse_list(text, "--gravity", "m/s^2");
  if (g.size() != 3)
    throw Error(ExitCode::usage, "--gravity takes three numbers, world x,y,z: --gravity 0,-9.81,0");
  return "gravity=[" + format_shortest(g[0]) + ", " + format_shortest(g[1]) + ", " + format_shortest(g[2]) + "]";
}

bool is_model_file(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".urdf" || ending == ".xml";
}

void add_scene_flags(Command& command, FlagValues& values, FlagGroup group) {
  for (const SceneKey& key : scene_keys())
    if (key.flags == group) command.add_option(key.flag, values[key.name], key.name + ": " + short_help(key));
}

void add_overrides(const FlagValues& values, std::vector<std::string>& overrides) {
  for (const auto& [key, value] : values)
    if (!value.empty()) overrides.push_back(key + "=" + value);
}

namespace {

std::string given(const FlagValues& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? "" : found->second;
}

}  // namespace

ThemeName theme_of(const FlagValues& values) {
  const std::string name = given(values, "theme");
  if (name.empty()) return Scene{}.theme;
  if (const auto theme = value_named<ThemeName>(name)) return *theme;
  throw Error(ExitCode::usage, "--theme takes " + alternatives(names_of(ThemeName{})) + ", not '" + name + "'");
}

double text_scale_of(const FlagValues& values) {
  const std::string text = given(values, "text_scale");
  if (text.empty()) return Scene{}.text_scale;
  const KeyRange range = find_key("text_scale")->range;
  const auto scale = parse_number(text);
  if (!scale || !range.holds(*scale))
    throw Error(ExitCode::usage, "--text-scale takes a number " + range_text(range, "") + ", not '" + text + "'");
  return *scale;
}

}  // namespace chainreel
