// The keys `frames`, `foot` and `events`, and the table of falls.

#include <gmock/gmock.h>

#include <cmath>

#include "scene/run/fall.hpp"
#include "scene/run/title.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/asked_instant.hpp"
#include "scene/text/write_scene.hpp"
#include "sim/simulate.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

TEST(AskedInstants, ArePartedByCommasOutsideOfBracketsAndNamesOfEvents) {
  using testing::ElementsAre;
  EXPECT_THAT(parted_instants("0,1.2s,home=event touch"), ElementsAre("0", "1.2s", "home=event touch"));
  EXPECT_THAT(parted_instants("event max(1, 2), 3"), ElementsAre("event max(1, 2)", " 3"));
  EXPECT_THAT(parted_instants("event down, first, 2s"), ElementsAre("event down, first", " 2s"));
  EXPECT_THAT(parted_instants("a=event down, first,b=event q1 == 2, second"), ElementsAre("a=event down, first", "b=event q1 == 2, second"));
  EXPECT_THAT(parted_instants("1s, soon"), ElementsAre("1s", " soon")) << "no event is named, so that this is a mistake";
}

// `event q1 >= 1` is no picture named "event q1 >" at 1 s.
TEST(AskedInstants, HaveNamesInFrontButNotOfPartsOfEvents) {
  EXPECT_EQ(named_instant("event q1 >= 1").name, "");
  EXPECT_EQ(named_instant("event q1 >= 1").text, "event q1 >= 1");
  EXPECT_EQ(named_instant("up=event q1 >= 1").name, "up");
  EXPECT_EQ(named_instant("up=event q1 >= 1").text, "event q1 >= 1");
  EXPECT_EQ(named_instant("start=0").name, "start");
  EXPECT_THROW(named_instant("=0"), Error);
}

