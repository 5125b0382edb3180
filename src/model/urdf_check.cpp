#include "model/urdf_check.hpp"

#include <tinyxml2.h>

#include <array>
#include <cmath>
#include <map>
#include <span>

#include "core/format.hpp"
#include "model/urdf_numbers.hpp"

namespace chainreel {
namespace {

using tinyxml2::XMLElement;
using Need = UrdfNumbers::Need;
using Range = UrdfNumbers::Range;

const std::vector<std::string> kRobotTags{"link", "joint", "material"};
const std::vector<std::string> kLinkTags{"inertial", "visual", "collision"};
const std::vector<std::string> kShapeTags{"origin", "geometry", "material"};
const std::vector<std::string> kGeometryTags{"box", "cylinder", "sphere", "mesh"};
const std::vector<std::string> kJointTags{"origin", "parent", "child", "axis", "limit", "dynamics", "mimic"};

bool is_one_of(const std::string& name, std::span<const std::string> names) {
  for (const std::string& candidate : names)
    if (name == candidate) return true;
  return false;
}

class Checker {
 public:
  Checker(tinyxml2::XMLDocument& document, const std::string& path, UrdfProblems& problems)
      : document_(document), problems_(problems), numbers_(problems) {
    result_.file.path = path;
  }

  CheckedUrdf run() {
    XMLElement& robot = robot_element();
    examine_attributes(robot, problems_);
    for (XMLElement* child = robot.FirstChildElement(); child != nullptr;) {
      XMLElement* next = child->NextSiblingElement();  // the child may be removed
      const std::string tag = child->Name();
      if (tag == "link") check_link(*child);
      if (tag == "joint") check_joint(*child);
      if (tag == "material") check_robot_material(*child);
      if (tag.starts_with("xacro:")) {
        problems_.add(child->GetLineNum(),
                      "<" + tag + "> is a xacro macro: expand the file first with `xacro FILE > model.urdf`");
      }
      if (!is_one_of(tag, kRobotTags)) ignore(*child);
      if (tag != "link" && tag != "joint") robot.DeleteChild(child);
      child = next;
    }
    if (result_.file.links.empty()) {
      problems_.add(robot.GetLineNum(),
                    "the model has no link: write at least a base and one <link> on a <joint>");
    }
    tinyxml2::XMLPrinter printer(nullptr, true);
    document_.Print(&printer);
    result_.plain = printer.CStr();
    return std::move(result_);
  }

 private:
  XMLElement& robot_element() {
    XMLElement* root = document_.RootElement();
    const std::string tag = root == nullptr ? "" : root->Name();
    if (tag != "robot") {
      throw Error(
          ExitCode::bad_input,
          "is no URDF: its outermost tag must be <robot>" + (tag.empty() ? "" : ", not <" + tag + ">"),
          result_.file.at(root == nullptr ? 0 : root->GetLineNum()));
    }
    result_.file.name = name_of(*root, "robot");
    return *root;
  }

  std::string name_of(const XMLElement& element, const std::string& kind) {
    const char* name = element.Attribute("name");
    if (name != nullptr && *name != '\0') return name;
    problems_.add(element.GetLineNum(), "<" + kind + "> has no name: write <" + kind + " name=\"...\">");
    return "";
  }

  // A name is given once; the place of the first is told with the second.
  void remember(std::map<std::string, int>& lines, const std::string& kind, const std::string& name,
                int line) {
    const auto [found, is_new] = lines.emplace(name, line);
    if (is_new || name.empty()) return;
    problems_.add(line, kind + " '" + name + "' exists already (line " + std::to_string(found->second) +
                            "): give each its own name");
  }

  // The child of that tag; a second one would be ignored in silence by urdfdom.
  XMLElement* only_child(XMLElement& element, const char* tag, const std::string& owner) {
    XMLElement* first = element.FirstChildElement(tag);
    const XMLElement* second = first == nullptr ? nullptr : first->NextSiblingElement(tag);
    if (second != nullptr)
      problems_.add(second->GetLineNum(), owner + " has more than one <" + tag + ">: keep one");
    return first;
  }

