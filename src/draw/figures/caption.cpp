#include "draw/figures/caption.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {
namespace {

constexpr double kMatrixRow = 1.30;  // of the em, between rows of the matrix
constexpr double kToMatrix = 1.75;   // of the em, between pose and matrix
constexpr double kFirstLine = 1.2,
                 kLineRow = 1.6;        // of the em: base line below a panel, and a caption of one line
constexpr double kNextLine = 1.35;      // of the em: each further line
constexpr double kBelowLines = 0.35;    // of the em, below several
constexpr double kLetterGap = 0.5;      // of the em
constexpr double kColumnGap = 0.9;      // of the em
constexpr double kBracketGap = 0.38;    // of the em, between bracket and numbers
constexpr double kBracketSerif = 0.16;  // of the em
constexpr double kBracketLine = 0.0022;
constexpr double kMathAxis = 0.25;  // of the em above the base line: where a matrix is centred
// Lambda is the inverse of Lambda_inv: entries this far below its largest are what round-off left of a zero.
constexpr double kSameWidth = 1e-9;

std::string list_of(const std::vector<std::string>& entries) {
  return "(" + joined(entries) + ")";
}

std::string degrees_notation(double angle) {
  const double tenths = std::round(angle * 1800 / std::numbers::pi);
  return format_shortest(tenths == 0 ? 0.0 : tenths / 10) + "\u00B0";
}

// A matrix in brackets with its name before and its unit behind it, laid out at one size.
struct MatrixLine {
  TextLine name, unit;
  std::vector<std::vector<TextLine>> entries;
  std::vector<double> column_width;
  double em = 0, bracket_width = 0, width = 0;
};

MatrixLine lay_out_matrix(const Fonts& fonts, const std::vector<std::vector<std::string>>& notations,
                          const TextStyle& style) {
  MatrixLine matrix;
  matrix.em = style.size;
  matrix.name = lay_out_math(fonts, "Lambda =", style);
  matrix.unit = lay_out_math(fonts, "\u2009kg", style);
  matrix.column_width.assign(notations.empty() ? 0 : notations[0].size(), 0);
  TextStyle centered = style;
  centered.align = Align::center;
  for (const std::vector<std::string>& row : notations) {
    matrix.entries.emplace_back();
    for (std::size_t j = 0; j < row.size(); ++j) {
      matrix.entries.back().push_back(lay_out_math(fonts, row[j], centered));
      matrix.column_width[j] = std::max(matrix.column_width[j], matrix.entries.back().back().advance);
    }
  }
  matrix.bracket_width =
      2 * kBracketGap * matrix.em + kColumnGap * matrix.em * double(matrix.column_width.size() - 1);
  for (const double width : matrix.column_width) matrix.bracket_width += width;
  matrix.width =
      matrix.name.advance + 0.4 * matrix.em + matrix.bracket_width + 0.25 * matrix.em + matrix.unit.advance;
  return matrix;
}

void draw_bracket(Picture& picture, double x, double y0, double y1, double serif, Color color) {
  const Paint paint{color, {}, 0};
  picture.add(Capsule{{x, y0}, {x, y1}, kBracketLine / 2, paint});
  picture.add(Capsule{{x, y0}, {x + serif, y0}, kBracketLine / 2, paint});
  picture.add(Capsule{{x, y1}, {x + serif, y1}, kBracketLine / 2, paint});
}

// Centred about `middle`.
void draw_matrix(Picture& picture, const MatrixLine& matrix, Point middle, Color color) {
  const double em = matrix.em, rows = double(matrix.entries.size());
  double x = middle.x - matrix.width / 2;
  const double base = middle.y - kMathAxis * em;
  draw_text(picture, matrix.name, {x, base});
  x += matrix.name.advance + 0.4 * em;
  const double half_height = rows * kMatrixRow * em / 2, serif = kBracketSerif * em;
  draw_bracket(picture, x, middle.y - half_height, middle.y + half_height, serif, color);
  draw_bracket(picture, x + matrix.bracket_width, middle.y - half_height, middle.y + half_height, -serif,
               color);
  for (std::size_t i = 0; i < matrix.entries.size(); ++i) {
    const double row = base + ((rows - 1) / 2 - double(i)) * kMatrixRow * em;
    double left = x + kBracketGap * em;
    for (std::size_t j = 0; j < matrix.entries[i].size(); ++j) {
      draw_text(picture, matrix.entries[i][j], {left + matrix.column_width[j] / 2, row});
      left += matrix.column_width[j] + kColumnGap * em;
    }
  }
  draw_text(picture, matrix.unit, {x + matrix.bracket_width + 0.25 * em, base});
}

}  // namespace

