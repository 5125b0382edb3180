// Small faults by lot, put into models and scenes of the project: each must be found, and its words must name
// the link, the joint or the key that was touched, and nothing else.

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <regex>

#include "app/verify/physics_record.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

constexpr const char* kShippedModels[] = {"arm", "four_bar", "humanoid", "p", "pp", "rr", "rrr", "slider_crank"};

struct Fault {
  std::string text;   // of the spoilt file
  std::string owner;  // what the words must name
  std::string word;   // and what they must call it; "": nothing in particular
};

// Spoils a text in one place, or cannot.
using Spoil = std::function<std::optional<Fault>(const std::string& text, std::mt19937& lot)>;

// The name in the last tag of `tags` that opens before `at`.
std::string owner_at(const std::string& text, std::size_t at, const std::string& tags) {
  static const std::regex open("<(link|joint|material|visual|inertial) ?(name=\"([^\"]*)\")?");
  std::string owner;
  for (auto it = std::sregex_iterator(text.begin(), text.begin() + std::ptrdiff_t(at), open);
       it != std::sregex_iterator(); ++it)
    if (tags.find((*it)[1].str()) != std::string::npos && !(*it)[3].str().empty()) owner = (*it)[3];
  return owner;
}

// Whether the piece at `at` stands in a <tag> of `text`.
bool is_inside(const std::string& text, std::size_t at, const std::string& tag) {
  const std::size_t open = text.rfind("<" + tag, at), close = text.rfind("</" + tag + ">", at);
  return open != std::string::npos && (close == std::string::npos || close < open);
}

// Changes the captured number of one match of `pattern`, by lot; `where` may refuse a place.
Spoil number_at(const std::string& pattern, const std::string& owners, const std::string& word,
                std::function<double(double)> change,
                std::function<bool(const std::string&, std::size_t)> where = {}) {
  return [=](const std::string& text, std::mt19937& lot) -> std::optional<Fault> {
    const std::regex expression(pattern);
    std::vector<std::smatch> matches;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), expression); it != std::sregex_iterator();
         ++it)
      if (!where || where(text, std::size_t(it->position(0)))) matches.push_back(*it);
    if (matches.empty()) return std::nullopt;
    const std::smatch& match = matches[lot() % matches.size()];
    const double old = std::stod(match[1]), now = change(old);
    if (old == now) return std::nullopt;
    std::string spoilt = text;
    spoilt.replace(std::size_t(match.position(1)), std::size_t(match.length(1)), format_shortest(now));
    return Fault{spoilt, owners.empty() ? word : owner_at(text, std::size_t(match.position(0)), owners),
                 word};
  };
}

Spoil renamed(const std::string& tag) {
  return [=](const std::string& text, std::mt19937& lot) -> std::optional<Fault> {
    const std::regex expression("<" + tag + " name=\"([^\"]*)\"");
    std::vector<std::string> names;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), expression); it != std::sregex_iterator();
         ++it)
      if ((*it)[1] != "gripper") names.push_back((*it)[1]);
    const std::string& name = names[lot() % names.size()];
    std::string spoilt = text;
    const std::string old = "\"" + name + "\"";
    for (std::size_t at = 0; (at = spoilt.find(old, at)) != std::string::npos; at += name.size() + 4)
      spoilt.replace(at, old.size(), "\"" + name + "_2\"");
    return Fault{spoilt, tag + " " + name, "renamed to " + name + "_2"};
  };
}

std::optional<Fault> lost_visual(const std::string& text, std::mt19937& lot) {
  static const std::regex visual("<visual>[\\s\\S]*?</visual>");
  std::vector<std::smatch> matches;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), visual); it != std::sregex_iterator(); ++it)
    matches.push_back(*it);
  if (matches.empty()) return std::nullopt;
  const std::smatch& match = matches[lot() % matches.size()];
  std::string spoilt = text;
  spoilt.erase(std::size_t(match.position(0)), std::size_t(match.length(0)));
  return Fault{spoilt, owner_at(text, std::size_t(match.position(0)), "link"), "gone"};
}

std::function<bool(const std::string&, std::size_t)> in(const std::string& tag) {
  return [=](const std::string& text, std::size_t at) { return is_inside(text, at, tag); };
}

std::vector<std::pair<const char*, Spoil>> model_faults() {
  const auto percent = [](double x) { return x * 1.01; };
  const auto more = [](double by) { return [=](double x) { return x + by; }; };
  return {
      {"a mass by 1 %", number_at("<mass value=\"([^\"]*)\"", "link", ": mass ", percent)},
      {"an entry of an inertia",
       number_at("(?:ixx|iyy|izz)=\"([^\"]*)\"", "link", "inertia of link", more(1e-4))},
      {"a centre of mass", number_at("<origin xyz=\"([^\" ]*)", "link", "centre of mass moved by 1 mm",
                                     more(1e-3), in("inertial"))},
      {"a joint's origin",
       number_at("<origin xyz=\"([^\" ]*)", "joint", "origin moved by 1 mm", more(1e-3), in("joint"))},
      {"an axis by 1e-3 rad",
       number_at("<axis xyz=\"(0) ", "joint", "axis turned by 0.0573 deg", more(1e-3), in("joint"))},
      {"a limit", number_at("upper=\"([^\"]*)\"", "joint", "upper limit", percent)},
      {"an effort", number_at("effort=\"([^\"]*)\"", "joint", "limit of effort", percent)},
      {"a place of a shape",
       number_at("<origin xyz=\"([^\" ]*)", "link", ") moved by 1 mm", more(1e-3), in("visual"))},
      {"a turn of a shape", number_at("rpy=\"([^\" ]*)", "link", ") turned by ", more(1e-3), in("visual"))},
      {"a radius", number_at("radius=\"([^\"]*)\"", "link", "radius", percent)},
      {"a colour by 4/255", number_at("rgba=\"([^\" ]*)", "material", "colour",
                                      [](double x) { return x > 0.5 ? x - 4.0 / 255 : x + 4.0 / 255; })},
      {"a link renamed", renamed("link")},
      {"a joint renamed", renamed("joint")},
      {"a shape gone", lost_visual}};
}

