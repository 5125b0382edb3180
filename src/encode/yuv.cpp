#include "encode/yuv.hpp"

#include <cstddef>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <cassert>

namespace chainreel {
namespace {

constexpr int kBits = 15;
constexpr LumaChroma kTo8 = {
    {2032, 20127, 5983},     // 219/255 * 2^15 * (0.0722, 0.7152, 0.2126)
    {14392, -11094, -3298},  // 224/255 * 2^15 * (0.5, -0.7152/1.8556, -0.2126/1.8556)
    {-1320, -13072, 14392},  // 224/255 * 2^15 * (-0.0722/1.5748, -0.7152/1.5748, 0.5)
};
static_assert(kTo8.white() == 28142);  // becomes 235
static_assert(kTo8.grey_is_grey());    // becomes 128

constexpr int kChromaBits = kBits + 2;  // chroma is computed from the sum of four pixels
constexpr int kLumaOffset = (16 << kBits) + (1 << (kBits - 1));
constexpr int kChromaOffset = (128 << kChromaBits) + (1 << (kChromaBits - 1));

// One row pair: where it is read and where it goes.
struct RowPair {
  const std::uint8_t* upper;
  const std::uint8_t* lower;
  std::uint8_t* y_upper;
  std::uint8_t* y_lower;
  std::uint8_t* cb;
  std::uint8_t* cr;
};

std::uint8_t luma_of(const std::uint8_t* p) {
  return static_cast<std::uint8_t>((dot(kTo8.y, p[0], p[1], p[2]) + kLumaOffset) >> kBits);
}

// Columns from x to the end, two at a time.
void convert_columns(const RowPair& rows, int x, int width) {
  for (; x < width; x += 2) {
    const std::uint8_t* u = rows.upper + std::ptrdiff_t(4) * x;
    const std::uint8_t* l = rows.lower + std::ptrdiff_t(4) * x;
    rows.y_upper[x] = luma_of(u);
    rows.y_upper[x + 1] = luma_of(u + 4);
    rows.y_lower[x] = luma_of(l);
    rows.y_lower[x + 1] = luma_of(l + 4);
    const int b = u[0] + u[4] + l[0] + l[4];
    const int g = u[1] + u[5] + l[1] + l[5];
    const int r = u[2] + u[6] + l[2] + l[6];
    rows.cb[x / 2] = static_cast<std::uint8_t>((dot(kTo8.cb, b, g, r) + kChromaOffset) >> kChromaBits);
    rows.cr[x / 2] = static_cast<std::uint8_t>((dot(kTo8.cr, b, g, r) + kChromaOffset) >> kChromaBits);
  }
}

#if defined(__SSE2__)

__m128i load(const std::uint8_t* p) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
}

// 16-bit pairs in each pixel's place: the even bytes are (b, r), the odd bytes are (g, alpha).
struct PairWeights {
  __m128i br, ga;
};

PairWeights pair_weights(const Weights& w) {
  return {_mm_set1_epi32(int((unsigned(w.r) << 16) | (unsigned(w.b) & 0xFFFFu))),
          _mm_set1_epi32(int(unsigned(w.g) & 0xFFFFu))};
}

template <int bits>
__m128i weigh(__m128i br, __m128i ga, const PairWeights& w, __m128i offset) {
  const __m128i sum = _mm_add_epi32(_mm_madd_epi16(br, w.br), _mm_madd_epi16(ga, w.ga));
  return _mm_srai_epi32(_mm_add_epi32(sum, offset), bits);
}

// Four numbers per register, each within 0..255, to bytes.
__m128i to_bytes(__m128i a, __m128i b) {
  const __m128i words = _mm_packs_epi32(a, b);
  return _mm_packus_epi16(words, words);
}

// Sums of neighbouring pixels: (p0+p1, p2+p3, q0+q1, q2+q3).
__m128i add_neighbours(__m128i p, __m128i q) {
  const __m128 pf = _mm_castsi128_ps(p);
  const __m128 qf = _mm_castsi128_ps(q);
  return _mm_add_epi16(_mm_castps_si128(_mm_shuffle_ps(pf, qf, _MM_SHUFFLE(2, 0, 2, 0))),
                       _mm_castps_si128(_mm_shuffle_ps(pf, qf, _MM_SHUFFLE(3, 1, 3, 1))));
}

// Eight columns at a time; returns the first column that is left.
int convert_columns_by_eight(const RowPair& rows, int width) {
  const __m128i even_bytes = _mm_set1_epi32(0x00FF00FF);
  const PairWeights weights_y = pair_weights(kTo8.y), weights_cb = pair_weights(kTo8.cb),
                    weights_cr = pair_weights(kTo8.cr);
  const __m128i offset_y = _mm_set1_epi32(kLumaOffset), offset_c = _mm_set1_epi32(kChromaOffset);
  int x = 0;
  for (; x + 8 <= width; x += 8) {
    __m128i br_sum[2], ga_sum[2], y[2][2];
    for (int half = 0; half < 2; ++half) {
      const std::ptrdiff_t at = std::ptrdiff_t(4) * (x + 4 * half);
      const __m128i upper = load(rows.upper + at), lower = load(rows.lower + at);
      const __m128i br_upper = _mm_and_si128(upper, even_bytes), ga_upper = _mm_srli_epi16(upper, 8);
      const __m128i br_lower = _mm_and_si128(lower, even_bytes), ga_lower = _mm_srli_epi16(lower, 8);
      y[0][half] = weigh<kBits>(br_upper, ga_upper, weights_y, offset_y);
      y[1][half] = weigh<kBits>(br_lower, ga_lower, weights_y, offset_y);
      br_sum[half] = _mm_add_epi16(br_upper, br_lower);
      ga_sum[half] = _mm_add_epi16(ga_upper, ga_lower);
    }
    _mm_storel_epi64(reinterpret_cast<__m128i*>(rows.y_upper + x), to_bytes(y[0][0], y[0][1]));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(rows.y_lower + x), to_bytes(y[1][0], y[1][1]));

    const __m128i br = add_neighbours(br_sum[0], br_sum[1]), ga = add_neighbours(ga_sum[0], ga_sum[1]);
    const __m128i cb = weigh<kChromaBits>(br, ga, weights_cb, offset_c);
    const __m128i cr = weigh<kChromaBits>(br, ga, weights_cr, offset_c);
    const __m128i both = to_bytes(cb, cr);
    _mm_storeu_si32(rows.cb + x / 2, both);
    _mm_storeu_si32(rows.cr + x / 2, _mm_srli_si128(both, 4));
  }
  return x;
}

