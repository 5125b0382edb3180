#include "scene/keys/keys.hpp"

#include <algorithm>

#include "integrate/method.hpp"
#include "scene/film_clock.hpp"
#include "scene/keys/key_rows.hpp"
#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

constexpr int kLargestSide = 16384;    // pixels
constexpr double kLongestHold = 3600;  // s
constexpr double kFarthestEye = 1e6;   // m; beyond, rays are parallel for all that is drawn
constexpr double kTurn = 2 * std::numbers::pi;

bool has_constraints(const Scene& scene) {
  return !scene.constraints.empty();
}

bool holds_by_baumgarte(const Scene& scene) {
  return has_constraints(scene) && scene.stabilize == Stabilization::baumgarte;
}

// A mass of zero is one of a sweep, whose titles tell it.
bool has_payload(const Scene& scene) { return scene.payload.mass > 0 || scene.places.contains("payload.mass"); }
bool is_computed(const Scene& scene) {
  return !scene.motion;
}

bool is_auto(const Scene& scene) {
  return scene.chooses_method();
}

struct Chapter {
  const char* name;
  std::vector<KeyRow> rows;
};

// One row a key, in the order in which keys are read and written.
std::vector<Chapter> chapters() {
  using Row = KeyRow;
  return {
      {"The mechanism",
       {Row("title", &Scene::title, "above the picture, formulas between dollar signs ($theta_1$, `help formulas`); {fall} in it becomes the time of the fall (and falls in {fall} does not fall within 5 s, where it does not), {F} the parameter F").of_page(),
        Row(told_model(), read_model, model_text).example("model: {links: [0.5, 0.4, 0.3], masses: [2, 1.5, 1], joints: RRR}"),
        Row("gravity", &Scene::gravity, "world x y z; a chain in a plane: down in it")
            .in("m/s^2")
            .absent("9.81 downwards: -y of planar chains, -z in space")
            .of_model(OfModel::mechanism),
        Row("base", &Scene::base, "how the root link is held").caption("@ base").of_model(OfModel::mechanism),
        Row("friction", &Scene::friction, "the model's joint damping and friction act").of_model(OfModel::mechanism),
        Row("massless", &Scene::massless, "mass that moving links without inertia get")
            .in("kg")
            .above(0)
            .hint(", like 1e-6")
            .absent("such links are an error")
            .caption("massless links @ kg")
            .of_model(OfModel::mechanism),
        Row::section("payload", "payload: {mass: 2, at: [0.1, 0, 0]}", "a load that the robot carries, as a mass at a point: `--over payload.mass=0:4:5` sweeps it"),
        Row("payload.mass", &Scene::payload, &Payload::mass, "of the load").in("kg").within(0, 1e9).of_model(OfModel::mechanism).seen_at_poses().where(has_payload).caption("payload @ kg"),
        Row("payload.link", &Scene::payload, &Payload::link, "that carries it").absent("the end effector").caption("payload on @").of_model(OfModel::mechanism).seen_at_poses().where(has_payload),
        Row("payload.at", &Scene::payload, &Payload::at, "where, in that link's frame").in("m").of_model(OfModel::mechanism).seen_at_poses().where(has_payload),
        Row("limit", &Scene::limit, "what comes of a joint that passes a limit").caption("limits: @"),
        Row(told_packages(), read_packages, write_packages)
            .example("packages: {my_robot: ../robot}")
            .of_model(OfModel::mechanism)}},
      {"Start and drive",
       {Row::section("start", "start: {q: [0, 90deg], qd: [0, 0]}", "the state in which the run begins"),
        Row("start.q", &Scene::start, &StartState::q, "joint positions, or those of some joints: {elbow: 90deg}; under constraints the others follow")
            .by_joint(&StartState::q, &StartState::q_of_joints)
            .in("rad or m")
            .absent("all at zero")
            .where(is_computed)
            .caption("q(0) = @"),
        Row("start.qd", &Scene::start, &StartState::qd, "joint rates, likewise")
            .by_joint(&StartState::qd, &StartState::qd_of_joints)
            .in("rad/s or m/s")
            .absent("at rest")
            .where(is_computed)
            .caption("qd(0) = @"),
        Row(told_torque(), read_torque, torque_text)
            .example("torque: [0, -100 * y_G]")
            .absent("none acts")
            .where(is_computed)
            .caption("\u03C4 = @"),
        Row(told_push(), read_push, push_text)
            .example("push: {frame: torso, force: [60, 0, 0], from: 1s, until: 1.1s}")
            .absent("none")
            .where(is_computed)
            .caption("push @"),
        Row(told_motion(), read_motion, motion_text)
            .absent("it is computed")
            .caption("motion @"),
        Row(told_parameters(), read_parameters, write_parameters).example("parameters: {k: 100}")}},
      {"Constraints",
       {Row(told_constraints(), read_constraints, constraints_text)
            .example("constraints: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]")
            .absent("none"),
        Row("stabilize", &Scene::stabilize, "what holds places and rates on the constraints against drift")
            .example("stabilize: baumgarte")
            .caption("drift: @")
            .where(has_constraints),
        Row::section("baumgarte", "baumgarte: {gain: 10}", "with `stabilize: baumgarte`"),
        Row("baumgarte.gain", &Scene::baumgarte_gain, "how fast errors die away")
            .in("1/s")
            .above(0)
            .hint("; some 10 is good")
            .caption("Baumgarte gain @ 1/s")
            .where(holds_by_baumgarte),
        Row(told_contact_force(), read_contact_force, contact_force_text)
            .example("contact_force: {constraint: 1, force: [0, -5]}")
            .absent("none")}},
      {"What is looked at",
       {Row("end_effector", &Scene::end_effector, "the link whose place, trail and effective mass are meant")
            .absent("link `gripper`, else the only end")
            .caption("end effector @")
            .of_model(OfModel::picture),
        Row(told_frames(), read_frames, write_frames).example("frames: {H: hip}"),
        Row::section("foot", "foot: {heel: -0.06, toe: 0.19, height: 0}",
                     "a root link that stands on the ground: events may read `cop`, the centre of pressure below it, and `grf`, the force up; "
                     "pictures show the force of the ground as an arrow, and where it would have to press beside the foot, or pull at it, say \"holds the foot: a real one would tip\": the chain's foot never turns"),
        Row("foot.heel", &Scene::foot, &Foot::heel, "along the ground, left of the toe").in("m").caption("heel at @ m"),
        Row("foot.toe", &Scene::foot, &Foot::toe, "along the ground").in("m").caption("toe at @ m"),
        Row("foot.height", &Scene::foot, &Foot::height, "of the ground, against gravity").in("m").caption("ground at @ m"),
        Row(told_events(), read_events, events_text)
            .example("events: [{when: \"y_G < 0.5\", kind: mark, name: low}]")
            .absent("none")}},
      {"The method",
       {Row("method", &Scene::method, "`auto`, the cheapest that keeps `accuracy`, or a row of `chainreel methods`")
            .example("method: dop853")
            .where(is_computed)
            .caption("@"),
        Row("step", &Scene::step, "of time")
            .in("s")
            .above(0)
            .absent("1 ms of methods with a fixed step; what the tolerance allows of the others")
            .caption("step @ s"),
        Row("tolerance", &Scene::tolerance, "of methods that choose their steps, per step and number: times 1 + its size")
            .at_least(kLeastTolerance)
            .hint("; no step can meet less than the rounding of doubles")
            .absent("1e-9, unless they have a step")
            .example("tolerance: 1e-10")
            .caption("tolerance @"),
        Row("order", &Scene::order, "of methods with several: taylor, see `chainreel methods`")
            .absent("the method's own")
            .caption("order @"),
        Row("accuracy", &Scene::accuracy, "what `method: auto` keeps in every frame: a number and px, m, rad or relative")
            .where(is_auto)
            .caption("accuracy @"),
        Row("expect", &Scene::expect, "what the run is to do").no_caption(),
        Row(told_acknowledge(), read_acknowledge, acknowledge_text)
            .example("acknowledge: [energy]")
            .absent("none")
            .where(is_computed)
            .no_caption()}},
      {"The robot's looks",
       {Row("links", &Scene::links, "bars, or the model's shapes")
            .example("links: plain")
            .caption("links: @")
            .flag(FlagGroup::view, "--links")
            .of_model(OfModel::picture),
        Row("mesh_up", &Scene::mesh_up, "whose up Collada meshes follow")
            .caption("mesh up: @")
            .flag(FlagGroup::view, "--mesh-up")
            .of_model(OfModel::picture)}},
      {"The picture",
       {Row("duration", &Scene::duration, "of the motion").in("s").above(0).example("duration: 5").of_page(),
        Row(told_draw(), read_draw, draw_text).example("draw: [+ellipse, -trail]").of_page(),
        Row::section("ellipse", "ellipse: {reading: belt}", "how the layer `ellipse` shows the effective mass").of_page(),
        Row("ellipse.reading", &Scene::ellipse, &EllipseEntry::reading, "what the curve is").of_page(),
        Row("ellipse.shape", &Scene::ellipse, &EllipseEntry::shape, "of arms in space").of_page(),
        Row::section("camera", "camera: {azimuth: 35deg, elevation: 20deg, fit: [-0.5, 0, 1.5, 1.2]}", "where the picture is seen from")
            .of_page()
            .of_model(OfModel::picture),
        Row("camera.azimuth", &Scene::camera, &CameraEntry::azimuth, "about the vertical")
            .in("rad")
            .within(-kTurn, kTurn)
            .hint("; a number without deg is in radians")
            .absent("along the plane's normal; 35deg in space")
            .of_page()
            .flag(FlagGroup::view, "--azimuth"),
        Row("camera.elevation", &Scene::camera, &CameraEntry::elevation, "above the horizon")
            .in("rad")
            .within(-kTurn / 4, kTurn / 4)
            .hint("; a number without deg is in radians")
            .absent("along the plane's normal; 20deg in space")
            .of_page()
            .flag(FlagGroup::view, "--elevation"),
        Row("camera.distance", &Scene::camera, &CameraEntry::distance, "of the eye from where it looks")
            .in("m")
            .above(0)
            .up_to(kFarthestEye)
            .or_endless("parallel")
            .absent("parallel in a plane; in space so far that 30 deg hold the motion")
            .of_page()
            .flag(FlagGroup::view, "--distance"),
        Row("camera.focus", &Scene::camera, &CameraEntry::focus, "x y z: where the eye looks, in the plane of camera.fit")
            .in("m")
            .absent("the middle of the motion")
            .of_page(),
        Row(told_fit(), read_fit, fit_text)
            .absent("motion")
            .of_page()
            .flag(FlagGroup::view, "--fit"),
        Row(told_plot(), read_plot, plot_text).example("plot: [energy, \"x_G - 1\"]").absent("none").of_page(),
        Row(told_layout(), read_layout, layout_text)
            .absent("auto; compare for two panels, grid for more")
            .of_page()
            .flag(FlagGroup::page, "--layout"),
        Row("theme", &Scene::theme, "the colours")
            .of_page()
            .flag(FlagGroup::look, "--theme")
            .of_model(OfModel::picture),
        Row("text_scale", &Scene::text_scale, "larger for small pictures")
            .within(0.5, 3)
            .of_page()
            .flag(FlagGroup::look, "--text-scale")
            .of_model(OfModel::picture),
        Row(told_style(), read_style, style_text)
            .example("style: {light: {ink: \"#14213D\"}, lines: 1.2}")
            .absent("the program's own")
            .of_page()
            .of_model(OfModel::picture)}},
      {"The film",
       {Row::section("video", "video: {width: 1280, height: 720, fps: 60}", "the film's frames and files").of_page(),
        Row("video.width", &Scene::video, &Video::width, "of the picture, even")
            .in("px")
            .within(16, kLargestSide)
            .flag(FlagGroup::size, "--width")
            .of_page()
            .of_model(OfModel::picture),
        Row("video.height", &Scene::video, &Video::height, "of the picture, even")
            .in("px")
            .within(16, kLargestSide)
            .flag(FlagGroup::size, "--height")
            .of_page()
            .of_model(OfModel::picture),
        Row("video.fps", &Scene::video, &Video::fps, "frames a second: 60, 29.97, 30000/1001").in("1/s").of_page().flag(FlagGroup::size, "--fps"),
        Row("video.preset", &Scene::video, &Video::preset, "what is written where no file is named")
            .absent("out/NAME.mp4; of layout transparent NAME.mov")
            .of_page()
            .flag(FlagGroup::output, "--preset"),
        Row("video.crf", &Scene::video, &Video::crf, "quality of films, 0 the best, rounded")
            .within(0, 63)
            .hint("; 0 is the best, 51 the most of MP4")
            .absent("18 of MP4, 28 of WebM")
            .of_page()
            .flag(FlagGroup::output, "--crf"),
        Row(told_slow_motion(), read_slow_motion, slow_motion_text)
            .example("slow_motion: [{from: 1s, until: 1.5s, speed: 0.25}]")
            .absent("auto")
            .of_page(),
        Row(told_annotate(), read_annotate, annotate_text)
            .example("annotate: [{at: 1.2s, text: \"heaviest along the arm\", point: gripper, hold: 1s}]")
            .absent("none")
            .of_page(),
        Row::section("hold", "hold: {first: 1, last: 2}", "how long the end frames stand still; one number is both")
            .or_one([](const SceneKey&, Fields& fields, Scene& scene) {
              double both = 0;
              fields.measure_in("s");
              if (fields.read("hold", both)) {
                if (both >= 0 && both <= kLongestHold)
                  scene.hold = {both, both};
                else
                  fields.problem_at("hold", "'hold' must be between 0 and " + format_shortest(kLongestHold) + " s");
              }
              fields.measure_in("");
            })
            .of_page()
            .flag(FlagGroup::output, "--hold"),
        Row("hold.first", &Scene::hold, &Hold::first, "of the first frame").in("s").within(0, kLongestHold).of_page(),
        Row("hold.last", &Scene::hold, &Hold::last, "of the last frame").in("s").within(0, kLongestHold).of_page()}},
      {"Comparisons",
       {Row(told_compare(), [](Fields& fields, Scene&) { fields.find("compare"); }, [](const Scene&) { return std::string(); })
            .example("compare: [{method: explicit_euler, expect: diverge}, {method: rk4}]")
            .absent("none")
            .of_page()}}};
}

