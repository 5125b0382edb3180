// The words below a panel of the ellipse figure: the pose, and Lambda as numbers.
#pragma once

#include <string>
#include <vector>

#include "dynamics/effective_mass.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// "q = (0\u00B0, 90\u00B0)" in math notation: revolute joints in degrees to a tenth, prismatic ones in m. The
// second form leaves out the middle of long lists.
std::vector<std::string> pose_notations(const Chain& chain, const std::vector<double>& q);

// Three significant digits in math notation; what is below round-off of `largest` is 0.
std::string number_notation(double value, double largest);

// Entries of Lambda, row by row.
std::vector<std::vector<std::string>> matrix_notations(const Eigen::MatrixXd& Lambda);

// "\u039B: infinite along (1, 0)", further directions behind it.
std::string singular_text(const EffectiveMass& effective);

// How tall a caption with a matrix of `rows` rows is, units of H.
double caption_height(int rows, double text_scale);

// Draws both lines centred in `box`, from its top down, smaller where its width asks for it.
void draw_caption(Picture& picture, const Chain& chain, const std::vector<double>& q,
                  const EffectiveMass& effective, const Rect& box, double text_scale, const Theme& theme,
                  const Fonts& fonts);

}  // namespace chainreel
