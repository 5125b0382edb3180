// All of a model that pictures and motions depend on, as its file says it and with what its names mean: plain
// enough to be kept beside a picture and held against a later state of the file.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "mesh/triangle_sketch.hpp"
#include "model/chain.hpp"
#include "model/read_chain.hpp"
#include "model/urdf_file.hpp"

namespace chainreel {

struct DescribedMesh {
  std::string file;                      // its name without the way to it, which differs from place to place
  std::optional<TriangleSketch> sketch;  // none where it was not found, or cannot be read
};

struct DescribedShape {
  UrdfShape shape;                                   // its mesh by file name alone, without its material
  std::optional<std::array<std::uint8_t, 4>> color;  // as it is drawn; a texture counts as its mean
  std::string material, texture;                     // names, for words alone
  int mesh = -1;                                     // index into ModelDescription::meshes
};

struct DescribedLink {
  std::string name;
  int line = 0;
  std::optional<UrdfInertial> inertial;
  std::vector<DescribedShape> visuals, collisions;
};

// A number of q: the joint that owns it, see position_names, and its unit: "rad", "m" or, of quaternions, "".
struct DescribedCoordinate {
  std::string name, unit;
  friend bool operator==(const DescribedCoordinate&, const DescribedCoordinate&) = default;
};
std::vector<DescribedCoordinate> coordinates_of(const Chain& chain);

struct ModelDescription {
  std::string name;
  std::vector<DescribedLink> links;  // in the file's order
  std::vector<UrdfJoint> joints;     // parent and child are indices into `links`
  int root = -1;
  std::vector<DescribedMesh> meshes;
  // As the model was read:
  std::vector<DescribedCoordinate> coordinates;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  bool floating_base = false;
  bool friction = true;
  std::optional<double> massless;
  std::string end_effector;  // "": there is none
  Payload payload;           // its link by name
};

enum class DescribeCollisions {
  where_seen,  // of links without <visual>s, which are measured by them
  all,
};

// Meshes are read as far as `options.meshes` asks for them. Throws Error as read_chain does; never for a mesh
// or colour.
ModelDescription describe_model(const ModelSource& source, const ModelOptions& options,
                                DescribeCollisions collisions = DescribeCollisions::where_seen);

Json to_json(const ModelDescription& model);
// Throws Error (bad input) where it is no such record.
ModelDescription model_description_of(const Json& json);

}  // namespace chainreel
