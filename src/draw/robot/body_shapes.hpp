// A robot as its model's visual shapes show it.
#pragma once

#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "draw/robot/skeleton.hpp"
#include "dynamics/workspace.hpp"
#include "mesh/read_mesh.hpp"
#include "model/visuals.hpp"
#include "picture/camera.hpp"
#include "scene/words.hpp"

namespace chainreel {

struct BodyShape {
  int body = 0;  // index into Chain::bodies; 0: fixed to the world
  Eigen::Isometry3d X_BM =
      Eigen::Isometry3d::Identity();  // pose of the mesh, which has its scale, in its body
  std::shared_ptr<const TriangleMesh> mesh;
  std::optional<Color> color;  // instead of the mesh's own
  std::vector<Eigen::Vector3d>
      corners;  // in the body's frame: vertices that lie farthest out in many directions
  std::shared_ptr<const TriangleMesh> lit;  // the same surface, of finer triangles where need be, with the openness of its vertices
  std::shared_ptr<const std::vector<std::uint8_t>> openness;  // (draw/robot/daylight); without them, none is in any shade
};

struct BodyShapes {
  std::vector<BodyShape> shapes;
};

// Finds the corners of its mesh where it stands.
void measure_corners(BodyShape& shape);

// Meshes that were read, so that several panels read each file once.
class MeshShelf {
 public:
  // With the scale of the visual. Throws Error where the file cannot be read.
  std::shared_ptr<const TriangleMesh> mesh_of(const Visual& visual, MeshUp up);

  // Reads the files among them that are not known yet, on all cores. What goes wrong is told by `mesh_of`.
  void read_ahead(const std::vector<Visual>& visuals, MeshUp up);

 private:
  struct Known {
    std::shared_ptr<const TriangleMesh> mesh;
    std::exception_ptr problem;  // of reading it
  };
  std::map<std::string, Known> known_;
};

// The meshes of all shapes; URDF scales are applied, and a material of the model stands
// before the colours of a file, as in RViz. Throws Error naming the <visual>'s line where a file cannot be
// read.
BodyShapes load_body_shapes(const std::vector<Visual>& visuals, MeshUp up, MeshShelf& shelf);

// The light tints of links that are told apart by nothing else: neighbours have different ones.
Color link_tint(int place_in_chain);

// How a scene, or a command, wants its robots drawn.
struct BodyLook {
  LinkShapes links = LinkShapes::automatic;
  MeshUp mesh_up = MeshUp::rviz;
  bool is_oblique = true;
  Place place;  // of `links`
};

// None for bars, nor with auto where the view is flat. With auto, bodies are made where nothing that moves has a shape, and of chains in numbers
// (draw/robot/made_bodies), and links that are all of one grey get two light tints in turn. Throws Error as above, and where
// `visual` finds none.
std::shared_ptr<const BodyShapes> shapes_for(const BodyLook& look, const ModelSource& model,
                                             const Chain& chain, const ModelOptions& options,
                                             MeshShelf& shelf);

// Calls add(place in W) for all corners after compute_kinematics.
template <class Add>
void for_each_corner(const BodyShapes& shapes, const Workspace& ws, Add add) {
  for (const BodyShape& shape : shapes.shapes)
    for (const Eigen::Vector3d& corner : shape.corners)
      add(Eigen::Vector3d(pose_of(ws, shape.body) * corner));
}
// What the corners of one take up on the page.
Rect extent_of(const BodyShape& shape, const Workspace& ws, const Camera& camera);

// Bodies as `camera` sees them, still without parts.
Solids solids_seen_by(const Camera& camera);
// The parts of all bodies as they stand after compute_kinematics.
void add_bodies(Solids& solids, const BodyShapes& shapes, const Workspace& ws, const Camera& camera);
// What they throw on the plane with normal `up`, `height` (m) above the world's origin, under a light right above.
void add_shadows(Solids& solids, const BodyShapes& shapes, const Workspace& ws, const Camera& camera,
                 const Eigen::Vector3d& up, double height);

}  // namespace chainreel
