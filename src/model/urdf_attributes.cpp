#include "model/urdf_attributes.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace chainreel {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kLongestName = 64;  // longer ones are not repeated in messages

// Of every tag that is read.
const std::map<std::string, std::vector<std::string>>& attributes_of_tags() {
  static const std::map<std::string, std::vector<std::string>> known{
      {"link", {"name"}},
      {"joint", {"name", "type"}},
      {"material", {"name"}},
      {"inertial", {}},
      {"visual", {"name"}},
      {"collision", {"name"}},
      {"geometry", {}},
      {"origin", {"xyz", "rpy"}},
      {"mass", {"value"}},
      {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}},
      {"parent", {"link"}},
      {"child", {"link"}},
      {"axis", {"xyz"}},
      {"limit", {"lower", "upper", "effort", "velocity"}},
      {"dynamics", {"damping", "friction"}},
      {"mimic", {"joint", "multiplier", "offset"}},
      {"box", {"size"}},
      {"cylinder", {"radius", "length"}},
      {"sphere", {"radius"}},
      {"mesh", {"filename", "scale"}},
      {"color", {"rgba"}},
      {"texture", {"filename"}},
  };
  return known;
}

std::string sorted(std::string word) {
  std::sort(word.begin(), word.end());
  return word;
}

// The name that was likely meant: two letters exchanged are nearer than any other slip.
std::string meant_by(const std::string& name, const std::vector<std::string>& known) {
  for (const std::string& candidate : known)
    if (sorted(name) == sorted(candidate)) return " did you mean '" + candidate + "'?";
  return near_name(name, known);
}

// `owner`: the link or joint around, "link 'arm'".
void examine(const XMLElement& element, const std::string& owner, UrdfProblems& problems) {
  const auto tag = attributes_of_tags().find(element.Name());
  if (tag == attributes_of_tags().end()) return;
  const std::vector<std::string>& known = tag->second;
  for (const tinyxml2::XMLAttribute* at = element.FirstAttribute(); at != nullptr; at = at->Next()) {
    const std::string name = at->Name();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    // One that stands beside what it resembles is something else.
    std::vector<std::string> absent;
    for (const std::string& candidate : known)
      if (element.Attribute(candidate.c_str()) == nullptr) absent.push_back(candidate);
    const std::string meant = meant_by(name, absent);
    problems.remark({meant.empty() ? "attributes that are not read" : "attributes that look misspelt",
                     owner + ": the attribute '" + (name.size() > kLongestName ? "..." : name) + "' of <" +
                         tag->first + "> is not read" + (meant.empty() ? "" : ":" + meant),
                     at->GetLineNum(), meant.empty()});
  }
  for (const XMLElement* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
    examine(*child, owner, problems);
}

}  // namespace

void examine_attributes(const XMLElement& robot, UrdfProblems& problems) {
  for (const XMLElement* child = robot.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const char* name = child->Attribute("name");
    examine(*child, std::string(child->Name()) + " '" + (name == nullptr ? "" : name) + "'", problems);
  }
}

}  // namespace chainreel
