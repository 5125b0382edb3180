#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "core/format.hpp"
#include "picture/fonts.hpp"
#include "picture/text.hpp"
#include "render/solid_image.hpp"
#include "render/vector_shapes.hpp"

namespace chainreel {
namespace {

struct FamilyRow {
  const char* name;       // of the embedded part
  const char* fallbacks;  // for readers that take installed fonts alone
  const char* weight;
};
constexpr std::array<FamilyRow, kOwnFaces> kFamilies = {
    {{"chainreel-label", "'DejaVu Sans',Verdana,sans-serif", "normal"},
     {"chainreel-bold", "'DejaVu Sans',Verdana,sans-serif", "bold"},
     {"chainreel-math", "'Latin Modern Math','STIX Two Math','Cambria Math',serif", "normal"}}};

constexpr double kWrittenAxis = 0.001;  // units of the page: the last digit that is written

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

// To a thousandth of a unit, no zeros behind.
std::string number(double value) {
  std::string text = format_fixed(value, 3);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string color_text(const Color& c) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text = "#";
  for (const int level : {int(c.r), int(c.g), int(c.b)}) {
    text += kHex[std::size_t(level / 16)];
    text += kHex[std::size_t(level % 16)];
  }
  return text;
}

class SvgWriter {
 public:
  SvgWriter(const Fonts& fonts, double height) : fonts_(fonts), scale_(height) {}

  std::string write(const Picture& picture, const VectorPage& page) {
    const double width = scale_ * picture.aspect;
    bodies_.emplace(picture.aspect, fonts_);
    for (std::size_t i = 0; i < picture.clips.size(); ++i) define_clip(i, picture.clips[i]);
    if (picture.background.a > 0)
      body_ += "<rect width=\"" + number(width) + "\" height=\"" + number(scale_) + "\"" +
               paint_text("fill", picture.background) + "/>\n";
    for (const Item& item : picture.items) {
      if (!is_finite(item.shape)) continue;
      enter_clip(item.clip);
      std::visit([this](const auto& shape) { add(shape); }, item.shape);
    }
    enter_clip(-1);
    const auto side = [&](double length) {
      if (page.width_mm > 0) return number(length * page.width_mm / width) + "mm";
      return number(page.height_px > 0 ? length * page.height_px / scale_ : length);
    };
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + side(width) + "\" height=\"" +
                      side(scale_) + "\" viewBox=\"0 0 " + number(width) + " " + number(scale_) +
                      "\" role=\"img\" xml:space=\"preserve\">\n";
    const auto element = [&svg](const char* name, const std::string& text) {
      if (!text.empty()) svg += std::string("<") + name + ">" + escaped(text) + "</" + name + ">\n";
    };
    element("title", page.title);
    element("desc", page.description);
    element("metadata", page.metadata);
    return svg + font_rules() + (defs_.empty() ? "" : "<defs>\n" + defs_ + "</defs>\n") + body_ + "</svg>\n";
  }

 private:
  double x(double page) const { return scale_ * page; }
  double y(double page) const { return scale_ * (1 - page); }
  std::string at(Point p) const { return number(x(p.x)) + " " + number(y(p.y)); }

  static std::string paint_text(const std::string& what, const Color& color, double opacity = 1) {
    std::string text = " " + what + "=\"" + color_text(color) + "\"";
    if (color.a * opacity < 1) text += " " + what + "-opacity=\"" + number(color.a * opacity) + "\"";
    return text;
  }

  std::string paint_text(const Paint& paint) const {
    std::string text = paint.fill.a > 0 ? paint_text("fill", paint.fill) : " fill=\"none\"";
    if (paint.stroke.a > 0 && paint.stroke_width > 0)
      text += paint_text("stroke", paint.stroke) + " stroke-width=\"" + number(scale_ * paint.stroke_width) +
              "\" stroke-linejoin=\"round\"";
    return text;
  }

  std::string line_text(const Color& color, double width, bool round_ends) const {
    return " fill=\"none\"" + paint_text("stroke", color) + " stroke-width=\"" + number(scale_ * width) +
           "\" stroke-linejoin=\"round\"" + (round_ends ? " stroke-linecap=\"round\"" : "");
  }

  void define_clip(std::size_t index, const Rect& r) {
    defs_ += "<clipPath id=\"clip" + std::to_string(index) + "\"><rect x=\"" + number(x(r.x0)) + "\" y=\"" +
             number(y(r.y1)) + "\" width=\"" + number(scale_ * r.width()) + "\" height=\"" +
             number(scale_ * r.height()) + "\"/></clipPath>\n";
  }

