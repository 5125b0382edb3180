#include "render/renderer_pins.hpp"

#include <array>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <vector>

#include "core/own_environment.hpp"
#include "picture/text.hpp"

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
    RendererPin{"GALLIUM_*", nullptr}, RendererPin{"GALLIVM_*", nullptr}, RendererPin{"LP_*", nullptr},
    RendererPin{"DRAW_*", nullptr},    RendererPin{"MESA_*", nullptr},    RendererPin{"ST_DEBUG", nullptr},
    RendererPin{"NIR_*", nullptr},     RendererPin{"TGSI_*", nullptr},
};

// Another renderer for who names one, threads, where compiled shaders are kept.
constexpr std::array<std::string_view, 5> kKept = {"GALLIUM_DRIVER", "LP_NUM_THREADS", "MESA_SHADER_CACHE", "MESA_GLSL_CACHE",
                                                   "MESA_DISK_CACHE"};

void set_pin(const RendererPin& one) {
  const std::string_view name(one.name);
  if (!name.ends_with('*')) return set_own_variable(one.name, one.value);
  std::vector<std::string_view> kept(kKept.begin(), kKept.end());
  for (const RendererPin& other : kPins)
    if (other.value != nullptr) kept.emplace_back(other.name);
  const std::array beginnings = {name.substr(0, name.size() - 1)};
  clear_variables(beginnings, kept);
}

}  // namespace

std::span<const RendererPin> renderer_pins() {
  return kPins;
}

void settle_environment() {
  static std::once_flag done;
  std::call_once(done, [] {
    for (const RendererPin& one : kPins) set_pin(one);
    // Without it there are as many threads as cores: flat shapes are drawn faster by the calling thread alone.
    setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
    clear_font_variables();
  });
}

}  // namespace chainreel
