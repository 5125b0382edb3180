#include "model/link_chain.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "core/scalar.hpp"

namespace chainreel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRadius = 0.03;       // of rods, of the longest link
constexpr double kLoneRadius = 0.05;   // m, where no link has a length
constexpr double kMostMetres = 1e6, kMostKilograms = 1e9, kMostDamping = 1e9, kMostEffort = 1e12;
constexpr const char* kMaterials =
    "  <material name=\"sky\"><color rgba=\"0.337 0.706 0.914 1\"/></material>\n"
    "  <material name=\"orange\"><color rgba=\"0.902 0.624 0.000 1\"/></material>\n";
constexpr Name kMasses[] = {{"rod", "thin and uniform: m L^2 / 12 about its middle"},
                            {"point", "all mass at the link's end, none in the link"}};
constexpr Name kConventions[] = {{"standard", "T_i = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha)"},
                                 {"modified", "T_i = Rot_x(alpha) Trans_x(a) Rot_z(theta) Trans_z(d), as Craig writes"}};

struct LetterJoint {
  bool slides = false;
  int axis = 2;  // 0 x, 1 y, 2 z
  bool is_named = false;  // the axis
};

// Empty where the letters are none.
std::vector<LetterJoint> joints_of(const std::string& letters) {
  std::vector<LetterJoint> joints;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (letters[i] != 'R' && letters[i] != 'P') return {};
    LetterJoint joint;
    joint.slides = letters[i] == 'P';
    if (i + 1 < letters.size() && letters[i + 1] >= 'x' && letters[i + 1] <= 'z') {
      joint.axis = letters[++i] - 'x';
      joint.is_named = true;
    } else if (joint.slides) {
      joint.axis = !joints.empty() && joints.back().slides ? (joints.back().axis + 1) % 3 : 0;
    }
    joints.push_back(joint);
  }
  return joints;
}

// One number a link, or one for all, within bounds.
void complete_list(std::vector<double>& values, const std::string& key, std::size_t count, double absent, double least,
                   double most, const std::string& unit, std::vector<LinkProblem>& problems) {
  if (values.empty()) values = {absent};
  if (values.size() == 1) values.resize(count, values.front());
  if (values.size() != count) {
    problems.push_back({key, "has " + std::to_string(values.size()) + " numbers, but the chain has " +
                                 std::to_string(count) + (count == 1 ? " link" : " links") +
                                 ": write one for each, or one for all"});
    return;
  }
  for (const double value : values)
    if (!(value >= least && value <= most))
      return problems.push_back({key, "holds " + format_shortest(value) + ": numbers must lie between " +
                                          format_shortest(least) + " and " + format_shortest(most) + " " + unit});
}

}  // namespace

std::span<const Name> names_of(LinkMass) {
  return kMasses;
}

std::span<const Name> names_of(DhConvention) {
  return kConventions;
}

std::vector<LinkProblem> complete(LinkChain& chain) {
  std::vector<LinkProblem> problems;
  const std::size_t count = chain.size();
  if (count == 0) return {{"links", "must hold the length of each link in m: links: [0.5, 0.4]; or give rows of `dh`"}};
  if (!chain.links.empty() && !chain.dh.empty())
    problems.push_back({"dh", "and `links` both say where joints lie: leave one out"});
  if (count > kMostLinks)
    return {{chain.dh.empty() ? "links" : "dh",
             "has " + std::to_string(count) + " entries; beyond " + std::to_string(kMostLinks) + " write a URDF file"}};
  if (chain.dh.empty()) complete_list(chain.links, "links", count, 1, 0, kMostMetres, "m", problems);
  for (const auto& [a, alpha, d, theta] : chain.dh)
    if (!(std::abs(a) <= kMostMetres && std::abs(d) <= kMostMetres && std::abs(alpha) <= 1e3 && std::abs(theta) <= 1e3)) {
      problems.push_back({"dh", "holds a length beyond 1e6 m or an angle beyond 1000 rad"});
      break;
    }
  complete_list(chain.masses, "masses", count, 1, 1e-12, kMostKilograms, "kg", problems);
  complete_list(chain.damping, "damping", count, 0, 0, kMostDamping, "N m s/rad", problems);
  if (!chain.efforts.empty()) complete_list(chain.efforts, "efforts", count, 0, 1e-12, kMostEffort, "N m or N", problems);
  if (chain.joints.empty()) chain.joints.assign(count, 'R');
  const std::vector<LetterJoint> joints = joints_of(chain.joints);
  if (joints.empty())
    problems.push_back({"joints", "must be letters R (turns) and P (slides), each maybe with its axis: RRP, RzPx, not '" +
                                      shortened(chain.joints, 40) + "'"});
  else if (joints.size() != count)
    problems.push_back({"joints", "'" + shortened(chain.joints, 40) + "' names " + std::to_string(joints.size()) +
                                      (joints.size() == 1 ? " joint" : " joints") + ", but the chain has " +
                                      std::to_string(count) + (count == 1 ? " link" : " links")});
  if (!chain.dh.empty() && std::any_of(joints.begin(), joints.end(), [](const LetterJoint& one) { return one.is_named; }))
    problems.push_back({"joints", "of `dh` turn about z and slide along it: write R and P without an axis"});
  return problems;
}

