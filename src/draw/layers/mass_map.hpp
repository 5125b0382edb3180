// The mass matrix M(q) as a small live heat map: blue below zero, orange above, one scale over the whole
// clip. Small matrices bear their numbers, larger ones a scale of colours.
#pragma once

#include <string>

#include "dynamics/equation_of_motion.hpp"
#include "model/chain.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

inline constexpr int kMostNumberedRows = 4;

// "kg m^2" where all joints are revolute, "kg" where all are prismatic; with both, what entries may be in.
std::string mass_unit(const Chain& chain);

class MassMap {
 public:
  // `largest`: of all |M_ij| of the clip.
  MassMap(int rows, std::string unit, double largest, const Theme& theme, const Fonts& fonts,
          double text_scale);

  double width() const { return width_; }
  double height() const { return height_; }
  // `corner`: lower left.
  void draw(Picture& picture, const Eigen::MatrixXd& M, Point corner) const;
  // The colour of an entry; M_ij = 0 has the background's.
  Color color_at(double entry) const;
  std::string number(double entry) const;

 private:
  int rows_;
  double largest_;
  const Theme* theme_;
  const Fonts* fonts_;
  double text_size_;
  int decimals_ = 0;
  TextLine title_, lower_, upper_;  // of the scale of colours
  double cell_width_ = 0, cell_height_ = 0, width_ = 0, height_ = 0;
};

}  // namespace chainreel
