#include "render/renderer_pins.hpp"

#include <array>
#include <cstdlib>
#include <mutex>
#include <string_view>

namespace chainreel {
namespace {

#ifdef __x86_64__
bool has_avx() {
  return __builtin_cpu_supports("avx") != 0;
}
#else
bool has_avx() {
  return false;
}
#endif

const std::array kPins = {
#ifdef __x86_64__
    RendererPin{"GALLIUM_OVERRIDE_CPU_CAPS", has_avx() ? "avx" : "sse4.1"},
#endif
    RendererPin{"LP_NATIVE_VECTOR_WIDTH", has_avx() ? "256" : "128"},  // bits
    RendererPin{"LIBGL_ALWAYS_SOFTWARE", "true"},  // EGL would take a graphics card
    RendererPin{"GALLIUM_NOSSE", nullptr},
    RendererPin{"GALLIVM_PERF", nullptr},
    RendererPin{"LP_PERF", nullptr},
    RendererPin{"LP_NO_RAST", nullptr},
};

std::vector<std::string>& overruled() {
  static std::vector<std::string> settings;
  return settings;
}

void set_pin(const RendererPin& one) {
  const char* const before = std::getenv(one.name);
  if (before != nullptr && (one.value == nullptr || std::string_view(before) != one.value))
    overruled().push_back(std::string(one.name) + "=" + before);
  if (one.value != nullptr)
    setenv(one.name, one.value, /*overwrite=*/1);
  else
    unsetenv(one.name);
}

}  // namespace

std::span<const RendererPin> renderer_pins() {
  return kPins;
}

void pin_renderer() {
  static std::once_flag done;
  std::call_once(done, [] {
    for (const RendererPin& one : kPins) set_pin(one);
  });
}

std::vector<std::string> overruled_settings() {
  pin_renderer();
  return overruled();
}

}  // namespace chainreel
