#include "mesh/texture.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
// clang-format off: libjpeg's header needs <cstdio> before it
#include <jpeglib.h>
// clang-format on

#include "core/input_file.hpp"
#include "mesh/limited_child.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kMostPixels = std::size_t(1) << 26;  // 8192 x 8192

double linear(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

double srgb(double l) {
  return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

const std::array<double, 256>& linear_levels() {
  static const std::array<double, 256> levels = [] {
    std::array<double, 256> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = linear(double(i) / 255);
    return all;
  }();
  return levels;
}

// Of colours, in linear light, each as much as it is opaque.
class Mean {
 public:
  void add(const ColorBytes& color) {
    const std::array<double, 256>& level = linear_levels();
    for (std::size_t i = 0; i < 3; ++i) sum_[i] += color[3] * level[color[i]];
    opacity_ += color[3];
    count_ += 1;
  }

  std::optional<std::array<std::uint8_t, 3>> color() const {
    if (!(opacity_ > 0)) return std::nullopt;
    std::array<std::uint8_t, 3> mean{};
    for (std::size_t i = 0; i < 3; ++i) mean[i] = std::uint8_t(std::lround(255 * srgb(sum_[i] / opacity_)));
    return mean;
  }
  std::uint8_t opacity() const { return std::uint8_t(std::lround(opacity_ / count_)); }

 private:
  std::array<double, 3> sum_{};
  double opacity_ = 0, count_ = 0;
};

// The place in an image of `count` texels that stands for one beyond it.
int wrapped(int place, int count, TextureWrap wrap) {
  if (place >= 0 && place < count) return place;
  if (wrap == TextureWrap::clamp) return std::clamp(place, 0, count - 1);
  const int period = wrap == TextureWrap::mirror ? 2 * count : count;
  const int within = ((place % period) + period) % period;
  return within < count ? within : period - 1 - within;
}

// libpng's simplified reader: nothing jumps.
bool read_png(std::FILE* file, Texture& texture) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_stdio(&png, file) == 0) return false;
  png.format = PNG_FORMAT_RGBA;
  if (std::size_t(png.width) * png.height <= kMostPixels) texture.texels.resize(std::size_t(png.width) * png.height);
  if (texture.texels.empty() || png_image_finish_read(&png, nullptr, texture.texels.data(), 0, nullptr) == 0) {
    png_image_free(&png);
    return false;
  }
  texture.width = int(png.width), texture.height = int(png.height);
  return true;
}

// libjpeg reports errors by longjmp, which must not pass over an object with a destructor: the function that
// calls setjmp holds plain numbers and pointers only.
struct JpegTrouble {
  jpeg_error_mgr manager;  // the first member: libjpeg knows this one alone
  std::jmp_buf jump;
};

[[noreturn]] void leave_jpeg(j_common_ptr jpeg) {
  std::longjmp(reinterpret_cast<JpegTrouble*>(jpeg->err)->jump, 1);
}

void say_nothing(j_common_ptr, int) {}

