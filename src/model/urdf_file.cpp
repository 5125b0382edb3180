#include "model/urdf_file.hpp"

#include "core/scalar.hpp"
#include "model/urdf_check.hpp"
#include "model/urdf_problems.hpp"
#include "model/urdf_tree.hpp"
#include "model/urdf_values.hpp"
#include "model/xml_text.hpp"

namespace chainreel {

Eigen::Isometry3d isometry_of(const UrdfOrigin& origin) {
  const auto [sr, cr] = sin_cos(origin.rpy[0]);
  const auto [sp, cp] = sin_cos(origin.rpy[1]);
  const auto [sy, cy] = sin_cos(origin.rpy[2]);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,            //
      -sp, cp * sr, cp * cr;
  X.translation() = origin.xyz;
  return X;
}

std::string to_string(UrdfJointType type) {
  switch (type) {
    case UrdfJointType::revolute:
      return "revolute";
    case UrdfJointType::continuous:
      return "continuous";
    case UrdfJointType::prismatic:
      return "prismatic";
    case UrdfJointType::fixed:
      return "fixed";
    case UrdfJointType::floating:
      return "floating";
    case UrdfJointType::planar:
      return "planar";
  }
  return "";
}

UrdfFile read_urdf_file(const std::string& path) {
  UrdfProblems problems(path);
  CheckedUrdf urdf = check_urdf(read_xml_text(path), path, problems);
  connect_links(urdf, problems);
  check_mimics(urdf.file, problems);
  problems.throw_if_any();
  read_urdf_values(urdf.plain, urdf.file);
  urdf.file.remarks = problems.take_remarks();
  return std::move(urdf.file);
}

}  // namespace chainreel
