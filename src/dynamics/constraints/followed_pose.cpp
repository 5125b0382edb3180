#include "dynamics/constraints/followed_pose.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/constraints/constraint_rows.hpp"

namespace chainreel {
namespace {

constexpr int kPasses = 60, kSeeds = 216;
constexpr double kLongestStep = 0.6;  // rad or m: beyond it the first derivatives know nothing
constexpr double kMet = 1e-12, kSettled = 1e-10;  // m or rad; `kSettled`: from there on passes go on as long as they help
constexpr double kSingular = 1e-9;  // of the largest entry to that power: a determinant that is none
constexpr double kSlide = 2;   // m: how far sliders without limits are tried
constexpr double kTurn = 2 * std::numbers::pi;

// The k-th of numbers that fill 0 to 1 evenly, however many there are: van der Corput, in the base of each freedom.
double spread(int k, int base) {
  double value = 0, share = 1;
  for (; k > 0; k /= base) {
    share /= base;
    value += share * (k % base);
  }
  return value;
}

class Follower {
 public:
  Follower(const Chain& chain, const ConstraintSet& set, ConstVec q, const std::vector<bool>& held, std::span<const std::size_t> about)
      : chain_(chain), set_(set), ws_(chain), about_(about), start_(q.begin(), q.end()), at_rest_(q.size(), 0.0), joints_(q.size(), nullptr) {
    for (const Body& body : chain.bodies)
      if (&body != &chain.bodies.front() && body.joint.ratio == 1 && body.joint.offset == 0) joints_[std::size_t(body.joint.q_index)] = &body.joint;
    // What no constraint touches at any of a few poses has no part in this.
    std::vector<bool> is_touched(q.size(), false);
    for (int k = 0; k < 4; ++k) {
      std::vector<double> pose = start_;
      for (std::size_t i = 0; i < pose.size(); ++i)
        if (!held[i]) pose[i] += 0.7 * k * std::cos(double(i) + k);
      ConstrainedWorkspace cws(chain, set);
      evaluate(cws, pose);
      for (std::size_t i = 0; i < pose.size(); ++i)
        for (int row = 0; row < set.rows(); ++row) is_touched[i] = is_touched[i] || cws.Jc[std::size_t(row) * pose.size() + i] != 0;
    }
    for (std::size_t i = 0; i < q.size(); ++i)
      if (!held[i] && is_touched[i]) free_.push_back(Eigen::Index(i));
  }

  FollowedPose find() {
    take(start_);
    for (int k = 1; k <= kSeeds && !free_.empty(); ++k) {
      std::vector<double> seed = start_;
      for (std::size_t f = 0; f < free_.size(); ++f) seed[std::size_t(free_[f])] = seed_of(free_[f], spread(k, kBases[f % std::size(kBases)]));
      take(std::move(seed));
    }
    return best_;
  }

 private:
  static constexpr int kBases[] = {2, 3, 5, 7, 11, 13, 17, 19};

  void evaluate(ConstrainedWorkspace& cws, const std::vector<double>& q) { compute_constraints(chain_, ws_, set_, cws, q, at_rest_); }

  const Joint* joint(Eigen::Index i) const { return joints_[std::size_t(i)]; }
  bool turns(Eigen::Index i) const { return joint(i) == nullptr || joint(i)->kind == JointKind::revolute; }

  double seed_of(Eigen::Index i, double share) const {
    const double reach = turns(i) ? std::numbers::pi : kSlide;
    double low = -reach, high = reach;
    if (joint(i) != nullptr && std::isfinite(joint(i)->limit.lower)) low = std::max(low, joint(i)->limit.lower);
    if (joint(i) != nullptr && std::isfinite(joint(i)->limit.upper)) high = std::min(high, joint(i)->limit.upper);
    return low < high ? low + share * (high - low) : joint(i)->limit.lower;
  }

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // Newton's method on the free coordinates; of redundant rows, or where several ways lead there, by least squares.
  FollowedPose settle(std::vector<double> q, Eigen::MatrixXd& J) {
    ConstrainedWorkspace cws(chain_, set_);
    FollowedPose pose{.q = q, .away = HUGE_VAL};
    for (int pass = 0; pass < kPasses; ++pass) {
      evaluate(cws, q);
      double away = 0;
      int row = 0;
      for (int r = 0; r < set_.rows(); ++r)
        if (!(std::abs(cws.phi[std::size_t(r)]) <= away)) away = std::abs(cws.phi[std::size_t(r)]), row = r;
      const Eigen::MatrixXd now = Eigen::Map<const Matrix>(cws.Jc.data(), set_.rows(), Eigen::Index(q.size()))(Eigen::all, free_);
      const bool is_better = away < pose.away;
      if (is_better) {
        pose = {q, away <= kMet, away, row};
        J = now;
      }
      if (!std::isfinite(away) || away == 0 || free_.empty() || (away < kSettled && !is_better)) break;
      Eigen::VectorXd step = now.completeOrthogonalDecomposition().solve(-Eigen::Map<const Eigen::VectorXd>(cws.phi.data(), set_.rows()));
      const double longest = step.cwiseAbs().maxCoeff();
      if (!(longest > 0) || !std::isfinite(longest)) break;
      if (longest > kLongestStep) step *= kLongestStep / longest;
      for (std::size_t f = 0; f < free_.size(); ++f) q[std::size_t(free_[f])] += step[Eigen::Index(f)];
    }
    return pose;
  }

