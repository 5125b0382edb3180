#include "draw/layers/mass_map.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/format.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {
namespace {

// The two ends of the map: far from each other in all vision types, and light or dark enough for numbers in
// ink.
constexpr Color kBelow = color_of(0x0072B2), kAbove = color_of(0xD55E00);
constexpr double kStrongest = 0.55;   // of these colours at the largest entry: numbers in ink stay legible
constexpr double kCellPad = 0.5;      // of the em, on both sides of the widest number
constexpr double kCellHeight = 1.7;   // of the em
constexpr double kMapTitlePitch = 1.5;   // of the em
constexpr double kPlainSide = 0.26;   // of a map without numbers, units of H
constexpr double kScaleHeight = 0.6;  // of the em: the scale of colours below it
constexpr int kScaleCells = 41;
constexpr int kSignificant = 3;

Color between(Color from, Color to, double way) {
  const auto mix = [&](std::uint8_t a, std::uint8_t b) {
    return std::uint8_t(std::lround(a + way * (double(b) - a)));
  };
  return {mix(from.r, to.r), mix(from.g, to.g), mix(from.b, to.b), 1};
}

void draw_frame(Picture& picture, const Rect& r, Color color) {
  picture.add(
      Polygon{{Point{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, 4, {{}, color, size::kFrameLine}});
}

}  // namespace

std::string mass_unit(const Chain& chain) {
  bool turns = false, slides = false;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    turns |= chain.bodies[b].joint.kind != JointKind::prismatic;
    slides |= chain.bodies[b].joint.kind != JointKind::revolute;
  }
  return turns && slides ? "kg, kg m, kg m^2" : slides ? "kg" : "kg m^2";
}

MassMap::MassMap(int rows, std::string unit, double largest, const Theme& theme, const Fonts& fonts,
                 double text_scale)
    : rows_(rows),
      largest_(largest),
      theme_(&theme),
      fonts_(&fonts),
      text_size_(scaled(size::kTick, text_scale)) {
  const TextStyle title{Face::math, scaled(size::kAxis, text_scale), theme.ink, Align::left};
  title_ = lay_out_math(fonts, "M(q)\u2009[" + unit + "]", title);
  const TextStyle plain{Face::label, text_size_, theme.ink, Align::left};
  const double title_height = kMapTitlePitch * title.size;
  if (rows_ <= kMostNumberedRows) {
    if (largest > 0) decimals_ = std::clamp(kSignificant - 1 - int(std::floor(std::log10(largest))), 0, 9);
    // A minus sign takes its room from the start, so that nothing moves when one appears.
    const double widest = lay_out_text(fonts, number(-largest), plain).advance;
    cell_width_ = std::max(widest + 2 * kCellPad * text_size_, kCellHeight * text_size_);
    cell_height_ = kCellHeight * text_size_;
    width_ = std::max(title_.advance, rows_ * cell_width_);
    height_ = title_height + rows_ * cell_height_;
    return;
  }
  cell_width_ = cell_height_ = kPlainSide / rows_;
  lower_ = lay_out_text(fonts, "\u2212" + format_significant(largest, 2), plain);
  upper_ = lay_out_text(fonts, format_significant(largest, 2), plain);
  width_ = std::max(title_.advance, kPlainSide);
  height_ = title_height + kPlainSide + (0.6 + kScaleHeight + 1.3) * text_size_;
}

Color MassMap::color_at(double entry) const {
  const double part = largest_ > 0 ? std::clamp(entry / largest_, -1.0, 1.0) : 0;
  return between(theme_->background, part < 0 ? kBelow : kAbove, kStrongest * std::abs(part));
}

std::string MassMap::number(double entry) const {
  std::string text = format_fixed(std::abs(entry), decimals_);
  const bool is_zero = text.find_first_not_of("0.") == text.npos;
  return (entry < 0 && !is_zero ? "\u2212" : "") + text;
}

void MassMap::draw(Picture& picture, const Eigen::MatrixXd& M, Point corner) const {
  const Rect map{corner.x,
                 corner.y + (rows_ > kMostNumberedRows ? (0.6 + kScaleHeight + 1.3) * text_size_ : 0),
                 corner.x + rows_ * cell_width_, 0};
  const double top = map.y0 + rows_ * cell_height_;
  draw_text(picture, title_, {corner.x, top + 0.35 * text_size_ - std::min(title_.box.y0, 0.0)});
  Cells cells{{map.x0, map.y0, map.x1, top}, rows_, rows_, {}};
  for (int i = rows_ - 1; i >= 0; --i)
    for (int j = 0; j < rows_; ++j) cells.colors.push_back(color_at(M(i, j)));
  picture.add(cells);
  draw_frame(picture, cells.rect, theme_->rule);
  const TextStyle right{Face::label, text_size_, theme_->ink, Align::right};
  if (rows_ <= kMostNumberedRows) {
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < rows_; ++j)
        draw_text(picture, lay_out_text(*fonts_, number(M(i, j)), right),
                  {map.x0 + (j + 1) * cell_width_ - kCellPad * text_size_,
                   top - (i + 0.5) * cell_height_ - 0.36 * text_size_});
    return;
  }
  const double scale_top = map.y0 - 0.6 * text_size_, scale_bottom = scale_top - kScaleHeight * text_size_;
  Cells scale{{map.x0, scale_bottom, map.x1, scale_top}, kScaleCells, 1, {}};
  for (int i = 0; i < kScaleCells; ++i)
    scale.colors.push_back(color_at(largest_ * (2.0 * i / (kScaleCells - 1) - 1)));
  picture.add(scale);
  draw_frame(picture, scale.rect, theme_->rule);
  const double base = scale_bottom - 1.0 * text_size_;
  draw_text(picture, lower_, {map.x0, base});
  const TextStyle middle{Face::label, text_size_, theme_->ink, Align::center};
  draw_text(picture, lay_out_text(*fonts_, "0", middle), {(map.x0 + map.x1) / 2, base});
  draw_text(picture, upper_, {map.x1 - upper_.advance, base});
}

