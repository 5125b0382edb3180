#include "draw/robot/body_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/machine.hpp"
#include "core/parallel.hpp"
#include "draw/robot/daylight.hpp"
#include "draw/robot/made_bodies.hpp"
#include "mesh/primitives.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

Vector3d position(const TriangleMesh::Vertex& vertex) {
  return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

// Sizes along the axes; normals go with the cofactors, and a mirror turns triangles inside out.
void stretch(TriangleMesh& mesh, const Vector3d& scale) {
  const double sense = scale.prod() < 0 ? -1 : 1;
  const Vector3d cofactors = sense * Vector3d(scale[1] * scale[2], scale[2] * scale[0], scale[0] * scale[1]);
  for (TriangleMesh::Vertex& vertex : mesh.vertices) {
    Vector3d n;
    for (int i = 0; i < 3; ++i) {
      const auto at = std::size_t(i);
      vertex.position[at] = float(scale[i] * vertex.position[at]);
      n[i] = vertex.normal[at] * cofactors[i];
    }
    if (n.norm() > 0) n.normalize();
    for (int i = 0; i < 3; ++i) vertex.normal[std::size_t(i)] = float(n[i]);
  }
  if (sense < 0)
    for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3)
      std::swap(mesh.triangles[t], mesh.triangles[t + 1]);
}

// 26 directions: faces, edges and corners of a cube. Between two of them a smooth body reaches out hardly
// farther.
std::vector<Vector3d> corners_of(const TriangleMesh& mesh) {
  std::set<std::size_t> farthest;
  std::array<double, 13> most, least;  // along the half of them; the others are opposite
  std::array<std::size_t, 13> at_most{}, at_least{};
  most.fill(-HUGE_VAL), least.fill(HUGE_VAL);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3d p = position(mesh.vertices[v]);
    const double x = p[0], y = p[1], z = p[2];
    const std::array<double, 13> reach = {x, y, z, x + y, x - y, y + z, y - z, x + z, x - z, x + y + z, x + y - z, x - y + z, x - y - z};
    for (std::size_t i = 0; i < reach.size(); ++i) {
      if (reach[i] > most[i]) most[i] = reach[i], at_most[i] = v;
      if (reach[i] < least[i]) least[i] = reach[i], at_least[i] = v;
    }
  }
  if (!mesh.vertices.empty())
    for (const auto* found : {&at_most, &at_least}) farthest.insert(found->begin(), found->end());
  std::vector<Vector3d> corners;
  for (const std::size_t v : farthest) corners.push_back(position(mesh.vertices[v]));
  return corners;
}

void require_finite(const TriangleMesh& mesh, const Visual& visual) {
  for (const TriangleMesh::Vertex& vertex : mesh.vertices)
    for (const float x : vertex.position)
      if (!std::isfinite(x))
        throw Error(ExitCode::bad_input, "is too large once it is scaled", {visual.mesh_file});
}

TriangleMesh read(const Visual& visual, MeshUp up) {
  switch (visual.kind) {
    case VisualKind::box:
      return box_mesh(visual.size);
    case VisualKind::cylinder:
      return cylinder_mesh(visual.size[0], visual.size[2]);
    case VisualKind::sphere:
      return sphere_mesh(visual.size[0]);
    default: {
      TriangleMesh mesh = read_mesh(visual.mesh_file, up);
      stretch(mesh, visual.mesh_scale);
      require_finite(mesh, visual);
      return mesh;
    }
  }
}

// Shapes that are the same triangles share them.
std::string key_of(const Visual& visual, MeshUp up) {
  std::string key = visual.mesh_file + "|" + std::to_string(int(up)) + "|" + std::to_string(int(visual.kind));
  const Vector3d& numbers = visual.kind == VisualKind::mesh ? visual.mesh_scale : visual.size;
  for (const double number : {numbers[0], numbers[1], numbers[2]}) key += "|" + format_shortest(number);
  return key;
}

