#include "render/gl_painter.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/machine.hpp"

namespace chainreel {
namespace {

std::string gl_string(const GlFunctions& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

// "llvmpipe (LLVM 15.0.6, 256 bits)" without the width of its vectors: that is the processor's and changes no
// byte.
std::string without_width(std::string renderer) {
  const std::size_t end = renderer.rfind(" bits)"), start = renderer.rfind(", ", end);
  if (end != std::string::npos && start != std::string::npos) renderer.erase(start, end + 5 - start);
  return renderer;
}

}  // namespace

RendererInfo info_of(const GlContext& context) {
  return {context.backend(), without_width(gl_string(context.gl(), GL_RENDERER)),
          gl_string(context.gl(), GL_VERSION)};
}

namespace {

// The longest side of a picture that the context can draw.
int measured_side(const GlFunctions& gl) {
  GLint texture = 0;
  std::array<GLint, 2> viewport{};
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  return std::min({texture, viewport[0], viewport[1]});
}

// The page, a trail's layer, what is read back and what lies under it; measured with the renderer that draws
// without a screen.
constexpr double kBytesOfPixel = 20;

std::string words_of_page(int width, int height) {
  return "a picture of " + std::to_string(width) + "x" + std::to_string(height) + " px";
}

void require_sides(int width, int height, int largest) {
  if (std::min(width, height) < 1 || std::max(width, height) > largest)
    throw Error(ExitCode::limit, words_of_page(width, height) + " cannot be drawn; each side must be 1 to " + std::to_string(largest) + " px");
}

// The functions of a context that can draw such a page.
const GlFunctions& functions_for(const GlContext& context, int width, int height) {
  require_sides(width, height, measured_side(context.gl()));
  return context.gl();
}

}  // namespace

void require_page(int width, int height) {
  require_sides(width, height, GlyphAtlas::kLargestSide);
  require_memory(kBytesOfPixel * width * height, words_of_page(width, height));
}

std::array<float, 4> cleared_to(const Color& background) {
  const auto level = [&background](int c) { return float(background.a * c / 255); };
  return {level(background.r), level(background.g), level(background.b), float(background.a)};
}

GlPainter::GlPainter(int width, int height)
    : width_(width),
      height_(height),
      context_(create_gl_context()),
      gl_(functions_for(*context_, width, height)),
      page_(gl_, Target::Kind::color, width, height) {
  for (GLuint* texture : {&cell_texture_, &atlas_texture_}) {
    gl_.GenTextures(1, texture);
    gl_.BindTexture(GL_TEXTURE_2D, *texture);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.Viewport(0, 0, width, height);
  gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

GlPainter::~GlPainter() {
  context_->make_current();
  gl_.DeleteTextures(1, &atlas_texture_);
  gl_.DeleteTextures(1, &cell_texture_);
}

void GlPainter::get_ready() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, page_.framebuffer());
  gl_.Enable(GL_BLEND);
  const std::uint8_t nothing = 0;
  gl_.BindTexture(GL_TEXTURE_2D, atlas_texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, 1, 1, 0, GL_RED, GL_UNSIGNED_BYTE, &nothing);
  for (const Primitive primitive : {Primitive::capsule, Primitive::glyph}) {
    const std::vector<float> empty(std::size_t(Windows::floats_of(primitive)));
    program(primitive).upload(empty.data(), empty.size());
    program(primitive).draw(0, 1);
  }
  gl_.Disable(GL_BLEND);
  check_gl(gl_, "getting ready");
  context_->release();
}

RendererInfo GlPainter::info() const {
  context_->make_current();
  return info_of(*context_);
}

PrimitiveProgram& GlPainter::program(Primitive primitive) {
  auto& program = programs_[std::size_t(primitive)];
  const PrimitiveRow& row = kPrimitives[std::size_t(primitive)];
  if (!program) program.emplace(gl_, row.name, row.vectors, width_, height_);
  return *program;
}

void GlPainter::upload(const Windows& windows, const GlyphAtlas& atlas) {
  for (std::size_t i = 0; i < kPrimitives.size(); ++i) {
    const std::vector<float>& instances = windows.instances(Primitive(i));
    if (!instances.empty()) program(Primitive(i)).upload(instances.data(), instances.size());
  }
  if (windows.instances(Primitive::glyph).empty() || atlas_version_ == atlas.version()) return;
  gl_.BindTexture(GL_TEXTURE_2D, atlas_texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width(), atlas.height(), 0, GL_RED, GL_UNSIGNED_BYTE,
                 atlas.sheet().data());
  atlas_version_ = atlas.version();
}

void GlPainter::upload_cells(const CellSheet& sheet) const {
  gl_.BindTexture(GL_TEXTURE_2D, cell_texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, sheet.width, sheet.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 sheet.rgba.data());
}

void GlPainter::draw_trail(const Run& run) {
  if (!trail_layer_) trail_layer_.emplace(gl_, Target::Kind::coverage, width_, height_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, trail_layer_->framebuffer());
  // By drawing: with a scissor the renderer fills what it clears pixel by pixel, too, and this is less.
  gl_.Disable(GL_BLEND);
  program(Primitive::flat).draw(run.first_to_clear, run.count_to_clear);
  gl_.Enable(GL_BLEND);
  gl_.BlendEquation(GL_MAX);
  program(run.primitive).draw(run.first, run.count);
  gl_.BlendEquation(GL_FUNC_ADD);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, page_.framebuffer());
}

void GlPainter::draw(const Color& background, const Windows& windows, const Batch& batch,
                     const GlyphAtlas& atlas, const std::function<void(const Run&)>& draw_solids) {
  context_->make_current();
  upload(windows, atlas);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, page_.framebuffer());
  const auto [r, g, b, a] = cleared_to(background);
  gl_.ClearColor(r, g, b, a);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  gl_.Enable(GL_BLEND);
  for (const Run& run : windows.runs()) {
    if (run.primitive == Primitive::trail) {
      draw_trail(run);
      continue;
    }
    if (run.primitive == Primitive::solids) {
      draw_solids(run);
      continue;
    }
    if (run.primitive == Primitive::glyph) gl_.BindTexture(GL_TEXTURE_2D, atlas_texture_);
    if (run.primitive == Primitive::layer) gl_.BindTexture(GL_TEXTURE_2D, trail_layer_->texture());
    if (run.primitive == Primitive::cells)
      upload_cells(batch.cell_sheets()[std::size_t(batch.pieces()[std::size_t(run.piece)].instance)]);
    program(run.primitive).draw(run.first, run.count);
  }
  gl_.Disable(GL_BLEND);
  check_gl(gl_, "drawing a picture");
}

void GlPainter::read(const std::vector<PixelBox>& boxes, Image& image) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, page_.framebuffer());
  gl_.PixelStorei(GL_PACK_ROW_LENGTH, width_);
  for (const PixelBox& box : boxes)
    gl_.ReadPixels(box.x, box.y, box.width, box.height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                   first_byte(image.bgra.data(), box));
  check_gl(gl_, "reading a picture");
}

void GlPainter::write(const std::vector<PixelBox>& boxes, const Image& image) const {
  gl_.BindTexture(GL_TEXTURE_2D, page_.texture());
  gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, width_);
  for (const PixelBox& box : boxes)
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, box.x, box.y, box.width, box.height, GL_BGRA,
                      GL_UNSIGNED_INT_8_8_8_8_REV, first_byte(image.bgra.data(), box));
  gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

}  // namespace chainreel
