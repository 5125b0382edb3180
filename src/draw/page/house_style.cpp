#include "draw/page/house_style.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr double kContrastOfWords = 4.5, kContrastOfMarks = 3;

Color* color_named(Theme& theme, const std::string& name) {
  const std::pair<const char*, Color*> table[] = {
      {"background", &theme.background}, {"ink", &theme.ink},         {"muted", &theme.muted},
      {"base", &theme.base},             {"rule", &theme.rule},       {"grid", &theme.grid},
      {"ellipse", &theme.ellipse},       {"torque", &theme.torque},   {"velocity", &theme.velocity},
      {"force", &theme.force},           {"constraint", &theme.constraint},
      {"side_a", &theme.side_a},         {"side_b", &theme.side_b}};
  const auto* found = std::find_if(std::begin(table), std::end(table), [&](const auto& row) { return name == row.first; });
  return found == std::end(table) ? nullptr : found->second;
}

Theme styled(Theme theme, const StyleColors& colors, const Style& style) {
  for (const auto& [name, values] : colors) {
    if (Color* one = color_named(theme, name)) *one = color_of(values.front());
    if (name == "links")
      for (std::size_t i = 0; i < theme.link.size(); ++i) theme.link[i] = color_of(values[i % values.size()]);
    if (name == "curves")
      for (std::size_t i = 0; i < std::min(values.size(), theme.curve.size()); ++i) theme.curve[i] = color_of(values[i]);
  }
  // More than two variants have the style's curves, then its sides.
  const auto add_variant = [&theme](Color color) {
    const auto end = theme.variant.begin() + theme.variants;
    if (std::find(theme.variant.begin(), end, color) == end) theme.variant[std::size_t(theme.variants++)] = color;
  };
  if (const auto curves = colors.find("curves"); curves != colors.end())
    for (std::size_t i = 0; i < std::min(curves->second.size(), theme.curve.size()); ++i) add_variant(theme.curve[i]);
  for (const char* side : {"side_a", "side_b"})
    if (colors.contains(side)) add_variant(*color_named(theme, side));
  theme.lines = style.lines;
  theme.trail = style.trail;
  return theme;
}

const StyleColors& colors_in(const Scene& scene) {
  return scene.theme == ThemeName::dark ? scene.style.dark : scene.style.light;
}

// Themes are held by reference in all that is drawn.
const Theme& kept(const Theme& theme) {
  static std::mutex lock;
  static std::list<Theme> themes;
  const std::lock_guard guard(lock);
  const auto found = std::find(themes.begin(), themes.end(), theme);
  return found == themes.end() ? themes.emplace_back(theme) : *found;
}

