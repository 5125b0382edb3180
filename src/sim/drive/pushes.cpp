#include "sim/drive/pushes.hpp"

#include <algorithm>
#include <utility>

#include "dynamics/kinematics.hpp"
#include "sim/drive/prices.hpp"
#include "sim/drive/state_corners.hpp"

namespace chainreel {
namespace {

// What it evaluates is the law's; what it pushes with is not.
class PushedLaw final : public TorqueLaw {
 public:
  PushedLaw(std::unique_ptr<TorqueLaw> law, std::vector<ActingPush> list) : law_(std::move(law)), pushes_(std::move(list)) {}

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    law_->evaluate(chain, ws, t, q, qd, tau);
  }
  double price(const Chain& chain) const override { return kPriceOfLaw + law_->price(chain) + price_of_kinematics(chain); }
  const Pushes* pushes() const override { return &pushes_; }
  bool drives_are_constant() const override { return law_->drives_are_constant(); }
  bool depends_on_velocity() const override { return law_->depends_on_velocity(); }
  std::vector<double> breaks(double end) const override {
    std::vector<double> all = law_->breaks(end);
    const std::vector<double> own = pushes_.breaks(end);
    all.insert(all.end(), own.begin(), own.end());
    return all;
  }
  void enter_piece(double t) override {
    law_->enter_piece(t);
    pushes_.enter_piece(t);
  }
  void leave_pieces() override {
    law_->leave_pieces();
    pushes_.leave_pieces();
  }
  StateCorners* corners() override { return law_->corners(); }
  std::vector<LinearDrive> linear_drives(const Chain& chain) const override { return law_->linear_drives(chain); }
  bool reference_at(double t, Vec q) override { return law_->reference_at(t, q); }
  bool follows(std::size_t freedom) const override { return law_->follows(freedom); }
  std::optional<TaskTarget> task_at(double t) override { return law_->task_at(t); }

 private:
  std::unique_ptr<TorqueLaw> law_;
  Pushes pushes_;
};

}  // namespace

// What the force does along each joint that carries the frame.
void add_force(const Chain& chain, const Workspace& ws, int frame, const Eigen::Vector3d& force, Vec tau) {
  const Eigen::Vector3d p = frame_position(chain, ws, frame);
  for (int body = chain.frames[std::size_t(frame)].body; body > 0; body = chain.bodies[std::size_t(body)].parent) {
    const Joint& joint = chain.bodies[std::size_t(body)].joint;
    const Eigen::Isometry3d& X_WB = ws.X_WB[std::size_t(body)];
    const Eigen::Vector3d moment = (p - X_WB.translation()).cross(force);
    const auto at = [&](int i) -> double& { return tau[std::size_t(joint.v_index + i)]; };
    switch (joint.kind) {
      case JointKind::revolute:
        at(0) += joint.ratio * (X_WB.linear() * joint.axis).dot(moment);
        break;
      case JointKind::prismatic:
        at(0) += joint.ratio * (X_WB.linear() * joint.axis).dot(force);
        break;
      case JointKind::floating: {  // the base's own axes: force, then moment
        const Eigen::Vector3d f = X_WB.linear().transpose() * force, m = X_WB.linear().transpose() * moment;
        for (int i = 0; i < 3; ++i) at(i) += f[i], at(3 + i) += m[i];
        break;
      }
    }
  }
}

Pushes::Pushes(std::vector<ActingPush> list) : list_(std::move(list)), acts_in_piece_(list_.size()) {}

bool Pushes::acts(std::size_t i, double t) const {
  return in_piece_ ? acts_in_piece_[i] : list_[i].acts_at(t);
}

void Pushes::add_to(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) const {
  bool is_placed = false;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (!acts(i, t)) continue;
    if (!is_placed) compute_kinematics(chain, ws, q, qd);
    is_placed = true;
    add_force(chain, ws, list_[i].frame, list_[i].force, tau);
  }
}

Wrench Pushes::wrench(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd) const {
  Wrench sum;
  compute_kinematics(chain, ws, q, qd);
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (!acts(i, t)) continue;
    sum.force += list_[i].force;
    sum.moment += frame_position(chain, ws, list_[i].frame).cross(list_[i].force);
  }
  return sum;
}

std::vector<double> Pushes::breaks(double end) const {
  std::vector<double> instants;
  for (const ActingPush& push : list_)
    for (const double t : {push.from, push.until})
      if (t > 0 && t < end) instants.push_back(t);
  return instants;
}

void Pushes::enter_piece(double t) {
  in_piece_ = false;
  for (std::size_t i = 0; i < list_.size(); ++i) acts_in_piece_[i] = acts(i, t);
  in_piece_ = true;
}

std::unique_ptr<TorqueLaw> make_pushed_law(std::unique_ptr<TorqueLaw> law, std::vector<ActingPush> pushes) {
  if (pushes.empty()) return law;
  return std::make_unique<PushedLaw>(std::move(law), std::move(pushes));
}

}  // namespace chainreel
