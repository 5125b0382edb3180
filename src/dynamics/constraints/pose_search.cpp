#include "dynamics/constraints/pose_search.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kAside[] = {0.01, 0.05, 0.2, 0.5, 1};  // rad or m
constexpr double kNear = 1;                             // a pose no further off is not looked for any longer
constexpr std::size_t kMostFreedoms = 24;               // that are moved by themselves

using Directions = std::vector<std::vector<double>>;

// Ways aside, each also backwards: of every freedom, of neighbours against each other, of all together and to and fro.
Directions ways_aside(std::size_t nv) {
  Directions ways;
  std::vector<double> all(nv, 1), zigzag(nv);
  for (std::size_t i = 0; i < nv; ++i) zigzag[i] = i % 2 == 0 ? 1 : -1;
  for (std::size_t i = 0; i < std::min(nv, kMostFreedoms); ++i) {
    std::vector<double> one(nv);
    one[i] = 1;
    ways.push_back(one);
    if (i + 1 == nv) break;
    one[i + 1] = -1;
    ways.push_back(one);
  }
  ways.push_back(std::move(all));
  ways.push_back(std::move(zigzag));
  const std::size_t count = ways.size();
  for (std::size_t k = 0; k < count; ++k) {
    ways.push_back(ways[k]);
    for (double& x : ways.back()) x = -x;
  }
  return ways;
}

class Search {
 public:
  Search(const Chain& chain, const ConstraintSet& set, ConstVec q)
      : chain_(chain), set_(set), ws_(chain), start_(q.begin(), q.end()) {
    best_ = arrive_from(start_);
    before_ = best_.way.before;
  }

  FoundPose find() {
    if (best_.way.reached) return std::move(best_);
    const Directions ways = ways_aside(std::size_t(chain_.nv));
    const std::vector<double> first_end = best_.q;
    for (const double aside : kAside) {
      if (best_.way.reached && moved(best_) <= kNear) break;
      for (const std::vector<double>& way : ways)
        for (const bool from_end : {false, true}) {
          std::vector<double> q = from_end ? first_end : start_;
          advance(chain_, q, way, aside);
          take(arrive_from(std::move(q)));
        }
    }
    best_.way.before = before_;
    return std::move(best_);
  }

 private:
  // With a memory of its own: where curves were met on the way to another pose does not matter.
  FoundPose arrive_from(std::vector<double> q) {
    ConstrainedWorkspace cws(chain_, set_);
    FoundPose pose;
    pose.way = project_positions(chain_, ws_, set_, cws, q);
    pose.q = std::move(q);
    return pose;
  }

  double moved(const FoundPose& pose) const {
    double largest = 0;
    for (std::size_t i = 0; i < start_.size(); ++i) largest = std::max(largest, std::fabs(pose.q[i] - start_[i]));
    return largest;
  }

  void take(FoundPose pose) {
    const bool arrives = pose.way.reached, arrived = best_.way.reached;
    const bool is_better = arrives != arrived ? arrives : arrives ? moved(pose) < moved(best_) : pose.way.after < best_.way.after;
    if (is_better) best_ = std::move(pose);
  }

  const Chain& chain_;
  const ConstraintSet& set_;
  Workspace ws_;
  std::vector<double> start_;
  FoundPose best_;
  double before_ = 0;
};

}  // namespace

FoundPose find_pose(const Chain& chain, const ConstraintSet& set, ConstVec q) {
  return Search(chain, set, q).find();
}

}  // namespace chainreel
