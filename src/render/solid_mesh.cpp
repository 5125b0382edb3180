#include "render/solid_mesh.hpp"

#include <utility>

#include "core/error.hpp"

namespace chainreel {
namespace {

std::uint32_t premultiplied(const std::array<std::uint8_t, 4>& rgba) {
  const auto level = [&rgba](std::size_t c) { return (unsigned(rgba[c]) * rgba[3] + 127) / 255; };
  return level(2) | level(1) << 8 | level(0) << 16 | unsigned(rgba[3]) << 24;
}

}  // namespace

SolidMesh::SolidMesh(std::shared_ptr<const TriangleMesh> whole) : mesh(std::move(whole)), bounds(bounds_of(*mesh)) {
  for (const std::uint32_t index : mesh->triangles)
    if (index >= mesh->vertices.size())
      throw Error(ExitCode::bad_input, "a mesh has triangles between vertices that it does not have");
  MeshSurface surface(*mesh);
  triangles = std::move(surface.triangles);
  creases = std::move(surface.creases);
  const auto add = [this](const TriangleMesh::Vertex& vertex) {
    for (std::size_t i = 0; i < 3; ++i) {
      position[i].push_back(vertex.position[i]);
      normal[i].push_back(vertex.normal[i]);
    }
    color.push_back(premultiplied(vertex.color));
  };
  for (const TriangleMesh::Vertex& vertex : mesh->vertices) add(vertex);
  while (color.size() % 4 != 0) add(mesh->vertices.back());
}

}  // namespace chainreel
