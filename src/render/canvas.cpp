#include "render/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

#include "core/loaded_libraries.hpp"
#include "core/machine.hpp"
#include "render/batch.hpp"
#include "render/changes.hpp"
#include "render/gl_painter.hpp"
#include "render/glyph_atlas.hpp"
#include "render/renderer_pins.hpp"
#include "render/solid_layer.hpp"
#include "render/window_painter.hpp"
#include "render/windows.hpp"

namespace chainreel {
namespace {

// Blending needs colours multiplied by their opacity; outside, opacity is straight.
void divide_by_alpha(Image& image, const PixelBox& box) {
  for (int y = box.y; y < box.bottom(); ++y) {
    std::uint8_t* p = &image.bgra[std::size_t(4) * (std::size_t(y) * std::size_t(image.width) + std::size_t(box.x))];
    for (int x = 0; x < box.width; ++x, p += 4) chainreel::divide_by_alpha(p);
  }
}

void copy(const Image& from, const std::vector<PixelBox>& boxes, Image& to) {
  for (const PixelBox& box : boxes)
    for (int y = box.y; y < box.bottom(); ++y) {
      const std::size_t first = 4 * (std::size_t(y) * std::size_t(from.width) + std::size_t(box.x));
      std::memcpy(&to.bgra[first], &from.bgra[first], 4 * std::size_t(box.width));
    }
}

std::uint32_t* pixels_of(Image& image) {
  return reinterpret_cast<std::uint32_t*>(image.bgra.data());
}

// Of a page that OpenGL has cleared: halves become even.
std::uint32_t pixel_of(const std::array<float, 4>& rgba) {
  const auto level = [](float c) { return std::uint32_t(std::nearbyint(c * 255.0F)); };
  return level(rgba[3]) << 24 | level(rgba[0]) << 16 | level(rgba[1]) << 8 | level(rgba[2]);
}

}  // namespace

struct Canvas::State {
  int width, height;
  PageUse use = PageUse::film;
  bool by_opengl = opengl_draws(use);
  std::optional<ComingRenderer> coming;  // none where the static layer is another canvas's
  std::unique_ptr<GlPainter> gl;
  WindowPainter painter;
  SolidLayer solid_layer;
  std::shared_ptr<const StaticLayer> static_layer;
  GlyphAtlas atlas;
  Batch batch, batch_before;           // of the picture that is drawn, and of the one that the page shows
  bool shows_batch_before = false;     // over the static layer
  std::vector<PlacedSolids> placed;          // of each group of bodies
  std::vector<SolidTraces> traces_before;    // of each group of the picture that the page shows
  TileMask changed;
  Windows windows;
  Image translucent;  // the page where its background is, premultiplied; otherwise it is the frame's image
  CanvasFrame frame;

  State(int w, int h, PageUse what_for, std::optional<ComingRenderer> with, std::shared_ptr<const StaticLayer> layer,
        const Fonts& fonts)
      : width(w),
        height(h),
        use(what_for),
        coming(std::move(with)),
        painter(w, h),
        solid_layer(w, h),
        static_layer(std::move(layer)),
        atlas(fonts),
        batch(w, h, atlas),
        batch_before(w, h, atlas),
        changed(w, h) {
    frame.image = Image(w, h);
  }

  PixelBox whole() const { return {0, 0, width, height}; }

  GlPainter& opengl() {
    if (gl) return *gl;
    // What failed once is tried anew by who draws again.
    std::optional<ComingRenderer> one;
    std::swap(one, coming);
    gl = one ? one->arrived() : ComingRenderer(width, height, use).arrived();
    return *gl;
  }

  void set(const Picture& picture) {
    atlas.trim();
    batch.set(picture);
    placed.resize(batch.solids().size());
    for (const Piece& piece : batch.pieces()) {
      if (piece.primitive != Primitive::solids) continue;
      const auto group = std::size_t(piece.instance);
      solid_layer.place(*batch.solids()[group], body_paint(piece), placed[group]);
    }
  }

  BodyPaint body_paint(const Piece& piece) const {
    const float* numbers = batch.numbers(piece);
    const Solids& solids = *batch.solids()[std::size_t(piece.instance)];
    return {numbers[0], numbers[1], {numbers[4], numbers[5], numbers[6], numbers[7]}, solids.is_shadow, solids.fade, height};
  }

  // Where bodies are in the changed tiles.
  std::vector<PixelBox> boxes_of_solids(const Run& run) const {
    const Piece& piece = batch.pieces()[std::size_t(run.piece)];
    TileMask touched(width, height);
    mark_difference(nullptr, &placed[std::size_t(piece.instance)].traces(), touched);
    touched.keep(changed);
    std::vector<PixelBox> boxes;
    touched.boxes(piece.outline.box, boxes);
    return boxes;
  }

  void draw_solids(const Run& run, const std::vector<PixelBox>& boxes, Image& page) {
    if (boxes.empty()) return;
    const Piece& piece = batch.pieces()[std::size_t(run.piece)];
    solid_layer.draw(placed[std::size_t(piece.instance)], body_paint(piece), boxes, pixels_of(page));
  }

  // The batch, the whole page.
  void draw_whole(const Color& background, Image& page) {
    changed.fill();
    windows.set(batch, changed);
    if (by_opengl) return draw_by(opengl(), background, page);
    std::fill_n(pixels_of(page), std::size_t(width) * std::size_t(height), pixel_of(cleared_to(background)));
    draw_in_memory(page);
  }

