#include "encode/palette.hpp"

#include <libimagequant.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "core/error.hpp"

namespace chainreel {
namespace {

// The colours of a drawn picture's flat areas are few; the others are edges.
constexpr std::size_t kExactColors = 64;
// libimagequant shares more colours than this among threads, and its sums then depend on their number.
constexpr std::size_t kMostCounted = 2000;

using Counted = std::pair<std::uint32_t, std::uint32_t>;  // colour, how often

std::uint32_t rgb_of(const std::uint8_t* bgra) {
  return std::uint32_t(bgra[2]) << 16 | std::uint32_t(bgra[1]) << 8 | bgra[0];
}

Pixel pixel_of(std::uint32_t rgb) {
  return {std::uint8_t(rgb >> 16), std::uint8_t(rgb >> 8), std::uint8_t(rgb), 255};
}

liq_color liq_of(std::uint32_t rgb) {
  const Pixel p = pixel_of(rgb);
  return {p.r, p.g, p.b, 255};
}

struct Destroy {
  void operator()(liq_attr* p) const { liq_attr_destroy(p); }
  void operator()(liq_histogram* p) const { liq_histogram_destroy(p); }
  void operator()(liq_result* p) const { liq_result_destroy(p); }
};

void check(liq_error error) {
  if (error != LIQ_OK)
    throw Error(error == LIQ_OUT_OF_MEMORY ? ExitCode::limit : ExitCode::no_renderer,
                "libimagequant finds no palette (error " + std::to_string(int(error)) + ")");
}

// The same, with colours that share their leading bits counted as the most frequent of them, until there are
// few enough.
std::vector<Counted> merged(std::vector<Counted> colors) {
  for (unsigned bits = 1; colors.size() > kMostCounted; ++bits) {
    const std::uint32_t leading = (0xFFu << bits & 0xFFu) * 0x010101u;
    std::unordered_map<std::uint32_t, std::size_t> place;
    std::vector<Counted> fewer;
    for (const Counted& color : colors) {
      const auto [at, is_new] = place.emplace(color.first & leading, fewer.size());
      if (is_new)
        fewer.push_back(color);
      else
        fewer[at->second].second += color.second;
    }
    colors = std::move(fewer);
  }
  return colors;
}

// At most `most` colours that stand for all of these.
std::vector<std::uint32_t> quantise(const std::vector<Counted>& colors, std::size_t most) {
  const std::unique_ptr<liq_attr, Destroy> options(liq_attr_create());
  if (!options) throw Error(ExitCode::limit, "no memory left for a palette");
  check(liq_set_max_colors(options.get(), int(most)));
  const std::unique_ptr<liq_histogram, Destroy> histogram(liq_histogram_create(options.get()));
  if (!histogram) throw Error(ExitCode::limit, "no memory left for a palette");
  std::vector<liq_histogram_entry> entries;
  for (const auto& [rgb, count] : colors) entries.push_back({liq_of(rgb), count});
  check(liq_histogram_add_colors(histogram.get(), options.get(), entries.data(), int(entries.size()), 0));
  liq_result* raw = nullptr;
  check(liq_histogram_quantize(histogram.get(), options.get(), &raw));
  const std::unique_ptr<liq_result, Destroy> result(raw);
  const liq_palette* palette = liq_get_palette(raw);
  std::vector<std::uint32_t> chosen;
  for (unsigned i = 0; i < palette->count; ++i) {
    const liq_color& c = palette->entries[i];
    chosen.push_back(std::uint32_t(c.r) << 16 | std::uint32_t(c.g) << 8 | c.b);
  }
  return chosen;
}

}  // namespace

void PaletteMaker::count(const Image& image) {
  // Runs of one colour are long in drawn pictures.
  std::uint32_t last = 0, run = 0;
  for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
    const std::uint32_t rgb = rgb_of(&image.bgra[i]);
    if (run > 0 && rgb != last) {
      counts_[last] += run;
      run = 0;
    }
    last = rgb;
    ++run;
  }
  if (run > 0) counts_[last] += run;
}

std::vector<Pixel> PaletteMaker::choose() const {
  std::vector<Counted> colors(counts_.begin(), counts_.end());
  std::sort(colors.begin(), colors.end(), [](const Counted& a, const Counted& b) {
    return a.second != b.second ? a.second > b.second : a.first < b.first;
  });
  std::vector<Pixel> palette;
  if (colors.size() <= kMostColors) {
    for (const Counted& color : colors) palette.push_back(pixel_of(color.first));
    return palette;
  }
  for (std::size_t i = 0; i < kExactColors; ++i) palette.push_back(pixel_of(colors[i].first));
  const std::vector<Counted> rest = merged({colors.begin() + kExactColors, colors.end()});
  for (const std::uint32_t rgb : quantise(rest, kMostColors - kExactColors)) palette.push_back(pixel_of(rgb));
  return palette;
}

std::uint8_t PaletteMap::nearest(std::uint32_t rgb) {
  const auto [place, is_new] = found_.try_emplace(rgb, std::uint8_t(0));
  if (!is_new) return place->second;
  const Pixel p = pixel_of(rgb);
  int best = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < palette_.size(); ++i) {
    const int r = p.r - palette_[i].r, g = p.g - palette_[i].g, b = p.b - palette_[i].b;
    const int distance = r * r + g * g + b * b;
    if (distance >= best) continue;
    best = distance;
    place->second = std::uint8_t(i);
  }
  return place->second;
}

void PaletteMap::map(const Image& image, std::uint8_t* indices, int stride) {
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* p = &image.bgra[std::size_t(4) * std::size_t(image.width) * std::size_t(y)];
    std::uint32_t last = rgb_of(p);
    std::uint8_t index = nearest(last);
    for (int x = 0; x < image.width; ++x, p += 4) {
      if (const std::uint32_t rgb = rgb_of(p); rgb != last) index = nearest(last = rgb);
      indices[std::ptrdiff_t(stride) * y + x] = index;
    }
  }
}

}  // namespace chainreel
