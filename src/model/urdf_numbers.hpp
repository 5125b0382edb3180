// Numbers in the attributes of a URDF file, always in the C locale, each complaint with its line and its
// remedy. A good number is written back in plain form (no sign +, no white space around it), since urdfdom
// drops in silence what it cannot read.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "model/urdf_file.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {

// Beyond this no mechanism in SI units goes, and squares still have room in a double.
inline constexpr double kLargestUrdfNumber = 1e12;

class UrdfNumbers {
 public:
  explicit UrdfNumbers(UrdfProblems& problems) : problems_(problems) {}

  enum class Need { required, optional };
  // Mass, length and inertia are physical; a limit may be any finite number ("as strong as you like").
  enum class Range { physical, any };

  // The number in `attribute`; nothing where it is absent or wrong (then a problem is noted). `owner` opens
  // the message: "link 'arm'".
  std::optional<double> one(tinyxml2::XMLElement& element, const char* attribute, const std::string& owner,
                            Need need, Range range = Range::physical);
  // Three numbers with white space between them.
  std::optional<Eigen::Vector3d> three(tinyxml2::XMLElement& element, const char* attribute,
                                       const std::string& owner, Need need);
  // The four of <color rgba>, each from 0 to 1.
  std::optional<std::array<double, 4>> rgba(tinyxml2::XMLElement& color, const std::string& owner);
  // <origin> inside `element`, zero where it is absent.
  UrdfOrigin origin(tinyxml2::XMLElement& element, const std::string& owner);

 private:
  std::optional<double> parse(std::string_view text, const tinyxml2::XMLElement& element,
                              const char* attribute, const std::string& owner, Range range);

  UrdfProblems& problems_;
};

// Attributes that nothing reads: `xzy` where `xyz` was meant would leave a link at its parent's origin in silence.

// A remark for each attribute of a tag that is read which is none of its own. Below tags that are not read nothing is
// looked at.
void examine_attributes(const tinyxml2::XMLElement& robot, UrdfProblems& problems);

}  // namespace chainreel
