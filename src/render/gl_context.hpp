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
  virtual std::string backend() const = 0;

  const GlFunctions& gl() const { return gl_; }

 protected:
  GlContext() = default;
  GlFunctions gl_;
};

// A current context of the first backend that works. Throws Error (exit 4) where none does.
std::unique_ptr<GlContext> create_gl_context();

// The backends; each throws Error (exit 4) saying what is missing.
std::unique_ptr<GlContext> create_osmesa_context();

}  // namespace chainreel
