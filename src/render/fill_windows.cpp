#include "render/fill_windows.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "render/lanes.hpp"
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace chainreel {

namespace lanes4 {
using Floats = Float4;
using Ints = Int4;
constexpr int kLanes = 4;
constexpr Floats kCenters = {0.5F, 1.5F, 2.5F, 3.5F};
#include "render/shades.hpp"
}  // namespace lanes4

#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("avx2")
namespace lanes8 {
using Floats [[gnu::vector_size(32)]] = float;
using Ints [[gnu::vector_size(32)]] = std::int32_t;
constexpr int kLanes = 8;
constexpr Floats kCenters = {0.5F, 1.5F, 2.5F, 3.5F, 4.5F, 5.5F, 6.5F, 7.5F};

// As those of render/lanes.
inline bool are_all(Ints lanes) {
  return _mm256_movemask_ps(__m256(lanes)) == 255;
}
inline Floats root(Floats x) {
  return Floats(_mm256_sqrt_ps(__m256(x)));
}
inline Ints rounded_to_even(Floats x) {
  return Ints(_mm256_cvtps_epi32(__m256(x)));
}
inline __m256i faded(__m256i pixels, __m256i over) {
  const __m256i opacity = _mm256_shufflehi_epi16(_mm256_shufflelo_epi16(over, 0xff), 0xff);
  const __m256i product = _mm256_mullo_epi16(pixels, _mm256_sub_epi16(_mm256_set1_epi16(255), opacity));
  return _mm256_srli_epi16(
      _mm256_add_epi16(_mm256_add_epi16(product, _mm256_srli_epi16(product, 8)), _mm256_set1_epi16(128)), 8);
}
inline Ints put_over(Ints above, Ints below) {
  const __m256i top = __m256i(above), bottom = __m256i(below), none = _mm256_setzero_si256();
  const __m256i low = faded(_mm256_unpacklo_epi8(bottom, none), _mm256_unpacklo_epi8(top, none));
  const __m256i high = faded(_mm256_unpackhi_epi8(bottom, none), _mm256_unpackhi_epi8(top, none));
  return Ints(_mm256_adds_epu8(top, _mm256_packus_epi16(low, high)));
}
#include "render/shades.hpp"
}  // namespace lanes8
#pragma GCC pop_options
#endif

std::span<const WindowFillers> window_fillers() {
#if defined(__x86_64__)
  static constexpr std::array kAll = {
      WindowFillers{lanes8::kLanes, lanes8::fill_window, lanes8::fill_trail_window},
      WindowFillers{lanes4::kLanes, lanes4::fill_window, lanes4::fill_trail_window}};
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return std::span(kAll).subspan(has_avx2 ? 0 : 1);
#else
  static constexpr std::array kAll = {
      WindowFillers{lanes4::kLanes, lanes4::fill_window, lanes4::fill_trail_window}};
  return kAll;
#endif
}

}  // namespace chainreel
