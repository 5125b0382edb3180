#include "sim/rank_loss.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <Eigen/Eigenvalues>

#include "core/format.hpp"
#include "dynamics/constraints/constrained_mass.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "integrate/hermite_span.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/watch/dip.hpp"

namespace chainreel {
namespace {

constexpr double kNoRow = 1e-10;        // an eigenvalue, squared, of rows of size 1: rounding
constexpr int kMostMinima = 64;         // minima looked at closer
constexpr int kMostLooksAtPose = 60;    // each narrows an interval to 0.62 of itself
constexpr int kInstantsAbout = 400;     // of a second run, between three samples
constexpr double kFar = 2;              // of a change from sample to sample
constexpr double kFarthestApart = 0.1;  // rad or m, from sample to sample
constexpr int kMostInstants = 50'000;
constexpr double kSpared = 0.02;        // of the time until it

class RowStrengths {
 public:
  RowStrengths(const Simulation& simulation, const Trajectory& trajectory)
      : chain_(simulation.chain),
        trajectory_(trajectory),
        system_(simulation),
        ws_(chain_),
        set_(chain_, simulation.constraints.list),
        cws_(chain_, set_),
        span_(chain_.nq, chain_.nv),
        rows_(set_.rows()),
        scale_(Eigen::VectorXd::Zero(rows_)),
        q_(std::size_t(chain_.nq)),
        qd_(std::size_t(chain_.nv)) {
    follow([&] { scale_ = scale_.cwiseMax(matrix().diagonal()); });
    scale_ = scale_.unaryExpr([](double size) { return size > 0 ? 1 / std::sqrt(size) : 0; });
    std::vector<Eigen::VectorXd> found;
    follow([&] {
      found.push_back(eigenvalues());
      rank_ = std::max(rank_, int((found.back().array() > kNoRow).count()));
    });
    if (rank_ == 0) return;
    for (const Eigen::VectorXd& one : found) strengths_.push_back(root_of(one));
    largest_ = *std::max_element(strengths_.begin(), strengths_.end());
  }

  // The poses of samples, or of instants between them on the cubic through both, that lie below the limit.
  std::vector<RankLoss> losses() {
    std::vector<RankLoss> found;
    for (const int k : minima())
      if (const auto loss = loss_about(k); loss && (found.empty() || loss->t > found.back().t)) found.push_back(*loss);
    return found;
  }

  // Instants near together about each sample at which such a pose may be near: what changes as fast there as from sample to sample could reach zero.
  std::vector<double> instants_about_minima() const {
    std::vector<double> times;
    for (const int k : minima()) {
      const int before = std::max(k - 1, 0), behind = std::min(k + 1, size() - 1);
      if (!(at(k) < kFar * std::max(at(before) - at(k), at(behind) - at(k)))) continue;
      const double begin = trajectory_.t[std::size_t(before)], end = trajectory_.t[std::size_t(behind)];
      for (int i = 1; i < kInstantsAbout; ++i) times.push_back(begin + (end - begin) * i / kInstantsAbout);
    }
    return times;
  }

 private:
  int size() const { return int(strengths_.size()); }
  double at(int k) const { return strengths_[std::size_t(k)]; }

  std::optional<RankLoss> loss_about(int k) {
    if (at(k) < kDependentRows * largest_) return RankLoss{trajectory_.t[std::size_t(k)], at(k) / largest_};
    for (const int before : {k - 1, k})
      if (before >= 0 && before + 1 < size())
        if (const auto found = loss_between(before)) return found;
    return {};
  }

  // Samples that are weaker than those beside them, the weakest of many.
  std::vector<int> minima() const {
    std::vector<int> found;
    for (int k = 0; k < size(); ++k)
      if ((k == 0 || at(k) <= at(k - 1)) && (k + 1 == size() || at(k) <= at(k + 1)) && at(k) < largest_ / 2) found.push_back(k);
    if (found.size() > kMostMinima) {
      std::nth_element(found.begin(), found.begin() + kMostMinima, found.end(), [&](int a, int b) { return at(a) < at(b); });
      found.resize(kMostMinima);
      std::sort(found.begin(), found.end());
    }
    return found;
  }

  // At each sample in turn, as curves are followed.
  template <class Function>
  void follow(Function&& look) {
    cws_ = ConstrainedWorkspace(chain_, set_);
    for (int k = 0; k < trajectory_.size(); ++k) {
      if (!set_.curves().empty() && int(curve_s_.size()) < trajectory_.size()) curve_s_.push_back(cws_.curve_s);
      place(trajectory_.q_at(k));
      look();
    }
  }

  void place(ConstVec q) {
    compute_constraints(chain_, ws_, set_, cws_, q, qd_);
    factor_mass(chain_, ws_, cws_, q);
    compute_row_system(chain_, ws_, cws_);
  }

  Eigen::MatrixXd matrix() {
    Eigen::MatrixXd G(rows_, rows_);
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j <= i; ++j) G(i, j) = G(j, i) = cws_.solver.G(i, j);
    return G;
  }

