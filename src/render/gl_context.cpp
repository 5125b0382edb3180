#include "render/gl_context.hpp"

#include <atomic>
#include <cstdlib>
#include <mutex>

#include "core/error.hpp"
#include "render/canvas.hpp"

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

namespace {
std::atomic<bool> several_threads = false;
}

void fill_by_several_threads() {
  several_threads = true;
}

std::unique_ptr<GlContext> create_gl_context() {
  // Mesa reads the variable when its first context is made; without it there are as many threads as cores.
  static std::once_flag set;
  std::call_once(set, [] {
    if (!several_threads) setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
  });
  return create_osmesa_context();
}

}  // namespace chainreel
