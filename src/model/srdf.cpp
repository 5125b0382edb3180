#include "model/srdf.hpp"

#include <tinyxml2.h>

#include <map>
#include <set>
#include <sstream>

#include "core/format.hpp"
#include "model/urdf_problems.hpp"
#include "model/xml_text.hpp"

namespace chainreel {
namespace {

using tinyxml2::XMLElement;

class SrdfReader {
 public:
  explicit SrdfReader(const std::string& path) : problems_(path) { file_.path = path; }

  SrdfFile read(const XMLElement& robot) {
    file_.robot = text_of(robot, "name");
    for (const XMLElement* child = robot.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string tag = child->Name();
      if (tag == "group_state") read_state(*child);
      if (tag.starts_with("xacro:"))
        problems_.add(child->GetLineNum(),
                      "<" + tag + "> is a xacro macro: expand the file first with `xacro FILE > model.srdf`");
    }
    problems_.throw_if_any();
    if (file_.states.empty())
      throw Error(
          ExitCode::bad_input,
          "names no state: write <group_state name=\"home\" group=\"..\"> with a <joint name value/> each",
          {file_.path, robot.GetLineNum()});
    return std::move(file_);
  }

 private:
  static std::string text_of(const XMLElement& element, const char* attribute) {
    const char* text = element.Attribute(attribute);
    return text == nullptr ? "" : text;
  }

  void read_state(const XMLElement& element) {
    SrdfState state{text_of(element, "name"), text_of(element, "group"), {}, element.GetLineNum()};
    if (state.name.empty())
      problems_.add(state.line, "<group_state> has no name: write <group_state name=\"...\">");
    const auto [first, is_new] = lines_.emplace(std::pair(state.group, state.name), state.line);
    if (!is_new)
      problems_.add(state.line, "the state '" + state.name + "' of group '" + state.group +
                                    "' exists already (line " + std::to_string(first->second) +
                                    "): give each its own name");
    std::set<std::string> seen;
    for (const XMLElement* joint = element.FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      SrdfValue value = value_of(*joint, state.name);
      if (!value.joint.empty() && !seen.insert(value.joint).second)
        problems_.add(value.line, "state '" + state.name + "' gives joint '" + value.joint +
                                      "' a second value: keep one");
      state.joints.push_back(std::move(value));
    }
    file_.states.push_back(std::move(state));
  }

  SrdfValue value_of(const XMLElement& element, const std::string& state) {
    SrdfValue read{text_of(element, "name"), {}, element.GetLineNum()};
    if (read.joint.empty())
      problems_.add(read.line, "a <joint> of state '" + state +
                                   "' has no name: write <joint name=\"...\" value=\"...\"/>");
    std::istringstream words(text_of(element, "value"));
    for (std::string word; words >> word;) {
      const std::optional<double> number = parse_number(word);
      if (!number) {
        problems_.add(read.line, "state '" + state + "': joint '" + read.joint + "' has the value '" +
                                     shortened(word, 40) +
                                     "', which is not a number: write radians or metres");
        return read;
      }
      read.values.push_back(*number);
    }
    if (read.values.empty())
      problems_.add(read.line, "state '" + state + "': joint '" + read.joint +
                                   "' has no value: write value=\"...\" in rad or m");
    return read;
  }

  SrdfFile file_;
  UrdfProblems problems_;
  std::map<std::pair<std::string, std::string>, int> lines_;  // of (group, name)
};

}  // namespace

SrdfFile read_srdf(const std::string& path) {
  const std::string text = read_xml_text(path);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
    throw Error(ExitCode::bad_input,
                std::string("is not well-formed XML (") + document.ErrorName() +
                    "): close every tag and quote every attribute",
                {path, document.ErrorLineNum()});
  const XMLElement* root = document.RootElement();
  if (root == nullptr || std::string(root->Name()) != "robot")
    throw Error(ExitCode::bad_input, "is no SRDF: its outermost tag must be <robot>",
                {path, root == nullptr ? 0 : root->GetLineNum()});
  if (root->FirstChildElement("link") != nullptr)
    throw Error(ExitCode::bad_input,
                "is a URDF, not an SRDF: name it under `model:`, and the file with <group_state> here",
                {path, root->GetLineNum()});
  return SrdfReader(path).read(*root);
}

}  // namespace chainreel
