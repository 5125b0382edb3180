// Cubic spline through samples, second derivative continuous, not-a-knot ends (C. de Boor, A Practical Guide
// to Splines, ch. IV): exact for cubics. Two samples give a line, three a parabola, one a constant. Outside
// the samples the motion stands still at the end's value.
#pragma once

#include <vector>

namespace chainreel {

class Spline {
 public:
  Spline() = default;
  Spline(std::vector<double> t, std::vector<double> y);  // t rising, same length

  struct Value {
    double y = 0, yd = 0, ydd = 0;
  };
  Value at(double t) const;

 private:
  std::vector<double> t_, y_, curvature_;  // second derivatives at the samples
};

}  // namespace chainreel
