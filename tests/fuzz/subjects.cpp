#include "fuzz/subjects.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>

#include "core/json.hpp"
#include "support/run_program.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kSmall{"--set", "duration=0.05", "--set", "video.width=64", "--set", "video.height=36"};
const std::vector<std::string> kPicture{"--width", "64", "--height", "36", "-o", "picture.png", "--quiet"};

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const std::string kBox = R"(<robot name="box"><link name="base"/><joint name="a" type="revolute"><parent link="base"/>
<child link="tip"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint><link name="tip">
<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><mesh filename="@MESH@"/></geometry></visual></link></robot>)";

const std::string kStl = R"(solid s
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0.5
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 1 0 0
vertex 1 1 0
vertex 0 1 0.25
endloop
endfacet
endsolid s
)";
const std::string kObj = R"(mtllib m.mtl
o thing
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vn 0 0 1
vt 0 0
usemtl red
f 1/1/1 2/1/1 3/1/1
f 1 3 4
)";
const std::string kMtl = "newmtl red\nKd 1 0 0\nd 0.5\nmap_Kd t.png\n";
const std::string kDae = R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.001"/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#pa"
count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1">
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

std::string binary_stl() {
  std::string text(80, ' ');
  text += std::string("\x02\0\0\0", 4);
  for (int facet = 0; facet < 2; ++facet) {
    for (int i = 0; i < 12; ++i) {
      const float x = float(i % 5) - float(facet);
      text.append(reinterpret_cast<const char*>(&x), sizeof x);
    }
    text += std::string(2, '\0');
  }
  return text;
}

}  // namespace

const std::vector<std::string>& Subjects::kinds() {
  static const std::vector<std::string> all{"scene", "expression", "urdf", "table", "mesh", "clip", "command_line"};
  return all;
}

Subjects::Subjects() {
  // Scenes of planar chains: others take longer and are read by the same text.
  for (const char* name : {"rr_free", "rr_torque", "pp_spring", "pp_free", "rrr_torque"})
    scenes_.push_back(read_whole_file(std::string("assets/scenes/") + name + ".yaml"));
  for (const auto& entry : fs::directory_iterator("models"))
    if (entry.path().extension() == ".urdf" && entry.file_size() < 20000) models_.push_back(entry.path().string());
  std::sort(models_.begin(), models_.end());
  for (std::string& model : models_) model = read_whole_file(model);
  keys_ = {"method: auto\n", "method: rk4\n", "step: 1e-3\n", "layers: [torque]\n", "compare: [{method: rk4}, {method: taylor}]\n",
           "events: [{when: q1, name: a}]\n", "plot: [tau]\n", "constraints: []\n", "control: {inverse_of: t.csv}\n",
           "title: x\n", "slow_motion: [{at: 0, speed: 0.5, seconds: 1}]\n", "camera: {}\n", "q1", "qd1", "sin(", "min(t,",
           "<mimic joint=\"a\"/>", "<joint name=\"b\" type=\"floating\">", "</link>", "inf", "base: floating\n", "&a ", "*a"};
}

Case Subjects::make(const std::string& kind, Dice& dice) {
  if (kind == "scene") return scene(dice);
  if (kind == "expression") return expression(dice);
  if (kind == "urdf") return urdf(dice);
  if (kind == "table") return table(dice);
  if (kind == "mesh") return mesh(dice);
  if (kind == "clip") return clip(dice);
  if (kind == "command_line") return command_line(dice);
  throw std::runtime_error("there is no kind " + kind);
}

Case Subjects::scene(Dice& dice) const {
  Case one;
  one.files["a/b/s.yaml"] = mutated(dice.pick(scenes_), dice, keys_);
  const std::vector<std::string> scene{"a/b/s.yaml"};
  const std::vector<std::string> check = joined(joined({"check"}, scene), kSmall);
  const std::vector<std::string> simulate = joined(joined({"simulate", "-o", "run.csv"}, scene), kSmall);
  const std::vector<std::string> snapshot = joined(joined({"snapshot"}, scene), joined(kSmall, {"-o", "p.svg"}));
  const std::vector<std::string> all[] = {check, simulate, simulate, snapshot};
  one.arguments = dice.pick(all);
  return one;
}