// Rows of the matrix from coordinates of a frame with this pose in W to those of the camera.
std::array<double, 12> to_view(const Camera& camera, const Eigen::Affine3d& X_WM) {
  std::array<double, 12> rows{};
  const std::array<Vector3d, 3> axes{camera.right, camera.up, camera.toward_viewer};
  for (std::size_t r = 0; r < 3; ++r) {
    const Eigen::RowVector3d row = axes[r].transpose() * X_WM.linear();
    for (int c = 0; c < 3; ++c) rows[4 * r + std::size_t(c)] = row[c];
    rows[4 * r + 3] = axes[r].dot(X_WM.translation() - camera.focus);
  }
  return rows;
}

}  // namespace

std::shared_ptr<const TriangleMesh> MeshShelf::mesh_of(const Visual& visual, MeshUp up) {
  Known& known = known_[key_of(visual, up)];
  if (known.problem) std::rethrow_exception(known.problem);
  if (!known.mesh) known.mesh = std::make_shared<const TriangleMesh>(read(visual, up));
  return known.mesh;
}

void MeshShelf::read_ahead(const std::vector<Visual>& visuals, MeshUp up) {
  std::vector<std::pair<const Visual*, Known*>> unread;
  for (const Visual& visual : visuals) {
    if (visual.kind != VisualKind::mesh) continue;
    const auto [place, is_new] = known_.try_emplace(key_of(visual, up));
    if (is_new) unread.emplace_back(&visual, &place->second);
  }
  for_each_index(unread.size(), std::min(usable_cores(), int(unread.size())),
                 [&](std::size_t i) {
                   const auto& [visual, known] = unread[i];
                   try {
                     known->mesh = std::make_shared<const TriangleMesh>(read(*visual, up));
                   } catch (const Error&) {
                     known->problem = std::current_exception();
                   }
                 });
}

void measure_corners(BodyShape& shape) {
  shape.corners.clear();
  for (const Vector3d& corner : corners_of(*shape.mesh)) shape.corners.push_back(shape.X_BM * corner);
}

BodyShapes load_body_shapes(const std::vector<Visual>& visuals, MeshUp up, MeshShelf& shelf) {
  BodyShapes result;
  std::vector<Problem> problems;
  ExitCode code = ExitCode::bad_input;
  shelf.read_ahead(visuals, up);
  for (const Visual& visual : visuals) {
    BodyShape shape{visual.body, visual.X_BV, nullptr, std::nullopt, {}, nullptr, nullptr};
    try {
      shape.mesh = shelf.mesh_of(visual, up);
    } catch (const Error& error) {
      if (problems.empty()) code = error.code();
      for (const Problem& problem : error.problems())
        problems.push_back({"link '" + visual.link + "': " + to_string(problem), visual.place});
      continue;
    }
    measure_corners(shape);
    if (visual.color) {
      const auto& [r, g, b, a] = *visual.color;
      shape.color = Color{r, g, b, a / 255.0};
    }
    result.shapes.push_back(std::move(shape));
  }
  if (!problems.empty()) throw Error(code, std::move(problems));
  return result;
}

Color link_tint(int place_in_chain) {
  return place_in_chain % 2 == 0 ? color_of(0xB7C5D6) : color_of(0xECEEF1);
}

namespace {

// The one colour that all of it has.
std::optional<Color> only_color(const BodyShape& shape) {
  if (shape.color) return shape.color;
  if (shape.mesh->vertices.empty()) return std::nullopt;
  const auto& first = shape.mesh->vertices.front().color;
  for (const TriangleMesh::Vertex& vertex : shape.mesh->vertices)
    if (vertex.color != first) return std::nullopt;
  return Color{first[0], first[1], first[2], first[3] / 255.0};
}

bool are_of_one_grey(const BodyShapes& shapes) {
  constexpr int kGrey = 24;  // levels between the channels of what still counts as grey
  std::optional<Color> all;
  for (const BodyShape& shape : shapes.shapes) {
    const std::optional<Color> own = only_color(shape);
    if (!own || own->a < 1 || (all && *all != *own)) return false;
    all = own;
  }
  return all && std::max({all->r, all->g, all->b}) - std::min({all->r, all->g, all->b}) <= kGrey;
}

// Bodies between which there is no shape count as one.
void tint_in_turn(BodyShapes& shapes, const Chain& chain) {
  std::vector<bool> is_shown(chain.bodies.size(), false);
  for (const BodyShape& shape : shapes.shapes) is_shown[std::size_t(shape.body)] = true;
  std::vector<int> place(chain.bodies.size(), 0);
  for (std::size_t b = 1; b < chain.bodies.size(); ++b)
    place[b] = place[std::size_t(chain.bodies[b].parent)] + (is_shown[b] ? 1 : 0);
  for (BodyShape& shape : shapes.shapes) shape.color = link_tint(place[std::size_t(shape.body)]);
}

}  // namespace

