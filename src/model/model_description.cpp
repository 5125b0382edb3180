#include "model/model_description.hpp"

#include <map>
#include <stdexcept>
#include <string_view>

#include "core/error.hpp"
#include "mesh/read_mesh.hpp"
#include "model/materials.hpp"
#include "model/package_path.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {
namespace {

constexpr const char* kShapeKinds[] = {"box", "cylinder", "sphere", "mesh"};
constexpr UrdfJointType kJointTypes[] = {UrdfJointType::revolute,  UrdfJointType::continuous,
                                         UrdfJointType::prismatic, UrdfJointType::fixed,
                                         UrdfJointType::floating,  UrdfJointType::planar};

// "package://arm/meshes/link.stl" is "link.stl".
std::string name_of_file(const std::string& written) {
  return written.substr(written.find_last_of("/\\") + 1);
}

class Describer {
 public:
  Describer(const UrdfFile& file, const ModelOptions& options)
      : finder_(file.path, options.packages),
        materials_(file, options),
        unheard_(file.path),
        reads_meshes_(options.meshes) {}

  DescribedShape described(const UrdfShape& shape, const std::string& link) {
    DescribedShape one;
    one.shape = shape;
    one.shape.material.reset();
    if (shape.material) {
      one.color = materials_.color_of(*shape.material, link, unheard_);
      one.material = shape.material->name;
      if (const UrdfMaterial* meaning = materials_.meaning_of(*shape.material))
        one.texture = name_of_file(meaning->texture);
    }
    if (shape.kind == UrdfShapeKind::mesh) {
      one.shape.mesh_file = name_of_file(shape.mesh_file);
      one.mesh = mesh(shape.mesh_file);
    }
    return one;
  }

  std::vector<DescribedMesh> take_meshes() { return std::move(meshes_); }

 private:
  int mesh(const std::string& written) {
    const auto [known, is_new] = indices_.try_emplace(written, int(meshes_.size()));
    if (!is_new) return known->second;
    meshes_.push_back({name_of_file(written), {}});
    if (!reads_meshes_) return known->second;
    try {
      const FoundFile& found = finder_.find(written);
      if (!found.path.empty()) meshes_.back().sketch = sketch_of(read_mesh(found.path));
    } catch (const Error&) {
      // Pictures that show it say what is wrong with it.
    }
    return known->second;
  }

  FileFinder finder_;
  Materials materials_;
  UrdfProblems unheard_;  // pictures tell them
  bool reads_meshes_;
  std::vector<DescribedMesh> meshes_;
  std::map<std::string, int> indices_;  // by the name as written
};

}  // namespace

std::vector<DescribedCoordinate> coordinates_of(const Chain& chain) {
  std::vector<DescribedCoordinate> coordinates;
  for (std::string& name : position_names(chain)) coordinates.push_back({std::move(name), ""});
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.ratio != 1 || joint.offset != 0) continue;  // it reads another joint's coordinate
    const auto at = std::size_t(joint.q_index);
    const std::size_t metres = joint.kind == JointKind::floating    ? 3
                               : joint.kind == JointKind::prismatic ? 1
                                                                    : 0;
    for (std::size_t k = 0; k < metres; ++k) coordinates[at + k].unit = "m";
    if (joint.kind == JointKind::revolute) coordinates[at].unit = "rad";
  }
  return coordinates;
}

namespace {

// Those of the text that numbers became: nobody can look them up.
void forget_lines(UrdfFile& file) {
  for (UrdfLink& link : file.links) {
    link.line = 0;
    if (link.inertial) link.inertial->line = link.inertial->mass_line = 0;
    for (UrdfShape& shape : link.visuals) shape.line = 0;
    for (UrdfShape& shape : link.collisions) shape.line = 0;
  }
  for (UrdfJoint& joint : file.joints) {
    joint.line = joint.limit.line = 0;
    if (joint.mimic) joint.mimic->line = 0;
  }
}

}  // namespace

