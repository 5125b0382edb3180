#include "model/visual_meshes.hpp"

#include "model/package_path.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {

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
