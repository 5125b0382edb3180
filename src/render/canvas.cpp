#include "render/canvas.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.hpp"
#include "core/machine.hpp"
#include "render/batch.hpp"
#include "render/changes.hpp"
#include "render/gl_context.hpp"
#include "render/gl_objects.hpp"
#include "render/glyph_atlas.hpp"
#include "render/solid_layer.hpp"
#include "render/windows.hpp"

namespace chainreel {
namespace {

std::string gl_string(const GlFunctions& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

// "llvmpipe (LLVM 15.0.6, 256 bits)" without the width of its vectors: that is the processor's and changes no byte.
std::string without_width(std::string renderer) {
  const std::size_t end = renderer.rfind(" bits)"), start = renderer.rfind(", ", end);
  if (end != std::string::npos && start != std::string::npos) renderer.erase(start, end + 5 - start);
  return renderer;
}

RendererInfo info_of(const GlContext& context) {
  return {context.backend(), without_width(gl_string(context.gl(), GL_RENDERER)), gl_string(context.gl(), GL_VERSION)};
}

// The longest side of a picture that the context can draw.
int largest_side(const GlFunctions& gl) {
  GLint texture = 0;
  std::array<GLint, 2> viewport{};
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  return std::min({texture, viewport[0], viewport[1]});
}

// The page, its layers and the image that is read back; measured with the renderer that draws without a screen.
constexpr double kBytesOfPixel = 20;

void require_size(int width, int height, int largest) {
  if (width >= 1 && height >= 1 && width <= largest && height <= largest)
    return require_memory(kBytesOfPixel * width * height,
                          "a picture of " + std::to_string(width) + "x" + std::to_string(height) + " px");
  throw Error(ExitCode::limit, "a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                                   " px cannot be drawn; each side must be 1 to " + std::to_string(largest) +
                                   " px");
}

// Blending needs colours multiplied by their opacity; outside, opacity is straight.
void divide_by_alpha(Image& image, const PixelBox& box) {
  for (int y = box.y; y < box.bottom(); ++y) {
    std::uint8_t* p = &image.bgra[std::size_t(4) * (std::size_t(y) * std::size_t(image.width) + std::size_t(box.x))];
    for (int x = 0; x < box.width; ++x, p += 4) {
      const int alpha = p[3];
      if (alpha == 0 || alpha == 255) continue;
      for (int k = 0; k < 3; ++k) p[k] = std::uint8_t(std::min(255, (255 * p[k] + alpha / 2) / alpha));
    }
  }
}

}  // namespace

struct Canvas::State {
  int width, height;
  std::unique_ptr<GlContext> context = create_gl_context();
  const GlFunctions& gl = context->gl();
  const int largest = largest_side(gl);
  Target page;
  std::optional<Target> static_layer, trail_layer;  // made when first used
  double static_alpha = 1;                          // of the static layer's background
  std::array<std::optional<PrimitiveProgram>, kPrimitives.size()> programs;
  std::optional<SolidLayer> solid_layer;
  GlyphAtlas atlas;
  GLuint atlas_texture = 0, cell_texture = 0;
  int atlas_version = 0;
  Batch batch, batch_before;           // of the picture that is drawn, and of the one that the page shows
  bool shows_batch_before = false;     // over the static layer
  std::vector<PlacedSolids> placed;          // of each group of bodies
  std::vector<SolidTraces> traces_before;    // of each group of the picture that the page shows
  TileMask changed;
  Windows windows;
  CanvasFrame frame;