ModelDescription describe_model(const ModelSource& source, const ModelOptions& options,
                                DescribeCollisions collisions) {
  UrdfFile file = read_urdf_file(source);
  if (source.links) forget_lines(file);
  const Chain chain = chain_of(file, options);
  ModelDescription model;
  model.name = file.name;
  model.joints = file.joints;
  model.root = file.root;
  model.coordinates = coordinates_of(chain);
  model.gravity = chain.gravity;
  model.floating_base = options.floating_base;
  model.friction = options.friction;
  model.massless = options.massless;
  if (chain.end_effector >= 0) model.end_effector = chain.frames[std::size_t(chain.end_effector)].name;
  if (options.payload.mass > 0) model.payload = options.payload;
  if (options.payload.mass > 0 && options.payload.link.empty()) model.payload.link = model.end_effector;
  Describer describer(file, options);
  for (const UrdfLink& link : file.links) {
    DescribedLink one{link.name, link.line, link.inertial, {}, {}};
    for (const UrdfShape& shape : link.visuals) one.visuals.push_back(describer.described(shape, link.name));
    if (link.visuals.empty() || collisions == DescribeCollisions::all)
      for (const UrdfShape& shape : link.collisions)
        one.collisions.push_back(describer.described(shape, link.name));
    model.links.push_back(std::move(one));
  }
  model.meshes = describer.take_meshes();
  return model;
}