std::shared_ptr<const BodyShapes> shapes_for(const BodyLook& look, const ModelSource& model,
                                             const Chain& chain, const ModelOptions& options,
                                             MeshShelf& shelf) {
  if (look.links == LinkShapes::plain || (look.links == LinkShapes::automatic && !look.is_oblique)) return nullptr;
  const bool collision = look.links == LinkShapes::collision;
  const std::vector<Visual> visuals =
      read_visuals(model, chain, options, collision ? ShapesOf::collision : ShapesOf::visual);
  const bool any_moves =
      std::any_of(visuals.begin(), visuals.end(), [](const Visual& visual) { return visual.body > 0; });
  // A chain in numbers has rods, all alike, in the text that is made of it: bodies say more.
  if (look.links == LinkShapes::automatic && (!any_moves || model.links)) {
    BodyShapes made = made_bodies(chain);
    if (made.shapes.empty() && !any_moves) return nullptr;
    if (!made.shapes.empty()) {
      put_in_daylight(made, chain);
      return std::make_shared<const BodyShapes>(std::move(made));
    }
  }
  if (visuals.empty())
    throw Error(
        ExitCode::bad_input,
        "'links' is " + to_string(look.links) + ", but the model has no <" + to_string(look.links) + ">: take auto or plain",
        look.place);
  BodyShapes shapes = load_body_shapes(visuals, look.mesh_up, shelf);
  if (look.links == LinkShapes::automatic && any_moves && are_of_one_grey(shapes)) tint_in_turn(shapes, chain);
  put_in_daylight(shapes, chain);
  return std::make_shared<const BodyShapes>(std::move(shapes));
}

Rect extent_of(const BodyShape& shape, const Workspace& ws, const Camera& camera) {
  Rect all{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Vector3d& corner : shape.corners) {
    const Point p = camera.project(pose_of(ws, shape.body) * corner);
    all = {std::min(all.x0, p.x), std::min(all.y0, p.y), std::max(all.x1, p.x), std::max(all.y1, p.y)};
  }
  return all;
}

Solids solids_seen_by(const Camera& camera) {
  Solids solids;
  solids.origin = camera.origin;
  solids.scale = camera.scale;
  const std::array<Vector3d, 3> axes{camera.right, camera.up, camera.toward_viewer};
  for (std::size_t i = 0; i < 3; ++i) solids.nearing[i] = camera.nearing.dot(axes[i]);
  return solids;
}

void add_bodies(Solids& solids, const BodyShapes& shapes, const Workspace& ws, const Camera& camera) {
  for (const BodyShape& shape : shapes.shapes) {
    const Eigen::Affine3d X_WM(pose_of(ws, shape.body) * shape.X_BM);
    solids.parts.push_back({shape.lit ? shape.lit : shape.mesh, to_view(camera, X_WM), shape.color, shape.openness});
  }
}

void add_shadows(Solids& solids, const BodyShapes& shapes, const Workspace& ws, const Camera& camera,
                 const Vector3d& up, double height) {
  Eigen::Affine3d onto_ground = Eigen::Affine3d::Identity();
  onto_ground.linear() -= up * up.transpose();
  onto_ground.translation() = height * up;
  for (const BodyShape& shape : shapes.shapes) {
    const Eigen::Affine3d X_WM(pose_of(ws, shape.body) * shape.X_BM);
    solids.parts.push_back({shape.mesh, to_view(camera, onto_ground * X_WM), std::nullopt, nullptr});
  }
}

}  // namespace chainreel