double luminance(Color color) {
  const auto linear = [](std::uint8_t value) {
    const double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

// What bears words: the letters at arrows and curves have their colours.
bool is_of_words(const std::string& name) {
  return name != "background" && name != "base" && name != "rule" && name != "grid";
}

// From and behind which fractions of pixels a target pixel takes its colour.
struct Span {
  int first = 0, behind = 0;
};

Span source_span(int target, int targets, int sources) {
  const int first = int(std::int64_t(target) * sources / targets);
  const int behind = int((std::int64_t(target + 1) * sources + targets - 1) / targets);
  return {first, std::max(behind, first + 1)};
}

Color mean_of(const Image& image, Span columns, Span rows) {
  double r = 0, g = 0, b = 0, a = 0;
  for (int y = rows.first; y < rows.behind; ++y)
    for (int x = columns.first; x < columns.behind; ++x) {
      const Pixel p = image.at(x, y);
      r += double(p.r) * p.a;
      g += double(p.g) * p.a;
      b += double(p.b) * p.a;
      a += p.a;
    }
  if (!(a > 0)) return {};
  const double pixels = double(columns.behind - columns.first) * (rows.behind - rows.first);
  return {std::uint8_t(std::lround(r / a)), std::uint8_t(std::lround(g / a)), std::uint8_t(std::lround(b / a)),
          a / (255 * pixels)};
}

// Which colours a page may show; what only some instants or layouts show counts.
class ShownColors {
 public:
  explicit ShownColors(const Scene& page) : page_(page) {
    if (page.compare.empty()) panels_.push_back(&page);
    for (const Scene& panel : page.compare) panels_.push_back(&panel);
  }

  bool has(const std::string& name) const {
    const auto any = [&](const auto& is_so) { return std::any_of(panels_.begin(), panels_.end(), [&](const Scene* one) { return is_so(*one); }); };
    const bool has_foot = any([](const Scene& one) { return one.foot.has_value(); });
    const bool is_tied = any([](const Scene& one) { return !one.constraints.empty(); });
    if (name == "ellipse") return shows({"ellipse"});
    if (name == "velocity") return shows({"velocity"});
    if (name == "force") return shows({"gravity"}) || (shows({"g"}) && any([](const Scene& one) { return !one.gravity || !one.gravity->isZero(); }));
    if (name == "constraint") return is_tied || has_foot;
    if (name == "torque")
      return has_foot || (shows({"torque", "torque_label", "target", "springs", "equation"}) && any(&is_driven));
    if (name == "side_a" || name == "side_b") return panels_.size() >= 2;
    if (name == "curves")
      return shows({"trail", "ghosts"}) || any([](const Scene& one) { return !one.plot.empty(); }) ||
             (page_.layout != PageLayout::scene && !is_transparent(page_));
    return true;
  }

 private:
  static bool is_driven(const Scene& scene) {
    return scene.control || scene.motion ||
           std::any_of(scene.torque.begin(), scene.torque.end(), [](const TorqueEntry& one) { return !one.text.empty() && one.text != "0"; });
  }
  bool shows(std::initializer_list<const char*> layers) const {
    return std::any_of(panels_.begin(), panels_.end(), [&](const Scene* one) {
      return std::any_of(layers.begin(), layers.end(), [&](const char* layer) {
        return std::find(one->draw.begin(), one->draw.end(), layer) != one->draw.end();
      });
    });
  }

  const Scene& page_;
  std::vector<const Scene*> panels_;
};

}  // namespace

const Theme& page_theme(const Scene& scene) {
  const Theme& plain = theme_named(to_string(scene.theme));
  const StyleColors& colors = colors_in(scene);
  if (colors.empty() && scene.style.lines == 1 && scene.style.trail == 1) return plain;
  return kept(styled(plain, colors, scene.style));
}

FontFamilies families_of(const Scene& scene) {
  const StyleFonts& fonts = scene.style.fonts;
  return {fonts.label, fonts.bold, fonts.math};
}

double contrast(Color a, Color b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

namespace {

// Of what is seen of a logo the contrast that all but a fiftieth stays below: a thin letter on a card of its own takes no less.
double contrast_of_logo(const Image& image, Color background) {
  constexpr double kSeen = 0.5, kFiftieth = 0.02;  // opacity; of its pixels
  std::vector<double> found;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (const Pixel p = image.at(x, y); p.a > 255 * kSeen) found.push_back(contrast({p.r, p.g, p.b, 1}, background));
  if (found.empty()) return 1;
  const auto at = found.end() - 1 - std::ptrdiff_t(kFiftieth * double(found.size()));
  std::nth_element(found.begin(), at, found.end());
  return *at;
}

}  // namespace

std::vector<std::string> low_contrasts(const Scene& scene, std::size_t links) {
  const StyleColors& colors = colors_in(scene);
  Theme theme = page_theme(scene);
  const ShownColors shown(scene);
  const bool has_background = colors.contains("background");
  const auto is_set = [&](const std::string& name) { return has_background || colors.contains(name); };
  std::vector<std::string> lines;
  const auto check = [&](const std::string& name, Color color, Color on, const std::string& what, double wanted, const char* whose) {
    const double found = contrast(color, on);
    if (found >= wanted) return;
    const int tenths = int(std::floor(10 * found));  // never rounded up to what is wanted
    lines.push_back("style: " + name + " has a contrast of " + format_shortest(tenths / 10.0) + " with " + what + "; " + whose +
                    " need " + format_shortest(wanted) + ": take a " +
                    (luminance(on) > 0.18 ? "darker" : "lighter") + " one");
  };
  for (const Name& row : kStyleColors) {
    const std::string name = row.name;
    if (!is_set(name) || !shown.has(name) || name == "background" || name == "rule" || name == "grid") continue;
    const bool words = is_of_words(name);
    check(name, *color_named(theme, name), theme.background, "the background", words ? kContrastOfWords : kContrastOfMarks,
          words ? "words" : "marks");
  }
  if (is_set("curves") && shown.has("curves"))
    for (std::size_t i = 0; i < theme.curve.size(); ++i)
      check("curve " + std::to_string(i + 1), theme.curve[i], theme.background, "the background", kContrastOfWords, "words");
  if (const auto& logo = scene.style.logo; logo && logo->image)
    if (const double found = contrast_of_logo(*logo->image, theme.background); found < kContrastOfMarks)
      lines.push_back("style: the logo has a contrast of " + format_shortest(int(std::floor(10 * found)) / 10.0) + " with the background; marks need " +
                      format_shortest(kContrastOfMarks) + ": take a " + (luminance(theme.background) > 0.18 ? "darker" : "lighter") +
                      " one, or one with a card of its own behind it");
  // Fills of links may be pale where their outlines set them off.
  if (colors.contains("links") || colors.contains("ink"))
    for (std::size_t i = 0; i < std::min(links, theme.link.size()); ++i)
      if ((!colors.contains("links") || i < colors.at("links").size()) && contrast(theme.link[i], theme.background) < kContrastOfMarks)
        check("link " + std::to_string(i + 1), theme.link[i], theme.ink, "its outline, which is ink", kContrastOfMarks, "marks");
  return lines;
}

void draw_logo(Picture& picture, const Image& image, const Rect& box, int height) {
  const int columns = std::max(1, int(std::lround(box.width() * height))), rows = std::max(1, int(std::lround(box.height() * height)));
  Cells cells{box, columns, rows, {}};
  for (int row = rows; row-- > 0;)  // from the lowest, images begin with the highest
    for (int column = 0; column < columns; ++column)
      cells.colors.push_back(mean_of(image, source_span(column, columns, image.width), source_span(row, rows, image.height)));
  picture.add(std::move(cells));
}

}  // namespace chainreel
