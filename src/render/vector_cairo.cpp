#include <ft2build.h>

#include "render/vector_shapes.hpp"
#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "picture/text.hpp"
#include "render/cairo_functions.hpp"
#include "render/solid_image.hpp"

namespace chainreel {
namespace {

constexpr double kFlattestAxis = 1e-6;  // H: flatter ellipses have no inverse that Cairo takes

void check(cairo_status_t status, const char* doing) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw Error(status == CAIRO_STATUS_NO_MEMORY ? ExitCode::limit : ExitCode::no_renderer,
              std::string(doing) + ": " + libcairo().cairo_status_to_string(status));
}

// Faces by file as everywhere. Cairo keeps a face longer than its users, so what it stands on goes with it.
class CairoFaces {
 public:
  explicit CairoFaces(const Fonts& fonts) : fonts_(fonts) {}
  CairoFaces(const CairoFaces&) = delete;
  CairoFaces& operator=(const CairoFaces&) = delete;
  ~CairoFaces() {
    for (const auto& [face, opened] : faces_)
      if (opened != nullptr) libcairo().cairo_font_face_destroy(opened);
  }

  cairo_font_face_t* get(Face face) {
    cairo_font_face_t*& cairo_face = faces_[face];
    if (cairo_face == nullptr) cairo_face = open(fonts_.file(face), fonts_.index(face));
    return cairo_face;
  }

 private:
  struct Opened {
    FT_Library library = nullptr;
    FT_Face face = nullptr;
    ~Opened() { FT_Done_FreeType(library); }
  };

  static cairo_font_face_t* open(const std::string& file, int index) {
    static const cairo_user_data_key_t key{};
    auto opened = std::make_unique<Opened>();
    if (FT_Init_FreeType(&opened->library) != 0 ||
        FT_New_Face(opened->library, file.c_str(), index, &opened->face) != 0)
      throw Error(ExitCode::no_renderer, "font file " + file + " cannot be read");
    cairo_font_face_t* face =
        libcairo().cairo_ft_font_face_create_for_ft_face(opened->face, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP);
    const cairo_status_t status = libcairo().cairo_font_face_set_user_data(
        face, &key, opened.get(), [](void* data) { delete static_cast<Opened*>(data); });
    check(status, "opening a font");
    opened.release();
    return face;
  }

  const Fonts& fonts_;
  std::map<Face, cairo_font_face_t*> faces_;
};

class Painter {
 public:
  Painter(cairo_t* cairo, const Fonts& fonts, double height) : cr_(cairo), fonts_(fonts), scale_(height), faces_(fonts) {
    libcairo().cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    cairo_font_options_t* options = libcairo().cairo_font_options_create();
    libcairo().cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    libcairo().cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    libcairo().cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    libcairo().cairo_set_font_options(cr_, options);
    libcairo().cairo_font_options_destroy(options);
  }

  void paint(const Picture& picture) {
    bodies_.emplace(picture.aspect, fonts_);
    fill_page(picture.background);
    for (const Item& item : picture.items) {
      if (!is_finite(item.shape)) continue;
      libcairo().cairo_save(cr_);
      if (item.clip >= 0) clip(picture.clips.at(std::size_t(item.clip)));
      std::visit([this](const auto& shape) { add(shape); }, item.shape);
      libcairo().cairo_restore(cr_);
    }
    check(libcairo().cairo_status(cr_), "drawing a page");
  }

 private:
  double x(double page) const { return scale_ * page; }
  double y(double page) const { return scale_ * (1 - page); }
  void move_to(Point p) { libcairo().cairo_move_to(cr_, x(p.x), y(p.y)); }
  void line_to(Point p) { libcairo().cairo_line_to(cr_, x(p.x), y(p.y)); }

  void set_color(const Color& c, double opacity = 1) {
    libcairo().cairo_set_source_rgba(cr_, c.r / 255.0, c.g / 255.0, c.b / 255.0, c.a * opacity);
  }

  void fill_page(const Color& background) {
    if (!(background.a > 0)) return;
    set_color(background);
    libcairo().cairo_paint(cr_);
  }

