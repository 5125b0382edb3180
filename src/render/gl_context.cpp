#include "render/gl_context.hpp"

#include <cstdlib>
#include <mutex>

#include "core/error.hpp"

namespace chainreel {

GlFunctions load_gl_functions(const GlLookup& lookup) {
  GlFunctions gl;
#define CHAINREEL_GL_LOAD(name)                                      \
  gl.name = reinterpret_cast<decltype(gl.name)>(lookup("gl" #name)); \
  if (gl.name == nullptr) throw Error(ExitCode::no_renderer, "the OpenGL library has no function gl" #name);
  CHAINREEL_GL_FUNCTIONS(CHAINREEL_GL_LOAD)
#undef CHAINREEL_GL_LOAD
  return gl;
}

std::unique_ptr<GlContext> create_gl_context() {
  // Flat pictures are drawn faster by the calling thread alone, and films are drawn by several threads with a
  // context each. Mesa reads the variable when its first context is made.
  static std::once_flag set;
  std::call_once(set, [] { setenv("LP_NUM_THREADS", "0", /*overwrite=*/0); });
  return create_osmesa_context();
}

}  // namespace chainreel
