// Many instances of one mechanism stepped together by the method semi_implicit_euler, each with its own
// state, torques (constant during a call of run), step, masses and lengths: for sweeps and stability maps.
//
// Every instance has the bits that `simulate` gives it, whatever the processor, the number of threads and the
// company of other instances. Nothing looks at the states: where `simulate` ends a run that diverged, an
// instance here goes on to infinity and NaN.
//
// Planar chains of one to four revolute joints without friction are stepped several at a time
// (dynamics/kernels/batch_planar.hpp); so is an instance with a chain of its own if it lies along the same axis and
// turns the same ways as the first one (PlanarKernel's along_x and turned). All others go one by one.
#pragma once

#include <memory>
#include <vector>

#include "dynamics/kernels/batch_planar.hpp"
#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

class BatchSimulator {
 public:
  // Each instance rests at zero without torques, with a step of 1 ms.
  BatchSimulator(const Chain& chain, int instances);
  ~BatchSimulator();
  BatchSimulator(BatchSimulator&&) noexcept;
  BatchSimulator& operator=(BatchSimulator&&) noexcept;

  int instances() const { return int(h_.size()); }
  bool is_in_lane(int i) const { return !alone_[std::size_t(i)]; }  // stepped together with others

  void set_state(int i, ConstVec q, ConstVec qd);
  void set_torque(int i, ConstVec tau);
  void set_step(int i, double h);  // s
  // Other masses, lengths or gravity; nq and nv must be those of the first chain. State, torques and step
  // stay.
  void set_chain(int i, const Chain& chain);

  void run(long steps, int threads = 1);

  void read_state(int i, Vec q, Vec qd) const;

 private:
  struct Alone;  // an instance that is stepped by itself

  void place(int i, const Chain& chain, ConstVec q, ConstVec qd);
  void step_slice(std::size_t slice, std::size_t slices, long steps);
  PlanarBlock& block_of(int i) { return blocks_[std::size_t(i) / PlanarBlock::kLanes]; }
  const PlanarBlock& block_of(int i) const { return blocks_[std::size_t(i) / PlanarBlock::kLanes]; }
  ConstVec torque_of(int i) const { return {&tau_[std::size_t(i) * nv_], nv_}; }

  std::size_t nq_ = 0, nv_ = 0;
  PlanarKernel kernel_;                     // of the first chain
  StepPlanarBlocks step_blocks_ = nullptr;  // null where no chain like the first one can stand in a lane
  std::vector<PlanarBlock> blocks_;         // lane i % 8 of block i / 8; the lane of one alone stands still
  std::vector<std::unique_ptr<Alone>> alone_;  // null for those in lanes
  std::vector<double> tau_;                    // nv each
  std::vector<double> h_;                      // s
};

}  // namespace chainreel
