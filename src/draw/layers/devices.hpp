// Torques that are linear, drawn as what they are: which ones of a run, and where.
#pragma once

#include <vector>

#include "draw/page/panel.hpp"
#include "draw/page/stage.hpp"
#include "sim/drive/linear_drive.hpp"

namespace chainreel {

// A spring, a damper or both at one joint.
struct Device {
  LinearDrive drive;
  int body = 0;            // that the joint moves
  bool from_upper = false;  // of a slider's: it hangs on the end of the rail where the joint's value is largest

  // It stands for the whole torque: what is seen of it says how large that is.
  bool is_all_of_it() const { return drive.whole && drive.is_spring(); }
};

// Whether what drives a run is drawn as springs and targets: on bars, and on bodies that are seen obliquely, whose joints
// have axes that are seen. Bodies seen flat from the front hide what is at their joints.
bool shows_drives(const Stage& stage, const StagedRun& motion);

// Those that the stage shows of such a run, with its layer `springs`; of sliders where their rails are drawn. Feedback to a reference is
// none of them: the layer `target` shows it.
std::vector<Device> devices_of(const Stage& stage, const StagedRun& motion);

// In what colour lines lie below a coil that is drawn over bodies, to set it off from them; none over bars.
Color casing_over(const Panel& panel);

// Two directions across a revolute joint's axis, in W: that in which its link goes where the joint's value is zero, as its
// parent stands, and a quarter turn on in its positive sense.
struct JointZero {
  Eigen::Vector3d along, quarter;
};
JointZero joint_zero(const Chain& chain, const Skeleton& skeleton, const Workspace& ws, int body);

}  // namespace chainreel
