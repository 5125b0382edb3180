#include "render/solid_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "render/solid_bounds.hpp"

namespace chainreel {
namespace {

constexpr int kFinePage = 540;  // px of height: smaller pages take more samples a pixel, since they cost less
constexpr double kDepthMargin = 0.01;
constexpr int kGrain = 64;          // px: layers are as large as a multiple of it
constexpr double kBodyFringe = 2;  // px around bodies that may be touched: outlines are a pixel wide at least

int samples_for(int width, int height, int largest) {
  const int wanted = height <= kFinePage ? 4 : 2;
  const int possible = std::min(wanted, largest / std::max(width, height));
  return possible >= 4 ? 4 : possible >= 2 ? 2 : 1;
}

}  // namespace

struct SolidLayer::Buffers {
  const GlFunctions& gl;
  std::shared_ptr<const TriangleMesh> mesh;  // kept, so that no other mesh gets its place in memory
  MeshBounds bounds;
  std::size_t closed = 0, opaque = 0, all = 0;  // triangles, in this order
  GLuint array = 0, vertices = 0, indices = 0;

  Buffers(const GlFunctions& functions, std::shared_ptr<const TriangleMesh> whole)
      : gl(functions), mesh(std::move(whole)), bounds(bounds_of(*mesh)) {
    using Vertex = TriangleMesh::Vertex;
    for (const std::uint32_t index : mesh->triangles)
      if (index >= mesh->vertices.size())
        throw Error(ExitCode::bad_input, "a mesh has triangles between vertices that it does not have");
    const SortedTriangles sorted = closed_parts_first(*mesh);
    closed = sorted.closed;
    opaque = sorted.opaque;
    all = sorted.indices.size() / 3;
    gl.GenVertexArrays(1, &array);
    gl.GenBuffers(1, &vertices);
    gl.GenBuffers(1, &indices);
    gl.BindVertexArray(array);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices);
    gl.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(mesh->vertices.size() * sizeof(Vertex)), mesh->vertices.data(),
                  GL_STATIC_DRAW);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(sorted.indices.size() * sizeof(std::uint32_t)),
                  sorted.indices.data(), GL_STATIC_DRAW);
    const auto attribute = [&](GLuint location, GLint size, GLenum type, GLboolean normalized,
                               std::size_t at) {
      gl.EnableVertexAttribArray(location);
      gl.VertexAttribPointer(location, size, type, normalized, GLsizei(sizeof(Vertex)),
                             reinterpret_cast<const void*>(std::uintptr_t(at)));
    };
    attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
    attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
    attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, color));
    check_gl(gl, "taking a mesh");
  }
  ~Buffers() {
    gl.DeleteBuffers(1, &indices);
    gl.DeleteBuffers(1, &vertices);
    gl.DeleteVertexArrays(1, &array);
  }
  Buffers(const Buffers&) = delete;
  Buffers& operator=(const Buffers&) = delete;
};

struct SolidLayer::Program {
  const GlFunctions& gl;
  GLuint program;
  std::array<GLint, 3> rows{};
  GLint page_px, page, own_color, depth;

  explicit Program(const GlFunctions& functions) : gl(functions), program(make_program(functions, "solid")) {
    gl.UseProgram(program);
    const auto place = [&](const char* name) { return gl.GetUniformLocation(program, name); };
    page_px = place("page_px");
    rows = {place("row_x"), place("row_y"), place("row_z")};
    page = place("page");
    own_color = place("own_color");
    depth = place("depth");
  }
  ~Program() { gl.DeleteProgram(program); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
};

struct SolidLayer::SampleTarget {
  Target color;
  const GlFunctions& gl;
  int width, height;
  GLuint depth = 0;

  SampleTarget(const GlFunctions& functions, int w, int h)
      : color(functions, Target::Kind::color, w, h), gl(functions), width(w), height(h) {
    gl.GenRenderbuffers(1, &depth);
    gl.BindRenderbuffer(GL_RENDERBUFFER, depth);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, color.framebuffer());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    check_gl(gl, "making room for bodies");
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw Error(ExitCode::no_renderer, "OpenGL offers no depth for a picture of " + std::to_string(width) +
                                             "x" + std::to_string(height));
  }
  ~SampleTarget() { gl.DeleteRenderbuffers(1, &depth); }
  SampleTarget(const SampleTarget&) = delete;
  SampleTarget& operator=(const SampleTarget&) = delete;
};

SolidLayer::SolidLayer(const GlFunctions& gl, int width, int height, int largest)
    : gl_(gl),
      width_(width),
      height_(height),
      samples_(samples_for(width, height, largest)),
      largest_(largest),
      program_(std::make_unique<Program>(gl)),
      page_(gl, Target::Kind::color, width, height) {}

SolidLayer::~SolidLayer() = default;

GLuint SolidLayer::texture() const {
  return page_.texture();
}

