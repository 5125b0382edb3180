#include "scene/run/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "expr/expression.hpp"
#include "model/chain.hpp"
#include "model/followers.hpp"
#include "model/read_chain.hpp"
#include "scene/annotation.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/run/pose_doubts.hpp"
#include "scene/run/scene_doubts.hpp"
#include "sim/system/constrained_chain.hpp"

namespace chainreel {
namespace {

constexpr double kDefaultStep = 0.001;  // s
constexpr double kDefaultTolerance = 1e-9;

// Fills what is absent and refuses what has the wrong length.
void check_length(std::vector<double>& values, const std::vector<double>& absent, StateNumbers numbers, const std::string& key,
                  const Scene& scene, const Chain& chain, ProblemList& problems) {
  const bool is_partial = !values.empty() && std::isnan(values.back());  // see Fields::read_some
  if (is_partial) {
    const std::vector<std::string> names = names_of_state(chain, numbers);
    if (const auto number = std::find_if(names.begin(), names.end(), [](const std::string& name) { return parse_number(name).has_value(); }); number != names.end())
      problems.add("'" + key + "' names single freedoms, and the model " + scene.model.words() + " has one that is called " + *number +
                       ", like a place in the list: write the whole list",
                   scene.place_of(key));
    values.pop_back();
    if (values.size() < absent.size()) values.resize(absent.size(), std::nan(""));
  }
  const FollowerNumbers followers = is_partial ? FollowerNumbers{} : numbers_of_followers(chain, values, numbers == StateNumbers::qd);
  take_out(values, followers.places);
  if (values.empty()) {
    values = absent;
  } else if (values.size() != absent.size()) {
    problems.add("'" + key + "' has " + std::to_string(values.size()) + " numbers, but the model " +
                     scene.model.words() + " needs " + std::to_string(absent.size()) +
                     (followers_of(chain).empty() ? "" : ": " + (followers.contradiction.empty() ? followers_of(chain) : followers.contradiction)),
                 scene.place_of(key));
  }
  for (std::size_t i = 0; i < std::min(values.size(), absent.size()); ++i)
    if (std::isnan(values[i])) values[i] = absent[i];
}

// Numbers of the start that are written by joint, at their places among those that are left out.
void place_joints(StartState& start, StateNumbers numbers, const std::string& key, const Scene& scene, const Chain& chain, ProblemList& problems) {
  const bool is_q = numbers == StateNumbers::q;
  const std::vector<std::string> names = names_of_state(chain, numbers);
  std::vector<double>& values = is_q ? start.q : start.qd;
  std::vector<std::string>& written = is_q ? start.written_q : start.written_qd;
  std::vector<JointNumbers>& of_joints = is_q ? start.q_of_joints : start.qd_of_joints;
  for (const JointNumbers& one : of_joints) {
    const std::vector<std::size_t> places = places_of_joint(names, one.joint);
    const std::string followers = places.empty() ? followers_of(chain) : "";
    if (places.empty())
      problems.add("'" + key + "' names '" + one.joint + "', but the model " + scene.model.words() + " has no freedom of that name:" +
                       did_you_mean(one.joint, names) + " It has " + joined(names) + (followers.empty() ? "" : "; " + followers),
                   one.place);
    else if (places.size() != one.values.size())
      problems.add("'" + key + "." + one.joint + "' takes " + std::to_string(places.size()) + (places.size() == 1 ? " number" : " numbers") +
                       ", not " + std::to_string(one.values.size()),
                   one.place);
    else
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] + 1 >= values.size()) values.resize(places[i] + 2, std::nan(""));  // the last one says that some are left out
        if (places[i] >= written.size()) written.resize(places[i] + 1);
        if (!std::isnan(values[places[i]]))
          problems.add("'" + key + "' has " + names[places[i]] + " twice: write it once", one.place);
        values[places[i]] = one.values[i];
        written[places[i]] = one.written[i];
        (is_q ? start.named_q : start.named_qd).push_back(places[i]);  // what is not may follow where ties want it
      }
  }
  of_joints.clear();
}

