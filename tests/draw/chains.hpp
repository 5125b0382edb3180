// Chains and runs for the tests of draw.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "core/frame_rate.hpp"
#include "model/chain.hpp"
#include "model/planar.hpp"
#include "model/read_chain.hpp"
#include "picture/text.hpp"
#include "sim/system/trajectory.hpp"
#include "support/fonts.hpp"

namespace chainreel::test {

inline Chain model(const std::string& name, const Eigen::Vector3d& gravity = {0, -9.81, 0}) {
  ModelOptions options;
  options.gravity = gravity;
  return read_chain("models/" + name + ".urdf", options);
}

// Two links of 1 m along `ex` at zero, turning about `normal`, 1 kg at the end of each.
inline Chain two_links(const Eigen::Vector3d& ex, const Eigen::Vector3d& normal,
                       const Eigen::Vector3d& gravity) {
  Chain chain;
  chain.frames = {{"base", 0, Eigen::Isometry3d::Identity()}};
  for (int b = 1; b <= 2; ++b) {
    Body body;
    body.name = "link" + std::to_string(b);
    body.parent = b - 1;
    body.joint.axis = normal;
    if (b == 2) body.joint.X_PJ.translation() = ex;
    body.joint.q_index = body.joint.v_index = b - 1;
    body.inertia.mass = 1;
    body.inertia.com = ex;
    chain.bodies.push_back(body);
    chain.frames.push_back({body.name, b, Eigen::Isometry3d::Identity()});
  }
  Eigen::Isometry3d tip = Eigen::Isometry3d::Identity();
  tip.translation() = ex;
  chain.frames.push_back({"gripper", 2, tip});
  chain.end_effector = 3;
  chain.nq = chain.nv = 2;
  chain.coordinate_names = {"joint1", "joint2"};
  chain.gravity = gravity;
  chain.planar = planar_form_of(chain, chain.why_algebra);
  return chain;
}

// Samples of q(t) with qd from a central difference: draw only needs it for the trail's smoothness.
inline Trajectory run_at(const std::vector<double>& times, const std::function<std::vector<double>(double)>& q) {
  Trajectory run;
  for (const double t : times) {
    const double h = 1e-5;
    const std::vector<double> now = q(t), before = q(t - h), after = q(t + h);
    run.nq = run.nv = int(now.size());
    run.t.push_back(t);
    run.work.push_back(0);
    for (std::size_t i = 0; i < now.size(); ++i) {
      run.q.push_back(now[i]);
      run.qd.push_back((after[i] - before[i]) / (2 * h));
    }
  }
  run.end_time = run.t.back();
  return run;
}

inline Trajectory run_of(const std::function<std::vector<double>(double)>& q, int frames, FrameRate fps = {}) {
  std::vector<double> times;
  for (int k = 0; k < frames; ++k) times.push_back(frame_time(k, fps));
  return run_at(times, q);
}

inline std::vector<double> swing(double t) {
  return {-1.2 + 1.1 * std::cos(2.1 * t), 1.4 * std::sin(3.3 * t)};
}

}  // namespace chainreel::test
