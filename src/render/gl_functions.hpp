// The OpenGL functions that are used, as a table filled by a context: the backends export them under
// different libraries, and none of these is linked.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <functional>

namespace chainreel {

#define CHAINREEL_GL_FUNCTIONS(X) \
  X(AttachShader)                 \
  X(BindBuffer)                   \
  X(BindFramebuffer)              \
  X(BindTexture)                  \
  X(BindVertexArray)              \
  X(BlendEquation)                \
  X(BlendFunc)                    \
  X(BufferData)                   \
  X(CheckFramebufferStatus)       \
  X(Clear)                        \
  X(ClearColor)                   \
  X(CompileShader)                \
  X(CreateProgram)                \
  X(CreateShader)                 \
  X(DeleteBuffers)                \
  X(DeleteFramebuffers)           \
  X(DeleteProgram)                \
  X(DeleteShader)                 \
  X(DeleteTextures)               \
  X(DeleteVertexArrays)           \
  X(Disable)                      \
  X(DrawElements)                 \
  X(Enable)                       \
  X(EnableVertexAttribArray)      \
  X(FramebufferTexture2D)         \
  X(GenBuffers)                   \
  X(GenFramebuffers)              \
  X(GenTextures)                  \
  X(GenVertexArrays)              \
  X(GetError)                     \
  X(GetIntegerv)                  \
  X(GetProgramInfoLog)            \
  X(GetProgramiv)                 \
  X(GetShaderInfoLog)             \
  X(GetShaderiv)                  \
  X(GetString)                    \
  X(GetUniformLocation)           \
  X(LinkProgram)                  \
  X(PixelStorei)                  \
  X(ReadPixels)                   \
  X(ShaderSource)                 \
  X(TexImage2D)                   \
  X(TexParameteri)                \
  X(TexSubImage2D)                \
  X(Uniform2f)                    \
  X(UseProgram)                   \
  X(VertexAttribPointer)          \
  X(Viewport)

struct GlFunctions {
#define CHAINREEL_GL_MEMBER(name) decltype(&gl##name) name = nullptr;
  CHAINREEL_GL_FUNCTIONS(CHAINREEL_GL_MEMBER)
#undef CHAINREEL_GL_MEMBER
};

using GlLookup = std::function<void (*(const char* name))()>;

// Throws Error (exit 4) naming the first function that `lookup` does not know.
GlFunctions load_gl_functions(const GlLookup& lookup);

}  // namespace chainreel