  void enter_clip(int clip) {
    if (clip == clip_) return;
    if (clip_ >= 0) body_ += "</g>\n";
    if (clip >= 0) body_ += "<g clip-path=\"url(#clip" + std::to_string(clip) + ")\">\n";
    clip_ = clip;
  }

  // White with the opacity of the two ends, so that fill and stroke fade as one.
  std::string define_fade(const Capsule& c) {
    const std::string id = std::to_string(++fades_);
    const auto stop = [](int offset, double alpha) {
      return "<stop offset=\"" + std::to_string(offset) + "\" stop-color=\"#fff\" stop-opacity=\"" +
             number(alpha) + "\"/>";
    };
    const double reach = c.radius + c.paint.stroke_width;
    const double left = std::min(c.a.x, c.b.x) - reach, top = std::max(c.a.y, c.b.y) + reach;
    const double width = std::abs(c.a.x - c.b.x) + 2 * reach, height = std::abs(c.a.y - c.b.y) + 2 * reach;
    const std::string box = " x=\"" + number(x(left)) + "\" y=\"" + number(y(top)) + "\" width=\"" +
                            number(scale_ * width) + "\" height=\"" + number(scale_ * height) + "\"";
    defs_ += "<linearGradient id=\"ramp" + id + "\" gradientUnits=\"userSpaceOnUse\" x1=\"" +
             number(x(c.a.x)) + "\" y1=\"" + number(y(c.a.y)) + "\" x2=\"" + number(x(c.b.x)) + "\" y2=\"" +
             number(y(c.b.y)) + "\">" + stop(0, c.alpha_a) + stop(1, c.alpha_b) +
             "</linearGradient>\n<mask id=\"fade" + id + "\" maskUnits=\"userSpaceOnUse\"" + box + "><rect" +
             box + " fill=\"url(#ramp" + id + ")\"/></mask>\n";
    return " mask=\"url(#fade" + id + ")\"";
  }

  // Shapes that fade alike share it.
  std::string fade_text(const Fade& fade) {
    if (!fade.any()) return "";
    const auto known = std::find(edges_.begin(), edges_.end(), fade);
    const std::string id = "edge" + std::to_string(known - edges_.begin() + 1);
    if (known == edges_.end()) define_edges(id, fade);
    return " mask=\"url(#" + id + ")\"";
  }

  void define_edges(const std::string& id, const Fade& fade) {
    edges_.push_back(fade);
    const auto place = [this](const Rect& r) {
      return " x=\"" + number(x(r.x0)) + "\" y=\"" + number(y(r.y1)) + "\" width=\"" + number(scale_ * r.width()) +
             "\" height=\"" + number(scale_ * r.height()) + "\"";
    };
    defs_ += "<mask id=\"" + id + "\" maskUnits=\"userSpaceOnUse\"" + place(fade.scene) + ">\n";
    for (const FadeLevel& level : fade_levels(fade)) {
      const auto gray = std::uint8_t(std::lround(255 * level.opacity));
      defs_ += "<rect" + place(level.part) + " fill=\"" + color_text({gray, gray, gray, 1}) + "\"/>\n";
    }
    defs_ += "</mask>\n";
  }

  void add(const Capsule& c) {
    std::string attributes;
    if (c.alpha_a != c.alpha_b)
      attributes = define_fade(c);
    else if (c.alpha_a != 1)
      attributes = " opacity=\"" + number(c.alpha_a) + "\"";
    const Point d = c.b - c.a;
    const double length = std::sqrt(d.x * d.x + d.y * d.y), r = scale_ * c.radius;
    if (length == 0) {
      body_ += "<circle cx=\"" + number(x(c.a.x)) + "\" cy=\"" + number(y(c.a.y)) + "\" r=\"" + number(r) +
               "\"" + paint_text(c.paint) + attributes + "/>\n";
      return;
    }
    if (c.paint.stroke.a > 0 && c.paint.stroke_width > 0) {
      const Point n = (c.radius / length) * Point{-d.y, d.x};
      const std::string arc = "A" + number(r) + " " + number(r) + " 0 0 1 ";
      body_ += "<path d=\"M" + at(c.a + n) + "L" + at(c.b + n) + arc + at(c.b - n) + "L" + at(c.a - n) + arc +
               at(c.a + n) + "Z\"" + paint_text(c.paint) + attributes + "/>\n";
      return;
    }
    body_ += "<path d=\"M" + at(c.a) + "L" + at(c.b) + "\"" + line_text(c.paint.fill, 2 * c.radius, true) +
             attributes + "/>\n";
  }