class Events : public WrittenScenes {
 protected:
  // The error of reading and preparing a scene of the human that stands.
  std::string human_error(const std::string& text) {
    try {
      Scene scene = read(text);
      scene.model = "models/humanoid.urdf";
      prepare(scene, false);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }
};

const char kAll[] =
    "frames: {H: hip, K: shank}\nfoot: {heel: -0.06, toe: 0.19, height: 0.01}\nevents:\n"
    "  - {when: \"cop > toe\", name: tips}\n  - {when: y_H - y_K, kind: fall, direction: falling}\n";

TEST_F(Events, AreReadAndWrittenBackTheSame) {
  Scene scene = read(kAll);
  scene.model = "rr.urdf";
  const Scene again = read_scene(folder_.write("again.yaml", scene_text(scene)));
  for (const Scene* one : std::initializer_list<const Scene*>{&scene, &again}) {
    EXPECT_EQ(one->frames.at("H"), "hip");
    EXPECT_EQ(one->frames.at("K"), "shank");
    ASSERT_TRUE(one->foot.has_value());
    EXPECT_EQ(one->foot->heel, -0.06);
    EXPECT_EQ(one->foot->toe, 0.19);
    EXPECT_EQ(one->foot->height, 0.01);
    ASSERT_EQ(one->events.size(), 2u);
    EXPECT_EQ(one->events[0].when, "cop > toe");
    EXPECT_EQ(one->events[0].kind, EventKind::mark);
    EXPECT_EQ(one->events[0].title(), "tips");
    EXPECT_EQ(one->events[1].kind, EventKind::fall);
    EXPECT_EQ(one->events[1].direction, Crossing::falling);
    EXPECT_EQ(one->events[1].title(), "y_H - y_K");
  }
}

TEST_F(Events, SayWhatIsWrongWithAnEntryAndWhere) {
  EXPECT_THAT(
      error("events: [{when: q1, kind: mrk}]\n"),
      HasSubstr("one.yaml:2:27: 'events.1.kind' must be mark, stop or fall, not 'mrk': did you mean 'mark'?"));
  EXPECT_THAT(error("events: [{when: q1, direction: up}]\n"), HasSubstr("must be either, rising or falling"));
  EXPECT_THAT(error("events: [{wen: q1}]\n"), HasSubstr("unknown key 'events.1.wen': did you mean 'when'?"));
  EXPECT_THAT(error("events: [{kind: stop}]\n"), HasSubstr("'events.1' needs `when`"));
  EXPECT_THAT(error("events: q1 > 2\n"), HasSubstr("'events' must be a list of entries like"));
  EXPECT_THAT(error("events: [q1 > 2]\n"), HasSubstr("'events.1' must be one of entries like"));
  EXPECT_THAT(error("frames: [hip]\n"), HasSubstr("frames: {H: hip}"));
  EXPECT_THAT(error("frames: {G: hip}\n"), HasSubstr("'G' cannot name a frame"));
  EXPECT_THAT(error("foot: {heel: 0.2, toe: 0.1}\n"), HasSubstr("a heel below its toe"));
  EXPECT_THAT(error("foot: 3\n"), HasSubstr("'foot' must hold heel, toe, height"));
}

TEST_F(Events, NameTheNearestOfWhatAnExpressionOrAFrameMayBe) {
  EXPECT_EQ(human_error(std::string(kAll) + "end_effector: head\n"), "");  // negative control
  const std::string unknown = human_error("frames: {H: hip}\nevents: [{when: \"y_Hh < 0.5\"}]\n");
  EXPECT_THAT(unknown, HasSubstr("one.yaml:3:17: unknown name 'y_Hh'"));
  EXPECT_THAT(unknown, HasSubstr("did you mean 'y_H'?"));
  const std::string frame = human_error("frames: {H: hipp}\n");
  EXPECT_THAT(frame, HasSubstr("one.yaml:2:"));
  EXPECT_THAT(frame,
              HasSubstr("names no link and no moving joint of models/humanoid.urdf: 'hipp'; did you mean "
                        "'hip'?"));
  EXPECT_THAT(human_error("events: [{when: cop - 0.1}]\n"), HasSubstr("unknown name 'cop'"));
  EXPECT_THAT(human_error("foot: {heel: -1, toe: 1}\ngravity: [0, 0, -9.81]\n"),
              HasSubstr("one.yaml:2:1: a foot needs gravity in the plane"));
  EXPECT_THAT(human_error("foot: {heel: -1, toe: 1}\nparameters: {toe: 3}\n"),
              HasSubstr("'toe' cannot name a parameter"));
}

TEST_F(Events, TorquesMayReadFramesToo) {
  Scene scene =
      read("frames: {H: hip}\ntorque: [\"-100 * x_H - 10 * xd_H\", 0, 0]\nstart: {q: [0.1, 0, 0]}\n");
  scene.model = "models/humanoid.urdf";
  const Simulation run = prepare(scene, false);
  Workspace ws(run.chain);
  std::vector<double> tau(3), qd{2, 0, 0};
  run.torque->evaluate(run.chain, ws, 0, run.q0, qd, tau);
  const double height = 0.4305 + 0.42875;  // of the hip above the ankle
  EXPECT_NEAR(tau[0], 100 * height * std::sin(0.1) + 10 * 2 * height * std::cos(0.1), 1e-12);
}

TEST(Fall, TimeStandsInTheTitle) {
  Scene scene;
  scene.title = "Falls in {fall}, a pity";
  scene.events = {{"q1 - 1", EventKind::fall, "", Crossing::either, {}}};
  Trajectory run;
  run.end_time = 5;
  EXPECT_EQ(title_of(scene, nullptr, run), "Does not fall within 5 s, a pity");
  scene.title = "A human, who falls in {fall}";
  EXPECT_EQ(title_of(scene, nullptr, run), "A human, who does not fall within 5 s");
  scene.title = "Time: {fall}";
  EXPECT_EQ(title_of(scene, nullptr, run), "Time: more than 5 s");
  scene.title = "Falls in {fall}, a pity";
  run.ending_event = 0;
  run.end_time = 1.2345;
  EXPECT_EQ(title_of(scene, nullptr, run), "Falls in 1.23 s, a pity");
  scene.events.clear();
  run.ending_event = -1;
  EXPECT_EQ(title_of(scene, nullptr, run), scene.title);
}

TEST(Titles, TellTheirParametersAndWhatStaysAsItIs) {
  Scene scene;
  scene.title = "{F} N, {G}, $x_{F}$, {fall";
  scene.parameters = {{"F", 42.5}, {"k", 1}};
  scene.set_parameters = scene.parameters;
  EXPECT_EQ(title_of(scene, nullptr, {}), "42.5 N, {G}, $x_{F}$, {fall, k = 1");
  EXPECT_THAT(title_notices(scene), testing::ElementsAre(HasSubstr("{G} stays as it is: `parameters:` has no such name")));
  scene.title = "costs $5, F={F}";
  EXPECT_EQ(title_of(scene, nullptr, {}), "costs $5, F=42.5, k = 1") << "one $ is no formula";
  scene.title = "{fall}";
  EXPECT_THAT(title_notices(scene), testing::ElementsAre(HasSubstr("no event of kind fall")));
  scene.title = "{F}";
  scene.compare.resize(2);
  EXPECT_THAT(title_notices(scene), testing::ElementsAre(HasSubstr("the title of a comparison has no values")));
}

TEST(Fall, TableIsTheSameForAnyNumberOfThreads) {
  const Sweep sweep = parse_sweep("parameters.k=0:900:4", "--sweep");
  const FallTable one = run_fall_table("assets/scenes/humanoid_fall.yaml", {}, sweep, {1});
  const FallTable two = run_fall_table("assets/scenes/humanoid_fall.yaml", {}, sweep, {2});
  ASSERT_EQ(one.rows.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(one.rows[k].fall_time, two.rows[k].fall_time) << k;
    EXPECT_EQ(one.rows[k].first, two.rows[k].first) << k;
  }
  EXPECT_TRUE(one.rows[0].fall_time.has_value());
  EXPECT_FALSE(one.rows[3].fall_time.has_value()) << "stiff calves hold";
  EXPECT_EQ(one.rows[3].status, RunStatus::finished);
}

// From when on a foot is held depends on the motion, not on how many frames show it: the event of the same condition is the oracle.
TEST(Fall, FootIsHeldFromTheInstantOfTheEventHoweverManyFramesThereAre) {
  Scene scene = read_scene("assets/scenes/humanoid_fall.yaml");
  const Simulation simulation = prepare(scene);
  for (const double fps : {7.0, 10.0, 25.0, 60.0}) {
    std::vector<double> times;
    for (int k = 0; k < 5 * int(fps); ++k) times.push_back(k / fps);
    const Trajectory run = simulate(simulation, times);
    ASSERT_GT(run.events.size(), 0);
    const std::optional<double> from = foot_is_held_from(simulation, run);
    ASSERT_TRUE(from.has_value());
    EXPECT_NEAR(*from, run.events.t[0], 1e-4) << fps << " Hz: what a quintic through its samples is off by";
  }
}

TEST(Fall, NeedsAnEventThatIsOne) {
  try {
    run_fall_table("assets/scenes/rr_free.yaml", {}, parse_sweep("torque.1=0,1", "--sweep"), {});
    FAIL() << "a scene without falls was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("rr_free.yaml: has no event of kind `fall`"));
  }
}

}  // namespace
}  // namespace chainreel
