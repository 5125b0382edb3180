#include "app/model_view.hpp"

#include <cmath>
#include <limits>

#include "app/command.hpp"
#include "core/error.hpp"
#include "draw/view.hpp"
#include "scene/quantity.hpp"
#include "scene/read_camera.hpp"

namespace chainreel {
namespace {

std::string given(const FlagValues& flags, const std::string& key) {
  const auto found = flags.find(key);
  return found == flags.end() ? "" : found->second;
}

std::optional<double> quantity(const FlagValues& flags, const std::string& key, const std::string& flag) {
  const std::string text = given(flags, key);
  if (text.empty()) return std::nullopt;
  try {
    return parse_quantity(text, {});
  } catch (const Error& error) {
    throw Error(ExitCode::usage, flag + ": " + error.problems().front().message);
  }
}

void require_good(const std::optional<double>& value, const std::string& flag,
                  std::string (*problem)(double)) {
  const std::string wrong = value ? problem(*value) : "";
  if (!wrong.empty()) throw Error(ExitCode::usage, flag + wrong);
}

CameraEntry camera_of(const FlagValues& flags) {
  CameraEntry camera;
  camera.azimuth = quantity(flags, "camera.azimuth", "--azimuth");
  camera.elevation = quantity(flags, "camera.elevation", "--elevation");
  if (given(flags, "camera.distance") == "parallel")
    camera.distance = std::numeric_limits<double>::infinity();
  else
    camera.distance = quantity(flags, "camera.distance", "--distance");
  require_good(camera.azimuth, "--azimuth", azimuth_problem);
  require_good(camera.elevation, "--elevation", elevation_problem);
  require_good(camera.distance, "--distance", distance_problem);
  const std::string fit = given(flags, "camera.fit");
  if (fit.empty() || fit == "motion") return camera;
  const bool is_list = fit.size() > 2 && fit.front() == '[' && fit.back() == ']';
  const std::vector<double> edges = parse_list(is_list ? fit.substr(1, fit.size() - 2) : fit, "--fit");
  if (edges.size() != 4 || !(edges[0] < edges[2]) || !(edges[1] < edges[3]))
    throw Error(ExitCode::usage, "--fit takes motion, or metres that grow: \"[left, bottom, right, top]\"");
  camera.fit = {edges[0], edges[1], edges[2], edges[3]};
  return camera;
}

std::string one_of(const FlagValues& flags, const std::string& key, const std::string& flag,
                   const std::vector<std::string>& known, const std::string& text) {
  const std::string value = given(flags, key);
  if (value.empty()) return known.front();
  for (const std::string& name : known)
    if (name == value) return value;
  throw Error(ExitCode::usage, flag + " takes " + text + ", not '" + value + "'");
}

}  // namespace

void set_view(PoseFigureOptions& figure, const FlagValues& flags, const std::string& model,
              const Chain& chain, const ModelOptions& options) {
  figure.camera = camera_of(flags);
  BodyLook look;
  look.links = one_of(flags, "links", "--links", {"auto", "plain", "visual", "collision"},
                      "auto, plain, visual or collision");
  look.mesh_up = one_of(flags, "mesh_up", "--mesh-up", {"rviz", "file"}, "rviz or file");
  look.is_oblique = is_oblique(chain, figure.camera);
  look.place = {model};
  MeshShelf shelf;
  figure.shapes = shapes_for(look, model, chain, options, shelf);
}

}  // namespace chainreel