  void ignore(const XMLElement& element) {
    const std::string parent = element.Parent()->ToElement()->Name();
    auto& known = ignored_[parent + "/" + element.Name()];
    if (known == 0) {
      result_.file.ignored.push_back({element.Name(), parent, 0, element.GetLineNum()});
      known = int(result_.file.ignored.size());
    }
    ++result_.file.ignored[std::size_t(known - 1)].count;
  }

  // Takes out every child that is not one of `tags`, so that urdfdom cannot stumble over it.
  void strip(XMLElement& element, std::span<const std::string> tags) {
    for (XMLElement* child = element.FirstChildElement(); child != nullptr;) {
      XMLElement* next = child->NextSiblingElement();
      if (!is_one_of(child->Name(), tags)) {
        ignore(*child);
        element.DeleteChild(child);
      }
      child = next;
    }
  }

  void check_link(XMLElement& element) {
    UrdfLink link;
    link.name = name_of(element, "link");
    link.line = element.GetLineNum();
    remember(link_lines_, "link", link.name, link.line);
    const std::string owner = "link '" + link.name + "'";
    strip(element, kLinkTags);

    if (XMLElement* inertial = only_child(element, "inertial", owner))
      link.inertial = check_inertial(*inertial, owner);
    link.visuals = check_shapes(element, "visual", owner);
    link.collisions = check_shapes(element, "collision", owner);
    result_.file.links.push_back(std::move(link));
  }

