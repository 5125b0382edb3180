#include "draw/charts/chart_page.hpp"

#include "core/error.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {
namespace {

constexpr double kAfterTitle = 0.45, kAfterSubtitle = 0.55, kBeforeFooter = 0.9;  // of the em
constexpr double kLeastHeight = 0.25;

}  // namespace

Rect draw_chart_page(Picture& picture, const ChartText& text, const ChartLook& look) {
  picture.aspect = look.aspect;
  picture.background = look.theme->background;
  const PlotStyle style = look.plot_style();
  const double left = size::kMargin, right = look.aspect - size::kMargin, width = right - left;
  double top = 1 - size::kMargin, bottom = size::kMargin;
  if (!text.title.empty()) {
    const TextStyle bold{Face::label_bold, style.text(size::kTitle), look.theme->ink, Align::left};
    const TextLine line = fit_text(*look.fonts, text.title, bold, width, look.text_scale);
    draw_text(picture, line, {left, top - kCapHeight * bold.size});
    top -= (kCapHeight + kAfterTitle) * bold.size;
  }
  if (!text.subtitle.empty()) {
    const TextStyle muted{Face::label, style.text(size::kAxis), look.theme->muted, Align::left};
    top -= draw_paragraph(picture, *look.fonts, text.subtitle, muted, {left, top - kCapHeight * muted.size},
                          width);
    top -= kAfterSubtitle * muted.size;
  }
  if (!text.footer.empty()) {
    const TextStyle small{Face::label, style.text(size::kTick), look.theme->muted, Align::left};
    const auto lines = double(wrapped(*look.fonts, text.footer, small, width).size());
    const double above = (lines - 1) * kLinePitch * small.size;
    draw_paragraph(picture, *look.fonts, text.footer, small, {left, bottom + above}, width);
    bottom += above + (kCapHeight + kBeforeFooter) * small.size;
  }
  if (top - bottom < kLeastHeight)
    throw Error(ExitCode::bad_input, "title and notes leave no room for the chart: lower text_scale");
  return {left, bottom, right, top};
}

}  // namespace chainreel