// A control of the whole chain: a number in brackets is that of one freedom, and of several it would be a slip.
void check_lists(const Scene& scene, const Chain& chain, ProblemList& problems) {
  if (!scene.control || chain.nv == 1) return;
  const auto refuse = [&](const std::string& path) {
    problems.add("'" + path + "' is a list of one entry, but the model " + scene.model.words() + " has " + std::to_string(chain.nv) +
                     " freedoms: write one for each, or one for all without brackets",
                 scene.place_of(path));
  };
  for (const auto& [name, feedback] : {std::pair{"pd", &scene.control->pd}, {"computed_torque", &scene.control->computed_torque}})
    for (const std::string& key : *feedback ? (*feedback)->lists_of_one : std::vector<std::string>{}) refuse(std::string("torque.") + name + "." + key);
  if (scene.control->plus_is_list_of_one) refuse("torque.plus");
}

void check_torque(Scene& scene, const Chain& chain, ProblemList& problems) {
  if (scene.control || scene.motion) return;
  if (!scene.torque.empty() && scene.torque.back().text == kOtherTorques) {
    scene.torque.pop_back();
    if (scene.torque.size() < std::size_t(chain.nv)) scene.torque.resize(std::size_t(chain.nv));
  }
  if (scene.torque.empty()) scene.torque.resize(std::size_t(chain.nv));
  if (scene.torque.size() == std::size_t(chain.nv)) return;
  std::string joints;
  for (const std::string& name : chain.coordinate_names) joints += (joints.empty() ? "" : ", ") + name;
  problems.add("'torque' has " + std::to_string(scene.torque.size()) + " entries, but the model " +
                   scene.model.words() + " has " + std::to_string(chain.nv) + " freedoms (" + joints +
                   "); an entry that holds a comma must be quoted, and decimals take a point",
               scene.place_of("torque"));
}

std::string list_of(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

// A parameter must be a name that expressions can read and that means nothing else there.
void check_parameters(const Scene& scene, const Chain& chain, const NamedFrames& frames,
                      ProblemList& problems) {
  const int rows = 6 * int(scene.constraints.size());  // the most there can be
  std::vector<std::string> taken = Probe(chain, {}, rows, frames).names();
  if (scene.foot)
    for (const auto& [name, value] : foot_parameters(*scene.foot)) taken.push_back(name);
  for (const auto& [name, value] : scene.parameters) {
    if (!is_variable_name(name) || is_reserved_name(name) ||
        std::find(taken.begin(), taken.end(), name) != taken.end())
      problems.add(
          "'" + name +
              "' cannot name a parameter: take letters, digits and _, and no name that expressions know",
          scene.place_of("parameters." + name));
  }
}

// Links by their names, else joints by theirs: the frame of the link behind the joint.
NamedFrames find_frames(const Scene& scene, const Chain& chain, ProblemList& problems) {
  NamedFrames frames;
  for (const auto& [name, wanted] : scene.frames) {
    const std::vector<std::string> known = point_names(chain);
    const int index = find_point(chain, wanted);
    if (index >= 0)
      frames.push_back({name, index});
    else
      problems.add("'frames." + name + "' names no link and no moving joint of " + scene.model.words() + ": '" +
                       wanted + "';" + did_you_mean(wanted, known) + " They are " + list_of(known) + ".",
                   scene.place_of("frames." + name));
  }
  return frames;
}

// What pushes the chain; nothing of what is a problem.
std::vector<ActingPush> find_pushes(const Scene& scene, const Chain& chain, ProblemList& problems) {
  std::vector<ActingPush> pushes;
  for (const PushEntry& entry : scene.push) {
    const int frame = find_point(chain, entry);
    if (frame < 0) {
      const std::vector<std::string> known = point_names(chain);
      problems.add(entry.frame.empty() ? "'push' needs a `frame`: the model has several ends, and none is its end effector; frames are " + list_of(known) + "."
                                       : "'push' names no link and no moving joint of " + scene.model.words() + ": '" + entry.frame + "';" +
                                             did_you_mean(entry.frame, known) + " They are " + list_of(known) + ".",
                   entry.place);
      continue;
    }
    const std::vector<double>& numbers = entry.force;
    if (numbers.size() == 2 && !chain.planar) {
      problems.add("'push' takes three numbers of force, as the chain moves in space: " + chain.why_algebra, entry.place);
      continue;
    }
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    if (numbers.size() == 2) force = numbers[0] * chain.planar->plane.ex + numbers[1] * chain.planar->plane.ey;
    if (numbers.size() == 3) force = {numbers[0], numbers[1], numbers[2]};
    // What lies across the plane moves nothing, of which is told: see doubts_of_pushes.
    if (chain.planar) force -= force.dot(chain.planar->plane.normal) * chain.planar->plane.normal;
    pushes.push_back({frame, force, entry.from, entry.until});
  }
  return pushes;
}

int constraint_rows(const Simulation& simulation) {
  const ConstraintPlan& plan = simulation.constraints;
  return plan.empty() ? 0 : ConstrainedChain(simulation.chain, plan).set().rows();
}

std::shared_ptr<const EventSet> events_of(const Scene& scene, const Simulation& simulation,
                                          const NamedFrames& frames, int rows) {
  const Chain& chain = simulation.chain;
  try {
    return make_events(chain, scene.events, scene.parameters, frames, scene.foot, rows);
  } catch (const Error& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems)
      if (problem.place.file.empty()) problem.place = scene.place_of("foot");
    throw Error(error.code(), std::move(problems));
  }
}