  // Each angle by whole turns to where it is within its limits, else within half a turn; as it is where a constraint counts turns.
  void unwind(FollowedPose& pose) {
    for (const Eigen::Index i : free_) {
      if (!turns(i)) continue;
      double& value = pose.q[std::size_t(i)];
      const double wound = value;
      value = std::remainder(value, kTurn);
      if (const Joint* own = joint(i)) {
        if (value < own->limit.lower && value + kTurn <= own->limit.upper) value += kTurn;
        if (value > own->limit.upper && value - kTurn >= own->limit.lower) value -= kTurn;
      }
      ConstrainedWorkspace cws(chain_, set_);
      evaluate(cws, pose.q);
      if (std::ranges::any_of(cws.phi, [](double phi) { return std::abs(phi) > kSettled; })) value = wound;
    }
  }

  int limits_passed(const std::vector<double>& q) const {
    return int(std::ranges::count_if(free_, [&](Eigen::Index i) {
      return joint(i) != nullptr && (q[std::size_t(i)] < joint(i)->limit.lower || q[std::size_t(i)] > joint(i)->limit.upper);
    }));
  }

  double way_to(const std::vector<double>& q) const {
    double way = 0;
    for (const Eigen::Index i : free_) {
      if (!about_.empty() && std::ranges::count(about_, std::size_t(i)) == 0) continue;
      const double by = q[std::size_t(i)] - start_[std::size_t(i)];
      way = std::max(way, std::abs(turns(i) ? std::remainder(by, kTurn) : by));
    }
    return way;
  }

  void take(std::vector<double> seed) {
    Eigen::MatrixXd J;
    FollowedPose pose = settle(std::move(seed), J);
    if (!pose.is_met) {
      if (!best_.is_met && (best_.q.empty() || pose.away < best_.away)) best_ = std::move(pose);
      return;
    }
    unwind(pose);
    const double det = about_.empty() && J.rows() == J.cols() ? J.determinant() : 0;
    const double least = kSingular * std::pow(std::max(J.size() > 0 ? J.cwiseAbs().maxCoeff() : 0, 1e-300), double(J.rows()));
    const Merit merit{limits_passed(pose.q), det > least ? 1 : 0, way_to(pose.q)};
    const bool is_nearer = std::pair(merit.passed, merit.other_way) != std::pair(merit_.passed, merit_.other_way)
                               ? std::pair(merit.passed, merit.other_way) < std::pair(merit_.passed, merit_.other_way)
                               : merit.way < merit_.way - kSettled;  // rounding does not choose
    if (best_.is_met && !is_nearer) return;
    merit_ = merit;
    best_ = std::move(pose);
  }

  struct Merit {
    int passed = 0, other_way = 0;
    double way = HUGE_VAL;
  };

  const Chain& chain_;
  const ConstraintSet& set_;
  Workspace ws_;
  std::span<const std::size_t> about_;
  std::vector<double> start_, at_rest_;
  std::vector<const Joint*> joints_;  // of each coordinate; null of one that several joints share
  std::vector<Eigen::Index> free_;
  FollowedPose best_;
  Merit merit_;
};

}  // namespace

FollowedPose followed_pose(const Chain& chain, const ConstraintSet& set, ConstVec q, const std::vector<bool>& held, std::span<const std::size_t> about) {
  return Follower(chain, set, q, held, about).find();
}

}  // namespace chainreel
