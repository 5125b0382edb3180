#include "model/visuals.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "mesh/material_color.hpp"
#include "model/package_path.hpp"
#include "model/urdf_file.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {
namespace {

using Color = std::array<std::uint8_t, 4>;

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

// What materials look like. A name is explained by the robot's <material>, else by the first link that says
// more than the name; a <visual> that says something itself means that.
class Materials {
 public:
  Materials(const UrdfFile& file, const ModelOptions& options) : finder_(file.path, options.packages) {
    for (const UrdfMaterial& material : file.materials) remember(material);
    for (const UrdfLink& link : file.links)
      for (const UrdfShape& shape : link.visuals)
        if (shape.material) remember(*shape.material);
  }

  std::optional<Color> color_of(const UrdfMaterial& material, const std::string& link,
                                UrdfProblems& problems) {
    if (material.says_something()) return look_of(material);
    if (material.name.empty()) return std::nullopt;
    const auto known = known_.find(material.name);
    if (known != known_.end()) return look_of(known->second);
    if (without_file_.contains(material.name)) return std::nullopt;
    const std::string near = problems.is_full() ? "" : near_name(material.name, names_);
    problems.add(material.line, "link '" + link + "' names the material '" + material.name +
                                    "', which has no colour anywhere:" +
                                    (near.empty() ? " write <color rgba=\"0.5 0.5 0.5 1\"/> in it" : near));
    return std::nullopt;
  }

 private:
  void remember(const UrdfMaterial& material) {
    if (material.has_empty_texture) without_file_.insert(material.name);
    if (material.name.empty() || !material.says_something()) return;
    if (known_.emplace(material.name, material).second) names_.push_back(material.name);
  }

  // A texture is the mean of its image, and opaque unless there is a colour, too.
  std::optional<Color> look_of(const UrdfMaterial& material) {
    std::optional<Color> color;
    if (material.rgba) {
      color.emplace();
      for (std::size_t i = 0; i < 4; ++i) (*color)[i] = std::uint8_t(std::lround(255 * (*material.rgba)[i]));
    }
    if (material.texture.empty()) return color;
    const auto [mean, is_new] = means_.try_emplace(material.texture);
    if (is_new) mean->second = read_mean_color(finder_.find(material.texture).path);
    if (!mean->second) return color;
    if (!color) color = Color{0, 0, 0, 255};
    std::copy(mean->second->begin(), mean->second->end(), color->begin());
    return color;
  }

  FileFinder finder_;
  std::map<std::string, std::optional<std::array<std::uint8_t, 3>>> means_;  // of textures, by name
  std::unordered_map<std::string, UrdfMaterial> known_;
  std::vector<std::string> names_;  // in the file's order
  std::set<std::string> without_file_;  // names of materials that are a texture without a file
};

}  // namespace

std::vector<Visual> read_visuals(const std::string& path, const Chain& chain, const ModelOptions& options,
                                 ShapesOf which) {
  const UrdfFile file = read_urdf_file(path);
  const std::map<std::string, std::string> meshes = find_meshes(file, options, which);
  std::unordered_map<std::string, const Frame*> frames;
  for (const Frame& frame : chain.frames) frames.emplace(frame.name, &frame);

  Materials materials(file, options);
  UrdfProblems problems(file.path);
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
  UrdfProblems problems(file.path);
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

}  // namespace chainreel
