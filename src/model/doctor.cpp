#include "model/doctor.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/format.hpp"
#include "model/planar.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {
namespace {

using Severity = Finding::Severity;

// Longer, and the file is likely in millimetres, m.
constexpr double kLongestJointOffset = 100;
// A joint that turns further than three times around either way is likely limited in degrees, rad.
constexpr double kWidestTurn = 20;
// A fixed rotation of more than that is likely in degrees, rad; a turn that was rounded up is not.
constexpr double kMoreThanATurn = 6.3;

// Tags that URDF files carry for other programs.
const std::vector<std::string> kReadTags{"link",      "joint",  "material", "inertial", "visual",
                                         "collision", "origin", "mass",     "inertia",  "geometry",
                                         "parent",    "child",  "axis",     "limit",    "dynamics",
                                         "mimic",     "box",    "cylinder", "sphere",   "mesh"};

// What the options made of the model: only told, never wrong.
void examine_chain(const Chain& chain, const ModelOptions& options, DoctorReport& report) {
  if (is_nearly_planar(chain))
    report.add(Severity::warning, "near planes", 0, "almost planar, but " + chain.why_algebra);
  if (!options.massless) return;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    if (chain.bodies[i].inertia.mass != *options.massless) continue;
    report.add(Severity::note, "links that were given a mass", 0,
               "link '" + chain.bodies[i].name + "' has no mass of its own and is given " +
                   format_shortest(*options.massless) + " kg");
  }
}

void examine_limit(const UrdfJoint& joint, DoctorReport& report) {
  const UrdfLimit& limit = joint.limit;
  const std::string owner = "joint '" + joint.name + "'";
  const int line = limit.line;
  if (!limit.has_lower && !limit.has_upper) {
    report.add(Severity::warning, "limits without lower and upper", line,
               owner +
                   ": <limit> has neither lower nor upper, which means 0 to 0: write both, or make the joint "
                   "continuous");
  } else if (limit.lower > limit.upper) {
    report.add(Severity::warning, "limits with lower above upper", line,
               owner + " has its lower limit " + format_shortest(limit.lower) + " above its upper limit " +
                   format_shortest(limit.upper) + ": swap them");
  } else if (limit.lower == limit.upper) {
    report.add(Severity::warning, "limits without a range", line,
               owner + " is limited to the single value " + format_shortest(limit.lower) +
                   ": widen the limit, or make the joint fixed");
  } else if (joint.type == UrdfJointType::revolute &&
             std::max(std::fabs(limit.lower), std::fabs(limit.upper)) > kWidestTurn) {
    report.add(Severity::warning, "limits that look like degrees", line,
               owner + " may turn from " + format_shortest(limit.lower) + " to " +
                   format_shortest(limit.upper) + " rad: were degrees meant? URDF has radians");
  }
}

void examine_strength(const UrdfJoint& joint, DoctorReport& report) {
  const std::string owner = "joint '" + joint.name + "'";
  for (const bool is_effort : {true, false}) {
    const bool given = is_effort ? joint.limit.has_effort : joint.limit.has_velocity;
    const double value = is_effort ? joint.limit.effort : joint.limit.velocity;
    const std::string what = is_effort ? "effort" : "velocity";
    if (!given || value > 0) continue;
    report.add(Severity::warning, what + " limits of 0 or less", joint.limit.line,
               owner + " has a limit of " + format_shortest(value) + " for " + what +
                   ", which allows none: leave the "
                   "attribute out where there is no limit");
  }
}

std::string angles_text(const Eigen::Vector3d& rpy) {
  return format_shortest(rpy[0]) + " " + format_shortest(rpy[1]) + " " + format_shortest(rpy[2]);
}

}  // namespace

void examine_angles(const UrdfOrigin& origin, const std::string& owner, int line, DoctorReport& report) {
  if (!(origin.rpy.cwiseAbs().maxCoeff() > kMoreThanATurn)) return;
  report.add(Finding::Severity::warning, "angles that look like degrees", line,
             owner + " has rpy=\"" + angles_text(origin.rpy) +
                 "\", more than a whole turn: were degrees meant? URDF has radians (90 degrees are 1.5707963)");
}

void examine_remarks(const UrdfFile& file, DoctorReport& report) {
  for (const UrdfRemark& remark : file.remarks)
    report.add(remark.is_harmless ? Finding::Severity::note : Finding::Severity::warning, remark.kind, remark.line,
               remark.message);
}

std::string to_string(Finding::Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::note:
      return "note";
  }
  return "";
}

