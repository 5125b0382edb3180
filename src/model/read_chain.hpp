// A URDF file as a Chain: checked with tinyxml2 first (lines, tags, numbers, limits on depth and size), then
// read by urdfdom, then reduced (fixed joints lumped, planar form found).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/chain.hpp"
#include "model/model_source.hpp"

namespace chainreel {

struct UrdfFile;

// A load that a link carries: a mass at a point.
struct Payload {
  double mass = 0;   // kg; 0: none
  std::string link;  // "": the end effector
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // in the link's frame, m
  friend bool operator==(const Payload&, const Payload&) = default;
};

struct ModelOptions {
  bool floating_base = false;      // the root link hangs on a floating joint instead of the world
  bool friction = true;            // honour <dynamics damping friction>
  std::optional<double> massless;  // kg given to moving links without inertia; absent: they are an error
  std::optional<Eigen::Vector3d>
      gravity;  // absent: [0, -9.81, 0] for chains that move in the xy plane, else -z
  // "": link `gripper`, else the only leaf, else none (Chain::end_effector is -1; see require_end_effector).
  std::string end_effector;
  Payload payload;
  bool meshes = true;                           // for pictures: mesh files must be found
  std::map<std::string, std::string> packages;  // package:// name -> folder
  friend bool operator==(const ModelOptions&, const ModelOptions&) = default;
};

// Throws Error with every problem of the file. Meshes are not looked at: only pictures that show them need them.
Chain read_chain(const ModelSource& source, const ModelOptions& options = {});

// The same from a file that has been read already.
Chain chain_of(const UrdfFile& file, const ModelOptions& options);

}  // namespace chainreel