  Eigen::VectorXd eigenvalues() {
    const Eigen::MatrixXd scaled = scale_.asDiagonal() * matrix() * scale_.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  }

  double root_of(const Eigen::VectorXd& eigenvalues) const { return std::sqrt(std::max(0.0, eigenvalues(rows_ - rank_))); }

  std::optional<RankLoss> loss_between(int k) {
    const double low = trajectory_.t[std::size_t(k)], high = trajectory_.t[std::size_t(k) + 1];
    if (!(high > low)) return {};
    span_.start();
    span_.begin(low, trajectory_.q_at(k), trajectory_.qd_at(k));
    span_.end(high, trajectory_.q_at(k + 1), trajectory_.qd_at(k + 1));
    std::vector<double> rate(qd_.size());
    const auto there = below_in_dip(low, high, kDependentRows, kMostLooksAtPose, [&](double t) {
      if (!curve_s_.empty()) cws_.curve_s = curve_s_[std::size_t(k)];
      span_.interpolate_apart(system_, t, q_, rate);
      place(q_);
      return root_of(eigenvalues()) / largest_;
    });
    return there ? std::optional(RankLoss{there->t, there->value}) : std::nullopt;
  }

  const Chain& chain_;
  const Trajectory& trajectory_;
  ChainSystem system_;
  Workspace ws_;
  ConstraintSet set_;
  ConstrainedWorkspace cws_;
  HermiteSpan span_;
  int rows_, rank_ = 0;
  Eigen::VectorXd scale_;  // 1 / the root of the largest diagonal
  double largest_ = 0;
  std::vector<double> strengths_;             // of the samples
  std::vector<std::vector<double>> curve_s_;  // before each, where there are curves
  std::vector<double> q_, qd_;                // qd_: zero, no rate is asked
};

// Where no joint goes far from one to the next, as far as the rates at the samples tell; none where the samples lie so.
std::vector<double> instants_near_enough(const Simulation& simulation, const Trajectory& trajectory) {
  double fastest = 0, longest = 0;
  for (const double rate : trajectory.qd) fastest = std::max(fastest, std::abs(rate));
  for (int k = 1; k < trajectory.size(); ++k) longest = std::max(longest, trajectory.t[std::size_t(k)] - trajectory.t[std::size_t(k) - 1]);
  if (!(fastest * longest > kFarthestApart) || !std::isfinite(fastest)) return {};
  const double end = std::min(trajectory.end_time, simulation.duration);
  const int count = int(std::min(std::ceil(fastest * end / kFarthestApart), double(kMostInstants)));
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

}  // namespace

std::vector<RankLoss> rank_losses_of(const Simulation& simulation, const Trajectory& trajectory) {
  if (trajectory.rows == 0 || trajectory.size() < 2) return {};
  // Rows of coordinates alone are the same at every pose.
  const auto is_of_coordinates = [](const Constraint& one) { return std::holds_alternative<JointConstraint>(one) || std::holds_alternative<LinearConstraint>(one); };
  if (std::all_of(simulation.constraints.list.begin(), simulation.constraints.list.end(), is_of_coordinates)) return {};
  const std::vector<double> near = instants_near_enough(simulation, trajectory);
  const auto seen_at = [&](std::vector<double> times) {
    times.insert(times.end(), trajectory.t.begin(), trajectory.t.end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return simulate(simulation, times);
  };
  const Trajectory denser = near.empty() ? Trajectory{} : seen_at(near);
  std::vector<double> times = RowStrengths(simulation, near.empty() ? trajectory : denser).instants_about_minima();
  if (times.empty()) return {};
  // A cubic through samples is none of a motion that turned another way between them: that is seen in the run itself.
  return RowStrengths(simulation, seen_at(std::move(times))).losses();
}

std::optional<Doubt> doubt_of_rank(const Simulation& simulation, const Trajectory& trajectory, double until) {
  std::vector<RankLoss> losses = rank_losses_of(simulation, trajectory);
  std::erase_if(losses, [&](const RankLoss& one) { return one.t > until; });
  if (losses.empty()) return {};
  constexpr std::size_t kTold = 4;
  std::string when;
  for (std::size_t k = 0; k < std::min(losses.size(), kTold); ++k) when += (k == 0 ? "" : k + 1 == losses.size() ? " and " : ", ") + format_significant(losses[k].t, 4);
  if (losses.size() > kTold) when += " and " + std::to_string(losses.size() - kTold) + " times more until " + format_significant(losses.back().t, 4);
  const double end = rounded_down(losses.front().t * (1 - kSpared), 3);
  return Doubt{"rank", losses.front().part,
               "at t = " + when + " s constraints that are independent elsewhere depend on each other, as of links in one line: which way "
               "the motion goes on there, and lambda, the equations do not say",
               end > 0 ? "--set duration=" + format_significant(end, 3) + ", which ends before it" : "a start away from it"};
}

}  // namespace chainreel
