// Four engines behind one face, so that one text times them all. No virtual functions: they would cost a
// tenth of the smallest call.
//
//   set(state), forward_dynamics()   accelerations at a state
//   start(state), step(h)            semi-implicit Euler under constant torques: qd += qdd h, q += qd h
//
// What an engine needs to take a state over is part of its call, as it is for whoever asks it. Ours reads the
// state where it lies.
//
// Nothing but free motion is asked for: MuJoCo has contacts, constraints, passive forces, actuators and
// sensors switched off, Bullet and DART are asked for one body's dynamics without a world around it. One
// thread each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynamics/equation_of_motion.hpp"
#include "integrate/method.hpp"
#include "peers/mujoco_chain.hpp"
#include "sim/system/chain_system.hpp"
#include "support/chains.hpp"

namespace chainreel::bench {

struct EngineInfo {
  std::string name;
  std::string version;
  std::string forward_dynamics;  // the functions that are timed
  std::string step;
};

class OurEngine {
 public:
  static EngineInfo info();
  explicit OurEngine(const Chain& chain);

  void set(const test::State& state) { state_ = &state; }
  void forward_dynamics() { compute_forward_dynamics(chain_, ws_, state_->q, state_->qd, state_->tau); }
  void start(const test::State& state);
  void step(double h) { stepper_->step(*system_, 0, h, q_, qd_); }

  std::vector<double> qdd() const { return ws_.qdd; }
  std::vector<double> q() const { return q_; }
  std::vector<double> qd() const { return qd_; }

 private:
  const Chain& chain_;
  Workspace ws_;
  const test::State* state_ = nullptr;
  std::unique_ptr<TorqueLaw> torque_;
  std::unique_ptr<ChainSystem> system_;
  std::unique_ptr<Stepper> stepper_;
  std::vector<double> q_, qd_;
};

class MujocoEngine {
 public:
  static EngineInfo info();
  explicit MujocoEngine(const Chain& chain) : chain_(chain) {}

  void set(const test::State& state);
  void forward_dynamics() { mj_forward(chain_.model(), chain_.data()); }
  void start(const test::State& state) { set(state); }
  void step(double h);

  std::vector<double> qdd();
  std::vector<double> q();
  std::vector<double> qd();

 private:
  peers::MujocoChain chain_;
};

class BulletEngine {
 public:
  static EngineInfo info();
  explicit BulletEngine(const Chain& chain);
  ~BulletEngine();

  void set(const test::State& state);
  void forward_dynamics();
  void start(const test::State& state) { set(state); }
  void step(double h);

  std::vector<double> qdd() const;
  std::vector<double> q() const;
  std::vector<double> qd() const;

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

class DartEngine {
 public:
  static EngineInfo info();
  explicit DartEngine(const Chain& chain);
  ~DartEngine();

  void set(const test::State& state);
  void forward_dynamics();
  void start(const test::State& state) { set(state); }
  void step(double h);

  std::vector<double> qdd() const;
  std::vector<double> q() const;
  std::vector<double> qd() const;

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace chainreel::bench