namespace {

std::string list_text(const std::vector<double>& values) {
  std::vector<std::string> words;
  for (const double value : values) words.push_back(format_shortest(value));
  return "[" + joined(words) + "]";
}

}  // namespace

std::string text_of(const LinkChain& chain) {
  std::string text = "{";
  if (chain.dh.empty()) {
    text += "links: " + list_text(chain.links);
  } else {
    std::vector<std::string> rows;
    for (const DhRow& row : chain.dh) rows.push_back(list_text({row.begin(), row.end()}));
    text += "dh: [" + joined(rows) + "]";
    if (chain.convention != DhConvention::standard) text += ", convention: " + to_string(chain.convention);
  }
  text += ", masses: " + list_text(chain.masses) + ", joints: " + chain.joints + ", shape: " + to_string(chain.shape);
  if (std::any_of(chain.damping.begin(), chain.damping.end(), [](double d) { return d != 0; }))
    text += ", damping: " + list_text(chain.damping);
  if (!chain.efforts.empty()) text += ", efforts: " + list_text(chain.efforts);
  return text + "}";
}

namespace {

std::string numbers(const Vector3d& v) {
  // Never "-0", which reads as a slip.
  return format_shortest(v.x() + 0.0) + " " + format_shortest(v.y() + 0.0) + " " + format_shortest(v.z() + 0.0);
}

std::string origin_tag(const Vector3d& xyz, const Vector3d& rpy) {
  if (xyz.isZero(0) && rpy.isZero(0)) return "";
  return "<origin xyz=\"" + numbers(xyz) + "\"" + (rpy.isZero(0) ? "" : " rpy=\"" + numbers(rpy) + "\"") + "/>";
}

std::string joint_tag(const std::string& name, const std::string& type, const std::string& parent,
                      const std::string& child, const std::string& rest) {
  return "  <joint name=\"" + name + "\" type=\"" + type + "\">\n    <parent link=\"" + parent + "\"/>\n    <child link=\"" +
         child + "\"/>\n" + rest + "  </joint>\n";
}

std::string line(const std::string& tag) {
  return tag.empty() ? "" : "    " + tag + "\n";
}

// A joint that slides needs a way, too, which is as good as endless.
std::string limit_tag(bool slides, double effort) {
  return std::string("<limit") + (slides ? " lower=\"-1e9\" upper=\"1e9\"" : "") + " effort=\"" + format_shortest(effort) + "\"/>";
}

class Writer {
 public:
  explicit Writer(const LinkChain& chain) : chain_(chain), joints_(joints_of(chain.joints)) {
    if (!chain_.dh.empty())
      for (LetterJoint& joint : joints_) joint.axis = 2;
    double longest = 0;
    for (std::size_t i = 0; i < chain_.size(); ++i) longest = std::max(longest, reach(i).norm());
    radius_ = longest > 0 ? kRadius * longest : kLoneRadius;
  }

  std::string text(const std::string& name) {
    text_ = "<?xml version=\"1.0\"?>\n<!-- " + about() + " -->\n<robot name=\"" + name + "\">\n" + kMaterials + "  <link name=\"base\"/>\n";
    std::string parent = "base";
    Vector3d at = Vector3d::Zero();  // of the next joint, in the parent link
    for (std::size_t i = 0; i < chain_.size(); ++i) {
      const std::string number = std::to_string(i + 1);
      Vector3d rpy = Vector3d::Zero();
      if (!chain_.dh.empty()) {
        const auto& [a, alpha, d, theta] = chain_.dh[i];
        if (is_modified()) {
          parent = add_frame("axis" + number, parent, {a, 0, 0}, {alpha, 0, 0});
          at = {0, 0, d};
        }
        rpy.z() = theta;
      }
      add_link(i);
      add_joint(i, parent, at, rpy);
      parent = "link" + number;
      at = reach(i);
      if (!chain_.dh.empty() && !is_modified()) {
        parent = add_frame("frame" + number, parent, at, {chain_.dh[i][1], 0, 0});
        at.setZero();
      }
    }
    text_ += "  <link name=\"gripper\"/>\n";
    text_ += joint_tag("tip", "fixed", parent, "gripper", line(origin_tag(at, Vector3d::Zero())));
    return text_ + "</robot>\n";
  }

 private:
  bool is_modified() const { return chain_.convention == DhConvention::modified; }

