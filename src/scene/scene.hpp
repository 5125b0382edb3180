// A scene is a struct written in YAML. Defaults stand here and nowhere else; keys.cpp holds a row a key.
#pragma once

#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_rate.hpp"
#include "mesh/read_mesh.hpp"
#include "model/model_source.hpp"
#include "model/read_chain.hpp"
#include "scene/constraint_entry.hpp"
#include "scene/layers.hpp"
#include "scene/motion_entry.hpp"
#include "scene/style.hpp"
#include "scene/words.hpp"
#include "sim/accuracy.hpp"
#include "sim/drive/limits.hpp"
#include "sim/drive/pushes.hpp"
#include "sim/drive/torque.hpp"
#include "sim/plots.hpp"
#include "sim/system/constraint_plan.hpp"
#include "sim/watch/events.hpp"

namespace chainreel {

// Numbers of a joint by its name, which only a model can place.
struct JointNumbers {
  std::string joint;  // or one of its coordinates: base.x
  std::vector<double> values;
  std::vector<std::string> written;
  Place place;
};

struct StartState {
  std::vector<double> q;   // empty: every joint at zero
  std::vector<double> qd;  // empty: at rest
  std::vector<JointNumbers> q_of_joints, qd_of_joints;  // until the model is known; not keys
  std::vector<std::string> written_q, written_qd;  // their numbers as they stand in the file; not keys
  std::vector<std::size_t> named_q, named_qd;  // of starts by joint: which are named, in that order; empty where all are meant; not keys
};

struct Video {
  int width = 1920;
  int height = 1080;
  FrameRate fps;
  std::optional<Preset> preset;  // of the outputs; absent: by their endings
  std::optional<double> crf;  // of films, 0 best; absent: 18 for H.264, 28 for VP9
  double least_text = 0;  // units of H: no word is lower, of pages that have a size on paper. Not a key
  double panel_names = 0;  // units of H: names of panels are that large, also where the preset leaves out all other words; 0: as usual. Not a key
};

struct Hold {
  double first = 0, last = 0;  // s for which the end frames stand still
};

// Where the picture is seen from. In the plane a chain is seen along the plane's normal, from infinitely far, as long
// as neither angle is given; in space from azimuth 35 deg, elevation 20 deg, so far that 30 deg hold the motion.
struct CameraEntry {
  std::optional<double> azimuth;    // rad about the vertical; 0: x to the right, or the plane's own view
  std::optional<double> elevation;  // rad above the horizon
  std::optional<double> distance;   // m from `focus`; infinity: parallel rays
  std::optional<Eigen::Vector3d> focus;  // m: where an eye looks; absent: the middle of the motion
  // The part that is shown, m along the camera's right and up: left, bottom, right, top. Absent: fitted to the motion.
  std::optional<std::array<double, 4>> fit;
};

// A stretch of the motion that the film shows slower, or faster, than it was.
struct SlowMotionEntry {
  std::string event;  // "": `from` and `until` are instants; else seconds from its instants on
  double from = 0, until = 0;  // s
  double speed = 1;   // 0.25: four times slower
};

// By which a film slows down where the scene names no stretches: see scene/slow_motion.
struct SlowMotionRule {
  double speed = 0.25;
  double turn = std::numbers::pi / 12;        // rad a frame: of a link, beyond which it is slowed down
  std::optional<double> around;  // s of the motion before and behind; absent: 0.2, at most a twentieth of the motion
  bool is_asked = false;         // the scene says so, by whatever numbers
};

// Words that point at something, while the film stands still for a while.
struct AnnotationEntry {
  std::string event;  // "": `at` says when; else the first time that this happens
  double at = 0;      // s of the motion
  std::string text;   // formulas between dollar signs
  std::string point;  // a name of `frames`, a link, or a joint; "": `spot` says where
  std::vector<double> spot;  // m: right and up as camera.fit has them, or x y z in the world
  double hold = 2;    // s of the film for which the motion stands still
  int panel = 1;      // of a comparison
  Place place;
};

struct EllipseEntry {
  EllipseReading reading = EllipseReading::mass;
  EllipseShape shape = EllipseShape::ellipsoid;
};

struct Scene {
  std::string title;
  int panel = 0;                           // which one of a comparison, from 1; 0: none
  ModelSource model;                       // a path as found from the working folder, or numbers
  std::optional<Eigen::Vector3d> gravity;  // m/s^2; absent: by the plane of the chain
  RootLink base = RootLink::fixed;
  bool friction = true;                    // the model's joint damping and friction act
  std::optional<double> massless;  // kg given to moving links without inertia; absent: they are an error
  Payload payload;
  LimitPolicy limit = LimitPolicy::report;
  std::map<std::string, std::string> packages;  // package:// name -> folder
  std::optional<MotionEntry> motion;  // absent: it is computed
  StartState start;
  std::vector<TorqueEntry> torque;  // one a degree of freedom; empty: none acts, or `control` does
  std::optional<Control> control;   // `torque:` as a mapping: for the whole chain
  std::vector<PushEntry> push;      // forces from outside
  Parameters parameters;
  std::vector<ConstraintEntry> constraints;
  Stabilization stabilize = Stabilization::project;  // against drift
  double baumgarte_gain = 10;         // 1/s; `baumgarte: {gain: 10}`
  std::vector<ContactEntry> contact_force;  // forces to press on constraints with
  std::string end_effector;                    // "": link `gripper`, else the only leaf
  std::map<std::string, std::string> frames;   // name in expressions -> link, or joint for the link behind it
  std::optional<Foot> foot;                    // on which the model stands: events may read `cop`
  std::vector<EventEntry> events;              // what a run looks out for
  double duration = 10;                        // s
  std::string method = "auto";      // or a row of the registry
  std::optional<double> step;                  // s; absent: 1 ms, or what the tolerance allows
  std::optional<double> tolerance;             // of adaptive methods; absent: 1e-9, unless they have a step
  std::optional<int> order;                    // of methods with several
  Accuracy accuracy;                           // of `method: auto`
  Outcome expect = Outcome::finish;
  std::vector<std::string> acknowledge;        // kinds of doubts that are known, and not printed
  std::vector<std::string> draw = default_layers();  // what is drawn: see scene/layers
  std::vector<std::string> named_layers;             // of these, what `draw:` itself names
  LinkShapes links = LinkShapes::automatic;
  MeshUp mesh_up = MeshUp::rviz;
  EllipseEntry ellipse;
  CameraEntry camera;
  std::vector<PlotEntry> plot;  // beside or below the scene, at most three
  PageLayout layout = PageLayout::automatic;
  std::vector<Scene>
      compare;            // the panels, each the scene with its changes; empty: the scene is the only one
  ThemeName theme = ThemeName::light;
  double text_scale = 1;  // for clips used smaller than drawn
  Style style;            // of the house; what a file said of it stands here, too
  Video video;
  std::optional<SlowMotionRule> slow_motion_rule = SlowMotionRule{};  // absent: the stretches below, or none
  std::vector<SlowMotionEntry> slow_motion;
  std::vector<AnnotationEntry> annotate;
  Hold hold;

