#include "sim/drive/task_torque.hpp"

#include <algorithm>

#include "core/format.hpp"
#include "dynamics/kinematics.hpp"
#include "sim/drive/control.hpp"
#include "sim/drive/prices.hpp"
#include "sim/drive/pushes.hpp"
#include "sim/drive/torque.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

class TaskTorque final : public TorqueLaw {
 public:
  TaskTorque(int frame, std::vector<Vector3d> axes, std::unique_ptr<Reference> reference, std::vector<double> kp, std::vector<double> kd)
      : frame_(frame), axes_(std::move(axes)), reference_(std::move(reference)), kp_(std::move(kp)), kd_(std::move(kd)),
        x_(axes_.size()), xd_(axes_.size()) {}

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    reference_->evaluate(t, x_, xd_, {});
    compute_kinematics(chain, ws, q, qd);
    const Vector3d p = frame_position(chain, ws, frame_), v = frame_velocity(chain, ws, frame_);
    Vector3d force = Vector3d::Zero();
    for (std::size_t i = 0; i < axes_.size(); ++i)
      force += (kp_[i] * (x_[i] - axes_[i].dot(p)) + kd_[i] * (xd_[i] - axes_[i].dot(v))) * axes_[i];
    std::fill(tau.begin(), tau.end(), 0.0);
    add_force(chain, ws, frame_, force, tau);
  }
  double price(const Chain& chain) const override { return kPriceOfLaw + reference_->price(false) + price_of_kinematics(chain); }
  std::vector<double> breaks(double end) const override { return reference_->breaks(end); }
  void enter_piece(double t) override { reference_->enter_piece(t); }
  void leave_pieces() override { reference_->leave_pieces(); }
  std::optional<TaskTarget> task_at(double t) override {
    reference_->evaluate(t, x_, xd_, {});
    TaskTarget target{frame_, Vector3d::Zero(), {}};
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      target.place += x_[i] * axes_[i];
      target.pulls.push_back({axes_[i], kp_[i]});
    }
    return target;
  }

 private:
  int frame_;
  std::vector<Vector3d> axes_;  // unit, in W
  std::unique_ptr<Reference> reference_;
  std::vector<double> kp_, kd_;  // an axis each
  std::vector<double> x_, xd_;   // the reference's
};

}  // namespace

Vector3d TaskTarget::wished(const Vector3d& p) const {
  Vector3d wished = p;
  for (const Pull& pull : pulls)
    if (pull.kp != 0) wished += pull.axis.dot(place - p) * pull.axis;
  return wished;
}

bool TaskTarget::is_one_spring() const {
  return std::all_of(pulls.begin(), pulls.end(), [&](const Pull& pull) { return pull.kp == pulls.front().kp; });
}

std::unique_ptr<TorqueLaw> make_task_torque(const Chain& chain, const TaskFeedback& task, const Parameters& parameters, const NamedFrames& frames) {
  const auto refuse = [&](const std::string& message) { throw Error(ExitCode::bad_input, message, task.place); };
  const auto named = std::find_if(frames.begin(), frames.end(), [&](const NamedFrame& one) { return one.name == task.frame; });
  const int frame = task.frame.empty() ? require_end_effector(chain) : named != frames.end() ? named->frame : find_frame(chain, task.frame);
  if (frame < 0) {
    std::vector<std::string> names;
    for (const Frame& one : chain.frames) names.push_back(one.name);
    refuse("'task.frame' names no link and none of `frames`: '" + task.frame + "';" + did_you_mean(task.frame, names) + " They are " + shortened(joined(names), 300));
  }
  const std::size_t count = task.x.size();
  if (count != 3 && !(count == 2 && chain.planar))
    refuse("'task.x' must be the place to go to, " + std::string(chain.planar ? "two or three expressions in t" : "three expressions in t, since the chain moves in space") +
           ": task: {kp: 100, kd: 20, x: [" + (chain.planar ? "\"0.5*cos(t)\", 0.5]}" : "0.5, 0, \"0.4 + 0.1*sin(t)\"]}"));
  if (!task.xd.empty() && task.xd.size() != count) refuse("'task.xd' has " + std::to_string(task.xd.size()) + " entries and 'task.x' " + std::to_string(count));
  std::vector<Vector3d> axes{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  if (count == 2) axes = {chain.planar->plane.ex, chain.planar->plane.ey};
  const auto spread = [&](const std::vector<double>& gains, const std::string& key) {
    if (std::find(task.lists_of_one.begin(), task.lists_of_one.end(), key) != task.lists_of_one.end() || (gains.size() != 1 && gains.size() != count))
      refuse("'task." + key + "' has " + std::to_string(gains.size()) + " entries: give one without brackets for all axes, or one for each of the " + std::to_string(count));
    return gains.size() == 1 ? std::vector<double>(count, gains.front()) : gains;
  };
  std::vector<double> kp = spread(task.kp, "kp"), kd = spread(task.kd, "kd");
  return std::make_unique<TaskTorque>(frame, std::move(axes), make_expression_reference(task.x, task.xd, {}, parameters), std::move(kp), std::move(kd));
}

}  // namespace chainreel
