#include "render/renderer_pins.hpp"

#include <cstdlib>
#include <mutex>
#include <string_view>

namespace chainreel {
namespace {

constexpr RendererPin kPins[] = {
#ifdef __x86_64__
    {"GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1"},
#endif
    {"LP_NATIVE_VECTOR_WIDTH", "128"},  // bits
    {"LIBGL_ALWAYS_SOFTWARE", "true"},  // EGL would take a graphics card
    {"GALLIUM_NOSSE", nullptr},
    {"GALLIVM_PERF", nullptr},
    {"LP_PERF", nullptr},
    {"LP_NO_RAST", nullptr},
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
