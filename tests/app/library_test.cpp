// What other programs call.
#include "app/library/scene_run.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <stdexcept>

#include "app/library/loaded_model.hpp"
#include "core/json.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

const char* const kSceneText =
    "{model: models/rr.urdf, gravity: [0, -9.81, 0], start: {q: [0.3, 1]}, duration: 0.5, method: rk4, step: 0.001}";

SceneRequest scene_of(std::vector<std::string> overrides = {}) {
  return {.path = "scene", .text = kSceneText, .overrides = std::move(overrides)};
}

OwnTorque torque_of(TorqueFunction function) {
  return {.function = std::move(function), .words = "the function f"};
}

std::string problem_of(SceneRequest request, std::vector<double> times = {}) {
  try {
    const SceneRun run(std::move(request), std::move(times));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Library, AFunctionMovesAChainAsTheExpressionThatItIs) {
  const SceneRun by_text(scene_of({"torque=[2 * t, -3 * qd2]"}));
  SceneRequest request = scene_of();
  request.torque = torque_of([](double t, auto, auto qd, auto tau) {
    tau[0] = 2 * t;
    tau[1] = -3 * qd[1];
  });
  const SceneRun by_function(std::move(request));
  EXPECT_EQ(by_function.trajectory().q, by_text.trajectory().q);
  EXPECT_EQ(by_function.torques(), by_text.torques());
  EXPECT_NE(by_function.torques().back(), 0);
}

// Slow motion that nobody asked for is the film's: arrays are those of `simulate`.
TEST(Library, ARunHasItsOwnTimeHoweverSlowItsFilmIs) {
  const SceneRun fast({.path = "assets/scenes/rrr_torque.yaml", .overrides = {"duration=1"}});
  const std::vector<double>& t = fast.trajectory().t;
  ASSERT_EQ(t.size(), 61u);
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(t[k], double(k) / 60, 1e-15);
  const SceneRun asked({.path = "assets/scenes/rrr_torque.yaml",
                        .overrides = {"duration=1", "slow_motion=[{from: 0.5, until: 1, speed: 0.5}]"}});
  EXPECT_EQ(asked.trajectory().t.size(), 91u) << "what the scene asks for is part of it";
}

TEST(Library, WhatAFunctionThrowsIsThrown) {
  for (const char* method : {"rk4", "auto"}) {
    SceneRequest request = scene_of({std::string("method=") + method, "step="});
    int asked_later = 0;
    request.torque = torque_of([&asked_later](double t, auto, auto, auto tau) {
      tau[0] = tau[1] = 0;
      if (asked_later > 0) ++asked_later;
      if (t > 0.1) {
        ++asked_later;
        throw std::domain_error("too late");
      }
    });
    EXPECT_THROW(SceneRun(std::move(request)), std::domain_error) << method;
    EXPECT_EQ(asked_later, 1) << method;
  }
}

TEST(Library, AFunctionThatAsksItsOwnRunIsToldSo) {
  const SceneRun* own = nullptr;
  SceneRequest request = scene_of();
  request.torque = torque_of([&own](auto, auto, auto, auto tau) {
    tau[0] = tau[1] = 0;
    if (own != nullptr) own->energy();
  });
  const SceneRun run(std::move(request));
  own = &run;
  EXPECT_THROW(run.torques(), Error);
  own = nullptr;
  EXPECT_EQ(run.torques().size(), 2 * run.trajectory().t.size());
}

TEST(Library, AFunctionIsNoTorqueOfAScene) {
  SceneRequest request = scene_of({"torque=[1, 0]"});
  request.torque = torque_of([](auto, auto, auto, auto) {});
  EXPECT_THAT(problem_of(std::move(request)), HasSubstr("has a torque of its own, and is given the function f"));

  // What a film of it remembers.
  request = scene_of();
  request.torque = torque_of([](auto, auto, auto, auto tau) { tau[0] = tau[1] = 1; });
  const std::string remembered = SceneRun(std::move(request)).effective_scene();
  EXPECT_THAT(remembered, HasSubstr("the function f"));
  EXPECT_THAT(problem_of({.path = "models/x.yaml", .text = remembered}),
              HasSubstr("the torque was the function f, which no file holds"));
}

TEST(Library, EnergyIsThatOfTheAudit) {
  const SceneRun run(scene_of());
  const Json report = parse_json(run.report());
  double largest = 0;
  for (const double error : run.energy().error) largest = std::max(largest, std::abs(error));
  EXPECT_EQ(run.energy().total.size(), run.trajectory().t.size());
  EXPECT_EQ(run.energy().total.front(), report["energy_start"].get<double>());
  EXPECT_EQ(largest, report["energy_error_of_frames"].get<double>());
}

TEST(Library, InstantsRiseWithinTheDuration) {
  EXPECT_EQ(SceneRun(scene_of(), {0, 0.125, 0.5}).trajectory().t, (std::vector<double>{0, 0.125, 0.5}));
  for (const std::vector<double>& times : {std::vector<double>{0.2, 0.1}, {-0.1}, {0, 0.6}, {0.1, 0.1}})
    EXPECT_THAT(problem_of(scene_of(), times), HasSubstr("times must rise within the duration of 0.5 s"));
}

TEST(Library, AFrameHasTheSizeThatIsAskedForAndTheFilmItsOwn) {
  const SceneRun run(scene_of({"video={width: 320, height: 180}"}));
  const Image frame = run.frame(0.25), small = run.frame(0.25, 160, 90), again = run.frame(0.25);
  EXPECT_EQ(frame.width, 320);
  EXPECT_EQ(small.height, 90);
  EXPECT_EQ(again.bgra, frame.bgra);
  EXPECT_THROW(run.frame(0.75), Error);
  EXPECT_THROW(run.frame(0.25, 8), Error);
}

TEST(Library, AModelTakesWhatAModelTakes) {
  EXPECT_EQ(load_model({.path = "rr.urdf", .overrides = {"gravity=[0, 0, 0]"}}).chain.gravity.norm(), 0);
  EXPECT_EQ(load_model({.path = "model", .text = "model: {links: [1, 2, 3]}"}).chain.nv, 3);
  EXPECT_THROW(load_model({.path = "rr.urdf", .overrides = {"duration=3"}}), Error);
  EXPECT_THROW(load_model({.path = "model", .text = "model: {links: [1]}", .overrides = {"duration=3"}}), Error);
}

}  // namespace
}  // namespace chainreel