bool read_jpeg(std::FILE* file, Texture& texture) {
  jpeg_decompress_struct jpeg;
  JpegTrouble trouble;
  jpeg.err = jpeg_std_error(&trouble.manager);
  trouble.manager.error_exit = leave_jpeg;
  trouble.manager.emit_message = say_nothing;
  if (setjmp(trouble.jump)) {
    jpeg_destroy_decompress(&jpeg);
    return false;
  }
  jpeg_create_decompress(&jpeg);
  jpeg_stdio_src(&jpeg, file);
  jpeg_read_header(&jpeg, TRUE);
  jpeg.out_color_space = JCS_RGB;
  if (double(jpeg.image_width) * jpeg.image_height > double(kMostPixels)) {
    jpeg_destroy_decompress(&jpeg);
    return false;
  }
  jpeg_start_decompress(&jpeg);
  texture.width = int(jpeg.output_width), texture.height = int(jpeg.output_height);
  texture.texels.reserve(std::size_t(jpeg.output_width) * jpeg.output_height);
  JSAMPARRAY row = (*jpeg.mem->alloc_sarray)(reinterpret_cast<j_common_ptr>(&jpeg), JPOOL_IMAGE,
                                             jpeg.output_width * JDIMENSION(jpeg.output_components), 1);
  while (jpeg.output_scanline < jpeg.output_height) {
    jpeg_read_scanlines(&jpeg, row, 1);
    for (JDIMENSION x = 0; x < jpeg.output_width; ++x) {
      const JSAMPLE* const rgb = row[0] + std::size_t(3) * x;
      texture.texels.push_back({rgb[0], rgb[1], rgb[2], 255});
    }
  }
  jpeg_finish_decompress(&jpeg);
  jpeg_destroy_decompress(&jpeg);
  return true;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

const ColorBytes& Texture::beyond(int x, int y) const {
  return texel(wrapped(x, width, wrap[0]), wrapped(y, height, wrap[1]));
}

std::array<float, 4> Texture::at(float x, float y) const {
  const float left = std::floor(x), top = std::floor(y), right_share = x - left, lower_share = y - top;
  const int column = int(left), row = int(top);
  const ColorBytes &a = beyond(column, row), &b = beyond(column + 1, row);
  const ColorBytes &c = beyond(column, row + 1), &d = beyond(column + 1, row + 1);
  std::array<float, 4> color{};
  for (std::size_t i = 0; i < 4; ++i) {
    const float upper = float(a[i]) + right_share * float(b[i] - a[i]), lower = float(c[i]) + right_share * float(d[i] - c[i]);
    color[i] = upper + lower_share * (lower - upper);
  }
  return color;
}

void Texture::put_over(const ColorBytes& color) {
  for (ColorBytes& own : texels) {
    for (std::size_t i = 0; i < 3; ++i) own[i] = std::uint8_t((own[i] * own[3] + color[i] * (255 - own[3]) + 127) / 255);
    own[3] = 255;
  }
}

Texture Texture::halved() const {
  Texture half;
  half.width = std::max(1, width / 2), half.height = std::max(1, height / 2);
  half.wrap = wrap;
  half.texels.reserve(std::size_t(half.width) * std::size_t(half.height));
  const int across = width > 1 ? 2 : 1, down = height > 1 ? 2 : 1;
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      Mean mean;
      for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) mean.add(texel(across * x + i, down * y + j));
      const auto rgb = mean.color().value_or(std::array<std::uint8_t, 3>{});
      half.texels.push_back({rgb[0], rgb[1], rgb[2], mean.opacity()});
    }
  return half;
}

std::optional<Texture> read_texture(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return std::nullopt;  // a pipe would wait for ever
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) return std::nullopt;
  const int first = std::getc(file.get());
  std::rewind(file.get());
  Texture texture;
  if (!(first == 0x89 ? read_png(file.get(), texture) : first == 0xFF && read_jpeg(file.get(), texture))) return std::nullopt;
  while (std::max(texture.width, texture.height) > kFinestTexture) texture = texture.halved();
  return texture;
}

std::optional<std::array<std::uint8_t, 3>> mean_color(const Texture& texture) {
  Mean mean;
  for (const ColorBytes& color : texture.texels) mean.add(color);
  return mean.color();
}

std::optional<std::array<std::uint8_t, 3>> read_mean_color(const std::string& path) {
  note_input(path);
  const ChildResult result = run_in_limited_child([&] {
    const auto texture = read_texture(path);
    const auto mean = texture ? mean_color(*texture) : std::nullopt;
    return mean ? std::string(mean->begin(), mean->end()) : std::string();
  });
  if (!result.finished || result.reply.size() != 3) return std::nullopt;
  const auto byte = [&](std::size_t i) { return std::uint8_t(result.reply[i]); };
  return std::array<std::uint8_t, 3>{byte(0), byte(1), byte(2)};
}

}  // namespace chainreel
