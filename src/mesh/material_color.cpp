#include "mesh/material_color.hpp"

#include <assimp/material.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "mesh/mesh_file.hpp"
// clang-format off: libjpeg's header needs <cstdio> before it
#include <jpeglib.h>
// clang-format on
#include "core/input_file.hpp"
#include "mesh/limited_child.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

std::uint8_t byte_of(float value) {
  if (!(value > 0)) return 0;  // also for what is no number
  return value >= 1 ? 255 : std::uint8_t(std::lround(255 * value));
}

// Where a texture lies: counted from the mesh, or beside it.
std::string texture_path(const std::string& mesh, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path folder = fs::path(mesh).parent_path();
  const fs::path path = folder / name;  // `name` alone where it is absolute
  std::error_code code;
  return fs::exists(path, code) ? path.string() : (folder / fs::path(name).filename()).string();
}

}  // namespace

ColorBytes bytes_of(const aiColor4D& color) {
  return {byte_of(color.r), byte_of(color.g), byte_of(color.b), byte_of(color.a)};
}

MaterialColor MaterialColors::of(const aiMesh& mesh) {
  if (mesh.HasVertexColors(0)) return {{255, 255, 255, 255}, true};
  if (is_stl(path_) || mesh.mMaterialIndex >= scene_.mNumMaterials) return {};
  const auto [known, is_new] = known_.emplace(mesh.mMaterialIndex, MaterialColor{});
  if (is_new) known->second = color_of(*scene_.mMaterials[mesh.mMaterialIndex]);
  return known->second;
}

MaterialColor MaterialColors::color_of(const aiMaterial& material) const {
  aiString name;
  if (material.Get(AI_MATKEY_NAME, name) == AI_SUCCESS && name == aiString(AI_DEFAULT_MATERIAL_NAME))
    return {};  // assimp's own, where a file has none
  aiColor4D diffuse(1, 1, 1, 1);
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) != AI_SUCCESS) return {};
  float opacity = 1;
  material.Get(AI_MATKEY_OPACITY, opacity);
  // Nobody makes a mesh that cannot be seen: such files mean transparency.
  diffuse.a = opacity > 0 ? opacity : 1;
  MaterialColor result{bytes_of(diffuse), true};
  aiString texture;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == AI_SUCCESS)
    if (const auto mean = mean_color(texture_path(path_, texture.C_Str())))
      std::copy(mean->begin(), mean->end(), result.color.begin());
  return result;
}

// libjpeg reports errors by longjmp, which must not pass over an object with a destructor: the function that
// calls setjmp holds plain numbers and pointers only.

namespace {

constexpr std::size_t kMostPixels = std::size_t(1) << 26;  // 8192 x 8192

double linear(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

double srgb(double l) {
  return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

class Mean {
 public:
  Mean() {
    for (std::size_t i = 0; i < 256; ++i) linear_[i] = linear(double(i) / 255);
  }

  void add(const std::uint8_t* rgb, double weight) {
    for (std::size_t i = 0; i < 3; ++i) sum_[i] += weight * linear_[rgb[i]];
    weight_ += weight;
  }

  std::optional<std::array<std::uint8_t, 3>> value() const {
    if (!(weight_ > 0)) return std::nullopt;
    std::array<std::uint8_t, 3> mean{};
    for (std::size_t i = 0; i < 3; ++i) mean[i] = std::uint8_t(std::lround(255 * srgb(sum_[i] / weight_)));
    return mean;
  }

 private:
  std::array<double, 256> linear_{};
  std::array<double, 3> sum_{};
  double weight_ = 0;
};

// libpng's simplified reader: nothing jumps.
std::optional<std::array<std::uint8_t, 3>> mean_of_png(std::FILE* file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_stdio(&png, file) == 0) return std::nullopt;
  png.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels;
  if (std::size_t(png.width) * png.height <= kMostPixels) pixels.resize(PNG_IMAGE_SIZE(png));
  if (pixels.empty() || png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) == 0) {
    png_image_free(&png);
    return std::nullopt;
  }
  Mean mean;
  for (std::size_t i = 0; i < pixels.size(); i += 4) mean.add(&pixels[i], pixels[i + 3]);
  return mean.value();
}

struct JpegTrouble {
  jpeg_error_mgr manager;  // the first member: libjpeg knows this one alone
  std::jmp_buf jump;
};

[[noreturn]] void leave_jpeg(j_common_ptr jpeg) {
  std::longjmp(reinterpret_cast<JpegTrouble*>(jpeg->err)->jump, 1);
}

void say_nothing(j_common_ptr, int) {}

bool add_jpeg(std::FILE* file, Mean& mean) {
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
  JSAMPARRAY row = (*jpeg.mem->alloc_sarray)(reinterpret_cast<j_common_ptr>(&jpeg), JPOOL_IMAGE,
                                             jpeg.output_width * JDIMENSION(jpeg.output_components), 1);
  while (jpeg.output_scanline < jpeg.output_height) {
    jpeg_read_scanlines(&jpeg, row, 1);
    for (JDIMENSION x = 0; x < jpeg.output_width; ++x) mean.add(row[0] + std::size_t(3) * x, 1);
  }
  jpeg_finish_decompress(&jpeg);
  jpeg_destroy_decompress(&jpeg);
  return true;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::optional<std::array<std::uint8_t, 3>> mean_color(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return std::nullopt;  // a pipe would wait for ever
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) return std::nullopt;
  const int first = std::getc(file.get());
  std::rewind(file.get());
  if (first == 0x89) return mean_of_png(file.get());
  Mean mean;
  return first == 0xFF && add_jpeg(file.get(), mean) ? mean.value() : std::nullopt;
}

std::optional<std::array<std::uint8_t, 3>> read_mean_color(const std::string& path) {
  note_input(path);
  const ChildResult result = run_in_limited_child([&] {
    const auto mean = mean_color(path);
    return mean ? std::string(mean->begin(), mean->end()) : std::string();
  });
  if (!result.finished || result.reply.size() != 3) return std::nullopt;
  const auto byte = [&](std::size_t i) { return std::uint8_t(result.reply[i]); };
  return std::array<std::uint8_t, 3>{byte(0), byte(1), byte(2)};
}

}  // namespace chainreel