Case Subjects::expression(Dice& dice) const {
  const std::string seeds[] = {"3*sin(2*t) - 0.5*qd1", "-k*(q1 - pi/2) + min(1, abs(qd2))", "60*(t>0.01)*(t<0.02)",
                               "exp(-t)*cos(q1)^2/(1 + q2^2)", "sqrt(abs(q1))", "t < 0.01", "pi/2*tanh(q1) + max(qd1, qd2)"};
  const std::vector<std::string> words{"(", ")", "^", "**", "/0", "t", "q1", "q9", "sqrt(", "log(", "-", "--", "1e308*", ">=", ",", "pi"};
  const std::string spoilt = mutated(dice.pick(seeds), dice, words);
  Case one;
  one.files["a/b/s.yaml"] = "model: ../../models/rr.urdf\nduration: 0.05\nmethod: rk4\nstep: 1e-3\nparameters: {k: 2}\ntorque:\n  - " +
                            Json(spoilt).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n  - 0\n";
  one.arguments = {"simulate", "a/b/s.yaml", "-o", "run.csv"};
  return one;
}

Case Subjects::urdf(Dice& dice) const {
  Case one;
  one.files["m.urdf"] = mutated(dice.pick(models_), dice, keys_);
  const std::vector<std::string> all[] = {
      {"check", "m.urdf"}, {"dynamics", "m.urdf"}, {"dynamics", "m.urdf", "--json"}, joined({"snapshot", "m.urdf"}, kPicture)};
  one.arguments = dice.pick(all);
  return one;
}

Case Subjects::table(Dice& dice) const {
  std::string text = "t,q1,q2\n";
  for (int i = 0; i < 8; ++i) text += std::to_string(0.1 * i) + "," + std::to_string(0.01 * i * i) + ",0.5\n";
  const std::vector<std::string> words{"qd1", "tau1", "# ", "\n\n", ";", ",,", "t,"};
  Case one;
  one.files["t.csv"] = mutated(text, dice, words);
  if (dice.one_in(2)) {
    one.arguments = {"inverse", "models/rr.urdf", "--trajectory", "t.csv", "-o", "tau.csv"};
    return one;
  }
  one.files["a/b/s.yaml"] = "model: ../../models/rr.urdf\nduration: 0.05\nmethod: rk4\ntorque: {" +
                            std::string(dice.one_in(2) ? "inverse_of" : "csv") + ": ../../t.csv}\n";
  one.arguments = {"simulate", "a/b/s.yaml", "-o", "run.csv"};
  return one;
}

Case Subjects::mesh(Dice& dice) const {
  const std::pair<std::string, std::string> seeds[] = {{"m.stl", kStl}, {"m.stl", binary_stl()}, {"m.obj", kObj}, {"m.dae", kDae}};
  const std::vector<std::string> words{"vertex", "facet", "f 9/9/9", "f -1 -2 -3", "usemtl", "mtllib /etc/passwd\n", "count=\"9\"", "<p>", "NaN"};
  const auto& [name, text] = dice.pick(seeds);
  Case one;
  one.files[name] = mutated(text, dice, words);
  one.files["m.mtl"] = dice.one_in(3) ? mutated(kMtl, dice, words) : kMtl;
  std::string box = kBox;
  one.files["r.urdf"] = box.replace(box.find("@MESH@"), 6, name);
  one.arguments = joined({"snapshot", "r.urdf", "--links", "visual"}, kPicture);
  return one;
}

void Subjects::make_clips() {
  const TemporaryFolder folder;
  std::vector<std::string> command{"render", "assets/scenes/rr_free.yaml", "--quiet", "--set", "video.fps=25"};
  command = joined(command, kSmall);
  const std::string names[] = {"c.mp4", "c.webm", "c.mov", "c.gif", "c.apng", "c.png", "c.svg", "c.pdf"};
  for (const std::string& name : names) command = joined(command, {"-o", folder.file(name)});
  const ProgramResult result = run_program(command);
  if (result.status != 0) throw std::runtime_error("no clips to spoil: " + result.err);
  for (const std::string& name : names) clips_[name] = read_whole_file(folder.file(name));
}