const SolidLayer::Buffers& SolidLayer::buffers_of(const std::shared_ptr<const TriangleMesh>& mesh) {
  std::unique_ptr<Buffers>& own = meshes_[mesh.get()];
  if (!own) own = std::make_unique<Buffers>(gl_, mesh);
  return *own;
}

void SolidLayer::draw_part(const Solid& solid, const Buffers& buffers, const Solids& solids,
                           const SolidBounds& bounds, const PixelBox& frame, Pass pass) {
  for (std::size_t r = 0; r < 3; ++r) {
    const double* row = &solid.to_view[4 * r];
    gl_.Uniform4f(program_->rows[r], float(row[0]), float(row[1]), float(row[2]), float(row[3]));
  }
  gl_.Uniform4f(program_->page, float(height_ * solids.origin.x - frame.x), float(height_ * (1 - solids.origin.y) - frame.y),
                float(height_ * solids.scale), float(solids.nearness));
  const std::optional<Color> color = solids.is_shadow ? solids.outline.faded(1) : solid.color;
  if (color)
    gl_.Uniform4f(program_->own_color, float(color->r) / 255, float(color->g) / 255, float(color->b) / 255,
                  float(solids.is_shadow ? 1 : color->a));
  else
    gl_.Uniform4f(program_->own_color, 0, 0, 0, -1);
  // Clip space runs from -1 for the nearest point to 1 for the farthest, before the division by w.
  const double margin = kDepthMargin * (bounds.nearest - bounds.farthest) + 1e-9;
  const double near = solids.nearness > 0 ? std::min(bounds.nearest + margin, 0.99 / solids.nearness)
                                          : bounds.nearest + margin;
  const double far = bounds.farthest - margin;
  const double w_near = 1 - near * solids.nearness, w_far = 1 - far * solids.nearness;
  const double slope = -(w_near + w_far) / (near - far);
  gl_.Uniform4f(program_->depth, float(slope), float(-w_near - slope * near), solids.is_shadow ? 0.f : 1.f,
                0);
  gl_.BindVertexArray(buffers.array);
  const auto draw = [&](std::size_t first, std::size_t end) {
    if (end > first)
      gl_.DrawElements(GL_TRIANGLES, GLsizei(3 * (end - first)), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(3 * first * sizeof(std::uint32_t)));
  };
  // A colour of its own holds for all triangles.
  const bool one_color = color.has_value();
  if (pass == Pass::translucent) return draw(one_color ? 0 : buffers.opaque, buffers.all);
  // The inside of a closed part is never seen, and half of its triangles need not be filled.
  gl_.Enable(GL_CULL_FACE);
  draw(0, buffers.closed);
  gl_.Disable(GL_CULL_FACE);
  draw(buffers.closed, one_color ? buffers.all : buffers.opaque);
}

// The middle of the mesh's box, towards the viewer, m.
double SolidLayer::depth_of(const Solid& solid, const Buffers& buffers) {
  double z = solid.to_view[11];
  for (std::size_t i = 0; i < 3; ++i)
    z += solid.to_view[8 + i] * (buffers.bounds.lower[i] + buffers.bounds.upper[i]) / 2;
  return z;
}

std::vector<MeshBounds> SolidLayer::bounds_of_parts(const Solids& solids) {
  std::vector<MeshBounds> boxes;
  for (const Solid& solid : solids.parts) boxes.push_back(buffers_of(solid.mesh).bounds);
  return boxes;
}

// The tiles around each part, not around all: arms and legs leave most of the box around them empty.
void SolidLayer::touch(const Solids& solids, TileMask& tiles) {
  const std::vector<MeshBounds> boxes = bounds_of_parts(solids);
  Solids part = solids;
  for (std::size_t i = 0; i < solids.parts.size(); ++i) {
    part.parts = {solids.parts[i]};
    const std::optional<SolidBounds> bounds = bounds_of(part, {boxes[i]});
    if (!bounds) continue;
    tiles.mark_box(pixels_of(*bounds));
  }
}

// Those of the page that it may touch.
PixelBox SolidLayer::pixels_of(const SolidBounds& bounds) const {
  const auto pixel = [](double edge, int side) { return int(std::clamp(edge, 0.0, double(side))); };
  const Rect& r = bounds.page;
  return box_between(pixel(std::floor(height_ * r.x0 - kBodyFringe), width_),
                     pixel(std::floor(height_ * (1 - r.y1) - kBodyFringe), height_),
                     pixel(std::ceil(height_ * r.x1 + kBodyFringe), width_),
                     pixel(std::ceil(height_ * (1 - r.y0) + kBodyFringe), height_));
}

// The layer. It depends on nothing but the bodies: where it lies bears on the last bit of
// their places.
PixelBox SolidLayer::frame_of(const SolidBounds& bounds) const {
  const PixelBox box = pixels_of(bounds);
  const auto grown = [this](int side) { return std::min((side + kGrain - 1) / kGrain * kGrain, largest_ / samples_); };
  return {box.x, box.y, grown(box.width), grown(box.height)};
}

