// The words below a panel of the ellipse figure: the pose, and Lambda as numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/effective_mass.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// "q = (0\u00B0, 90\u00B0)" in math notation: revolute joints in degrees to a tenth, prismatic ones in m. The
// second form leaves out the middle of long lists.
std::vector<std::string> pose_notations(const Chain& chain, const std::vector<double>& q);
std::vector<std::string> coordinate_notations(const Chain& chain, const std::vector<double>& q);  // its entries

// Three significant digits in math notation; what is below round-off of `largest` is 0.
std::string number_notation(double value, double largest);

// Entries of Lambda, row by row.
std::vector<std::vector<std::string>> matrix_notations(const Eigen::MatrixXd& Lambda);

// How tall a caption with a matrix of `rows` rows is, units of H.
double caption_height(int rows, double text_scale);

// Whether Lambda, or where it is infinite its eigenvalues, can be read where the caption is so wide.
bool matrix_fits(const EffectiveMass& effective, double width, double text_scale, const Theme& theme, const Fonts& fonts);

// Of each axis of the ellipse, nothing where it is infinite.
std::vector<std::optional<double>> masses_of(const EffectiveMass& effective);
// The masses along the axes of the ellipse, which are the eigenvalues of Lambda: "eig \u039B = (2, 1) kg".
// The second form calls them Lambda, the third is the list alone.
std::vector<std::string> eigenvalues_notations(const std::vector<std::optional<double>>& masses);
// "q = (0, 90," and "45, 0)", so many coordinates a line: for poses too long for one.
std::vector<std::string> pose_in_lines(const Chain& chain, const std::vector<double>& q, std::size_t a_line);
// A caption of one line: the pose, behind it in the first form those masses; where that is too long for one panel the others do
// without them, too.
std::vector<std::string> line_notations(const Chain& chain, const std::vector<double>& q,
                                        const std::vector<std::optional<double>>& masses);
double caption_line_height(double text_scale, int lines = 1);
bool line_fits(const std::string& notation, double width, double text_scale, const Theme& theme, const Fonts& fonts);

// One line a panel, all in the same form and of one size: the first of their forms that fits everywhere, no smaller than
// the smallest text.
struct CaptionLines {
  std::vector<std::string> notations;
  double size = 0;   // em, units of H
  bool fit = false;  // where they stand; else even the last form is wider
};
CaptionLines caption_lines(const std::vector<std::vector<std::string>>& forms, double width, double text_scale, const Theme& theme,
                           const Fonts& fonts);
// The size at which what stands below the pose in a caption fits: the numbers of Lambda, or along what it is infinite.
double mass_size(const EffectiveMass& effective, double width, double text_scale, const Theme& theme, const Fonts& fonts);

// The base line of the first line of a caption in `box`.
double caption_base(const Rect& box, double text_scale);
void draw_caption_line(Picture& picture, const std::string& notation, double size, const Rect& box, double text_scale,
                       const Theme& theme, const Fonts& fonts, int line = 0);

// "(a)", "(b)", .. at the left end of the caption in `box`. Returns what is left of it.
Rect draw_letter(Picture& picture, std::size_t panel, double size, const Rect& box, double text_scale, const Theme& theme,
                 const Fonts& fonts);

// How wide it is in its usual size.
double usual_width(const std::string& pose, const EffectiveMass& effective, double text_scale, const Theme& theme, const Fonts& fonts);

// Draws pose and mass centred in `box`, from its top down.
void draw_caption(Picture& picture, const std::string& pose, const EffectiveMass& effective, double size, const Rect& box,
                  double text_scale, const Theme& theme, const Fonts& fonts);

}  // namespace chainreel
