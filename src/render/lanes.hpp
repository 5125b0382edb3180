// Four numbers at once, in the compiler's own vectors: the same operations in the same order on every processor.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace chainreel {

using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

inline Float4 all4(float x) { return Float4{x, x, x, x}; }
inline Int4 all4(std::int32_t x) { return Int4{x, x, x, x}; }

template <class Lanes, class Number>
Lanes load4(const Number* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
template <class Lanes, class Number>
void store4(Number* to, Lanes lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}

inline Float4 least(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 most(Float4 a, Float4 b) { return a > b ? a : b; }

inline Float4 root(Float4 x) {
#if defined(__SSE2__)
  __m128 floats;
  std::memcpy(&floats, &x, sizeof floats);
  floats = _mm_sqrt_ps(floats);
  std::memcpy(&x, &floats, sizeof x);
  return x;
#else
  return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

// To the nearest whole number, the even one of two.
inline Int4 rounded_to_even(Float4 x) {
#if defined(__SSE2__)
  __m128 floats;
  std::memcpy(&floats, &x, sizeof floats);
  const __m128i whole = _mm_cvtps_epi32(floats);
  Int4 lanes;
  std::memcpy(&lanes, &whole, sizeof lanes);
  return lanes;
#else
  return Int4{std::int32_t(std::nearbyint(x[0])), std::int32_t(std::nearbyint(x[1])), std::int32_t(std::nearbyint(x[2])),
              std::int32_t(std::nearbyint(x[3]))};
#endif
}

// Four premultiplied pixels over four others, the highest byte their opacity; bytes are rounded as OpenGL's software renderer
// rounds them.
inline Int4 put_over(Int4 above, Int4 below) {
#if defined(__SSE2__)
  __m128i top, bottom;
  std::memcpy(&top, &above, sizeof top);
  std::memcpy(&bottom, &below, sizeof bottom);
  const __m128i none = _mm_setzero_si128(), half = _mm_set1_epi16(128), full = _mm_set1_epi16(255);
  const auto faded = [&](__m128i pixels, __m128i over) {
    const __m128i opacity = _mm_shufflehi_epi16(_mm_shufflelo_epi16(over, 0xff), 0xff);
    const __m128i product = _mm_mullo_epi16(pixels, _mm_sub_epi16(full, opacity));
    return _mm_srli_epi16(_mm_add_epi16(_mm_add_epi16(product, _mm_srli_epi16(product, 8)), half), 8);
  };
  const __m128i through = _mm_packus_epi16(faded(_mm_unpacklo_epi8(bottom, none), _mm_unpacklo_epi8(top, none)),
                                           faded(_mm_unpackhi_epi8(bottom, none), _mm_unpackhi_epi8(top, none)));
  const __m128i sum = _mm_adds_epu8(top, through);
  Int4 result;
  std::memcpy(&result, &sum, sizeof result);
  return result;
#else
  Int4 result = {};
  for (int k = 0; k < 4; ++k) {
    const std::uint32_t top = std::uint32_t(above[k]), bottom = std::uint32_t(below[k]);
    std::uint32_t sum = 0;
    for (int shift = 0; shift < 32; shift += 8) {
      const std::uint32_t product = (bottom >> shift & 255) * (255 - (top >> 24));
      const std::uint32_t level = (top >> shift & 255) + ((product + (product >> 8) + 128) >> 8);
      sum |= (level > 255 ? 255 : level) << shift;
    }
    result[k] = std::int32_t(sum);
  }
  return result;
#endif
}

// Of lanes that are all ones or all zeros: bit k for lane k.
inline unsigned bits_of(Int4 lanes) {
#if defined(__SSE2__)
  __m128 floats;
  std::memcpy(&floats, &lanes, sizeof floats);
  return unsigned(_mm_movemask_ps(floats));
#else
  return unsigned(lanes[0] & 1) | unsigned(lanes[1] & 2) | unsigned(lanes[2] & 4) | unsigned(lanes[3] & 8);
#endif
}

inline bool are_all(Int4 lanes) { return bits_of(lanes) == 15; }

// Four bytes as numbers, the lowest first, and back: what is between two is cut off.
inline Float4 unpacked(std::uint32_t bytes) {
#if defined(__SSE2__)
  const __m128i none = _mm_setzero_si128();
  const __m128i words = _mm_unpacklo_epi8(_mm_cvtsi32_si128(std::int32_t(bytes)), none);
  return Float4(_mm_cvtepi32_ps(_mm_unpacklo_epi16(words, none)));
#else
  return Float4{float(bytes & 255), float(bytes >> 8 & 255), float(bytes >> 16 & 255), float(bytes >> 24)};
#endif
}
inline std::uint32_t packed(Float4 numbers) {
  const Int4 whole = __builtin_convertvector(numbers, Int4);
#if defined(__SSE2__)
  __m128i lanes;
  std::memcpy(&lanes, &whole, sizeof lanes);
  const __m128i words = _mm_packs_epi32(lanes, lanes);
  return std::uint32_t(_mm_cvtsi128_si32(_mm_packus_epi16(words, words)));
#else
  return std::uint32_t(whole[0]) | std::uint32_t(whole[1]) << 8 | std::uint32_t(whole[2]) << 16 |
         std::uint32_t(whole[3]) << 24;
#endif
}

}  // namespace chainreel