  void clip(const Rect& r) {
    libcairo().cairo_rectangle(cr_, x(r.x0), y(r.y1), scale_ * r.width(), scale_ * r.height());
    libcairo().cairo_clip(cr_);
  }

  // The current path.
  void paint_path(const Paint& paint) {
    if (paint.fill.a > 0) {
      set_color(paint.fill);
      libcairo().cairo_fill_preserve(cr_);
    }
    if (paint.stroke.a > 0 && paint.stroke_width > 0) {
      set_color(paint.stroke);
      libcairo().cairo_set_line_width(cr_, scale_ * paint.stroke_width);
      libcairo().cairo_stroke_preserve(cr_);
    }
    libcairo().cairo_new_path(cr_);
  }

  // The current path, fading.
  void paint_path(const Paint& paint, const Fade& fade) {
    if (!fade.any()) return paint_path(paint);
    libcairo().cairo_push_group(cr_);
    paint_path(paint);
    cairo_pattern_t* shape = libcairo().cairo_pop_group(cr_);
    libcairo().cairo_push_group_with_content(cr_, CAIRO_CONTENT_ALPHA);
    double below = 0;
    for (const auto& [part, opacity] : fade_levels(fade)) {
      libcairo().cairo_rectangle(cr_, x(part.x0), y(part.y1), scale_ * part.width(), scale_ * part.height());
      libcairo().cairo_set_source_rgba(cr_, 0, 0, 0, (opacity - below) / (1 - below));  // over what is there they make the whole
      libcairo().cairo_fill(cr_);
      below = opacity;
    }
    cairo_pattern_t* mask = libcairo().cairo_pop_group(cr_);
    libcairo().cairo_set_source(cr_, shape);
    libcairo().cairo_mask(cr_, mask);
    libcairo().cairo_pattern_destroy(mask);
    libcairo().cairo_pattern_destroy(shape);
    libcairo().cairo_new_path(cr_);
  }

  void capsule_path(const Capsule& c) {
    const double dx = x(c.b.x) - x(c.a.x), dy = y(c.b.y) - y(c.a.y), r = scale_ * c.radius;
    const double angle = std::atan2(dy, dx), quarter = std::numbers::pi / 2;
    libcairo().cairo_new_path(cr_);
    libcairo().cairo_arc(cr_, x(c.b.x), y(c.b.y), r, angle - quarter, angle + quarter);
    libcairo().cairo_arc(cr_, x(c.a.x), y(c.a.y), r, angle + quarter, angle + 3 * quarter);
    libcairo().cairo_close_path(cr_);
  }

  void add(const Capsule& c) {
    const bool fades = c.alpha_a != 1 || c.alpha_b != 1;
    if (!fades) {
      capsule_path(c);
      paint_path(c.paint);
      return;
    }
    libcairo().cairo_push_group(cr_);
    capsule_path(c);
    paint_path(c.paint);
    libcairo().cairo_pop_group_to_source(cr_);
    cairo_pattern_t* mask = libcairo().cairo_pattern_create_linear(x(c.a.x), y(c.a.y), x(c.b.x), y(c.b.y));
    libcairo().cairo_pattern_add_color_stop_rgba(mask, 0, 0, 0, 0, c.alpha_a);
    libcairo().cairo_pattern_add_color_stop_rgba(mask, 1, 0, 0, 0, c.alpha_b);
    libcairo().cairo_mask(cr_, mask);
    libcairo().cairo_pattern_destroy(mask);
  }

  void add(const Ellipse& e) {
    const auto size_of = [](Point p) { return std::sqrt(p.x * p.x + p.y * p.y); };
    Point u = e.u, v = e.v;
    if (size_of(u) < size_of(v)) std::swap(u, v);
    const double length = std::max(size_of(u), kFlattestAxis);
    if (size_of(u) < kFlattestAxis) u = {kFlattestAxis, 0};
    if (size_of(v) < kFlattestAxis) v = (kFlattestAxis / length) * Point{-u.y, u.x};
    cairo_matrix_t before;
    libcairo().cairo_get_matrix(cr_, &before);
    const cairo_matrix_t to_page = {scale_ * u.x,  -scale_ * u.y, scale_ * v.x,
                                    -scale_ * v.y, x(e.center.x), y(e.center.y)};
    libcairo().cairo_new_path(cr_);
    libcairo().cairo_transform(cr_, &to_page);
    libcairo().cairo_arc(cr_, 0, 0, 1, 0, 2 * std::numbers::pi);
    libcairo().cairo_close_path(cr_);
    libcairo().cairo_set_matrix(cr_, &before);
    paint_path(e.paint, e.fade);
  }