std::vector<std::string> coordinate_notations(const Chain& chain, const std::vector<double>& q) {
  std::vector<std::string> entries;
  for (const double value : q) entries.push_back(number_notation(value, std::abs(value)));
  for (const Body& body : chain.bodies) {
    if (&body == &chain.bodies[0] || body.joint.kind == JointKind::floating) continue;
    std::string& entry = entries[std::size_t(body.joint.q_index)];
    const double value = q[std::size_t(body.joint.q_index)];
    entry = body.joint.kind == JointKind::revolute ? degrees_notation(value)
                                                   : number_notation(value, std::abs(value)) + " m";
  }
  return entries;
}

std::vector<std::string> pose_notations(const Chain& chain, const std::vector<double>& q) {
  const std::vector<std::string> entries = coordinate_notations(chain, q);
  const std::vector<std::string> ends{entries.empty() ? "" : entries.front(), "\u2026",
                                      entries.empty() ? "" : entries.back()};
  return {"q = " + list_of(entries), list_of(entries), "q = " + list_of(ends)};
}

std::string number_notation(double value, double largest) {
  if (std::abs(value) <= kSameWidth * largest) return "0";
  // Without an exponent as long as that is short.
  const double size = std::abs(value);
  if (size >= 1e-3 && size < 1e3) return format_significant(value, 3);
  if (size >= 1e3 && size < 1e4) return format_fixed(value, 0);
  const double exponent = std::floor(std::log10(size));
  const std::string mantissa = format_significant(value / std::pow(10, exponent), 3);
  return mantissa + "e" + format_fixed(exponent, 0);
}

namespace {

// Three digits also where the last ones are zeros, as numbers of one table have them.
std::string entry_notation(double value, double largest) {
  const double size = std::abs(value);
  if (size <= kSameWidth * largest || !(size >= 1e-3 && size < 999.5)) return number_notation(value, largest);
  return format_digits(value, 3);
}

}  // namespace

std::vector<std::vector<std::string>> matrix_notations(const Eigen::MatrixXd& Lambda) {
  const double largest = Lambda.size() > 0 ? Lambda.cwiseAbs().maxCoeff() : 0;
  const auto written = [&](std::string (*notation)(double value, double largest)) {
    std::vector<std::vector<std::string>> rows(std::size_t(Lambda.rows()));
    for (Eigen::Index i = 0; i < Lambda.rows(); ++i)
      for (Eigen::Index j = 0; j < Lambda.cols(); ++j) rows[std::size_t(i)].push_back(notation(Lambda(i, j), largest));
    return rows;
  };
  // Whole numbers among themselves have no need of zeros.
  const std::vector<std::vector<std::string>> plain = written(&number_notation);
  const bool are_whole = std::ranges::all_of(plain, [](const auto& row) {
    return std::ranges::none_of(row, [](const std::string& entry) { return entry.find('.') != std::string::npos; });
  });
  return are_whole ? plain : written(&entry_notation);
}

double caption_height(int rows, double text_scale) {
  return scaled(size::kAxis, text_scale) * (kToMatrix + std::max(rows, 1) * kMatrixRow + 0.5);
}

bool matrix_fits(const EffectiveMass& effective, double width, double text_scale, const Theme& theme,
                 const Fonts& fonts) {
  if (!effective.Lambda) return line_fits(eigenvalues_notations(masses_of(effective)).front(), width, text_scale, theme, fonts);
  const TextStyle smallest{Face::math, scaled(kSmallestText, text_scale), theme.ink, Align::left};
  return lay_out_matrix(fonts, matrix_notations(*effective.Lambda), smallest).width <= width;
}

std::vector<std::optional<double>> masses_of(const EffectiveMass& effective) {
  std::vector<std::optional<double>> masses;
  for (const MassAxis& axis : mass_axes(effective)) masses.push_back(axis.mass);
  return masses;
}

std::vector<std::string> eigenvalues_notations(const std::vector<std::optional<double>>& masses) {
  std::vector<std::string> entries;
  for (const std::optional<double>& mass : masses)
    entries.push_back(mass ? number_notation(*mass, *mass) : std::string("\u221E"));
  const std::string list = list_of(entries) + "\u2009kg";
  return {"\"eig\" Lambda = " + list, "Lambda: " + list, list};
}

std::vector<std::string> pose_in_lines(const Chain& chain, const std::vector<double>& q, std::size_t a_line) {
  const std::vector<std::string> entries = coordinate_notations(chain, q);
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < entries.size(); from += a_line) {
    const std::size_t to = std::min(from + a_line, entries.size());
    lines.push_back((from == 0 ? "q = (" : "") + joined(std::vector<std::string>(entries.begin() + std::ptrdiff_t(from), entries.begin() + std::ptrdiff_t(to))) +
                    (to < entries.size() ? "," : ")"));
  }
  return lines;
}

std::vector<std::string> line_notations(const Chain& chain, const std::vector<double>& q,
                                        const std::vector<std::optional<double>>& masses) {
  std::vector<std::string> forms = pose_notations(chain, q);
  forms.insert(forms.begin(), forms.front() + ", " + eigenvalues_notations(masses).front());
  return forms;
}