  void add(const Ellipse& e) {
    const auto size_of = [](Point p) { return std::sqrt(p.x * p.x + p.y * p.y); };
    // An axis of zero length would take the stroke with it.
    const double thinnest = kWrittenAxis / scale_;
    const double a = std::max(size_of(e.u), thinnest), b = std::max(size_of(e.v), thinnest);
    const Point axis = size_of(e.u) > 0 ? e.u : Point{e.v.y, -e.v.x};
    const double degrees = -std::atan2(axis.y, axis.x) * 180 / std::numbers::pi;
    const std::string center = number(x(e.center.x)) + " " + number(y(e.center.y));
    const std::string mask = fade_text(e.fade);
    if (!mask.empty()) body_ += "<g" + mask + ">";  // which is not turned
    body_ += "<ellipse cx=\"" + number(x(e.center.x)) + "\" cy=\"" + number(y(e.center.y)) + "\" rx=\"" +
             number(scale_ * a) + "\" ry=\"" + number(scale_ * b) + "\"" + paint_text(e.paint);
    if (a != b && degrees != 0) body_ += " transform=\"rotate(" + number(degrees) + " " + center + ")\"";
    body_ += mask.empty() ? "/>\n" : "/></g>\n";
  }

  // Two halves: an arc of a whole turn has no direction in SVG.
  void add(const Arc& a) {
    const double sweep = std::clamp(a.sweep, -2 * std::numbers::pi, 2 * std::numbers::pi);
    const auto on_arc = [&](double share) {
      const double angle = a.start + share * sweep;
      return a.center + a.radius * Point{std::cos(angle), std::sin(angle)};
    };
    const std::string r = number(scale_ * a.radius);
    const std::string arc = "A" + r + " " + r + " 0 0 " + (sweep > 0 ? "0 " : "1 ");
    body_ += "<path d=\"M" + at(on_arc(0)) + arc + at(on_arc(0.5)) + arc + at(on_arc(1)) + "\"" +
             line_text(a.color, a.width, true) + "/>\n";
  }

  // A picture in the picture: its light has no vector form.
  void add(const Solids& solids) {
    const std::optional<SolidImage> image = bodies_->draw(solids);
    if (!image) return;
    const Rect& r = image->place;
    body_ += "<image x=\"" + number(x(r.x0)) + "\" y=\"" + number(y(r.y1)) + "\" width=\"" +
             number(scale_ * r.width()) + "\" height=\"" + number(scale_ * r.height()) +
             "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," + base64(png_text(image->pixels)) +
             "\"/>\n";
  }

  void add(const Polygon& p) {
    const std::string mask = fade_text(p.fade);
    body_ += "<polygon points=\"";
    for (int i = 0; i < p.count; ++i) body_ += (i > 0 ? " " : "") + at(p.corners[std::size_t(i)]);
    body_ += "\"" + paint_text(p.paint) + mask + "/>\n";
  }

  void add(const Trail& trail) {
    for (const TrailRun& run : trail_runs(trail)) {
      body_ += "<path d=\"";
      for (const std::vector<Point>& line : run.lines)
        for (std::size_t i = 0; i < line.size(); ++i) body_ += (i == 0 ? "M" : "L") + at(line[i]);
      body_ += "\"" + line_text(trail.color.faded(run.alpha), run.width, run.round_ends) + "/>\n";
    }
  }

  // Some readers (librsvg) take the first of a list of places alone, so where the gaps are the layout's own,
  // in formulas, every character has an element of its own. So have characters beyond the first plane, which
  // count as one or as two from reader to reader, and clusters that are not one glyph for one character.
  void add(const GlyphRun& run) {
    if (run.glyphs.empty()) return;
    if (run.joins || run.right_to_left) return add_outlines(run);
    const bool is_own = int(run.face) < kOwnFaces;
    const std::string weight = is_own ? kFamilies[std::size_t(run.face)].weight : "normal";
    body_ += "<text y=\"" + number(y(run.origin.y)) + "\" font-family=\"" + family_name(run.face) + "," +
             (is_own ? kFamilies[std::size_t(run.face)].fallbacks : "sans-serif") + "\" font-size=\"" +
             number(scale_ * run.size) + "\"" + (weight == "bold" ? " font-weight=\"bold\"" : "") +
             (run.stroke_width > 0 ? line_text(run.color, run.stroke_width, true) + " pointer-events=\"none\"" +
                                         " style=\"user-select:none\""
                                   : paint_text("fill", run.color)) +
             ">";
    std::string places, words;
    const auto flush = [&] {
      if (!words.empty()) body_ += "<tspan x=\"" + places + "\">" + escaped(words) + "</tspan>";
      places.clear();
      words.clear();
    };
    for (const GlyphCluster& cluster : clusters_of(run)) {
      // Readers collapse blanks that others precede, whatever xml:space says, and each letter behind would take the place of the
      // one before it.
      if (cluster.text == U" " && (words.empty() || words.back() == ' ')) continue;
      for (const char32_t c : cluster.text) used_[run.face].insert(c);
      const bool is_simple = run.face != Face::math && cluster.count == 1 && cluster.text.size() == 1 &&
                             cluster.text[0] < 0x10000;
      if (!is_simple) flush();
      places += (places.empty() ? "" : " ") + number(x(run.origin.x + run.glyphs[cluster.first].x));
      words += encode_utf8(cluster.text);
      if (!is_simple) flush();
    }
    flush();
    body_ += "</text>\n";
  }