  std::string file;                     // where it was read; not a key
  std::string name;                     // the file's name without its ending; not a key
  std::vector<std::string> notices;     // what was changed of it when it was made ready; not a key
  std::vector<std::string> not_beside;  // names in it whose files come with the program, as none lie beside it, in words; among the notices; not a key
  std::vector<std::string> doubts;      // what speaks against it, found at the same time: warnings; not a key
  std::vector<std::string> set;         // key=value of the command line; not a key
  Parameters set_parameters;            // those that the command line gave a single run, told behind its title; not a key
  std::vector<std::string> absolute_paths;  // that the file itself has as such; not a key
  std::map<std::string, Place> places;  // where each key stood, by its dotted path; not a key

  // For errors found later: the key's place, or the file where the scene left it out.
  Place place_of(const std::string& key) const;

  bool chooses_method() const { return method == "auto" && !motion; }
};

// Throws Error (bad input) where the scene compares several runs.
void require_single_run(const Scene& scene);
// The same of a command with --panel, which counts from 1; 0: it was not given. Returns the panel's place, 0 of a scene of one.
std::size_t chosen_panel(const Scene& scene, int asked);

// The same for a command that is about methods, where the scene shows a recorded motion; `command` is named.
void require_computed_run(const Scene& scene, const std::string& command);

// "rk4, step 0.001 s", "dop853, tolerance 1e-9".
std::string method_text(const Scene& scene);

// Drawn on nothing, without words above and below: layout `transparent` or preset `overlay`.
bool is_transparent(const Scene& scene);
// Panels in one place: the first in full, the others over it in outline.
bool is_ghost_layout(const Scene& page);

}  // namespace chainreel