double caption_line_height(double text_scale, int lines) {
  return (kLineRow + (lines > 1 ? kBelowLines : 0) + (lines - 1) * kNextLine) * scaled(size::kAxis, text_scale);
}

bool line_fits(const std::string& notation, double width, double text_scale, const Theme& theme,
               const Fonts& fonts) {
  const TextStyle style{Face::math, scaled(kSmallestText, text_scale), theme.ink, Align::center};
  return lay_out_math(fonts, notation, style).advance <= width;
}

CaptionLines caption_lines(const std::vector<std::vector<std::string>>& forms, double width, double text_scale, const Theme& theme,
                           const Fonts& fonts) {
  const TextStyle style{Face::math, scaled(size::kAxis, text_scale), theme.ink, Align::center};
  CaptionLines lines;
  std::size_t most = forms.empty() ? 0 : forms[0].size();
  for (const std::vector<std::string>& panel : forms) most = std::min(most, panel.size());
  for (std::size_t form = 0; form < most; ++form) {
    lines = {{}, style.size, true};
    double widest = 0;
    for (const std::vector<std::string>& panel : forms) {
      lines.notations.push_back(panel[form]);
      widest = std::max(widest, lay_out_math(fonts, panel[form], style).advance);
    }
    if (widest <= width) return lines;
    lines.size = std::max(style.size * width / widest, std::min(style.size, scaled(kSmallestText, text_scale)));
    lines.fit = lines.size * widest <= (1 + kRoundOff) * style.size * width;
    if (lines.fit) return lines;
  }
  return lines;
}

namespace {

double mass_width(const EffectiveMass& effective, const TextStyle& style, const Fonts& fonts) {
  if (effective.Lambda) return lay_out_matrix(fonts, matrix_notations(*effective.Lambda), style).width;
  return lay_out_math(fonts, eigenvalues_notations(masses_of(effective)).front(), style).advance;
}

}  // namespace

double mass_size(const EffectiveMass& effective, double width, double text_scale, const Theme& theme, const Fonts& fonts) {
  const TextStyle style{Face::math, scaled(size::kAxis, text_scale), theme.ink, Align::left};
  const double usual = mass_width(effective, style, fonts);
  return usual <= width ? style.size : std::max(std::min(style.size, scaled(kSmallestText, text_scale)), style.size * width / usual);
}

double usual_width(const std::string& pose, const EffectiveMass& effective, double text_scale, const Theme& theme, const Fonts& fonts) {
  const TextStyle style{Face::math, scaled(size::kAxis, text_scale), theme.ink, Align::left};
  return std::max(lay_out_math(fonts, pose, style).advance, mass_width(effective, style, fonts));
}

double caption_base(const Rect& box, double text_scale) {
  return box.y1 - kFirstLine * scaled(size::kAxis, text_scale);
}

void draw_caption_line(Picture& picture, const std::string& notation, double size, const Rect& box, double text_scale,
                       const Theme& theme, const Fonts& fonts, int line) {
  draw_text(picture, lay_out_math(fonts, notation, {Face::math, size, theme.ink, Align::center}),
            {(box.x0 + box.x1) / 2, caption_base(box, text_scale) - line * kNextLine * scaled(size::kAxis, text_scale)});
}

Rect draw_letter(Picture& picture, std::size_t panel, double size, const Rect& box, double text_scale, const Theme& theme,
                 const Fonts& fonts) {
  std::string name;
  for (std::size_t left = panel + 1; left > 0; left = (left - 1) / 26)
    name.insert(name.begin(), char('a' + (left - 1) % 26));
  const TextStyle style{Face::label_bold, size, theme.ink, Align::left};
  const TextLine letter = lay_out_text(fonts, "(" + name + ")", style);
  draw_text(picture, letter, {box.x0, caption_base(box, text_scale)});
  return {box.x0 + letter.advance + kLetterGap * style.size, box.y0, box.x1, box.y1};
}

void draw_caption(Picture& picture, const std::string& pose, const EffectiveMass& effective, double size, const Rect& box,
                  double text_scale, const Theme& theme, const Fonts& fonts) {
  TextStyle style{Face::math, size, theme.ink, Align::center};
  const double em = scaled(size::kAxis, text_scale), middle = (box.x0 + box.x1) / 2;
  draw_caption_line(picture, pose, size, box, text_scale, theme, fonts);
  const double rest = box.y1 - kToMatrix * em;
  if (!effective.Lambda) {
    draw_text(picture, lay_out_math(fonts, eigenvalues_notations(masses_of(effective)).front(), style), {middle, rest - 0.9 * em});
    return;
  }
  style.align = Align::left;
  const std::vector<std::vector<std::string>> notations = matrix_notations(*effective.Lambda);
  draw_matrix(picture, lay_out_matrix(fonts, notations, style),
              {middle, rest - double(notations.size()) * kMatrixRow * em / 2 - 0.15 * em}, theme.ink);
}

}  // namespace chainreel
