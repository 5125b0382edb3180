// The backend that Debian's later releases have, too: EGL without a surface, on Mesa's software renderer.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <cstdio>

#include "core/error.hpp"
#include "render/gl_context.hpp"

namespace chainreel {
namespace {

constexpr const char* kPackages = "install the Debian packages libegl1, libegl-mesa0 and libgl1-mesa-dri";

[[noreturn]] void refuse_egl(const std::string& why) {
  throw Error(ExitCode::no_renderer, "no OpenGL renderer: " + why + "; " + kPackages);
}

// Opened once and never closed, like its display: drivers leave threads' destructors behind.
struct EglLibrary {
  decltype(&eglGetProcAddress) proc_address = nullptr;
  decltype(&eglGetPlatformDisplay) platform_display = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglChooseConfig) choose_config = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  decltype(&eglGetCurrentContext) current_context = nullptr;
  decltype(&eglGetError) last_error = nullptr;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLConfig config = nullptr;

  EglLibrary() {
    void* const library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) refuse_egl(dlerror());
    load(library, "eglGetProcAddress", proc_address);
    load(library, "eglGetPlatformDisplay", platform_display);
    load(library, "eglInitialize", initialize);
    load(library, "eglBindAPI", bind_api);
    load(library, "eglChooseConfig", choose_config);
    load(library, "eglCreateContext", create_context);
    load(library, "eglDestroyContext", destroy_context);
    load(library, "eglMakeCurrent", make_current);
    load(library, "eglGetCurrentContext", current_context);
    load(library, "eglGetError", last_error);
    open_display();
  }

  std::string trouble(const char* call) const {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04X", unsigned(last_error()));
    return std::string(call) + " failed (" + code + ")";
  }

 private:
  template <class Function>
  static void load(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (function == nullptr) refuse_egl(std::string("libEGL has no function ") + name);
  }

  void open_display() {
    display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display == EGL_NO_DISPLAY) refuse_egl("EGL has no display without a surface, " + trouble("eglGetPlatformDisplay"));
    if (initialize(display, nullptr, nullptr) == EGL_FALSE) refuse_egl("EGL finds no driver, " + trouble("eglInitialize"));
    constexpr std::array<EGLint, 5> kWanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                               EGL_NONE};
    EGLint found = 0;
    if (choose_config(display, kWanted.data(), &config, 1, &found) == EGL_FALSE || found == 0)
      refuse_egl("EGL offers no OpenGL, " + trouble("eglChooseConfig"));
  }
};

const EglLibrary& egl() {
  static const EglLibrary library;
  return library;
}

class EglContext : public GlContext {
 public:
  EglContext() {
    const EglLibrary& library = egl();
    constexpr std::array<EGLint, 7> kAttributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                   3,
                                                   EGL_CONTEXT_MINOR_VERSION,
                                                   3,
                                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                   EGL_NONE};
    // Which interface contexts are made for is a thread's own setting.
    if (library.bind_api(EGL_OPENGL_API) == EGL_FALSE) refuse_egl("EGL offers no OpenGL, " + library.trouble("eglBindAPI"));
    context_ = library.create_context(library.display, library.config, EGL_NO_CONTEXT, kAttributes.data());
    if (context_ == EGL_NO_CONTEXT)
      refuse_egl("EGL offers no OpenGL 3.3 core context, " + library.trouble("eglCreateContext"));
    try {
      make_current();
      gl_ = load_gl_functions([](const char* name) { return egl().proc_address(name); });
    } catch (...) {
      destroy();
      throw;
    }
  }
  ~EglContext() override { destroy(); }

  void make_current() override {
    const EglLibrary& library = egl();
    library.bind_api(EGL_OPENGL_API);  // of this thread, which need not be the one that made the context
    if (library.current_context() == context_) return;
    if (library.make_current(library.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
      throw Error(ExitCode::no_renderer, "no OpenGL renderer: EGL does not accept its own context, " +
                                             library.trouble("eglMakeCurrent"));
  }

  void release() override {
    const EglLibrary& library = egl();
    if (library.current_context() == context_)
      library.make_current(library.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  std::string backend() const override { return "EGL"; }

 private:
  // A context that is current anywhere lives on.
  void destroy() {
    release();
    egl().destroy_context(egl().display, context_);
  }

  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> create_egl_context() {
  return std::make_unique<EglContext>();
}

}  // namespace chainreel
