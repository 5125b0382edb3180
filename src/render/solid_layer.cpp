#include "render/solid_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "render/gl_objects.hpp"
#include "render/solid_bounds.hpp"

namespace chainreel {
namespace {

constexpr int kFinePage = 540;  // px of height: smaller pages take more samples a pixel, since they cost less
constexpr double kDepthMargin = 0.01;
constexpr int kRim = TileMask::kSide;  // px around what is asked for that is drawn, too
constexpr double kBodyFringe = 2;  // px around bodies that may be touched: outlines are a pixel wide at least

int samples_for(int width, int height, int largest) {
  const int wanted = height <= kFinePage ? 4 : 2;
  return std::max(1, std::min(wanted, largest / std::max(width, height)));
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
  GLint page, own_color, depth;

  Program(const GlFunctions& functions, int width, int height)
      : gl(functions), program(make_program(functions, "solid")) {
    gl.UseProgram(program);
    const auto place = [&](const char* name) { return gl.GetUniformLocation(program, name); };
    gl.Uniform2f(place("page_px"), float(width), float(height));
    rows = {place("row_x"), place("row_y"), place("row_z")};
    page = place("page");
    own_color = place("own_color");
    depth = place("depth");
  }
  ~Program() { gl.DeleteProgram(program); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
};

struct SolidLayer::Target {
  chainreel::Target color;
  const GlFunctions& gl;
  GLuint depth = 0;

  Target(const GlFunctions& functions, int width, int height)
      : color(functions, chainreel::Target::Kind::color, width, height), gl(functions) {
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
  ~Target() { gl.DeleteRenderbuffers(1, &depth); }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
};

SolidLayer::SolidLayer(const GlFunctions& gl, int width, int height, int largest)
    : gl_(gl),
      width_(width),
      height_(height),
      samples_(samples_for(width, height, largest)),
      program_(std::make_unique<Program>(gl, width, height)),
      target_(std::make_unique<Target>(gl, samples_ * width, samples_ * height)) {}

SolidLayer::~SolidLayer() = default;

GLuint SolidLayer::texture() const {
  return target_->color.texture();
}

const SolidLayer::Buffers& SolidLayer::buffers_of(const std::shared_ptr<const TriangleMesh>& mesh) {
  std::unique_ptr<Buffers>& own = meshes_[mesh.get()];
  if (!own) own = std::make_unique<Buffers>(gl_, mesh);
  return *own;
}

void SolidLayer::draw_part(const Solid& solid, const Buffers& buffers, const Solids& solids,
                           const SolidBounds& bounds, Pass pass) {
  for (std::size_t r = 0; r < 3; ++r) {
    const double* row = &solid.to_view[4 * r];
    gl_.Uniform4f(program_->rows[r], float(row[0]), float(row[1]), float(row[2]), float(row[3]));
  }
  gl_.Uniform4f(program_->page, float(height_ * solids.origin.x), float(height_ * (1 - solids.origin.y)),
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
    const auto pixel = [](double edge, int largest) { return int(std::clamp(edge, -1.0, largest + 1.0)); };
    const Rect& r = bounds->page;
    tiles.mark_box(box_between(pixel(std::floor(height_ * r.x0 - kBodyFringe), width_),
                               pixel(std::floor(height_ * (1 - r.y1) - kBodyFringe), height_),
                               pixel(std::ceil(height_ * r.x1 + kBodyFringe), width_),
                               pixel(std::ceil(height_ * (1 - r.y0) + kBodyFringe), height_)));
  }
}

// With a rim, since an outline looks for bodies beyond its own pixel.
void SolidLayer::clear(const std::vector<PixelBox>& boxes) const {
  gl_.DepthMask(GL_TRUE);
  gl_.ClearColor(0, 0, 0, 0);
  for (const PixelBox& box : boxes) {
    gl_.Scissor(samples_ * (box.x - kRim), samples_ * (box.y - kRim), samples_ * (box.width + 2 * kRim),
                samples_ * (box.height + 2 * kRim));
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
}

void SolidLayer::draw(const Solids& solids, const std::vector<PixelBox>& touched) {
  const std::vector<MeshBounds> boxes = bounds_of_parts(solids);
  const std::optional<SolidBounds> bounds = bounds_of(solids, boxes);
  if (!bounds) return;
  std::vector<const Buffers*> buffers;
  for (const Solid& solid : solids.parts) buffers.push_back(&buffers_of(solid.mesh));

  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_->color.framebuffer());
  gl_.Viewport(0, 0, samples_ * width_, samples_ * height_);
  clear(touched);
  const PixelBox all = box_around(touched);
  gl_.Scissor(samples_ * (all.x - kRim), samples_ * (all.y - kRim), samples_ * (all.width + 2 * kRim),
              samples_ * (all.height + 2 * kRim));
  gl_.Enable(GL_DEPTH_TEST);
  gl_.FrontFace(GL_CW);  // counter-clockwise triangles, in pictures whose y points down
  gl_.UseProgram(program_->program);
  // What shines through comes last, farthest first, and hides nothing.
  std::vector<std::size_t> translucent;
  for (std::size_t i = 0; i < solids.parts.size(); ++i) {
    const std::optional<Color>& color = solids.parts[i].color;
    const bool whole = color && color->a < 1, some = !color && buffers[i]->opaque < buffers[i]->all;
    if (solids.is_shadow || !whole) draw_part(solids.parts[i], *buffers[i], solids, *bounds, Pass::opaque);
    if (!solids.is_shadow && (whole || some)) translucent.push_back(i);
  }
  std::stable_sort(translucent.begin(), translucent.end(), [&](std::size_t a, std::size_t b) {
    return depth_of(solids.parts[a], *buffers[a]) < depth_of(solids.parts[b], *buffers[b]);
  });
  gl_.DepthMask(GL_FALSE);
  for (const std::size_t i : translucent)
    draw_part(solids.parts[i], *buffers[i], solids, *bounds, Pass::translucent);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Viewport(0, 0, width_, height_);
}

}  // namespace chainreel