TEST(PhysicsFaults, InModelsAreFoundAndNamed) {
  std::mt19937 lot(14);
  const TemporaryFolder folder;
  int faults = 0, refused = 0;
  for (const char* model : kShippedModels) {
    const std::string text =
        read_whole_file(std::string(CHAINREEL_SOURCE_FOLDER "/models/") + model + ".urdf");
    const Json before = model_record(folder.write("model.urdf", text), {});
    for (const auto& [name, spoil] : model_faults()) {
      const std::optional<Fault> fault = spoil(text, lot);
      if (!fault) continue;
      SCOPED_TRACE(std::string(model) + ": " + name + " of " + fault->owner);
      std::vector<std::string> words;
      try {
        words = explain_models(before, model_record(folder.write("model.urdf", fault->text), {}));
      } catch (const Error&) {
        ++refused;  // it is no model any more: a triangle that moments of inertia must fulfil
        continue;
      }
      ++faults;
      EXPECT_THAT(words, testing::Contains(testing::AllOf(testing::HasSubstr(fault->owner),
                                                          testing::HasSubstr(fault->word))));
      // A material may be that of several links; an arm that leaves its plane has another gravity by default.
      std::erase_if(words, [](const std::string& sentence) { return sentence.starts_with("gravity "); });
      if (std::string(name) != "a colour by 4/255")
        EXPECT_EQ(words.size(), 1U) << testing::PrintToString(words);
    }
  }
  EXPECT_GE(faults, 100);
  EXPECT_LT(refused, 8);
}

struct SceneFault {
  const char* scene;
  const char* change;  // KEY=VALUE
  const char* words;   // that must stand in a sentence that tells of another motion
};

// Over 0.4 s or what the fault takes to be felt.
constexpr SceneFault kSceneFaults[] = {
    {"rr_torque", "torque.1=1.01", "torque.1 1 -> 1.01"},
    {"rr_torque", "torque.2=0.99", "torque.2 1 -> 0.99"},
    {"rr_torque", "method=symplectic_euler", "method semi_implicit_euler -> symplectic_euler"},
    {"rr_torque", "method=rk4", "method semi_implicit_euler -> rk4"},
    {"rr_torque", "step=0.0005", "step 0.001 -> 0.0005"},
    {"rr_torque", "gravity=[0, -9.8, 0]", "gravity.2 -9.81 -> -9.8"},
    {"rr_torque", "start.q=[1e-3, 0]", "start.q.1 0 -> 0.001"},
    {"rr_torque", "start.qd=[0, 1e-3]", "start.qd.2 0 -> 0.001"},
    {"rrr_torque", "torque.3=10.1", "torque.3 10 -> 10.1"},
    {"rrr_torque", "start.q.3=0.001", "start.q.3 0 -> 0.001"},
    {"pp_spring", "torque.2=-101 * y_G", "torque.2"},
    {"pp_spring", "step=0.002", "step 0.001 -> 0.002"},
    {"pp_spring", "start.q.2=1.001", "start.q.2 1 -> 1.001"},
    {"humanoid_fall", "parameters.tau=25.25", "parameters.tau 25 -> 25.25"},
    {"humanoid_fall", "parameters.k=1", "parameters.k 0 -> 1"},
    {"humanoid_fall", "start.q.1=-0.0533", "start.q.1 -0.0523599 -> -0.0533"},
    {"four_bar", "torque.1=12.12 - 2 * qd1", "torque.1"},
    {"slider_crank", "torque.1=8.08 - qd1", "torque.1"},
};

TEST(PhysicsFaults, InScenesAreFoundAndToldWithTheirMotion) {
  for (const SceneFault& fault : kSceneFaults) {
    SCOPED_TRACE(std::string(fault.scene) + " " + fault.change);
    const std::string scene = std::string(CHAINREEL_SOURCE_FOLDER "/assets/scenes/") + fault.scene + ".yaml";
    const auto record = [&](std::vector<std::string> overrides) {
      overrides.insert(overrides.end(), {"duration=0.4", "plot=null", "layout=scene"});
      const PreparedFilm film = load_film(scene, overrides, false);
      return run_record(film, Runs(film));
    };
    const bool is_auto = std::string(fault.scene) == "four_bar" || std::string(fault.scene) == "slider_crank";
    const std::vector<std::string> fixed =
        is_auto ? std::vector<std::string>{"method=rk4", "step=0.002"} : std::vector<std::string>{};
    std::vector<std::string> changed = fixed;
    changed.push_back(fault.change);
    const Json before = record(fixed), after = record(changed);
    EXPECT_LT(before.dump().size(), 100'000U);
    EXPECT_THAT(explain_runs(before, after),
                testing::ElementsAre(testing::AllOf(testing::HasSubstr(" differs by "),
                                                    testing::HasSubstr(": " + std::string(fault.words)))));
    EXPECT_THAT(explain_runs(before, record(fixed)), testing::IsEmpty());
  }
}

}  // namespace
}  // namespace chainreel