namespace {

class MassMatrixLayer : public Layer {
 public:
  explicit MassMatrixLayer(const Stage& stage) {
    double largest = 0;
    for (const StagedRun& motion : stage.motions) largest = std::max(largest, largest_entry(motion));
    for (const StagedRun& motion : stage.motions)
      maps_.try_emplace(&motion, motion.chain().nv, mass_unit(motion.chain()), largest, stage.theme, stage.fonts,
                        stage.page.text_scale);
  }

  std::optional<Point> room_beside(const StagedRun& motion) const override {
    const MassMap& map = maps_.at(&motion);
    return Point{map.width(), map.height()};
  }

  std::string no_room() const override { return "M(q) leaves no room for the chain: draw without mass_matrix"; }

  void draw(Picture& picture, const Shot& shot) const override {
    const StagedRun& motion = shot.panel.motion();
    Workspace ws(motion.chain());
    compute_mass_matrix(motion.chain(), ws, motion.trajectory().q_at(shot.k));
    maps_.at(&motion).draw(picture, ws.M, shot.corner);
  }

 private:
  // The largest |M_ij| at some of the frames.
  static double largest_entry(const StagedRun& motion) {
    double largest = 0;
    Workspace ws(motion.chain());
    for (const int k : some_of(motion.samples())) {
      compute_mass_matrix(motion.chain(), ws, motion.trajectory().q_at(k));
      const double entry = ws.M.cwiseAbs().maxCoeff();
      if (std::isfinite(entry)) largest = std::max(largest, entry);
    }
    return largest;
  }

  std::map<const StagedRun*, MassMap> maps_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_mass_matrix(const Stage& stage) {
  return std::make_unique<MassMatrixLayer>(stage);
}

}  // namespace chainreel
