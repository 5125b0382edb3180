// One off-screen OpenGL 3.3 core context, whoever provides it. Current in one thread at a time.
#pragma once

#include <memory>
#include <string>

#include "render/gl_functions.hpp"

namespace chainreel {

class GlContext {
 public:
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  virtual void make_current() = 0;
  // From the thread where it is current: another one may make it current then.
  virtual void release() = 0;
  virtual std::string backend() const = 0;

  const GlFunctions& gl() const { return gl_; }

 protected:
  GlContext() = default;
  GlFunctions gl_;
};

// A current context of the chosen backend. Throws Error (exit 4) saying what is missing, and where it would not draw by
// llvmpipe, unless the environment names another renderer to Mesa; exit 7 where the address space is too short.
std::unique_ptr<GlContext> create_gl_context();

// The backends, for the above.
bool osmesa_is_there();
std::unique_ptr<GlContext> create_osmesa_context();
std::unique_ptr<GlContext> create_egl_context();

}  // namespace chainreel