  // Letters that join, or run to the left, as what they look like: readers differ in how they set these letter by letter.
  void add_outlines(const GlyphRun& run) {
    std::string path;
    for (const Glyph& glyph : run.glyphs)
      for (const OutlinePiece& piece : outline_of(fonts_, run.face, glyph.index)) {
        path += piece.kind;
        for (int i = 0; i < piece.count; ++i)
          path += (i > 0 ? " " : "") + at(run.origin + Point{glyph.x, glyph.y} + run.size * piece.points[std::size_t(i)]);
      }
    if (path.empty()) return;  // spaces
    body_ += "<path role=\"img\" aria-label=\"" + escaped(run.text) + "\" d=\"" + path + "\"" +
             (run.stroke_width > 0 ? line_text(run.color, run.stroke_width, true) : paint_text("fill", run.color)) + "/>\n";
  }

  // The others by their place among those that the page uses, so that it does not hang on other pages.
  std::string family_name(Face face) {
    if (int(face) < kOwnFaces) return kFamilies[std::size_t(face)].name;
    const auto known = std::find(others_.begin(), others_.end(), face);
    const std::string name = "chainreel-other" + std::to_string(known - others_.begin() + 1);
    if (known == others_.end()) others_.push_back(face);
    return name;
  }

  // One path a colour, in units of cells; edges are left to whole pixels, else neighbours would show seams.
  void add(const Cells& cells) {
    std::map<std::string, std::string> paths;
    for (int row = 0; row < cells.ny; ++row)
      for (int first = 0, column = 1; column <= cells.nx; ++column) {
        const std::size_t start = std::size_t(row) * std::size_t(cells.nx);
        const Color& c = cells.colors[start + std::size_t(first)];
        if (column < cells.nx && cells.colors[start + std::size_t(column)] == c) continue;
        if (c.a > 0)
          paths[paint_text("fill", c)] +=
              "M" + std::to_string(first) + " " + std::to_string(cells.ny - 1 - row) + "h" +
              std::to_string(column - first) + "v1H" + std::to_string(first) + "z";
        first = column;
      }
    body_ += "<g shape-rendering=\"crispEdges\" transform=\"translate(" + number(x(cells.rect.x0)) + " " +
             number(y(cells.rect.y1)) + ") scale(" +
             format_significant(scale_ * cells.rect.width() / cells.nx, 9) + " " +
             format_significant(scale_ * cells.rect.height() / cells.ny, 9) + ")\">\n";
    for (const auto& [paint, path] : paths) body_ += "<path d=\"" + path + "\"" + paint + "/>\n";
    body_ += "</g>\n";
  }

  std::string font_rules() {
    std::string rules;
    const auto add_rule = [&](Face face, const std::string& weight) {
      const auto characters = used_.find(face);
      if (characters == used_.end()) return;
      rules += "@font-face{font-family:" + family_name(face) + ";font-weight:" + weight + ";src:url(data:font/otf;base64," +
               base64(font_subset(fonts_, face, characters->second)) + ")}\n";
    };
    for (std::size_t i = 0; i < kFamilies.size(); ++i) add_rule(Face(i), kFamilies[i].weight);
    for (const Face face : others_) add_rule(face, "normal");
    return rules.empty() ? "" : "<style>\n" + rules + "</style>\n";
  }

  const Fonts& fonts_;
  double scale_;
  std::optional<SolidImages> bodies_;
  std::string defs_, body_;
  std::map<Face, std::set<char32_t>> used_;
  std::vector<Face> others_;  // beyond the program's own, as the page came to use them
  std::vector<Fade> edges_;
  int clip_ = -1, fades_ = 0;
};

}  // namespace

std::string svg_text(const Picture& picture, const Fonts& fonts, const VectorPage& page) {
  return SvgWriter(fonts, page.height).write(picture, page);
}

}  // namespace chainreel