// All of the target is cleared: a part of it would be filled sample by sample.
void SolidLayer::begin(const PixelBox& frame) {
  const int width = samples_ * frame.width, height = samples_ * frame.height;
  if (!target_ || target_->width < width || target_->height < height) {
    const int most_width = std::max(width, target_ ? target_->width : 0), most_height = std::max(height, target_ ? target_->height : 0);
    target_.reset();
    target_ = std::make_unique<SampleTarget>(gl_, most_width, most_height);
  }
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_->color.framebuffer());
  gl_.Viewport(0, 0, width, height);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.DepthMask(GL_TRUE);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void SolidLayer::draw_parts(const Solids& solids, const SolidBounds& bounds, const PixelBox& frame) {
  std::vector<const Buffers*> buffers;
  for (const Solid& solid : solids.parts) buffers.push_back(&buffers_of(solid.mesh));
  gl_.Enable(GL_DEPTH_TEST);
  gl_.FrontFace(GL_CW);  // counter-clockwise triangles, in pictures whose y points down
  gl_.UseProgram(program_->program);
  gl_.Uniform2f(program_->page_px, float(frame.width), float(frame.height));
  // What shines through comes last, farthest first, and hides nothing.
  std::vector<std::size_t> translucent;
  for (std::size_t i = 0; i < solids.parts.size(); ++i) {
    const std::optional<Color>& color = solids.parts[i].color;
    const bool whole = color && color->a < 1, some = !color && buffers[i]->opaque < buffers[i]->all;
    if (solids.is_shadow || !whole) draw_part(solids.parts[i], *buffers[i], solids, bounds, frame, Pass::opaque);
    if (!solids.is_shadow && (whole || some)) translucent.push_back(i);
  }
  std::stable_sort(translucent.begin(), translucent.end(), [&](std::size_t a, std::size_t b) {
    return depth_of(solids.parts[a], *buffers[a]) < depth_of(solids.parts[b], *buffers[b]);
  });
  gl_.DepthMask(GL_FALSE);
  for (const std::size_t i : translucent)
    draw_part(solids.parts[i], *buffers[i], solids, bounds, frame, Pass::translucent);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_DEPTH_TEST);
}

void SolidLayer::read(const PixelBox& frame, const PixelBox& wanted) {
  // The layer may reach out of the page: what lies there has no line within it, at any side.
  read_.box = common_part(common_part(frame, {0, 0, width_, height_}), wanted);
  read_.per_side = samples_;
  const PixelBox& box = read_.box;
  read_.rgba.resize(std::size_t(4) * std::size_t(samples_ * samples_) * std::size_t(box.width) * std::size_t(box.height));
  gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
  gl_.ReadPixels(samples_ * (box.x - frame.x), samples_ * (box.y - frame.y), samples_ * box.width,
                 samples_ * box.height, GL_RGBA, GL_UNSIGNED_BYTE, read_.rgba.data());
}

// Tile by tile, since most are empty.
void SolidLayer::put(const PixelBox& box, const BodyPixels& pixels, BoxJoiner& shown) {
  constexpr int kSide = TileMask::kSide;
  for (int top = box.y; top < box.bottom(); top = (top / kSide + 1) * kSide)
    for (int left = box.x; left < box.right(); left = (left / kSide + 1) * kSide) {
      const PixelBox tile = common_part(box, {left / kSide * kSide, top / kSide * kSide, kSide, kSide});
      if (!pixels.draw(tile, rgba_)) continue;
      gl_.TexSubImage2D(GL_TEXTURE_2D, 0, tile.x, tile.y, tile.width, tile.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
      shown.add(tile);
    }
}

const std::vector<PixelBox>& SolidLayer::draw(const Solids& solids, const BodyPaint& paint,
                                              const std::vector<PixelBox>& boxes) {
  shown_.clear();
  const std::optional<SolidBounds> bounds = bounds_of(solids, bounds_of_parts(solids));
  if (!bounds) return shown_;
  const PixelBox frame = frame_of(*bounds);
  if (frame.empty()) return shown_;
  begin(frame);
  draw_parts(solids, *bounds, frame);
  // A line looks for bodies beyond its own pixel.
  const int rim = int(std::ceil(paint.radius)) + 1;
  const PixelBox all = box_around(boxes);
  read(frame, {all.x - rim, all.y - rim, all.width + 2 * rim, all.height + 2 * rim});
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Viewport(0, 0, width_, height_);
  if (read_.box.empty()) return shown_;
  const BodyPixels pixels(read_, paint);
  gl_.BindTexture(GL_TEXTURE_2D, page_.texture());
  BoxJoiner shown(shown_);
  for (const PixelBox& box : boxes) put(box, pixels, shown);
  return shown_;
}

}  // namespace chainreel