Case Subjects::clip(Dice& dice) {
  if (clips_.empty()) make_clips();
  const std::vector<std::string> words{"chainreel_scene", "chainreel_audit", "\"model\":", "[[[[", "{\"a\":", "moov", "tEXt", "IHDR",
                                       "<metadata>", "/Keywords (", "null", "\"panels\": 3", "model: /dev/zero"};
  const auto& [name, bytes] = *std::next(clips_.begin(), std::ptrdiff_t(dice.below(clips_.size())));
  Case one;
  // What a clip remembers lies together: changes there tell more than those among pixels.
  std::string text = bytes;
  const std::size_t memory = text.find("duration");
  if (memory != std::string::npos && dice.one_in(2)) {
    const std::size_t from = memory > 600 ? memory - 600 : 0;
    text = text.substr(0, from) + mutated(text.substr(from, 3000), dice, words) + text.substr(std::min(text.size(), from + 3000));
  } else {
    text = mutated(text, dice, words);
  }
  one.files[name] = text;
  const std::vector<std::string> all[] = {{"extract", name}, {"extract", name, "--json"}, {"extract", name, "-o", "again.yaml"}};
  one.arguments = dice.pick(all);
  if ((name == "c.mp4" || name == "c.webm") && dice.one_in(3)) one.arguments = {"gallery", name, "-o", "page.html"};
  return one;
}

// Words are dropped, doubled, exchanged and spoilt; none may lead out of the folder.
Case Subjects::command_line(Dice& dice) const {
  const std::vector<std::string> seeds[] = {
      joined({"check", "s.yaml"}, kSmall),
      joined({"simulate", "s.yaml", "-o", "run.csv"}, kSmall),
      {"dynamics", "models/rr.urdf", "--q", "0,90deg", "--qd", "1,2", "--tau", "0,1", "--gravity", "0,-9.81,0", "--json"},
      joined({"snapshot", "models/rr.urdf", "--pose", "0,90deg"}, kPicture),
      joined({"ellipse", "models/rr.urdf", "--pose", "0,90deg", "--reading", "belt"}, kPicture),
      {"ellipse", "models/rr.urdf", "--sweep", "q2=0:180deg:3", "-o", "e.csv"},
      {"init", "arm", "--quiet"},
      {"methods", "--json"},
      joined({"snapshot", "s.yaml", "--at", "0.01", "-o", "p.svg", "--theme", "dark"}, kSmall),
      {"stability", "s.yaml"}};
  const std::vector<std::string> words{"--json", "--force", "--quiet", "-o", "--set", "method=taylor", "=", "--pose", "", "-", "--",
                                       "--help", "q2=0:1:-1", "models/arm.urdf", "--base", "floating", "torque=[1,2", "--width", "0"};
  Case one;
  one.files["s.yaml"] = "model: models/rr.urdf\nduration: 0.05\nmethod: rk4\n";
  std::vector<std::string>& line = one.arguments = dice.pick(seeds);
  for (std::size_t changes = 1 + dice.below(3); changes > 0; --changes) {
    const std::size_t at = dice.below(line.size());
    switch (dice.below(5)) {
      case 0:
        if (line.size() > 1) line.erase(line.begin() + std::ptrdiff_t(at));
        break;
      case 1:
        line.insert(line.begin() + std::ptrdiff_t(at), dice.pick(words));
        break;
      case 2:
        line[at] = mutated(line[at], dice, words);
        break;
      case 3:
        line[at] = dice.one_in(2) ? nasty_number(dice) : dice.pick(words);
        break;
      default:
        std::swap(line[at], line[dice.below(line.size())]);
    }
  }
  for (std::string& word : line) {
    word.erase(std::remove(word.begin(), word.end(), '\0'), word.end());
    if (word.starts_with('/') || word.find("..") != std::string::npos) word = "away";
    // The system takes no longer ones.
    if (word.size() > 100000) word.resize(100000);
  }
  return one;
}

}  // namespace chainreel