  UrdfInertial check_inertial(XMLElement& element, const std::string& owner) {
    UrdfInertial inertial;
    inertial.line = inertial.mass_line = element.GetLineNum();
    inertial.origin = numbers_.origin(element, owner);

    if (XMLElement* mass = only_child(element, "mass", owner)) {
      inertial.mass_line = mass->GetLineNum();
      const auto value = numbers_.one(*mass, "value", owner, Need::required);
      if (value && *value < 0)
        problems_.add(mass->GetLineNum(), owner + " has a negative mass: no body has one");
    } else {
      problems_.add(inertial.line, owner + ": <inertial> has no <mass>: write <mass value=\"...\"/> in kg");
    }
    if (XMLElement* inertia = only_child(element, "inertia", owner)) {
      for (const char* entry : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"})
        numbers_.one(*inertia, entry, owner, Need::required);
    } else {
      problems_.add(
          inertial.line,
          owner +
              ": <inertial> has no <inertia>: write all six of ixx ixy ixz iyy iyz izz in kg m^2 (zeros "
              "for a point mass)");
    }
    return inertial;
  }

  std::vector<UrdfShape> check_shapes(XMLElement& link, const char* tag, const std::string& owner) {
    std::vector<UrdfShape> shapes;
    for (XMLElement* element = link.FirstChildElement(tag); element != nullptr;) {
      XMLElement* next = element->NextSiblingElement(tag);
      strip(*element, kShapeTags);
      const std::optional<UrdfMaterial> material = take_material(*element, tag, owner);
      XMLElement* geometry = only_child(*element, "geometry", owner);
      if (geometry == nullptr) {
        problems_.add(element->GetLineNum(),
                      owner + ": <" + tag + "> has no <geometry>: add one or remove the tag");
      } else {
        strip(*geometry, kGeometryTags);
        if (XMLElement* shape = geometry->FirstChildElement()) {
          check_geometry(*shape, owner);
          shapes.emplace_back();
          shapes.back().origin = numbers_.origin(*element, owner);
          shapes.back().material = material;
          shapes.back().line = element->GetLineNum();
        } else {
          link.DeleteChild(element);  // a capsule or the like, which was counted as ignored
        }
      }
      element = next;
    }
    return shapes;
  }

  // The <material> of a <visual>. All are taken out: urdfdom refuses incomplete ones, and names that only a later
  // link explains. Those of a <collision> are seen by nobody.
  std::optional<UrdfMaterial> take_material(XMLElement& shape, const std::string& tag,
                                            const std::string& owner) {
    std::optional<UrdfMaterial> material;
    if (tag == "visual")
      if (XMLElement* first = only_child(shape, "material", owner)) material = check_material(*first, owner);
    while (XMLElement* found = shape.FirstChildElement("material")) shape.DeleteChild(found);
    return material;
  }

  UrdfMaterial check_material(XMLElement& element, const std::string& owner) {
    UrdfMaterial material;
    const char* name = element.Attribute("name");
    material.name = name == nullptr ? "" : name;
    material.line = element.GetLineNum();
    if (XMLElement* color = only_child(element, "color", owner)) material.rgba = numbers_.rgba(*color, owner);
    if (XMLElement* texture = only_child(element, "texture", owner)) {
      const char* file = texture->Attribute("filename");
      material.texture = file == nullptr ? "" : file;
      material.has_empty_texture = material.texture.empty();
      if (material.has_empty_texture)
        problems_.remark({"textures without a file",
                          owner + ": <texture> names no file and is not read: write <texture filename=\"...\"/>",
                          texture->GetLineNum()});
    }
    return material;
  }

  void check_robot_material(XMLElement& element) {
    const std::string name = name_of(element, "material");
    result_.file.materials.push_back(check_material(element, "material '" + name + "'"));
  }

  void require_length(double value, const XMLElement& shape, const std::string& attribute, const std::string& owner) {
    if (value < 0)
      problems_.add(shape.GetLineNum(), owner + ": the " + attribute + " of its <" + shape.Name() + "> is negative (" +
                                            format_shortest(value) + "): a shape is at least as large as nothing");
  }

  void check_geometry(XMLElement& shape, const std::string& owner) {
    const std::string tag = shape.Name();
    if (tag == "box")
      if (const auto size = numbers_.three(shape, "size", owner, Need::required))
        require_length(size->minCoeff(), shape, "size", owner);
    if (tag == "sphere" || tag == "cylinder")
      if (const auto radius = numbers_.one(shape, "radius", owner, Need::required))
        require_length(*radius, shape, "radius", owner);
    if (tag == "cylinder")
      if (const auto length = numbers_.one(shape, "length", owner, Need::required))
        require_length(*length, shape, "length", owner);
    if (tag == "mesh") {
      numbers_.three(shape, "scale", owner, Need::optional);
      const char* file = shape.Attribute("filename");
      if (file == nullptr || *file == '\0')
        problems_.add(shape.GetLineNum(), owner + ": <mesh> names no file: write <mesh filename=\"...\"/>");
    }
  }

  void check_joint(XMLElement& element) {
    UrdfJoint joint;
    joint.name = name_of(element, "joint");
    joint.line = element.GetLineNum();
    remember(joint_lines_, "joint", joint.name, joint.line);
    const std::string owner = "joint '" + joint.name + "'";
    strip(element, kJointTags);

    const bool has_type = check_type(element, joint, owner);
    joint.origin = numbers_.origin(element, owner);
    result_.parent_names.push_back(end_of(element, "parent", owner));
    result_.child_names.push_back(end_of(element, "child", owner));
    if (has_type) check_axis(element, joint, owner);
    check_limit(element, joint, owner);
    check_dynamics(element, owner);
    XMLElement* mimic = only_child(element, "mimic", owner);
    if (mimic != nullptr && joint.type == UrdfJointType::fixed && has_type) {
      problems_.remark({"fixed joints that mimic",
                        owner + " is fixed, so its <mimic> is not read: give it another type if it shall move",
                        mimic->GetLineNum()});
      element.DeleteChild(mimic);
      mimic = nullptr;
    }
    if (mimic != nullptr) {
      joint.mimic.emplace();
      joint.mimic->line = mimic->GetLineNum();
      const char* target = mimic->Attribute("joint");
      joint.mimic->joint = target == nullptr ? "" : target;
      if (joint.mimic->joint.empty()) {
        problems_.add(mimic->GetLineNum(), owner + ": <mimic> names no joint: write <mimic joint=\"...\"/>");
      }
      numbers_.one(*mimic, "multiplier", owner, Need::optional);
      numbers_.one(*mimic, "offset", owner, Need::optional);
    }
    result_.file.joints.push_back(std::move(joint));
  }

  bool check_type(const XMLElement& element, UrdfJoint& joint, const std::string& owner) {
    static const std::vector<std::string> names{"revolute", "continuous", "prismatic",
                                                "fixed",    "floating",   "planar"};
    const char* text = element.Attribute("type");
    if (text == nullptr) {
      problems_.add(
          joint.line,
          owner + " has no type: write type=\"revolute\", continuous, prismatic, fixed, floating or planar");
      return false;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != text) continue;
      joint.type = UrdfJointType(int(i));
      return true;
    }
    problems_.add(joint.line, owner + " has the unknown type '" + text + "':" + near_name(text, names) +
                                  " there are revolute, continuous, prismatic, fixed, floating and planar");
    return false;
  }