// --- as JSON
namespace {

template <int n>
Json json_of(const Eigen::Matrix<double, n, 1>& v) {
  Json json = Json::array();
  for (const double x : v) json.push_back(x);
  return json;
}

void add_origin(const UrdfOrigin& origin, Json& json) {
  json["xyz"] = json_of(origin.xyz);
  json["rpy"] = json_of(origin.rpy);
}

Json json_of(const UrdfInertial& inertial) {
  const Eigen::Matrix3d& I = inertial.inertia;
  Json json{{"line", inertial.line}, {"mass_line", inertial.mass_line}, {"mass", inertial.mass}};
  add_origin(inertial.origin, json);
  json["inertia"] = {I(0, 0), I(0, 1), I(0, 2), I(1, 1), I(1, 2), I(2, 2)};
  return json;
}

Json json_of(const std::vector<DescribedShape>& shapes) {
  Json list = Json::array();
  for (const DescribedShape& one : shapes) {
    Json json{{"line", one.shape.line}, {"kind", kShapeKinds[std::size_t(one.shape.kind)]}};
    add_origin(one.shape.origin, json);
    if (one.mesh >= 0) {
      json["mesh"] = one.mesh;
      json["scale"] = json_of(one.shape.mesh_scale);
    } else {
      json["size"] = json_of(one.shape.size);
    }
    if (one.color) json["color"] = *one.color;
    if (!one.material.empty()) json["material"] = one.material;
    if (!one.texture.empty()) json["texture"] = one.texture;
    list.push_back(std::move(json));
  }
  return list;
}

Json json_of(const DescribedLink& link) {
  Json json{{"name", link.name}, {"line", link.line}};
  if (link.inertial) json["inertial"] = json_of(*link.inertial);
  if (!link.visuals.empty()) json["visuals"] = json_of(link.visuals);
  if (!link.collisions.empty()) json["collisions"] = json_of(link.collisions);
  return json;
}

Json json_of(const UrdfJoint& joint) {
  Json json{{"name", joint.name},
            {"line", joint.line},
            {"type", to_string(joint.type)},
            {"parent", joint.parent},
            {"child", joint.child}};
  add_origin(joint.origin, json);
  json["axis"] = json_of(joint.axis);
  const UrdfLimit& limit = joint.limit;
  if (limit.given) {
    json["limit"] = {{"line", limit.line}, {"lower", limit.lower}, {"upper", limit.upper}};
    if (limit.has_effort) json["limit"]["effort"] = limit.effort;
    if (limit.has_velocity) json["limit"]["velocity"] = limit.velocity;
  }
  if (joint.damping != 0) json["damping"] = joint.damping;
  if (joint.friction != 0) json["friction"] = joint.friction;
  if (joint.mimic)
    json["mimic"] = {{"line", joint.mimic->line},
                     {"joint", joint.mimic->joint},
                     {"multiplier", joint.mimic->multiplier},
                     {"offset", joint.mimic->offset}};
  return json;
}

template <int n>
Eigen::Matrix<double, n, 1> vector_of(const Json& json) {
  if (!json.is_array() || json.size() != std::size_t(n))
    throw std::invalid_argument("a vector of another length");
  Eigen::Matrix<double, n, 1> v;
  for (int i = 0; i < n; ++i) v[i] = json[std::size_t(i)].get<double>();
  return v;
}

UrdfOrigin origin_of(const Json& json) {
  return {vector_of<3>(json.at("xyz")), vector_of<3>(json.at("rpy"))};
}

int index_below(const Json& json, std::size_t count) {
  const int index = json.get<int>();
  if (index < 0 || std::size_t(index) >= count) throw std::invalid_argument("an index of nothing");
  return index;
}

UrdfInertial inertial_of(const Json& json) {
  UrdfInertial inertial;
  inertial.line = json.at("line").get<int>();
  inertial.mass_line = json.value("mass_line", inertial.line);  // which older records do not tell
  inertial.mass = json.at("mass").get<double>();
  inertial.origin = origin_of(json);
  const Eigen::Matrix<double, 6, 1> I = vector_of<6>(json.at("inertia"));
  inertial.inertia << I[0], I[1], I[2], I[1], I[3], I[4], I[2], I[4], I[5];
  return inertial;
}

DescribedShape shape_of(const Json& json, const std::vector<DescribedMesh>& meshes) {
  DescribedShape one;
  one.shape.line = json.at("line").get<int>();
  const std::string kind = json.at("kind").get<std::string>();
  std::size_t k = 0;
  while (kind != kShapeKinds[k])
    if (++k == std::size(kShapeKinds)) throw std::invalid_argument("a shape of no kind");
  one.shape.kind = UrdfShapeKind(k);
  one.shape.origin = origin_of(json);
  if (one.shape.kind == UrdfShapeKind::mesh) {
    one.mesh = index_below(json.at("mesh"), meshes.size());
    one.shape.mesh_file = meshes[std::size_t(one.mesh)].file;
    one.shape.mesh_scale = vector_of<3>(json.at("scale"));
  } else {
    one.shape.size = vector_of<3>(json.at("size"));
  }
  if (json.contains("color")) one.color = json["color"].get<std::array<std::uint8_t, 4>>();
  one.material = json.value("material", "");
  one.texture = json.value("texture", "");
  return one;
}

DescribedLink link_of(const Json& json, const std::vector<DescribedMesh>& meshes) {
  DescribedLink link;
  link.name = json.at("name").get<std::string>();
  link.line = json.at("line").get<int>();
  if (json.contains("inertial")) link.inertial = inertial_of(json["inertial"]);
  if (json.contains("visuals"))
    for (const Json& one : json["visuals"]) link.visuals.push_back(shape_of(one, meshes));
  if (json.contains("collisions"))
    for (const Json& one : json["collisions"]) link.collisions.push_back(shape_of(one, meshes));
  return link;
}

UrdfJoint joint_of(const Json& json, std::size_t links) {
  UrdfJoint joint;
  joint.name = json.at("name").get<std::string>();
  joint.line = json.at("line").get<int>();
  const std::string type = json.at("type").get<std::string>();
  std::size_t k = 0;
  while (type != to_string(kJointTypes[k]))
    if (++k == std::size(kJointTypes)) throw std::invalid_argument("a joint of no type");
  joint.type = kJointTypes[k];
  joint.parent = index_below(json.at("parent"), links);
  joint.child = index_below(json.at("child"), links);
  joint.origin = origin_of(json);
  joint.axis = vector_of<3>(json.at("axis"));
  if (json.contains("limit")) {
    const Json& limit = json["limit"];
    joint.limit.given = true;
    joint.limit.line = limit.at("line").get<int>();
    joint.limit.lower = limit.at("lower").get<double>();
    joint.limit.upper = limit.at("upper").get<double>();
    joint.limit.has_effort = limit.contains("effort");
    joint.limit.has_velocity = limit.contains("velocity");
    joint.limit.effort = limit.value("effort", 0.0);
    joint.limit.velocity = limit.value("velocity", 0.0);
  }
  joint.damping = json.value("damping", 0.0);
  joint.friction = json.value("friction", 0.0);
  if (json.contains("mimic")) {
    const Json& mimic = json["mimic"];
    joint.mimic = UrdfMimic{mimic.at("joint").get<std::string>(), mimic.at("multiplier").get<double>(),
                            mimic.at("offset").get<double>(), mimic.at("line").get<int>()};
  }
  return joint;
}

// Throws Json::exception and std::invalid_argument.
ModelDescription read(const Json& json) {
  ModelDescription model;
  model.name = json.at("name").get<std::string>();
  model.gravity = vector_of<3>(json.at("gravity"));
  model.floating_base = json.at("floating_base").get<bool>();
  model.friction = json.at("friction").get<bool>();
  if (json.contains("massless")) model.massless = json["massless"].get<double>();
  model.end_effector = json.at("end_effector").get<std::string>();
  if (json.contains("payload")) {
    const Json& payload = json["payload"];
    model.payload = {payload.at("mass").get<double>(), payload.at("link").get<std::string>(), vector_of<3>(payload.at("at"))};
  }
  for (const Json& one : json.at("coordinates"))
    model.coordinates.push_back({one.at("name").get<std::string>(), one.at("unit").get<std::string>()});
  for (const Json& one : json.at("meshes")) {
    model.meshes.push_back({one.at("file").get<std::string>(), {}});
    if (one.contains("triangles")) model.meshes.back().sketch = triangle_sketch_of(one);
  }
  for (const Json& one : json.at("links")) model.links.push_back(link_of(one, model.meshes));
  for (const Json& one : json.at("joints")) model.joints.push_back(joint_of(one, model.links.size()));
  model.root = index_below(json.at("root"), model.links.size());
  return model;
}

}  // namespace

