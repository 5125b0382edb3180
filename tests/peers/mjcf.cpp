#include "peers/mjcf.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <vector>

#include "core/format.hpp"

namespace chainreel::peers {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + format_shortest(value);
  return text;
}

std::string numbers(const Eigen::Vector3d& v) {
  return numbers({v.x(), v.y(), v.z()});
}

std::string numbers(const Eigen::Quaterniond& r) {
  return numbers({r.w(), r.x(), r.y(), r.z()});
}

std::string inertial_of(const Inertia& inertia) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia.about_com);
  Eigen::Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;  // a rotation, no reflection
  const Eigen::Vector3d moments = principal.eigenvalues().cwiseMax(kLeast);
  return "<inertial pos=\"" + numbers(inertia.com) + "\" quat=\"" + numbers(Eigen::Quaterniond(axes)) +
         "\" mass=\"" + format_shortest(std::max(inertia.mass, kLeast)) + "\" diaginertia=\"" +
         numbers(moments) + "\"/>";
}

std::string joint_of(const Body& body, int index) {
  const std::string name = "name=\"j" + std::to_string(index) + "\"";
  if (body.joint.kind == JointKind::floating) return "<freejoint " + name + "/>";
  const std::string type = body.joint.kind == JointKind::revolute ? "hinge" : "slide";
  return "<joint " + name + " type=\"" + type + "\" axis=\"" + numbers(body.joint.axis) + "\"/>";
}

void check(const Chain& chain) {
  if (chain.has_mimic) throw std::invalid_argument("MJCF joints share no coordinates");
  int next = 0;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind == JointKind::floating && chain.bodies[i].parent != 0)
      throw std::invalid_argument("MJCF knows floating joints on the world alone");
    if (joint.v_index != next) throw std::invalid_argument("coordinates are not in the order of the bodies");
    next += joint.kind == JointKind::floating ? 6 : 1;
  }
}

// MuJoCo numbers bodies in document order, depth first: so does a chain that was read from a file. Where it
// does not, the joints' names tell.
void add_bodies(const Chain& chain, const std::vector<std::vector<int>>& children, int parent,
                std::string& text) {
  for (const int i : children[std::size_t(parent)]) {
    const Body& body = chain.bodies[std::size_t(i)];
    const Eigen::Isometry3d& X = body.joint.X_PJ;
    text += "<body name=\"b" + std::to_string(i) + "\" pos=\"" + numbers(Eigen::Vector3d(X.translation())) +
            "\" quat=\"" + numbers(Eigen::Quaterniond(X.linear())) + "\">\n" + inertial_of(body.inertia) +
            joint_of(body, i) + "\n";
    add_bodies(chain, children, i, text);
    text += "</body>\n";
  }
}

}  // namespace

std::string mjcf_of(const Chain& chain, const std::string& equality) {
  check(chain);
  std::vector<std::vector<int>> children(chain.bodies.size());
  for (std::size_t i = 1; i < chain.bodies.size(); ++i)
    children[std::size_t(chain.bodies[i].parent)].push_back(int(i));

  std::string text =
      "<mujoco model=\"chain\">\n"
      "<compiler angle=\"radian\" inertiafromgeom=\"false\" balanceinertia=\"false\" boundmass=\"0\" "
      "boundinertia=\"0\"/>\n"
      "<option timestep=\"0.001\" integrator=\"Euler\" gravity=\"" +
      numbers(chain.gravity) +
      "\">\n"
      "<flag contact=\"disable\" " +
      (equality.empty() ? "constraint=\"disable\" " : "") +
      "passive=\"disable\" actuation=\"disable\" "
      "sensor=\"disable\"/>\n"
      "</option>\n<worldbody>\n";
  add_bodies(chain, children, 0, text);
  text += "</worldbody>\n";
  if (!equality.empty()) text += "<equality>" + equality + "</equality>\n";
  return text + "</mujoco>\n";
}

}  // namespace chainreel::peers