// Layers of the end effector, where there is none. Who names them asks for one; of the default ones those are left out that need it.
void require_end_effector_of_layers(Scene& scene, const Chain& chain) {
  const auto needs_one = [&](const std::string& layer) {
    return layer_needs(layer, LayerNeeds::end_effector) || (layer_needs(layer, LayerNeeds::way) && !chain.has_floating);
  };
  const auto first = std::find_if(scene.draw.begin(), scene.draw.end(), [&](const std::string& layer) {
    return needs_one(layer) && std::ranges::count(scene.named_layers, layer) > 0;
  });
  if (first != scene.draw.end()) {
    try {
      require_end_effector(chain);
    } catch (const Error& error) {
      throw Error(error.code(),
                  "the layer '" + *first + "' is of the end effector: " + error.problems().front().message +
                      "; or leave it out with draw: [-" + *first + "]",
                  scene.place_of("draw"));
    }
  }
  std::erase_if(scene.draw, needs_one);
}

void choose_end_effector(Scene& scene, Chain& chain) {
  if (!scene.end_effector.empty()) {
    chain.end_effector = find_frame(chain, scene.end_effector);
    std::vector<std::string> links;
    for (const Frame& frame : chain.frames) links.push_back(frame.name);
    if (chain.end_effector < 0)
      throw Error(ExitCode::bad_input,
                  "'end_effector' names no link of " + scene.model.words() + ": '" + scene.end_effector + "';" +
                      did_you_mean(scene.end_effector, links),
                  scene.place_of("end_effector"));
  }
  if (chain.end_effector < 0) require_end_effector_of_layers(scene, chain);
}

// Fills in what the scene left to the method.
void set_method(Scene& scene, Simulation& simulation) {
  const Method& method = find_method(scene.method);
  if (!scene.step && !method.adaptive) scene.step = kDefaultStep;
  if (!scene.step && !scene.tolerance) scene.tolerance = kDefaultTolerance;
  if (!scene.order && method.highest_order > 0) scene.order = method.order;
  simulation.method = &method;
  simulation.step = scene.step.value_or(0);
  simulation.options = {scene.tolerance.value_or(0), scene.order.value_or(0)};
  try {
    check_method(simulation);
  } catch (const Error& error) {
    throw Error(error.code(), error.problems().front().message, scene.place_of("method"));
  }
}

}  // namespace