  // The link that <parent> or <child> names.
  std::string end_of(XMLElement& element, const char* tag, const std::string& owner) {
    const XMLElement* end = only_child(element, tag, owner);
    const char* name = end == nullptr ? nullptr : end->Attribute("link");
    if (name != nullptr && *name != '\0') return name;
    problems_.add(end == nullptr ? element.GetLineNum() : end->GetLineNum(),
                  owner + " names no " + tag + " link: write <" + tag + " link=\"...\"/>");
    return "";
  }

  void check_axis(XMLElement& element, const UrdfJoint& joint, const std::string& owner) {
    XMLElement* axis = only_child(element, "axis", owner);
    if (axis == nullptr || joint.type == UrdfJointType::fixed || joint.type == UrdfJointType::floating)
      return;
    const auto xyz = numbers_.three(*axis, "xyz", owner, Need::required);
    // Below this the squared length of the axis has no digits left.
    if (xyz && !(xyz->cwiseAbs().maxCoeff() > 1e-100))
      problems_.add(axis->GetLineNum(),
                    owner + " has a zero axis: give it a direction, such as xyz=\"0 0 1\"");
  }

  void check_limit(XMLElement& element, UrdfJoint& joint, const std::string& owner) {
    XMLElement* limit = only_child(element, "limit", owner);
    joint.limit.given = limit != nullptr;
    if (limit != nullptr) {
      joint.limit.line = limit->GetLineNum();
      const auto number = [&](const char* attribute) { return numbers_.one(*limit, attribute, owner, Need::optional, Range::any); };
      joint.limit.has_lower = number("lower").has_value();
      joint.limit.has_upper = number("upper").has_value();
      const auto effort = number("effort"), velocity = number("velocity");
      joint.limit.has_effort = effort.has_value();
      joint.limit.has_velocity = velocity.has_value();
      for (const auto& [attribute, value] : {std::pair("effort", effort), std::pair("velocity", velocity)})
        if (value && *value < 0)
          problems_.add(limit->GetLineNum(), owner + " has a limit of " + attribute + " below zero: limits are sizes, of either direction; leave the attribute out where there is none");
    } else if (joint.type == UrdfJointType::revolute || joint.type == UrdfJointType::prismatic) {
      limit = element.InsertNewChildElement("limit");
    } else {
      return;
    }
    // urdfdom insists on both; what was not written is not looked at later.
    if (!joint.limit.has_effort) limit->SetAttribute("effort", "0");
    if (!joint.limit.has_velocity) limit->SetAttribute("velocity", "0");
  }

  void check_dynamics(XMLElement& element, const std::string& owner) {
    XMLElement* dynamics = only_child(element, "dynamics", owner);
    if (dynamics == nullptr) return;
    for (const char* attribute : {"damping", "friction"}) {
      const auto value = numbers_.one(*dynamics, attribute, owner, Need::optional);
      if (value && *value < 0) {
        problems_.add(dynamics->GetLineNum(),
                      owner + " has negative " + attribute + ", which would feed energy in: write 0 or more");
      }
    }
    // urdfdom refuses an empty <dynamics>.
    if (dynamics->Attribute("damping") == nullptr && dynamics->Attribute("friction") == nullptr)
      dynamics->SetAttribute("damping", "0");
  }

  tinyxml2::XMLDocument& document_;
  UrdfProblems& problems_;
  UrdfNumbers numbers_;
  CheckedUrdf result_;
  std::map<std::string, int> link_lines_, joint_lines_;
  std::map<std::string, int> ignored_;  // "parent/tag" -> 1 + index into UrdfFile::ignored
};

}  // namespace

CheckedUrdf check_urdf(const std::string& text, const std::string& path, UrdfProblems& problems) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw Error(ExitCode::bad_input,
                std::string("is not well-formed XML (") + document.ErrorName() +
                    "): close every tag and quote every attribute",
                {path, document.ErrorLineNum()});
  }
  return Checker(document, path, problems).run();
}

}  // namespace chainreel
