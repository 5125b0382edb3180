#include "draw/charts/chart_page.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "draw/page/house_style.hpp"
#include "draw/page/sheet.hpp"
#include "picture/place_picture.hpp"

namespace chainreel {
namespace {

constexpr double kAfterTitle = 0.45, kAfterSubtitle = 0.55, kBeforeFooter = 0.9;  // of the em
constexpr double kLeastHeight = 0.25;
constexpr double kNarrowLogo = 0.2, kRowOfTitle = 1.3;  // of the page's width; of the em

}  // namespace

namespace {

Rect draw_words(Picture& picture, const ChartText& text, const ChartLook& look) {
  picture.aspect = look.width();
  picture.background = look.theme->background;
  const PlotStyle style = look.plot_style();
  const Rect inside{size::kMargin, size::kMargin, look.width() - size::kMargin, look.height - size::kMargin};
  double top = inside.y1, bottom = inside.y0;
  const std::optional<Rect> logo = look.logo ? std::optional(box_of(*look.logo, inside)) : std::nullopt;
  // From where to where words run at the top and at the bottom.
  const auto row_at = [&](bool at_top) -> std::pair<double, double> {
    if (!logo || is_at_top(look.logo->corner) != at_top) return {inside.x0, inside.x1};
    return is_at_left(look.logo->corner) ? std::pair(logo->x1 + kBesideLogo, inside.x1) : std::pair(inside.x0, logo->x0 - kBesideLogo);
  };
  const auto [left, upper_right] = row_at(true);
  const double width = upper_right - left;
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
  if (!text.warning.empty()) {
    const TextStyle bold{Face::label_bold, style.text(size::kTick), look.theme->ink, Align::left};
    top -= draw_paragraph(picture, *look.fonts, text.warning, bold, {left, top - kCapHeight * bold.size}, width);
    top -= kAfterSubtitle * bold.size;
  }
  if (!text.footer.empty()) {
    const auto [lower_left, lower_right] = row_at(false);
    const TextStyle small{Face::label, style.text(size::kTick), look.theme->muted, Align::left};
    const auto lines = double(wrapped(*look.fonts, text.footer, small, lower_right - lower_left).size());
    const double above = (lines - 1) * kLinePitch * small.size;
    draw_paragraph(picture, *look.fonts, text.footer, small, {lower_left, bottom + above}, lower_right - lower_left);
    bottom += above + (kCapHeight + kBeforeFooter) * small.size;
  }
  if (logo) {
    draw_logo(picture, *look.logo->image, *logo, look.logo->page_height);
    if (is_at_top(look.logo->corner))
      top = std::min(top, logo->y0 - size::kMarkToText);
    else {
      // Beside the title of the axis, which stands in the middle, where the logo is narrow: not below it.
      const double title = logo->width() < kNarrowLogo * inside.width() ? kRowOfTitle * style.text(size::kAxis) : 0;
      bottom = std::max(bottom, logo->y1 + size::kMarkToText - title);
    }
  }
  return {inside.x0, bottom, inside.x1, top};
}

}  // namespace

Picture as_page(const Picture& picture, const ChartLook& look) {
  return look.height == 1 ? picture : in_page_units(picture, look.height);
}

Rect draw_chart_page(Picture& picture, const ChartText& text, const ChartLook& look) {
  ChartText shown = text;
  const auto height = [&] {
    Picture measured;
    return draw_words(measured, shown, look).height() / look.height;
  };
  const double least = text.is_in_caption ? kWholeChart : kMostlyChart;
  if (look.is_small && height() < least) shown.footer = text.needed;
  if (look.is_small && height() < least) shown.subtitle.clear();
  if (look.is_small && text.is_in_caption && height() < least) shown.title.clear();
  const Rect area = draw_words(picture, shown, look);
  if (area.height() < kLeastHeight)
    throw Error(ExitCode::bad_input, look.is_small ? "the title leaves no room for the chart: take a higher page"
                                                      : "title and notes leave no room for the chart: lower text_scale");
  return area;
}

void require_room_for_axes(const PlotFrame& frame, const ChartLook& look) {
  constexpr double kLeast = 4;  // of the em of numbers
  const double least = kLeast * look.plot_style().text(size::kTick);
  if (frame.box.width() >= least && frame.box.height() >= least) return;
  throw Error(ExitCode::bad_input, std::string("what stands beside the axes leaves them no room: take a ") + (frame.box.width() < least ? "wider" : "higher") +
                                       " page, or fewer curves");
}

void require_room_for_names(std::size_t curves, const Rect& area, const ChartLook& look) {
  if (!look.is_small || double(curves) * kLinePitch * look.plot_style().text(size::kTick) <= area.height()) return;
  throw Error(ExitCode::bad_input, "the names of " + std::to_string(curves) +
                                       " methods have no room on this page: name fewer by --methods, or take a higher page");
}

}  // namespace chainreel