std::vector<SceneKey> table() {
  std::vector<SceneKey> keys;
  for (Chapter& chapter : chapters())
    for (KeyRow& row : chapter.rows) {
      keys.push_back(std::move(row).key());
      keys.back().chapter = chapter.name;
    }
  return keys;
}

// Names of what holds a path, however deep; a mapping's have none.
void collect_paths(const KeyText& text, std::vector<std::string>& names) {
  if (text.form == KeyForm::path && !text.name.empty() &&
      std::find(names.begin(), names.end(), text.name) == names.end())
    names.push_back(text.name);
  for (const KeyText& part : text.parts) {
    // Of a key that may be a path or something else, which bears the name.
    const bool is_alternative = text.form == KeyForm::either && part.form == KeyForm::path && part.name.empty();
    if (is_alternative && std::find(names.begin(), names.end(), text.name) == names.end()) names.push_back(text.name);
    collect_paths(part, names);
  }
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> keys = table();
  return keys;
}

const SceneKey* find_key(const std::string& path) {
  const std::vector<SceneKey>& keys = scene_keys();
  const std::string first = path.substr(0, path.find('.'));
  const SceneKey* whole = nullptr;
  for (const SceneKey& key : keys) {
    if (key.name == path) return &key;
    if (key.name == first) whole = &key;
  }
  return whole;
}

std::string short_help(const SceneKey& key) {
  std::string help = key.help;
  if (!key.words.empty()) help += ": " + alternatives(key.words);
  if (const std::string range = range_text(key.range, key.unit); !range.empty()) help += ", " + range;
  if (!key.infinity.empty()) help += ", or " + key.infinity;
  if (key.is_section) help += ", like " + key.example.substr(key.name.size() + 2);
  return help;
}

std::vector<std::string> keys_of_models(OfModel use) {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys())
    if (key.of_model != OfModel::no && key.of_model <= use) names.push_back(key.name);
  return names;
}

const std::vector<std::string>& page_keys() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const SceneKey& key : scene_keys())
      if (key.of == KeyOf::page && key.section().empty() && key.name != "title") all.push_back(key.name);
    return all;
  }();
  return names;
}

const std::vector<std::string>& path_keys() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const SceneKey& key : scene_keys()) collect_paths(key, all);
    return all;
  }();
  return names;
}

}  // namespace chainreel
