#include "render/gl_context.hpp"

#include <sys/mman.h>

#include <atomic>
#include <cstdlib>
#include <mutex>

#include "core/error.hpp"
#include "render/canvas.hpp"
#include "render/gl_backend.hpp"
#include "render/renderer_pins.hpp"

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

constexpr Name kBackends[] = {{"auto", "for films OSMesa if it is there, else EGL; for a still none"},
                              {"osmesa", "Mesa's library for pictures in memory"},
                              {"egl", "Mesa without a screen, on the processor"},
                              {"none", "all is filled by chainreel itself"}};

std::atomic<GlBackend> chosen = GlBackend::automatic;

// What the library, the compiler in it and a first context map (185 MB were measured), and some more: each of two
// threads that start meanwhile maps 128 MiB for a moment, of which it keeps 64, for what it allocates.
constexpr std::size_t kAddressSpace = std::size_t(420) << 20;  // bytes

// Where it is short, the library does not say so but crashes. Mapped without access, it takes no memory, so that only a
// limit of the address space can refuse it.
void require_address_space() {
  void* const room = mmap(nullptr, kAddressSpace, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED)
    throw Error(ExitCode::limit, "the renderer needs " + std::to_string(kAddressSpace >> 20) +
                                     " MiB of address space, which a limit (ulimit -v) does not leave: raise it");
  munmap(room, kAddressSpace);
}

// Who names a renderer to Mesa means it.
bool names_renderer() {
  return std::getenv("GALLIUM_DRIVER") != nullptr;
}

// Any other renderer draws other bytes.
void require_llvmpipe(GlContext& context) {
  const auto* const text = reinterpret_cast<const char*>(context.gl().GetString(GL_RENDERER));
  const std::string renderer = text == nullptr ? "" : text;
  if (renderer.starts_with("llvmpipe") || names_renderer()) return;
  throw Error(ExitCode::no_renderer,
              context.backend() + " draws by " + renderer +
                  ", whose pictures have other bytes than those of llvmpipe: install the Debian package libosmesa6, or "
                  "name the renderer to Mesa (GALLIUM_DRIVER) to take it all the same");
}

// Where both libraries are missing, both are named.
std::unique_ptr<GlContext> create_any_context() {
  // Looked for once a process, so that all its contexts come from one library.
  static const bool has_osmesa = osmesa_is_there();
  if (has_osmesa) return create_osmesa_context();
  try {
    return create_egl_context();
  } catch (const Error& error) {
    if (error.code() != ExitCode::no_renderer) throw;
    throw Error(ExitCode::no_renderer, std::string(error.what()) + "; or install libosmesa6");
  }
}

std::unique_ptr<GlContext> create_chosen_context() {
  switch (chosen) {
    case GlBackend::osmesa: return create_osmesa_context();
    case GlBackend::egl: return create_egl_context();
    case GlBackend::automatic:
    case GlBackend::none: break;
  }
  return create_any_context();
}

}  // namespace

std::span<const Name> names_of(GlBackend) {
  return kBackends;
}

void choose_gl_backend(GlBackend backend) {
  chosen = backend;
}

bool opengl_draws(PageUse use) {
  if (chosen != GlBackend::automatic) return chosen != GlBackend::none;
  return use == PageUse::film || names_renderer();
}

std::unique_ptr<GlContext> create_gl_context() {
  static std::once_flag first;
  std::call_once(first, [] {
    settle_environment();
    require_address_space();
  });
  std::unique_ptr<GlContext> context = create_chosen_context();
  require_llvmpipe(*context);
  return context;
}

}  // namespace chainreel