  State(int w, int h, const Fonts& fonts)
      : width(w),
        height(h),
        page(checked(gl, w, h, largest), Target::Kind::color, w, h),
        atlas(fonts, largest),
        batch(w, h, atlas),
        batch_before(w, h, atlas),
        changed(w, h) {
    frame.image = Image(w, h);
    for (GLuint* texture : {&cell_texture, &atlas_texture}) {
      gl.GenTextures(1, texture);
      gl.BindTexture(GL_TEXTURE_2D, *texture);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.Viewport(0, 0, w, h);
    gl.Enable(GL_SCISSOR_TEST);
    gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }
  ~State() {
    context->make_current();
    gl.DeleteTextures(1, &atlas_texture);
    gl.DeleteTextures(1, &cell_texture);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  static const GlFunctions& checked(const GlFunctions& gl, int w, int h, int largest) {
    require_size(w, h, largest);
    return gl;
  }

  PixelBox whole() const { return {0, 0, width, height}; }

  void scissor(const PixelBox& box) const { gl.Scissor(box.x, box.y, box.width, box.height); }

  PrimitiveProgram& program(Primitive primitive) {
    auto& program = programs[std::size_t(primitive)];
    const PrimitiveRow& row = kPrimitives[std::size_t(primitive)];
    if (!program) program.emplace(gl, row.name, row.vectors, width, height);
    return *program;
  }

  void clear(const Color& background) const {
    const auto level = [&background](int c) { return float(background.a * c / 255); };
    scissor(whole());
    gl.ClearColor(level(background.r), level(background.g), level(background.b), float(background.a));
    gl.Clear(GL_COLOR_BUFFER_BIT);
  }

  void set(const Picture& picture) {
    atlas.trim();
    batch.set(picture);
    placed.resize(batch.solids().size());
    for (const Piece& piece : batch.pieces()) {
      if (piece.primitive != Primitive::solids) continue;
      if (!solid_layer) solid_layer.emplace(gl, width, height);
      const auto group = std::size_t(piece.instance);
      solid_layer->place(*batch.solids()[group], body_paint(piece), placed[group]);
    }
  }

  BodyPaint body_paint(const Piece& piece) const {
    const float* numbers = batch.numbers(piece);
    return {numbers[0], numbers[1], {numbers[4], numbers[5], numbers[6], numbers[7]}};
  }

  void upload() {
    for (std::size_t i = 0; i < kPrimitives.size(); ++i) {
      const std::vector<float>& instances = windows.instances(Primitive(i));
      if (!instances.empty()) program(Primitive(i)).upload(instances.data(), instances.size());
    }
    const bool has_glyphs = !windows.instances(Primitive::glyph).empty();
    if (!has_glyphs || atlas_version == atlas.version()) return;
    gl.BindTexture(GL_TEXTURE_2D, atlas_texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width(), atlas.height(), 0, GL_RED, GL_UNSIGNED_BYTE,
                  atlas.sheet().data());
    atlas_version = atlas.version();
  }

  void upload_cells(const CellSheet& sheet) const {
    gl.BindTexture(GL_TEXTURE_2D, cell_texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, sheet.width, sheet.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                  sheet.rgba.data());
  }

  void draw_trail(const Run& run, const Target& target) {
    if (!trail_layer) trail_layer.emplace(gl, Target::Kind::coverage, width, height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, trail_layer->framebuffer());
    // By drawing: with a scissor the renderer fills what it clears pixel by pixel, too, and this is less.
    gl.Disable(GL_BLEND);
    program(Primitive::flat).draw(run.first_to_clear, run.count_to_clear);
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_MAX);
    program(run.primitive).draw(run.first, run.count);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  }

  // Bodies are drawn aside and put down where they are.
  void draw_solids(const Run& run, const Target& target, const TileMask& tiles) {
    const Piece& piece = batch.pieces()[std::size_t(run.piece)];
    const PlacedSolids& group = placed[std::size_t(piece.instance)];
    TileMask touched(width, height);
    mark_difference(nullptr, &group.traces(), touched);
    touched.keep(tiles);
    std::vector<PixelBox> boxes;
    touched.boxes(piece.outline.box, boxes);
    if (boxes.empty()) return;
    solid_layer->draw(group, body_paint(piece), boxes, target);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  }

  // Everything of the batch that lies in the tiles, onto what is there.
  void draw_in(const TileMask& tiles, const Target& target) {
    windows.set(batch, tiles);
    upload();
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
    scissor(whole());
    gl.Enable(GL_BLEND);
    for (const Run& run : windows.runs()) {
      if (run.primitive == Primitive::trail) {
        draw_trail(run, target);
        continue;
      }
      if (run.primitive == Primitive::solids) {
        draw_solids(run, target, tiles);
        continue;
      }
      if (run.primitive == Primitive::glyph) gl.BindTexture(GL_TEXTURE_2D, atlas_texture);
      if (run.primitive == Primitive::layer) gl.BindTexture(GL_TEXTURE_2D, trail_layer->texture());
      if (run.primitive == Primitive::cells)
        upload_cells(batch.cell_sheets()[std::size_t(batch.pieces()[std::size_t(run.piece)].instance)]);
      program(run.primitive).draw(run.first, run.count);
    }
    gl.Disable(GL_BLEND);
  }

  void copy(const Target& from, const Target& to, const std::vector<PixelBox>& boxes) const {
    scissor(whole());
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer());
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer());
    for (const PixelBox& box : boxes)
      gl.BlitFramebuffer(box.x, box.y, box.right(), box.bottom(), box.x, box.y, box.right(), box.bottom(),
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }

  void read(const std::vector<PixelBox>& boxes, bool is_translucent) {
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, page.framebuffer());
    gl.PixelStorei(GL_PACK_ROW_LENGTH, width);
    for (const PixelBox& box : boxes) {
      const std::size_t first = std::size_t(box.y) * std::size_t(width) + std::size_t(box.x);
      gl.ReadPixels(box.x, box.y, box.width, box.height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                    frame.image.bgra.data() + 4 * first);
    }
    check_gl(gl, "drawing a picture");
    if (is_translucent)
      for (const PixelBox& box : boxes) divide_by_alpha(frame.image, box);
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

Canvas::Canvas(int width, int height, const Fonts& fonts)
    : state_(std::make_unique<State>(width, height, fonts)) {}

Canvas::~Canvas() = default;

RendererInfo Canvas::info() const {
  state_->context->make_current();
  return info_of(*state_->context);
}

void Canvas::set_static_layer(const Picture& picture) {
  State& s = *state_;
  s.context->make_current();
  if (!s.static_layer) s.static_layer.emplace(s.gl, Target::Kind::color, s.width, s.height);
  s.static_alpha = picture.background.a;
  s.shows_batch_before = false;
  s.set(picture);
  s.gl.BindFramebuffer(GL_FRAMEBUFFER, s.static_layer->framebuffer());
  s.clear(picture.background);
  s.changed.fill();
  s.draw_in(s.changed, *s.static_layer);
  check_gl(s.gl, "drawing the static layer");
}

const CanvasFrame& Canvas::draw(const Picture& picture) {
  State& s = *state_;
  s.context->make_current();
  s.set(picture);
  s.find_changes();
  s.shows_batch_before = false;  // should this fail
  s.changed.boxes(s.whole(), s.frame.changed);
  if (s.static_layer) {
    s.copy(*s.static_layer, s.page, s.frame.changed);
  } else {
    s.gl.BindFramebuffer(GL_FRAMEBUFFER, s.page.framebuffer());
    s.clear(picture.background);
  }
  s.draw_in(s.changed, s.page);
  s.read(s.frame.changed, (s.static_layer ? s.static_alpha : picture.background.a) < 1);
  std::swap(s.batch, s.batch_before);
  s.traces_before.resize(s.placed.size());
  for (std::size_t i = 0; i < s.placed.size(); ++i) std::swap(s.traces_before[i], s.placed[i].traces());
  s.shows_batch_before = true;
  return s.frame;
}

void Canvas::draw(const Picture& picture, Image& image) {
  image = draw(picture).image;
}

RendererInfo probe_renderer() {
  return info_of(*create_gl_context());
}

}  // namespace chainreel
