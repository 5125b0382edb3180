#include "model/visuals.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "mesh/mesh_extents.hpp"
#include "model/materials.hpp"
#include "model/package_path.hpp"
#include "model/urdf_file.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {
namespace {

VisualKind kind_of(UrdfShapeKind kind) {
  switch (kind) {
    case UrdfShapeKind::box:
      return VisualKind::box;
    case UrdfShapeKind::cylinder:
      return VisualKind::cylinder;
    case UrdfShapeKind::sphere:
      return VisualKind::sphere;
    case UrdfShapeKind::mesh:
      return VisualKind::mesh;
  }
  return VisualKind::box;
}

}  // namespace

std::vector<Visual> read_visuals(const ModelSource& source, const Chain& chain, const ModelOptions& options,
                                 ShapesOf which) {
  const UrdfFile file = read_urdf_file(source);
  const std::map<std::string, std::string> meshes = find_meshes(file, options, which);
  std::unordered_map<std::string, const Frame*> frames;
  for (const Frame& frame : chain.frames) frames.emplace(frame.name, &frame);

  Materials materials(file, options);
  UrdfProblems problems = file.problems();
  std::vector<Visual> visuals;
  for (const UrdfLink& link : file.links) {
    const auto frame = frames.find(link.name);
    if (frame == frames.end()) {
      problems.add(link.line, "link '" + link.name +
                                  "' is not in the chain that was read before: has the file "
                                  "changed meanwhile?");
      continue;
    }
    for (const UrdfShape& shape : shapes_of(link, which)) {
      Visual visual;
      visual.body = frame->second->body;
      visual.X_BV = frame->second->X_BF * isometry_of(shape.origin);
      visual.kind = kind_of(shape.kind);
      visual.size = shape.size;
      visual.mesh_scale = shape.mesh_scale;
      visual.link = link.name;
      visual.place = file.at(shape.line);
      if (shape.material) visual.color = materials.color_of(*shape.material, link.name, problems);
      if (visual.kind == VisualKind::mesh) visual.mesh_file = meshes.at(shape.mesh_file);
      if (visual.kind == VisualKind::mesh && visual.mesh_file.empty()) continue;
      visuals.push_back(std::move(visual));
    }
  }
  problems.throw_if_any();
  return visuals;
}

const std::vector<UrdfShape>& shapes_of(const UrdfLink& link, ShapesOf which) {
  return which == ShapesOf::visual ? link.visuals : link.collisions;
}

std::map<std::string, std::string> find_meshes(const UrdfFile& file, const ModelOptions& options,
                                               ShapesOf which) {
  std::map<std::string, std::string> paths;
  FileFinder finder(file.path, options.packages);
  UrdfProblems problems = file.problems();
  for (const UrdfLink& link : file.links) {
    for (const UrdfShape& shape : shapes_of(link, which)) {
      if (shape.kind != UrdfShapeKind::mesh) continue;
      const FoundFile& found = finder.find(shape.mesh_file);
      paths[shape.mesh_file] = found.path;
      if (found.path.empty() && options.meshes)
        problems.add(shape.line, missing_mesh_message(link.name, shape.mesh_file, found) + "; or draw without shapes with `--links plain`");
    }
  }
  problems.throw_if_any();
  return paths;
}

namespace {

using Eigen::Vector3d;

constexpr std::size_t kFewPoints = 16;  // that are all kept

void add_corners(const Vector3d& lower, const Vector3d& upper, const Eigen::Isometry3d& X_BS,
                 std::vector<Vector3d>& points) {
  for (int i = 0; i < 8; ++i)
    points.push_back(X_BS * Vector3d(i & 1 ? upper.x() : lower.x(), i & 2 ? upper.y() : lower.y(),
                                     i & 4 ? upper.z() : lower.z()));
}

void add_sphere(double radius, const Eigen::Isometry3d& X_BS, std::vector<Vector3d>& points) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-radius, radius}) points.push_back(X_BS * Vector3d(side * Vector3d::Unit(axis)));
}

// Those of many points that lie farthest in the 26 directions of a cube's faces, edges and corners.
std::vector<Vector3d> farthest_of(const std::vector<Vector3d>& points) {
  if (points.size() <= kFewPoints) return points;
  std::vector<bool> kept(points.size(), false);
  for (int i = 0; i < 27; ++i) {
    const Vector3d direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (direction.isZero(0)) continue;
    std::size_t best = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
      if (direction.dot(points[k]) > direction.dot(points[best])) best = k;
    kept[best] = true;
  }
  std::vector<Vector3d> farthest;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (kept[k]) farthest.push_back(points[k]);
  return farthest;
}

class Measure {
 public:
  Measure(const UrdfFile& file, const ModelOptions& options) : finder_(file.path, options.packages) {}

  // False where a mesh cannot be measured.
  bool add(const UrdfShape& shape, const Eigen::Isometry3d& X_BL, std::vector<Vector3d>& points) {
    const Eigen::Isometry3d X_BS = X_BL * isometry_of(shape.origin);
    const Vector3d& size = shape.size;
    switch (shape.kind) {
      case UrdfShapeKind::box:
        add_corners(-size / 2, size / 2, X_BS, points);
        return true;
      case UrdfShapeKind::cylinder: {
        const Vector3d half(size[0], size[0], size[2] / 2);
        add_corners(-half, half, X_BS, points);
        return true;
      }
      case UrdfShapeKind::sphere:
        add_sphere(size[0], X_BS, points);
        return true;
      case UrdfShapeKind::mesh:
        break;
    }
    const std::optional<Box>& box = mesh_box(shape.mesh_file);
    if (!box) return false;
    add_corners(box->lower.cwiseProduct(shape.mesh_scale), box->upper.cwiseProduct(shape.mesh_scale), X_BS, points);
    return true;
  }

 private:
  const std::optional<Box>& mesh_box(const std::string& name) {
    const auto [known, is_new] = boxes_.try_emplace(name);
    if (!is_new) return known->second;
    const FoundFile& found = finder_.find(name);
    if (found.path.empty()) return known->second;
    try {
      known->second = mesh_extents(found.path);
    } catch (const Error&) {
      // Pictures that show it will say what is wrong with it.
    }
    return known->second;
  }

  FileFinder finder_;
  std::map<std::string, std::optional<Box>> boxes_;  // by the name as written
};

}  // namespace

Outline read_outline(const ModelSource& source, const Chain& chain, const ModelOptions& options) {
  const UrdfFile file = read_urdf_file(source);
  std::unordered_map<std::string, const Frame*> frames;
  for (const Frame& frame : chain.frames) frames.emplace(frame.name, &frame);
  Measure measure(file, options);
  Outline outline;
  outline.points.resize(chain.bodies.size());
  for (const UrdfLink& link : file.links) {
    const auto found = frames.find(link.name);
    if (found == frames.end() || found->second->body == 0) continue;
    const Frame& frame = *found->second;
    bool is_whole = true;
    for (const UrdfShape& shape : link.visuals.empty() ? link.collisions : link.visuals)
      is_whole &= measure.add(shape, frame.X_BF, outline.points[std::size_t(frame.body)]);
    if (!is_whole) outline.unmeasured.push_back(link.name);
  }
  for (std::vector<Vector3d>& points : outline.points) points = farthest_of(points);
  return outline;
}

}  // namespace chainreel
