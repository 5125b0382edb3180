#include "render/cairo_functions.hpp"

#include <dlfcn.h>

#include <string>

#include "core/error.hpp"

namespace chainreel {
namespace {

CairoFunctions load_functions() {
  void* const library = dlopen("libcairo.so.2", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    throw Error(ExitCode::no_renderer, std::string("no vectors can be drawn: ") + dlerror() + "; install the Debian package libcairo2");
  CairoFunctions functions;
#define CHAINREEL_CAIRO_LOAD(name)                                                    \
  functions.name = reinterpret_cast<decltype(functions.name)>(dlsym(library, #name)); \
  if (functions.name == nullptr)                                                      \
    throw Error(ExitCode::no_renderer, "Cairo has no function " #name ": version 1.16 or newer is needed");
  CHAINREEL_CAIRO(CHAINREEL_CAIRO_LOAD)
#undef CHAINREEL_CAIRO_LOAD
  return functions;
}

}  // namespace

const CairoFunctions& libcairo() {
  static const CairoFunctions functions = load_functions();
  return functions;
}

}  // namespace chainreel
