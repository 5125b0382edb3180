// The numbers behind an ellipse figure.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "core/json.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/body_shapes.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"
#include "scene/scene.hpp"
#include "sim/instant.hpp"

namespace chainreel {

// Where the poses of an ellipse figure come from: named ones, a sweep, a motion, or the workspace.

struct PoseSources {
  std::vector<std::string> poses;  // "0,90deg"
  std::string sweep;               // "q2=0:180deg:9"
  std::string along;               // a scene
  bool field = false;
  int samples = 0;  // 0: 6 along a motion, 12 points across the workspace
  std::string elbow = "up";
};

struct GatheredPoses {
  std::vector<std::vector<double>> q;
  std::vector<std::string> labels;    // one a pose, or none
  std::vector<double> t;              // s, along a motion
  std::vector<Eigen::Vector3d> path;  // of the end effector along the motion, m
  double cell = 0;                    // m, of a field
  std::string branch;                 // of a field: which of several poses at a point
};

// The poses of a model. Throws Error (usage) where the options do not name any, or name them twice.
GatheredPoses gather_poses(const Chain& chain, const PoseSources& sources);

// The chain of the scene and its poses along the motion. Throws Error where the scene cannot be run.
struct Motion {
  Chain chain;
  GatheredPoses poses;
  const Theme* theme = &light_theme();
  double text_scale = 1;
  CameraEntry camera = {};  // of a scene
  EllipseEntry ellipse = {};
  std::shared_ptr<const BodyShapes> shapes = nullptr;
  ConstraintPlan constraints = {};  // of the scene
  Video video = {};
  FontFamilies families = {};
  std::optional<PageLogo> logo = {};
};
Motion motion_of(const PoseSources& sources, const CommonOptions& common);

// Which curve.
struct EllipseForm {
  EllipseReading reading = EllipseReading::mass;
  bool section = false;  // by the xy plane of the end effector, of arms in space
};

// A list, one entry a pose: t along a motion, q, point (m, in W), Lambda_inv, Lambda and what else add_effective_mass
// gives, eigenvalues of Lambda (kg, null where infinite) and semi_axes of the curve in its unit, in the same order,
// from the heaviest direction on.
Json ellipse_json(const TipMass& tip, const GatheredPoses& poses, const EllipseForm& form);
// The same as a table; infinite numbers are "inf".
std::string ellipse_csv(const TipMass& tip, const GatheredPoses& poses, const EllipseForm& form);

// M(q) of each pose, and the part of it that belongs to two joints (from 0).
Json joint_space_json(const Chain& chain, const GatheredPoses& poses, std::array<int, 2> joints);

}  // namespace chainreel
