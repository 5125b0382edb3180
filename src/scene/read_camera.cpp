#include "scene/read_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/format.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

constexpr double kFarthestEye = 1e6;  // m; beyond, rays are parallel for all that is drawn

std::string angle_problem(double angle, double most) {
  if (std::abs(angle) <= most) return "";
  const std::string degrees = format_shortest(most * 180 / std::numbers::pi);
  return " must lie between -" + degrees + "deg and " + degrees + "deg; a number without deg is in radians";
}

void complain_of(Fields& camera, const char* key, const std::string& problem) {
  if (!problem.empty())
    camera.problems().add("'" + camera.path(key) + "'" + problem, camera.place_of(camera.find(key), key));
}

void read_angle(Fields& camera, const char* key, std::optional<double>& angle,
                std::string (*problem)(double)) {
  if (!camera.find(key).IsDefined()) return;
  double value = 0;
  camera.read(key, value);
  complain_of(camera, key, problem(value));
  angle = value;
}

void read_distance(Fields& camera, std::optional<double>& distance) {
  const YAML::Node node = camera.find("distance");
  if (!node.IsDefined()) return;
  if (node.IsScalar() && node.Scalar() == "parallel") {
    distance = std::numeric_limits<double>::infinity();
    return;
  }
  double value = 1;
  camera.read("distance", value);
  complain_of(camera, "distance", distance_problem(value));
  distance = value;
}

void read_fit(Fields& camera, std::optional<std::array<double, 4>>& fit) {
  const YAML::Node node = camera.find("fit");
  if (!node.IsDefined() || (node.IsScalar() && node.Scalar() == "motion")) return;
  const auto complain = [&](const std::string& what) {
    camera.problems().add("'" + camera.path("fit") + "' " + what, camera.place_of(node, "fit"));
  };
  if (!node.IsSequence() || node.size() != 4)
    return complain("must be motion, or the part that is shown in metres: fit: [left, bottom, right, top]");
  std::vector<double> edges;
  camera.read("fit", edges);
  if (edges.size() != 4) return;
  if (!(edges[0] < edges[2]) || !(edges[1] < edges[3]))
    return complain("must grow from left to right and from bottom to top: fit: [-1, -2, 1, 0.5]");
  fit = {edges[0], edges[1], edges[2], edges[3]};
}

}  // namespace

std::string azimuth_problem(double azimuth) {
  return angle_problem(azimuth, 2 * std::numbers::pi);
}

std::string elevation_problem(double elevation) {
  return angle_problem(elevation, std::numbers::pi / 2);
}

std::string distance_problem(double distance) {
  const bool good = distance > 0 && (distance <= kFarthestEye || std::isinf(distance));
  return good ? "" : " must be metres above 0, or parallel";
}

void read_camera(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("camera");
  if (!node.IsDefined()) return;
  if (!node.IsMap()) {
    fields.problems().add(
        "'camera' must hold azimuth, elevation, distance or fit: camera: {azimuth: 35deg, elevation: 20deg}",
        fields.place_of(node, "camera"));
    return;
  }
  Fields camera(fields.document(), node, fields.path("camera"), fields.problems());
  read_angle(camera, "azimuth", scene.camera.azimuth, azimuth_problem);
  read_angle(camera, "elevation", scene.camera.elevation, elevation_problem);
  read_distance(camera, scene.camera.distance);
  read_fit(camera, scene.camera.fit);
  camera.finish();
}

void read_body_shapes(Fields& fields, Scene& scene) {
  const auto choose = [&](const char* key, std::string& value, const std::vector<std::string>& known,
                          const std::string& text) {
    fields.read(key, value);
    if (std::find(known.begin(), known.end(), value) == known.end())
      fields.problems().add("'" + fields.path(key) + "' must be " + text + ", not '" + value + "'",
                            fields.place_of(fields.find(key), key));
  };
  choose("links", scene.links, {"auto", "plain", "visual", "collision"}, "auto, plain, visual or collision");
  choose("mesh_up", scene.mesh_up, {"rviz", "file"}, "rviz or file");
}

}  // namespace chainreel
