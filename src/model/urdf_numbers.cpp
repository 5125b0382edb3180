#include "model/urdf_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/format.hpp"

namespace chainreel {
namespace {

using tinyxml2::XMLElement;

constexpr std::string_view kSpace = " \t\r\n";

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(kSpace); at != std::string_view::npos;
       at = text.find_first_not_of(kSpace, at)) {
    const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 40;
  return text.size() <= kMost ? "'" + std::string(text) + "'"
                              : "'" + std::string(text.substr(0, kMost)) + "...'";
}

// Why the text is no number, and what to write instead.
std::string remedy_for(std::string_view text) {
  if (text.find(',') != std::string_view::npos) return "write it with a decimal point";
  if (text.find("${") != std::string_view::npos || text.find("$(") != std::string_view::npos)
    return "this looks like a xacro file: expand it first with `xacro FILE > model.urdf`";
  const bool has_digit = text.find_first_of("0123456789") != std::string_view::npos;
  const bool only_number_signs = text.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
  if (has_digit && only_number_signs && text.find_first_of("eE") != std::string_view::npos)
    return "it is beyond the range of a double";
  return "write a finite number such as 0.25 or 1e-3";
}

std::string name_of(const XMLElement& element, const char* attribute, const std::string& owner) {
  return owner + ": <" + element.Name() + " " + attribute + ">";
}

}  // namespace

std::optional<double> UrdfNumbers::parse(std::string_view text, const XMLElement& element,
                                         const char* attribute, const std::string& owner, Range range) {
  const std::optional<double> value = parse_number(text);
  if (!value) {
    problems_.add(element.GetLineNum(), name_of(element, attribute, owner) + " " + quoted(text) +
                                            " is not a number: " + remedy_for(text));
  } else if (range == Range::physical && std::fabs(*value) > kLargestUrdfNumber) {
    problems_.add(element.GetLineNum(), name_of(element, attribute, owner) + " " + quoted(text) +
                                            " is larger than " + format_shortest(kLargestUrdfNumber) +
                                            ": URDF is in metres, kilograms and radians");
    return std::nullopt;
  }
  return value;
}

std::optional<double> UrdfNumbers::one(XMLElement& element, const char* attribute, const std::string& owner,
                                       Need need, Range range) {
  const char* text = element.Attribute(attribute);
  if (text == nullptr) {
    if (need == Need::required) {
      problems_.add(element.GetLineNum(), name_of(element, attribute, owner) + " is missing: write " +
                                              attribute + "=\"...\" with a number");
    }
    return std::nullopt;
  }
  const std::vector<std::string_view> words = words_of(text);
  const auto value =
      parse(words.size() == 1 ? words[0] : std::string_view(text), element, attribute, owner, range);
  if (value) element.SetAttribute(attribute, format_shortest(*value).c_str());
  return value;
}

std::optional<Eigen::Vector3d> UrdfNumbers::three(XMLElement& element, const char* attribute,
                                                  const std::string& owner, Need need) {
  const char* text = element.Attribute(attribute);
  if (text == nullptr) {
    if (need == Need::required) {
      problems_.add(element.GetLineNum(), name_of(element, attribute, owner) + " is missing: write " +
                                              attribute + "=\"...\" with three numbers");
    }
    return std::nullopt;
  }
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != 3) {
    const bool has_comma = std::string_view(text).find(',') != std::string_view::npos;
    problems_.add(element.GetLineNum(), name_of(element, attribute, owner) + " " + quoted(text) +
                                            " must be three numbers with spaces between" +
                                            (has_comma ? ", no commas" : ""));
    return std::nullopt;
  }
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) {
    const auto value = parse(words[std::size_t(i)], element, attribute, owner, Range::physical);
    if (!value) return std::nullopt;
    vector[i] = *value;
  }
  const std::string plain =
      format_shortest(vector[0]) + " " + format_shortest(vector[1]) + " " + format_shortest(vector[2]);
  element.SetAttribute(attribute, plain.c_str());
  return vector;
}

std::optional<std::array<double, 4>> UrdfNumbers::rgba(XMLElement& color, const std::string& owner) {
  const char* text = color.Attribute("rgba");
  const std::vector<std::string_view> words = words_of(text == nullptr ? "" : text);
  if (words.size() != 4) {
    problems_.add(color.GetLineNum(),
                  owner + ": <color> must have four numbers, red green blue and opacity: write rgba=\"0.5 "
                          "0.5 0.5 1\"");
    return std::nullopt;
  }
  std::array<double, 4> rgba{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto value = parse(words[i], color, "rgba", owner, Range::physical);
    if (!value) return std::nullopt;
    rgba[i] = *value;
    if (*value >= 0 && *value <= 1) continue;
    problems_.add(color.GetLineNum(), name_of(color, "rgba", owner) + " " + quoted(words[i]) +
                                          " is not between 0 and 1" +
                                          (*value > 1 ? ": divide it by 255 if that was meant" : ""));
    return std::nullopt;
  }
  return rgba;
}

UrdfOrigin UrdfNumbers::origin(XMLElement& element, const std::string& owner) {
  UrdfOrigin origin;
  XMLElement* found = element.FirstChildElement("origin");
  if (found == nullptr) return origin;
  if (const XMLElement* second = found->NextSiblingElement("origin")) problems_.add(second->GetLineNum(), owner + " has more than one <origin>: keep one");
  origin.xyz = three(*found, "xyz", owner, Need::optional).value_or(origin.xyz);
  origin.rpy = three(*found, "rpy", owner, Need::optional).value_or(origin.rpy);
  return origin;
}

namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kLongestName = 64;  // longer ones are not repeated in messages

// The attributes of every tag that is read.
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
