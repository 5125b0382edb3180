// How far a run's numbers lie from its reference's as plots and tables show them: rates, torques, multipliers and what
// the scene plots, each in shares of the range over which it moves. Places on the page may be right where these are not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/accuracy.hpp"
#include "sim/choice/choice_reference.hpp"
#include "sim/plots.hpp"

namespace chainreel {

// The share of its range by which a curve may be off where points may be by that much: as many hundredths as the
// accuracy has pixels, 0.1 % for 0.1 px (0.3 px of a plot 300 px high); for angles as if the motion's diagonal turned.
double share_of_curves(const Accuracy& accuracy, const MotionSize& size);

class CurveDeviation {
 public:
  // Of the first reference.samples samples; `allowed`: see above. The simulation and the reference must outlive it.
  CurveDeviation(const Simulation& simulation, const ChoiceReference& reference, double allowed);

  struct Worst {
    double share = 0;  // of the curve's range, no larger: the reference's own error is added
    std::string name;  // of the curve: "tau2"; "" where there is none
  };
  // Over the samples and curves that the reference knows well enough. `run` has as many samples.
  Worst largest(const Trajectory& run) const;

  // A clause without end mark: what the reference itself does not know to what is allowed; "" nothing.
  const std::string& remark() const { return remark_; }

 private:
  struct Curve {
    std::string name;
    bool may_jump = false;
    double unit = 1;        // its range, or a tenth of that of all curves of its plot
    std::vector<double> y;  // of the reference
    // By how much the reference may be off, a share of the unit; infinite where that is too much to judge by.
    std::vector<double> own;
  };

  std::vector<PlotCurves> curves_along(const Trajectory& run) const;
  void set_units(std::vector<PlotCurves>& plots);
  double apart(const Curve& curve, double y, int k) const;

  const Simulation& simulation_;
  int samples_;
  std::shared_ptr<const PlotSet> own_, named_;  // null: none
  std::vector<Curve> curves_;
  std::string remark_;
};

}  // namespace chainreel
