// Owners of OpenGL objects, and the one place that looks at OpenGL errors.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "render/gl_context.hpp"

namespace chainreel {

// The name of a glGetError() code and what it means here.
std::string gl_error_text(GLenum error);
// Throws Error (exit 7 where memory ran out, exit 4 otherwise) if an OpenGL call since the last look has
// failed.
void check_gl(const GlFunctions& gl, const char* doing);

// The shader pair NAME.vert, NAME.frag as a program.
GLuint make_program(const GlFunctions& gl, std::string_view name);

// A texture that can be drawn into.
class Target {
 public:
  enum class Kind { color, coverage };  // BGRA bytes, or one byte a pixel

  Target(const GlFunctions& gl, Kind kind, int width, int height);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  GLuint framebuffer() const { return framebuffer_; }
  GLuint texture() const { return texture_; }

 private:
  const GlFunctions& gl_;
  GLuint texture_ = 0, framebuffer_ = 0;
};

// The shader pair NAME.vert, NAME.frag and the stream of its instances, each a window and `vectors` vec4 long.
class PrimitiveProgram {
 public:
  PrimitiveProgram(const GlFunctions& gl, std::string_view name, int vectors, int page_width,
                   int page_height);
  ~PrimitiveProgram();
  PrimitiveProgram(const PrimitiveProgram&) = delete;
  PrimitiveProgram& operator=(const PrimitiveProgram&) = delete;

  void upload(const float* instances, std::size_t floats);
  void draw(int first_instance, int count) const;  // of what was uploaded last

 private:
  const GlFunctions& gl_;
  int vectors_;
  GLuint program_ = 0, vertex_array_ = 0, buffer_ = 0, corners_ = 0;
  std::size_t has_corners_ = 0;  // of so many instances
  std::vector<float> vertices_;
};

// The texts of shaders/, embedded when the program is built.

struct EmbeddedShader {
  std::string_view name;  // "capsule.vert"
  std::string_view source;
};

extern const EmbeddedShader kEmbeddedShaders[];
extern const int kEmbeddedShaderCount;

// Throws Error (exit 4) for a name that is not embedded.
std::string_view shader_source(std::string_view name);

}  // namespace chainreel
