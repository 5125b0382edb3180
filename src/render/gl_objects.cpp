#include "render/gl_objects.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "core/error.hpp"

namespace chainreel {

std::string gl_error_text(GLenum error) {
  switch (error) {
    case GL_NO_ERROR:
      return "no error";
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY: choose a smaller picture";
    default:
      return "error " + std::to_string(error);
  }
}

void check_gl(const GlFunctions& gl, const char* doing) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return;
  const ExitCode code = error == GL_OUT_OF_MEMORY ? ExitCode::limit : ExitCode::no_renderer;
  throw Error(code, std::string("OpenGL failed while ") + doing + ": " + gl_error_text(error));
}

Target::Target(const GlFunctions& gl, Kind kind, int width, int height) : gl_(gl) {
  gl_.GenTextures(1, &texture_);
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  if (kind == Kind::color) {
    // Stored as it will be read: any other order costs a conversion per frame and the renderer's fast paths.
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                   nullptr);
  } else {
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
  }
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  check_gl(gl_, "making room for the picture");
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ExitCode::no_renderer, "OpenGL cannot draw into a picture of " + std::to_string(width) + "x" +
                                           std::to_string(height));
}

Target::~Target() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &texture_);
}

namespace {

GLuint compile(const GlFunctions& gl, GLenum stage, const std::string& name) {
  const GLuint shader = gl.CreateShader(stage);
  const std::string_view head = shader_source(stage == GL_VERTEX_SHADER ? "page.glsl" : "paint.glsl");
  const std::string_view body = shader_source(name);
  const std::array<const GLchar*, 2> texts = {head.data(), body.data()};
  const std::array<GLint, 2> lengths = {GLint(head.size()), GLint(body.size())};
  gl.ShaderSource(shader, GLsizei(texts.size()), texts.data(), lengths.data());
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;

  std::array<GLchar, 1024> log{};
  gl.GetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
  gl.DeleteShader(shader);
  throw Error(ExitCode::no_renderer, "shader " + name + " does not compile: " + log.data());
}

void link(const GlFunctions& gl, GLuint program, const std::string& name) {
  gl.LinkProgram(program);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;

  std::array<GLchar, 1024> log{};
  gl.GetProgramInfoLog(program, GLsizei(log.size()), nullptr, log.data());
  throw Error(ExitCode::no_renderer, "shader pair " + name + " does not link: " + log.data());
}

}  // namespace

GLuint make_program(const GlFunctions& gl, std::string_view name) {
  const GLuint program = gl.CreateProgram();
  try {
    for (const auto& [stage, ending] :
         {std::pair(GL_VERTEX_SHADER, ".vert"), std::pair(GL_FRAGMENT_SHADER, ".frag")}) {
      const GLuint shader = compile(gl, GLenum(stage), std::string(name) + ending);
      gl.AttachShader(program, shader);
      gl.DeleteShader(shader);  // lives on while attached
    }
    link(gl, program, std::string(name));
  } catch (...) {
    gl.DeleteProgram(program);
    throw;
  }
  return program;
}

PrimitiveProgram::PrimitiveProgram(const GlFunctions& gl, std::string_view name, int vectors, int page_width,
                                   int page_height)
    : gl_(gl), vectors_(vectors) {
  program_ = make_program(gl_, name);
  gl_.UseProgram(program_);
  gl_.Uniform2f(gl_.GetUniformLocation(program_, "page_px"), float(page_width), float(page_height));

  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.GenBuffers(1, &buffer_);
  gl_.GenBuffers(1, &corners_);
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, corners_);
  constexpr std::size_t kVectorBytes = 4 * sizeof(float);
  const std::size_t all = std::size_t(1 + vectors_);  // the window comes first
  for (std::size_t i = 0; i < all; ++i) {
    gl_.EnableVertexAttribArray(GLuint(i));
    gl_.VertexAttribPointer(GLuint(i), 4, GL_FLOAT, GL_FALSE, GLsizei(all * kVectorBytes),
                            reinterpret_cast<const void*>(std::uintptr_t(i * kVectorBytes)));
  }
  check_gl(gl_, "preparing the shaders");
}

PrimitiveProgram::~PrimitiveProgram() {
  gl_.DeleteBuffers(1, &corners_);
  gl_.DeleteBuffers(1, &buffer_);
  gl_.DeleteVertexArrays(1, &vertex_array_);
  gl_.DeleteProgram(program_);
}

// Each corner bears all numbers of its instance: drawn as instances, each would pass the renderer's stages alone, at the
// price of some 100 pixels.
void PrimitiveProgram::upload(const float* instances, std::size_t floats) {
  const std::size_t size = std::size_t(4 * (1 + vectors_)), count = floats / size;
  vertices_.clear();
  for (std::size_t i = 0; i < count; ++i)
    for (int corner = 0; corner < 4; ++corner)
      vertices_.insert(vertices_.end(), instances + i * size, instances + (i + 1) * size);
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices_.size() * sizeof(float)), vertices_.data(), GL_STREAM_DRAW);
  if (count <= has_corners_) return;
  has_corners_ = std::max(count, 2 * has_corners_);
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < has_corners_; ++i)
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) corners.push_back(4 * i + corner);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(corners.size() * sizeof(corners[0])), corners.data(),
                 GL_STATIC_DRAW);
}

void PrimitiveProgram::draw(int first_instance, int count) const {
  gl_.UseProgram(program_);
  gl_.BindVertexArray(vertex_array_);
  gl_.DrawElements(GL_TRIANGLES, 6 * GLsizei(count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(6 * sizeof(std::uint32_t) * std::size_t(first_instance)));
}

std::string_view shader_source(std::string_view name) {
  for (const EmbeddedShader& shader : std::span(kEmbeddedShaders, std::size_t(kEmbeddedShaderCount)))
    if (shader.name == name) return shader.source;
  throw Error(ExitCode::no_renderer, "shader " + std::string(name) + " is not part of this build");
}

}  // namespace chainreel