  std::string about() const {
    std::string words = chain_.shape == LinkMass::rod ? "Uniform rods" : "Point masses at the ends of links without mass";
    words += chain_.dh.empty() ? ", along x at zero" : ", by rows of Denavit and Hartenberg (" + to_string(chain_.convention) + ")";
    return words + "; lengths in m, masses in kg, damping in N m s/rad or N s/m.";
  }

  // From a link's joint to the next one, in the link's frame.
  Vector3d reach(std::size_t i) const {
    if (chain_.dh.empty()) return Vector3d::Unit(joints_[i].slides ? joints_[i].axis : 0) * chain_.links[i];
    if (!is_modified()) return {chain_.dh[i][0], 0, chain_.dh[i][2]};
    if (i + 1 == chain_.size()) return Vector3d::Zero();
    const auto& [a, alpha, d, theta] = chain_.dh[i + 1];
    const auto [s, c] = sin_cos(alpha);
    return {a, -d * s, d * c};
  }

  std::string add_frame(const std::string& name, const std::string& parent, const Vector3d& xyz, const Vector3d& rpy) {
    text_ += "  <link name=\"" + name + "\"/>\n";
    text_ += joint_tag("to_" + name, "fixed", parent, name, line(origin_tag(xyz, rpy)));
    return name;
  }

  void add_joint(std::size_t i, const std::string& parent, const Vector3d& at, const Vector3d& rpy) {
    const std::string number = std::to_string(i + 1);
    std::string rest = line(origin_tag(at, rpy)) + line("<axis xyz=\"" + numbers(Vector3d::Unit(joints_[i].axis)) + "\"/>");
    if (!chain_.efforts.empty()) rest += line(limit_tag(joints_[i].slides, chain_.efforts[i]));
    if (chain_.damping[i] != 0) rest += line("<dynamics damping=\"" + format_shortest(chain_.damping[i]) + "\"/>");
    text_ += joint_tag("joint" + number, joints_[i].slides ? "prismatic" : "continuous", parent, "link" + number, rest);
  }

  void add_link(std::size_t i) {
    const Vector3d end = reach(i);
    const double length = end.norm(), mass = chain_.masses[i];
    const bool is_point = chain_.shape == LinkMass::point;
    Matrix3d inertia = Matrix3d::Zero();
    if (!is_point && length > 0) {
      const Vector3d u = end / length;
      inertia = mass * length * length / 12 * (Matrix3d::Identity() - u * u.transpose()) +
                mass * radius_ * radius_ / 2 * u * u.transpose();
    } else if (!is_point) {
      inertia.diagonal().setConstant(0.4 * mass * radius_ * radius_);
    }
    text_ += "  <link name=\"link" + std::to_string(i + 1) + "\">\n    <inertial>\n";
    if (!end.isZero(0)) text_ += "  " + line(origin_tag(is_point ? end : end / 2, Vector3d::Zero()));
    text_ += "  " + line("<mass value=\"" + format_shortest(mass) + "\"/>");
    const auto entry = [&](const char* key, int row, int column) {
      return std::string(" ") + key + "=\"" + format_shortest(inertia(row, column) + 0.0) + "\"";
    };
    text_ += "  " + line("<inertia" + entry("ixx", 0, 0) + entry("ixy", 0, 1) + entry("ixz", 0, 2) + entry("iyy", 1, 1) +
                         entry("iyz", 1, 2) + entry("izz", 2, 2) + "/>");
    text_ += "    </inertial>\n";
    if (length > 0) {
      // The cylinder's own axis is z.
      const Vector3d turn(0, std::atan2(std::hypot(end.x(), end.y()), end.z()), std::atan2(end.y(), end.x()));
      add_visual(i, origin_tag(end / 2, turn), "<cylinder radius=\"" + format_significant(is_point ? radius_ / 2 : radius_, 6) +
                                                "\" length=\"" + format_shortest(length) + "\"/>");
    }
    if (is_point || length == 0)
      add_visual(i, origin_tag(end, Vector3d::Zero()), "<sphere radius=\"" + format_significant(1.5 * radius_, 6) + "\"/>");
    text_ += "  </link>\n";
  }

  void add_visual(std::size_t i, const std::string& origin, const std::string& shape) {
    text_ += "    <visual>\n";
    if (!origin.empty()) text_ += "  " + line(origin);
    text_ += "  " + line("<geometry>" + shape + "</geometry>");
    text_ += "  " + line(std::string("<material name=\"") + (i % 2 == 0 ? "sky" : "orange") + "\"/>") + "    </visual>\n";
  }

  const LinkChain& chain_;
  std::vector<LetterJoint> joints_;
  double radius_ = 0;  // of rods, m
  std::string text_;
};

}  // namespace

std::string urdf_of(const LinkChain& chain, const std::string& name) {
  return Writer(chain).text(name);
}

}  // namespace chainreel
