// The command line: one file per subcommand, each with an options struct, a function that registers it and
// one that runs it. What a command throws is caught once, in main.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command_line.hpp"
#include "model/read_chain.hpp"
#include "scene/run/pose_doubts.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {

// Keys of a scene that have a flag of their own: --theme dark says what --set theme=dark does. Which ones is in the table
// of keys; what a flag says is in overrides_of(CommonOptions), so a command takes a group of flags by one line where it
// is registered.

// What the command line says of the keys, by key; keys that it leaves out hold "".
using FlagValues = std::map<std::string, std::string>;

// `values` must outlive the command.
void add_scene_flags(Command& command, FlagValues& values, FlagGroup group);
// Appends "theme=dark" for each flag that was given.
void add_overrides(const FlagValues& values, std::vector<std::string>& overrides);

// The same two keys where there is no scene to read them. Throw Error (usage) naming the flag.
ThemeName theme_of(const FlagValues& values);
double text_scale_of(const FlagValues& values);

// What several subcommands take; each offers those of them that it honours, and no others.
struct CommonOptions {
  std::vector<std::string> set;      // key=value over the scene's keys
  std::vector<std::string> package;  // name=folder for package:// in a model
  std::string base;                  // fixed or floating; "": as the scene says
  FlagValues flags;                  // keys of the scene as flags, where the command has any
  bool json = false;
  bool quiet = false;
  bool force = false;
};

// --set, --package and --base: of all that reads a scene or a model.
void add_scene_options(Command& command, CommonOptions& options);
void add_json_option(Command& command, CommonOptions& options);
void add_quiet_option(Command& command, CommonOptions& options);
void add_force_option(Command& command, CommonOptions& options);
// The last three: of what writes a file and can tell of it.
void add_result_options(Command& command, CommonOptions& options);

// --panel, which chosen_panel takes.
void add_panel_option(Command& command, int& panel);

// `set` with what the other options say in the words of a scene.
std::vector<std::string> overrides_of(const CommonOptions& options);

void add_vary_option(Command& command, std::vector<std::string>& vary);
// Adds what --vary KEY=a,b,c says in the words of a scene, as its key `compare`: a panel a value, with several
// options a panel a combination; a layout of one run that the scene has is left out, which is said. Throws Error (usage)
// for more than twelve panels.
void add_comparison(const std::vector<std::string>& vary, const std::string& scene, bool quiet, std::vector<std::string>& overrides);
// Throws Error (usage) where what varies is a parameter that nothing in the scene reads.
void require_varied_read(const std::vector<std::string>& vary, const Scene& scene);

// "0,90deg" as numbers; `what` names the option in the error, `in` the unit as parse_quantity has it.
std::vector<double> parse_list(const std::string& text, const std::string& what, const std::string& in = "");

// An instant or a span of the command line, s: 1.2, 1.2s, 20ms. Throws Error (usage) naming the option.
double parse_seconds(const std::string& text, const std::string& option);
// The same of what must be above 0; the error gives `example`.
double parse_positive_seconds(const std::string& text, const std::string& option, const std::string& example);

// The place of q1, q2, .. or of a coordinate's name among the chain's; none where it has no such.
std::optional<std::size_t> coordinate_of(const Chain& chain, const std::string& name);

// A pose of the chain from "0,90deg", as many numbers as it has coordinates, or from "elbow=90deg,q3=0.3", where joints
// that are not named stand at zero. Angles that can only be meant in degrees are said to be radians.
std::vector<double> parse_pose(const Chain& chain, const std::string& text, const std::string& what);
// The same for each text of a repeatable option.
std::vector<std::vector<double>> parse_poses(const Chain& chain, const std::vector<std::string>& texts,
                                             const std::string& what);
// One number a freedom, rates or torques; empty text gives zeros.
std::vector<double> parse_freedoms(const Chain& chain, const std::string& text, const std::string& what, StateNumbers numbers);

// "gravity=[0, -9.81, 0]" from "0,-9.81,0", as scenes say it.
std::string gravity_override(const std::string& text);

// A file that names a mechanism, not a scene: .urdf or .xml.
bool is_model_file(const std::string& path);

void add_render_command(CommandLine& app);
void add_join_command(CommandLine& app);
void add_bench_command(CommandLine& app);
void add_snapshot_command(CommandLine& app);
void add_ellipse_command(CommandLine& app);
void add_simulate_command(CommandLine& app);
void add_extract_command(CommandLine& app);
void add_compare_command(CommandLine& app);
void add_dynamics_command(CommandLine& app);
void add_inverse_command(CommandLine& app);
void add_init_command(CommandLine& app);
void add_check_command(CommandLine& app);
void add_doctor_command(CommandLine& app);
void add_methods_command(CommandLine& app);
void add_chart_command(CommandLine& app);
void add_energy_command(CommandLine& app);
void add_stability_command(CommandLine& app);
void add_sweep_command(CommandLine& app);
void add_fall_command(CommandLine& app);
void add_sheet_command(CommandLine& app);
void add_gallery_command(CommandLine& app);
void add_verify_command(CommandLine& app);
void add_schema_command(CommandLine& app);
// Both tell of all commands that are there when they run.
void add_completion_command(CommandLine& app);
void add_help_command(CommandLine& app);

}  // namespace chainreel