void DoctorReport::add(Severity severity, const std::string& kind, int line, std::string message) {
  Kind& known = kinds_[kind];
  known.severity = severity;
  if (++known.count <= kMostOfAKind) {
    findings_.push_back({severity, std::move(message), {path_, line, 0}});
  } else if (known.first_unlisted_line == 0) {
    known.first_unlisted_line = line;
  }
}

void DoctorReport::add_errors(const Error& error) {
  for (const Problem& problem : error.problems())
    findings_.push_back({Severity::error, problem.message, problem.place});
}

std::vector<Finding> DoctorReport::sorted() {
  std::stable_sort(findings_.begin(), findings_.end(), [](const Finding& a, const Finding& b) {
    return a.severity != b.severity ? a.severity < b.severity : a.place.line < b.place.line;
  });
  // Behind all others of their severity.
  for (const auto& [name, kind] : kinds_) {
    if (kind.count <= kMostOfAKind) continue;
    const auto behind = std::find_if(findings_.begin(), findings_.end(), [&](const Finding& finding) {
      return finding.severity > kind.severity;
    });
    findings_.insert(behind, {kind.severity,
                              "and " + std::to_string(kind.count - kMostOfAKind) + " more " + name,
                              {path_, kind.first_unlisted_line, 0}});
  }
  return std::move(findings_);
}

namespace {

std::string not_read(const UrdfIgnoredTag& tag) {
  return "<" + tag.name + "> inside <" + tag.parent + "> is not read" + (tag.count > 1 ? " (" + std::to_string(tag.count) + " times, the first is here)" : "");
}

}  // namespace

std::vector<std::string> slips_of(const UrdfFile& file) {
  std::vector<std::pair<int, std::string>> found;
  for (const UrdfRemark& remark : file.remarks)
    if (!remark.is_harmless) found.emplace_back(remark.line, remark.message);
  for (const UrdfIgnoredTag& tag : file.ignored)
    if (const std::string near = near_name(tag.name, kReadTags); !near.empty()) found.emplace_back(tag.first_line, not_read(tag) + ":" + near);
  std::ranges::stable_sort(found, {}, &std::pair<int, std::string>::first);
  std::vector<std::string> slips;
  const std::string name = std::filesystem::path(file.path).filename().string();
  for (std::size_t i = 0; i < std::min(found.size(), std::size_t(kMostOfAKind)); ++i) slips.push_back(name + ":" + std::to_string(found[i].first) + ": " + found[i].second);
  if (found.size() > slips.size()) slips.push_back(name + ": and " + std::to_string(found.size() - slips.size()) + " more: `chainreel check " + name + "`");
  return slips;
}

void examine_tags(const UrdfFile& file, DoctorReport& report) {
  for (const UrdfIgnoredTag& tag : file.ignored) {
    const std::string message = not_read(tag), near = near_name(tag.name, kReadTags);
    const Severity severity = near.empty() ? Severity::note : Severity::warning;
    report.add(severity, "tags that are not read", tag.first_line,
               message + (near.empty() ? "" : ":" + near));
  }
}

void examine_joints(const UrdfFile& file, DoctorReport& report) {
  for (const UrdfJoint& joint : file.joints) {
    const std::string owner = "joint '" + joint.name + "'";
    const bool is_bounded = joint.type == UrdfJointType::revolute || joint.type == UrdfJointType::prismatic;
    if (is_bounded && !joint.limit.given) {
      report.add(Severity::note, "joints without <limit>", joint.line,
                 owner + " is " + to_string(joint.type) +
                     " without <limit>: it is read as unlimited; other programs "
                     "want <limit lower=\"..\" upper=\"..\" effort=\"..\" velocity=\"..\"/>");
    }
    if (is_bounded && joint.limit.given) examine_limit(joint, report);
    if (joint.type != UrdfJointType::fixed) examine_strength(joint, report);
    examine_angles(joint.origin, owner, joint.line, report);
    const double offset = joint.origin.xyz.norm();
    if (offset > kLongestJointOffset) {
      report.add(Severity::warning, "joints far from their parents", joint.line,
                 owner + " sits " + format_significant(offset, 3) +
                     " m from its parent link: were millimetres meant? URDF has metres");
    }
  }
}

std::vector<Finding> examine_model(const std::string& path, const ModelOptions& options) {
  DoctorReport report(path);
  try {
    const UrdfFile file = read_urdf_file(path);
    examine_tags(file, report);
    examine_remarks(file, report);
    examine_joints(file, report);
    examine_links(file, options, report);
    examine_chain(chain_of(file, options), options, report);
  } catch (const Error& error) {
    report.add_errors(error);
  }
  return report.sorted();
}

}  // namespace chainreel
