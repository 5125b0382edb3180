// Four numbers at once, in the compiler's own vectors: the same operations in the same order on every processor.
#pragma once

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