  void add(const Arc& a) {
    const double sweep = std::clamp(a.sweep, -2 * std::numbers::pi, 2 * std::numbers::pi);
    const auto draw = sweep > 0 ? libcairo().cairo_arc_negative : libcairo().cairo_arc;  // y points down here
    libcairo().cairo_new_path(cr_);
    draw(cr_, x(a.center.x), y(a.center.y), scale_ * a.radius, -a.start, -(a.start + sweep));
    stroke(a.color, a.width, true);
  }

  void stroke(const Color& color, double width, bool round_ends) {
    set_color(color);
    libcairo().cairo_set_line_width(cr_, scale_ * width);
    libcairo().cairo_set_line_cap(cr_, round_ends ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    libcairo().cairo_stroke(cr_);
  }

  void add(const Polygon& p) {
    libcairo().cairo_new_path(cr_);
    for (int i = 0; i < p.count; ++i) line_to(p.corners[std::size_t(i)]);
    libcairo().cairo_close_path(cr_);
    paint_path(p.paint, p.fade);
  }

  void add(const Trail& trail) {
    for (const TrailRun& run : trail_runs(trail)) {
      libcairo().cairo_new_path(cr_);
      for (const std::vector<Point>& line : run.lines) {
        move_to(line.front());
        for (std::size_t i = 1; i < line.size(); ++i) line_to(line[i]);
      }
      stroke(trail.color.faded(run.alpha), run.width, run.round_ends);
    }
  }

  void add(const GlyphRun& run) {
    if (run.glyphs.empty() || !(run.size > 0)) return;
    std::vector<cairo_glyph_t> glyphs;
    for (const Glyph& glyph : run.glyphs)
      glyphs.push_back({glyph.index, x(run.origin.x + glyph.x), y(run.origin.y + glyph.y)});
    if (run.stroke_width > 0) {
      libcairo().cairo_set_font_face(cr_, faces_.get(run.face));
      libcairo().cairo_set_font_size(cr_, scale_ * run.size);
      libcairo().cairo_new_path(cr_);
      libcairo().cairo_glyph_path(cr_, glyphs.data(), int(glyphs.size()));
      return stroke(run.color, run.stroke_width, true);
    }
    std::string text;
    std::vector<cairo_text_cluster_t> clusters;
    std::vector<GlyphCluster> as_read = clusters_of(run);
    if (run.right_to_left) std::reverse(as_read.begin(), as_read.end());
    for (const GlyphCluster& cluster : as_read) {
      const std::string part = encode_utf8(cluster.text);
      clusters.push_back({int(part.size()), int(cluster.count)});
      text += part;
    }
    libcairo().cairo_set_font_face(cr_, faces_.get(run.face));
    libcairo().cairo_set_font_size(cr_, scale_ * run.size);
    set_color(run.color);
    libcairo().cairo_show_text_glyphs(cr_, text.data(), int(text.size()), glyphs.data(), int(glyphs.size()),
                           clusters.data(), int(clusters.size()),
                           run.right_to_left ? CAIRO_TEXT_CLUSTER_FLAG_BACKWARD : cairo_text_cluster_flags_t(0));
  }

  // A picture in the picture: its light has no vector form.
  void add(const Solids& solids) {
    const std::optional<SolidImage> image = bodies_->draw(solids);
    if (!image) return;
    cairo_surface_t* sheet = image_surface(image->pixels);
    check(libcairo().cairo_surface_status(sheet), "drawing bodies");
    libcairo().cairo_translate(cr_, x(image->place.x0), y(image->place.y1));
    libcairo().cairo_scale(cr_, scale_ * image->place.width() / image->pixels.width,
                scale_ * image->place.height() / image->pixels.height);
    libcairo().cairo_set_source_surface(cr_, sheet, 0, 0);
    libcairo().cairo_pattern_set_filter(libcairo().cairo_get_source(cr_), CAIRO_FILTER_GOOD);
    libcairo().cairo_paint(cr_);
    libcairo().cairo_surface_destroy(sheet);
  }

  void add(const Cells& cells) {
    cairo_surface_t* sheet = libcairo().cairo_image_surface_create(CAIRO_FORMAT_ARGB32, cells.nx, cells.ny);
    check(libcairo().cairo_surface_status(sheet), "drawing a map");
    unsigned char* pixels = libcairo().cairo_image_surface_get_data(sheet);
    const std::size_t stride = std::size_t(libcairo().cairo_image_surface_get_stride(sheet));
    for (std::size_t row = 0; row < std::size_t(cells.ny); ++row)
      for (std::size_t column = 0; column < std::size_t(cells.nx); ++column) {
        const std::size_t from_top = std::size_t(cells.ny) - 1 - row;
        const Color& c = cells.colors[row * std::size_t(cells.nx) + column];
        const auto level = [&c](double value) { return std::uint32_t(std::lround(c.a * value)); };
        const std::uint32_t argb = level(255) << 24 | level(c.r) << 16 | level(c.g) << 8 | level(c.b);
        std::copy_n(reinterpret_cast<const unsigned char*>(&argb), 4,
                    pixels + from_top * stride + 4 * column);
      }
    libcairo().cairo_surface_mark_dirty(sheet);
    libcairo().cairo_translate(cr_, x(cells.rect.x0), y(cells.rect.y1));
    libcairo().cairo_scale(cr_, scale_ * cells.rect.width() / cells.nx, scale_ * cells.rect.height() / cells.ny);
    libcairo().cairo_set_source_surface(cr_, sheet, 0, 0);
    libcairo().cairo_pattern_set_filter(libcairo().cairo_get_source(cr_), CAIRO_FILTER_NEAREST);
    libcairo().cairo_rectangle(cr_, 0, 0, cells.nx, cells.ny);
    libcairo().cairo_fill(cr_);
    libcairo().cairo_surface_destroy(sheet);
  }

  cairo_t* cr_;
  const Fonts& fonts_;
  double scale_;
  std::optional<SolidImages> bodies_;
  CairoFaces faces_;
};

}  // namespace

void paint_with_cairo(cairo_t* cairo, const Picture& picture, const Fonts& fonts, double height) {
  Painter(cairo, fonts, height).paint(picture);
}

std::string pdf_text(const Picture& picture, const Fonts& fonts, const VectorPage& page) {
  std::string bytes;
  const auto append = [](void* to, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
  constexpr double kPointsPerMm = 72 / 25.4;
  const double height = page.width_mm > 0 ? page.width_mm * kPointsPerMm / picture.aspect : page.height;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      libcairo().cairo_pdf_surface_create_for_stream(append, &bytes, height * picture.aspect, height),
      libcairo().cairo_surface_destroy);
  const auto set = [&](cairo_pdf_metadata_t key, const std::string& value) {
    libcairo().cairo_pdf_surface_set_metadata(surface.get(), key, value.empty() ? nullptr : value.c_str());
  };
  set(CAIRO_PDF_METADATA_TITLE, page.title);
  set(CAIRO_PDF_METADATA_SUBJECT, page.description);
  set(CAIRO_PDF_METADATA_KEYWORDS, page.metadata);
  set(CAIRO_PDF_METADATA_CREATE_DATE, "");  // else the time of the call
  {
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(libcairo().cairo_create(surface.get()),
                                                                   libcairo().cairo_destroy);
    paint_with_cairo(cairo.get(), picture, fonts, height);
  }
  libcairo().cairo_surface_finish(surface.get());
  check(libcairo().cairo_surface_status(surface.get()), "writing a PDF page");
  return bytes;
}

}  // namespace chainreel