#else

int convert_columns_by_eight(const RowPair&, int) {
  return 0;
}

#endif

// That of the box which begins in row y.
RowPair row_pair(const Image& image, const PlanesYuv420& planes, int x, int y) {
  const std::ptrdiff_t row = std::ptrdiff_t(4) * image.width;
  const std::uint8_t* upper = image.bgra.data() + row * y + std::ptrdiff_t(4) * x;
  std::uint8_t* y_upper = planes.plane[0] + std::ptrdiff_t(planes.stride[0]) * y + x;
  return {upper,
          upper + row,
          y_upper,
          y_upper + planes.stride[0],
          planes.plane[1] + std::ptrdiff_t(planes.stride[1]) * (y / 2) + x / 2,
          planes.plane[2] + std::ptrdiff_t(planes.stride[2]) * (y / 2) + x / 2};
}

[[maybe_unused]] bool is_even(const PixelBox& box) {
  return box.x % 2 == 0 && box.y % 2 == 0 && box.width % 2 == 0 && box.height % 2 == 0;
}

}  // namespace

void convert_to_yuv420(const Image& image, const PixelBox& box, const PlanesYuv420& planes) {
  assert(is_even(box));
  for (int y = box.y; y < box.bottom(); y += 2) {
    const RowPair rows = row_pair(image, planes, box.x, y);
    convert_columns(rows, convert_columns_by_eight(rows, box.width), box.width);
  }
}

void convert_to_yuv420_scalar(const Image& image, const PixelBox& box, const PlanesYuv420& planes) {
  assert(is_even(box));
  for (int y = box.y; y < box.bottom(); y += 2)
    convert_columns(row_pair(image, planes, box.x, y), 0, box.width);
}

namespace {

// 876/255 and 896/255 * 2^14: ten bits a component.
constexpr int kBits10 = 14;
constexpr LumaChroma kTo10 = {{4064, 40254, 11966}, {28784, -22189, -6595}, {-2639, -26145, 28784}};
static_assert(kTo10.white() == 56284);  // becomes 940
static_assert(kTo10.grey_is_grey());

constexpr std::uint16_t level(const Weights& w, int zero, const std::uint8_t* p) {
  return std::uint16_t((dot(w, p[0], p[1], p[2]) + (zero << kBits10) + (1 << (kBits10 - 1))) >> kBits10);
}

}  // namespace

void convert_to_yuv444(const Image& image, const PixelBox& box, const PlanesYuv444& planes) {
  for (int y = box.y; y < box.bottom(); ++y) {
    const std::uint8_t* p = image.bgra.data() + std::ptrdiff_t(4) * (std::ptrdiff_t(image.width) * y + box.x);
    const auto row = [&](int i) { return planes.plane[i] + std::ptrdiff_t(planes.stride[i]) * y; };
    std::uint16_t *luma = row(0), *cb = row(1), *cr = row(2);
    std::uint16_t* alpha = planes.plane[3] == nullptr ? nullptr : row(3);
    for (int x = box.x; x < box.right(); ++x, p += 4) {
      luma[x] = level(kTo10.y, 64, p);
      cb[x] = level(kTo10.cb, 512, p);
      cr[x] = level(kTo10.cr, 512, p);
      if (alpha != nullptr) alpha[x] = std::uint16_t((p[3] * 1023 + 127) / 255);
    }
  }
}

}  // namespace chainreel