ModelOptions model_options_of(const Scene& scene) {
  ModelOptions options;
  options.gravity = scene.gravity;
  options.floating_base = scene.base == RootLink::floating;
  options.friction = scene.friction;
  options.massless = scene.massless;
  options.packages = scene.packages;
  options.payload = scene.payload;
  if (options.payload.link.empty()) options.payload.link = scene.end_effector;
  return options;
}

const Chain& LastChain::read(const ModelSource& source, const ModelOptions& options) {
  if (!chain_ || !(source == source_) || !(options == options_)) {
    chain_ = read_chain(source, options);
    source_ = source;
    options_ = options;
  }
  return *chain_;
}

Simulation prepare(Scene& scene, bool meshes) {
  LastChain none;
  return prepare(scene, meshes, none);
}

Simulation prepare(Scene& scene, bool meshes, LastChain& last) {
  ModelOptions options = model_options_of(scene);
  options.meshes = meshes;
  Simulation simulation;
  simulation.chain = last.read(scene.model, options);
  choose_end_effector(scene, simulation.chain);
  const Chain& chain = simulation.chain;
  scene.gravity = chain.gravity;
  if (chain.end_effector >= 0) scene.end_effector = chain.frames[std::size_t(chain.end_effector)].name;

  if (scene.motion) prepare_motion(scene, simulation);
  prepare_tables(scene, chain);
  ProblemList problems;
  place_joints(scene.start, StateNumbers::q, "start.q", scene, chain, problems);
  place_joints(scene.start, StateNumbers::qd, "start.qd", scene, chain, problems);
  check_length(scene.start.q, zero_configuration(chain), StateNumbers::q, "start.q", scene, chain, problems);
  check_length(scene.start.qd, std::vector<double>(std::size_t(chain.nv)), StateNumbers::qd, "start.qd", scene, chain, problems);
  check_torque(scene, chain, problems);
  check_lists(scene, chain, problems);
  const NamedFrames frames = find_frames(scene, chain, problems);
  std::vector<ActingPush> pushes = find_pushes(scene, chain, problems);
  check_parameters(scene, chain, frames, problems);
  for (const auto& [key, written, numbers] : {std::tuple{"start.q", &scene.start.written_q, StateNumbers::q},
                                              std::tuple{"start.qd", &scene.start.written_qd, StateNumbers::qd}})
    if (const std::string trouble = trouble_of_units(chain, *written, numbers); !trouble.empty())
      problems.add(std::string("'") + key + "': " + trouble, scene.place_of(key));
  problems.throw_if_any();
  if (const std::string trouble = trouble_of_pose(chain, scene.start.q); !trouble.empty())
    throw Error(ExitCode::bad_input, "start.q: " + trouble, scene.place_of("start.q"));
  for (std::string& doubt : doubts_of_scene(scene, chain)) scene.doubts.push_back(std::move(doubt));

  simulation.q0 = scene.start.q;
  simulation.qd0 = scene.start.qd;
  if (!scene.motion)
    simulation.torque = scene.control ? make_control(chain, *scene.control, scene.parameters, {}, frames)
                                      : make_torque_law(chain, scene.torque, scene.parameters, frames);
  if (!scene.motion) simulation.torque = make_pushed_law(std::move(simulation.torque), std::move(pushes));
  prepare_constraints(scene, simulation);
  if (!scene.motion && !scene.chooses_method()) set_method(scene, simulation);
  simulation.limit = scene.limit;
  simulation.duration = scene.duration;
  const int rows = constraint_rows(simulation);
  simulation.events = events_of(scene, simulation, frames, rows);
  simulation.plots = make_plots(chain, scene.plot, scene.parameters, frames, scene.foot, rows);
  return simulation;
}

}  // namespace chainreel
