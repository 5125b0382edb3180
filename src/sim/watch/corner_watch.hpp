// The corners of a torque law that depend on the state, in one run in progress.
//
// Between crossings the law is smooth: each corner keeps its side. Where a switching function g leaves its
// side, the step is cut and the corner is settled there: it goes over where the motion under the other branch
// goes on that way; where both branches lead back to g = 0, it is held there by the mean of both that keeps g
// as it is (a sliding mode: dry friction at rest), until that mean would need more than one of them.
//
// A corner whose g reads the side of another, like min(6, 9*(qd1>0)), may jump with it: it goes where its g
// stands just behind, and so does one at a pole of its g. Beside one that is held it follows the text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "integrate/integrator.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {

class CornerWatch {
 public:
  // For a system whose law has such corners. `straight` looks for crossings on straight lines between the ends
  // of a step: for methods of low order, whose velocities change so; dense output may swing more than the
  // method does.
  CornerWatch(ChainSystem& system, double duration, bool straight);

  // Picks the sides of all corners at the state where the run begins, or behind a cut or a break of the
  // torques. False where they jump to and fro without end: see `culprit`.
  bool settle(double t, ConstVec q, ConstVec qd);

  // After a step: the first instant in it at which a corner leaves its side, by dense output.
  // `q0` and `qd0` are the state at its beginning.
  std::optional<double> first_crossing(Integrator& integrator, ConstVec q0, ConstVec qd0);

  // At the end of a step that was cut there: by how much the crossing is still later, to first order.
  double off_by(double t, ConstVec q, ConstVec qd);

  // Where crossings come to no end: what stands still at a corner at which nothing jumps swings about it by what its method is off.
  // From here on that counts as within the corner. False where there is no such corner, or none that has room for it.
  bool rests_at_bends(double t, ConstVec q, ConstVec qd);

  const std::string& culprit() const { return corners_.text(culprit_); }
  // Whether a side has changed just before t, or here.
  bool changed_before(double t) const;
  bool is_holding() const { return !system_.held().empty(); }

 private:
  struct Watched {
    double before = 0;  // see margin_of
    double slack = 0;   // what a margin may be below zero before the corner has been left
    double rest = 0;    // no less than this: of a corner where nothing jumps and the motion has come to rest
    bool as_written = false;
    bool is_free = false;  // it follows the text and is not watched: what it reads is held
  };

  // How far each corner is from leaving its side, into margins_: the switching function on it, or 1 - |side|
  // of one that is held; negative beyond.
  void read(double t, ConstVec q, ConstVec qd);
  void look(Integrator& integrator, double t);  // the state at t into q_, qd_
  double margin_at(Integrator& integrator, int k, double t);
  std::optional<double> crossing(Integrator& integrator, int k, double from, double to);
  std::optional<double> crossing_at_dip(Integrator& integrator, int k, double from, double to);
  std::optional<double> crossing_at_ends(Integrator& integrator, int k);

  std::vector<int> near_ones(double t, ConstVec q, ConstVec qd);
  void look_ahead(double t, ConstVec q, ConstVec qd, double dt);
  void sort_corners(std::vector<int>& open, double t, ConstVec q, ConstVec qd);
  bool reads_any(int k, const std::vector<int>& others) const;
  void let_followers_follow(const std::vector<int>& held);
  bool agrees(int k, int choice, const std::vector<int>& open, double t, ConstVec q, ConstVec qd);
  bool choose_sides(const std::vector<int>& open, double t, ConstVec q, ConstVec qd);
  bool is_consistent(const std::vector<int>& open, const std::vector<int>& choice, double t, ConstVec q,
                     ConstVec qd);
  void follow_text(const std::vector<int>& open, double t, ConstVec q, ConstVec qd);
  int direction(int k, double t, ConstVec q, ConstVec qd);
  bool jumps_without_end(double t, ConstVec q, ConstVec qd, const std::vector<int>& changed);
  bool bends_only(int k, double t, ConstVec q, ConstVec qd);

  ChainSystem& system_;
  StateCorners& corners_;
  Workspace ws_;
  bool straight_;
  ConstVec q0_, qd0_;  // where the step began
  double rush_;        // s: as many changes as are counted, within this time, come to no end
  std::vector<Watched> watched_;
  std::vector<double> margins_, g_, g_ahead_, last_g_;
  std::vector<double> touch_;  // what is no further from zero may be at it
  std::vector<double> q_, qd_, ahead_q_, ahead_qd_;
  double t_behind_ = 0;  // just behind the instant that is settled
  std::vector<double> q_behind_, qd_behind_;
  std::vector<double> looks_;   // margins at the looks of a step
  std::vector<int> left_;       // corners that were held and cannot be any longer
  std::vector<int> followers_;  // that read corners at zero, and are not at zero themselves; rising
  std::vector<double> change_times_;
  std::size_t changes_ = 0;
  int culprit_ = 0;
  int crossed_ = 0;            // the corner of the last crossing found
  bool crossed_pole_ = false;  // its function is large there
  bool started_ = false;
};

}  // namespace chainreel