Json to_json(const ModelDescription& model) {
  Json json{{"name", model.name},
            {"gravity", json_of<3>(model.gravity)},
            {"floating_base", model.floating_base},
            {"friction", model.friction}};
  if (model.massless) json["massless"] = *model.massless;
  json["end_effector"] = model.end_effector;
  if (model.payload.mass > 0) json["payload"] = {{"mass", model.payload.mass}, {"link", model.payload.link}, {"at", json_of<3>(model.payload.at)}};
  json["root"] = model.root;
  json["coordinates"] = Json::array();
  for (const DescribedCoordinate& one : model.coordinates)
    json["coordinates"].push_back({{"name", one.name}, {"unit", one.unit}});
  for (const char* list : {"links", "joints", "meshes"}) json[list] = Json::array();
  for (const DescribedLink& link : model.links) json["links"].push_back(json_of(link));
  for (const UrdfJoint& joint : model.joints) json["joints"].push_back(json_of(joint));
  for (const DescribedMesh& mesh : model.meshes) {
    json["meshes"].push_back({{"file", mesh.file}});
    if (mesh.sketch) json["meshes"].back().update(to_json(*mesh.sketch));
  }
  return json;
}

ModelDescription model_description_of(const Json& json) {
  try {
    return read(json);
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "is no record of a model, or was changed by hand");
  } catch (const std::invalid_argument& error) {
    throw Error(ExitCode::bad_input, std::string("is no record of a model: it has ") + error.what());
  }
}

}  // namespace chainreel