  void draw_by(GlPainter& by, const Color& background, Image& page) {
    by.draw(background, windows, batch, atlas, [&](const Run& run) {
      const std::vector<PixelBox> boxes = boxes_of_solids(run);
      by.read(boxes, page);
      draw_solids(run, boxes, page);
      by.write(boxes, page);
    });
    by.read({whole()}, page);
  }

  // What of the batch lies in the changed tiles, over the static layer.
  void draw_changed(Image& page) {
    windows.set(batch, changed);
    copy(static_layer->pixels, frame.changed, page);
    draw_in_memory(page);
  }

  void draw_in_memory(Image& page) {
    for (const Run& run : windows.runs())
      if (run.primitive == Primitive::solids)
        draw_solids(run, boxes_of_solids(run), page);
      else
        painter.draw(run, windows, batch, atlas, pixels_of(page));
  }

  // The page of a background so opaque.
  Image& page_of(double alpha) {
    if (alpha >= 1) return frame.image;
    if (translucent.width == 0) translucent = Image(width, height);
    return translucent;
  }

  // The tiles in which the page will differ from what it shows.
  void find_changes() {
    if (!static_layer || !shows_batch_before) return changed.fill();
    changed.clear();
    mark_changes(batch_before, batch, [this](const Piece* before, const Piece* now, TileMask& marked) {
      mark_difference(before == nullptr ? nullptr : &traces_before[std::size_t(before->instance)],
                      now == nullptr ? nullptr : &placed[std::size_t(now->instance)].traces(), marked);
    }, changed);
  }
};

ComingRenderer::ComingRenderer(int width, int height, PageUse use, const std::function<void()>& before)
    : width_(width), height_(height), use_(use) {
  require_page(width, height);
  settle_environment();
  if (!opengl_draws(use)) {
    if (before) before();
    return;
  }
  painter_ = std::async(std::launch::async | std::launch::deferred, [width, height, before] {
    if (before) before();
    auto painter = std::make_unique<GlPainter>(width, height);
    painter->get_ready();
    return painter;
  });
}

ComingRenderer::ComingRenderer(ComingRenderer&&) noexcept = default;
ComingRenderer& ComingRenderer::operator=(ComingRenderer&&) noexcept = default;
ComingRenderer::~ComingRenderer() = default;

std::unique_ptr<GlPainter> ComingRenderer::arrived() {
  return painter_.get();
}

Canvas::Canvas(int width, int height, const Fonts& fonts, PageUse use) : Canvas(ComingRenderer(width, height, use), fonts) {}

Canvas::Canvas(ComingRenderer renderer, const Fonts& fonts) {
  const int width = renderer.width_, height = renderer.height_;
  const PageUse use = renderer.use_;
  state_ = std::make_unique<State>(width, height, use, std::move(renderer), nullptr, fonts);
}

Canvas::Canvas(std::shared_ptr<const StaticLayer> layer, const Fonts& fonts)
    : state_(std::make_unique<State>(layer->pixels.width, layer->pixels.height, PageUse::film, std::nullopt, layer, fonts)) {}

Canvas::~Canvas() = default;

RendererInfo Canvas::info() const {
  return state_->by_opengl ? state_->opengl().info() : RendererInfo{"none", "chainreel", "none"};
}

void Canvas::set_static_layer(const Picture& picture) {
  State& s = *state_;
  s.shows_batch_before = false;
  s.set(picture);
  auto layer = std::make_shared<StaticLayer>();
  layer->pixels = Image(s.width, s.height);
  layer->alpha = picture.background.a;
  s.draw_whole(picture.background, layer->pixels);
  s.static_layer = std::move(layer);
}

std::shared_ptr<const StaticLayer> Canvas::static_layer() const {
  return state_->static_layer;
}

const CanvasFrame& Canvas::draw(const Picture& picture) {
  State& s = *state_;
  if (!s.static_layer && picture.fixed > 0 && s.by_opengl) {
    set_static_layer(picture.part(0, picture.fixed));
    draw(picture.part(picture.fixed, picture.items.size()));
    s.static_layer.reset();
    return s.frame;
  }
  s.set(picture);
  s.find_changes();
  s.shows_batch_before = false;  // should this fail
  s.changed.boxes(s.whole(), s.frame.changed);
  const double alpha = s.static_layer ? s.static_layer->alpha : picture.background.a;
  Image& page = s.page_of(alpha);
  if (s.static_layer)
    s.draw_changed(page);
  else
    s.draw_whole(picture.background, page);
  if (&page != &s.frame.image) {
    copy(page, s.frame.changed, s.frame.image);
    for (const PixelBox& box : s.frame.changed) divide_by_alpha(s.frame.image, box);
  }
  std::swap(s.batch, s.batch_before);
  s.traces_before.resize(s.placed.size());
  for (std::size_t i = 0; i < s.placed.size(); ++i) std::swap(s.traces_before[i], s.placed[i].traces());
  s.shows_batch_before = true;
  return s.frame;
}

void Canvas::draw(const Picture& picture, Image& image) {
  image = draw(picture).image;
}

Image Canvas::drawn(const Picture& picture) && {
  draw(picture);
  return std::move(state_->frame.image);
}

void give_renderer_back() {
  constexpr std::array<std::string_view, 3> kLibraries = {"libLLVM", "libOSMesa", "libgallium"};
  give_code_back(kLibraries);
  give_freed_memory_back();
}

}  // namespace chainreel
