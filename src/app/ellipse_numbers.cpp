#include "app/ellipse_numbers.hpp"

#include <algorithm>

#include "app/report.hpp"
#include "core/format.hpp"
#include "draw/chain.hpp"
#include "draw/section.hpp"
#include "dynamics/crba.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

Eigen::Vector3d point_of(const Chain& chain, Workspace& ws, const std::vector<double>& q) {
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  compute_kinematics(chain, ws, q, at_rest);
  return frame_position(chain, ws, chain.end_effector);
}

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string number_or_inf(const std::optional<double>& value) {
  return value ? format_exact(*value) : "inf";
}

// At the pose at which `mass` was taken.
std::vector<MassAxis> drawn_axes(const Chain& chain, Workspace& ws, const std::vector<double>& q,
                                 const EffectiveMass& mass, const EllipseForm& form) {
  if (!form.section) return mass_axes(mass);
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  compute_kinematics(chain, ws, q, at_rest);
  return section_axes(mass, tip_plane(chain, ws), form.reading);
}

}  // namespace

Json ellipse_json(const TipMass& tip, const GatheredPoses& poses, const EllipseForm& form) {
  const Chain& chain = tip.chain();
  Workspace ws(chain);
  Json list = Json::array();
  for (std::size_t i = 0; i < poses.q.size(); ++i) {
    Json entry;
    if (i < poses.t.size()) entry["t"] = poses.t[i];
    entry["q"] = to_json(std::span<const double>(poses.q[i]));
    const EffectiveMass mass = tip.at(ws, poses.q[i]);
    entry["point"] = to_json(point_of(chain, ws, poses.q[i]));
    add_effective_mass(entry, mass);
    entry["eigenvalues"] = entry["semi_axes"] = Json::array();
    for (const MassAxis& axis : mass_axes(mass)) entry["eigenvalues"].push_back(number_or_null(axis.mass));
    for (const MassAxis& axis : drawn_axes(chain, ws, poses.q[i], mass, form))
      entry["semi_axes"].push_back(number_or_null(semi_axis(axis, form.reading)));
    list.push_back(entry);
  }
  return list;
}

std::string ellipse_csv(const TipMass& tip, const GatheredPoses& poses, const EllipseForm& form) {
  const Chain& chain = tip.chain();
  Workspace ws(chain);
  const TaskBasis basis = task_basis(chain, Task::linear);
  const std::size_t rows = basis.names.size();
  std::string text = poses.t.empty() ? "" : "t,";
  for (const std::string& name : position_names(chain)) text += "q." + name + ",";
  text += "x,y,z";
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = i; j < rows; ++j) text += ",Lambda_inv_" + basis.names[i] + basis.names[j];
  for (std::size_t i = 0; i < rows; ++i) text += ",eigenvalue" + std::to_string(i + 1);
  for (std::size_t i = 0; i < (form.section ? std::min<std::size_t>(rows, 2) : rows); ++i)
    text += ",semi_axis" + std::to_string(i + 1) + "_" + to_string(form.reading);
  text += "\n";
  for (std::size_t k = 0; k < poses.q.size(); ++k) {
    if (k < poses.t.size()) text += format_exact(poses.t[k]) + ",";
    for (const double q : poses.q[k]) text += format_exact(q) + ",";
    const EffectiveMass mass = tip.at(ws, poses.q[k]);
    const Eigen::Vector3d point = point_of(chain, ws, poses.q[k]);
    text += format_exact(point.x()) + "," + format_exact(point.y()) + "," + format_exact(point.z());
    for (Eigen::Index i = 0; i < Eigen::Index(rows); ++i)
      for (Eigen::Index j = i; j < Eigen::Index(rows); ++j) text += "," + format_exact(mass.Lambda_inv(i, j));
    for (const MassAxis& axis : mass_axes(mass)) text += "," + number_or_inf(axis.mass);
    for (const MassAxis& axis : drawn_axes(chain, ws, poses.q[k], mass, form))
      text += "," + number_or_inf(semi_axis(axis, form.reading));
    text += "\n";
  }
  return text;
}

Json joint_space_json(const Chain& chain, const GatheredPoses& poses, std::array<int, 2> joints) {
  Workspace ws(chain);
  Json list = Json::array();
  for (const std::vector<double>& q : poses.q) {
    compute_mass_matrix(chain, ws, q);
    Eigen::MatrixXd part(2, 2);
    for (Eigen::Index i = 0; i < 2; ++i)
      for (Eigen::Index j = 0; j < 2; ++j) part(i, j) = ws.M(joints[std::size_t(i)], joints[std::size_t(j)]);
    list.push_back({{"q", to_json(std::span<const double>(q))},
                    {"joints", {joints[0] + 1, joints[1] + 1}},
                    {"M", to_json(Eigen::MatrixXd(ws.M))},
                    {"image", to_json(part)}});
  }
  return list;
}

}  // namespace chainreel
