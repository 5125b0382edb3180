#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <cstdint>

#include "core/error.hpp"
#include "render/gl_context.hpp"

namespace chainreel {

// The backend that needs neither display nor device: Mesa's OSMesa, which renders on the processor.

namespace {

constexpr const char* kOsmesa = "libOSMesa.so.8";

// Opened once and never closed: its LLVM leaves behind threads' destructors that would outlive it.
struct OsmesaLibrary {
  decltype(&OSMesaCreateContextAttribs) create_context = nullptr;
  decltype(&OSMesaDestroyContext) destroy_context = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetCurrentContext) current_context = nullptr;
  decltype(&OSMesaGetProcAddress) proc_address = nullptr;

  OsmesaLibrary() {
    void* library = dlopen(kOsmesa, RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr)
      throw Error(ExitCode::no_renderer, std::string("no OpenGL renderer: ") + dlerror() +
                                             "; install the Debian package libosmesa6");
    load(library, "OSMesaCreateContextAttribs", create_context);
    load(library, "OSMesaDestroyContext", destroy_context);
    load(library, "OSMesaMakeCurrent", make_current);
    load(library, "OSMesaGetCurrentContext", current_context);
    load(library, "OSMesaGetProcAddress", proc_address);
  }

  template <class Function>
  static void load(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (function == nullptr)
      throw Error(ExitCode::no_renderer, std::string("libOSMesa has no function ") + name +
                                             "; install Debian's libosmesa6 22 or newer");
  }
};

const OsmesaLibrary& osmesa() {
  static const OsmesaLibrary library;
  return library;
}

class OsmesaContext : public GlContext {
 public:
  OsmesaContext() {
    constexpr std::array<int, 13> kAttributes = {OSMESA_FORMAT,
                                                 OSMESA_BGRA,
                                                 OSMESA_PROFILE,
                                                 OSMESA_CORE_PROFILE,
                                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                                 3,
                                                 OSMESA_CONTEXT_MINOR_VERSION,
                                                 3,
                                                 OSMESA_DEPTH_BITS,
                                                 0,
                                                 OSMESA_STENCIL_BITS,
                                                 0,
                                                 0};
    context_ = osmesa().create_context(kAttributes.data(), nullptr);
    if (context_ == nullptr)
      throw Error(ExitCode::no_renderer, "no OpenGL renderer: OSMesa offers no OpenGL 3.3 core context");
    try {
      make_current();
      gl_ = load_gl_functions([](const char* name) { return osmesa().proc_address(name); });
    } catch (...) {
      osmesa().destroy_context(context_);
      throw;
    }
  }
  ~OsmesaContext() override { osmesa().destroy_context(context_); }

  void make_current() override {
    if (osmesa().current_context() == context_) return;
    // Pictures are drawn into framebuffers of their own; OSMesa asks for one pixel of memory all the same.
    if (osmesa().make_current(context_, &unused_pixel_, GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE)
      throw Error(ExitCode::no_renderer, "no OpenGL renderer: OSMesa does not accept its own context");
  }

  void release() override { osmesa().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  std::string backend() const override { return "OSMesa"; }

 private:
  OSMesaContext context_ = nullptr;
  std::uint32_t unused_pixel_ = 0;
};

}  // namespace

bool osmesa_is_there() {
  return dlopen(kOsmesa, RTLD_LAZY | RTLD_LOCAL) != nullptr;
}

std::unique_ptr<GlContext> create_osmesa_context() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace chainreel

#ifdef __SANITIZE_ADDRESS__
// OSMesa keeps 160 bytes of every context that it has destroyed, however it is destroyed; EGL its display.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa.so\nleak:libEGL\nleak:swrast_dri.so\n";
}
#endif
