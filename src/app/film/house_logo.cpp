#include "app/film/house_logo.hpp"

#include <filesystem>
#include <memory>
#include <span>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "draw/page/house_style.hpp"
#include "encode/png.hpp"
#include "render/svg_image.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestLogoFile = std::uintmax_t(8) << 20;  // bytes
constexpr int kPixelsOfSvg = 1024;  // high: more than a logo takes of any page

std::string family_of(const StyleFonts& fonts, Face face) {
  if (face == Face::math) return fonts.math;
  return face == Face::label || fonts.bold.empty() ? fonts.label : fonts.bold;
}

}  // namespace

void load_logo(Scene& scene) {
  if (!scene.style.logo) return;
  Logo& logo = *scene.style.logo;
  note_input(logo.file);
  const std::string bytes = read_plain_file(logo.file, kLargestLogoFile);
  logo.image = std::make_shared<const Image>(fs::path(logo.file).extension() == ".svg"
                                                 ? svg_image(bytes, logo.file, kPixelsOfSvg)
                                                 : decode_png(bytes, logo.file));
  logo.sha256 = sha256_of(bytes);
}

Json style_report(const Scene& scene) {
  const Style& style = scene.style;
  if (style.empty()) return nullptr;
  Json report = Json::object();
  if (!style.fonts.empty()) {
    const Fonts fonts(families_of(scene));
    for (const auto& [role, face] : {std::pair{"label", Face::label}, {"bold", Face::label_bold}, {"math", Face::math}})
      if (const std::string family = family_of(style.fonts, face); !family.empty())
        report["fonts"][role] = {{"family", family},
                                 {"file", fs::path(fonts.file(face)).filename().string()},
                                 {"sha256", fonts.sha256(face)}};
  }
  if (style.logo && style.logo->image) {
    Sha256 pixels;
    pixels.add(std::as_bytes(std::span(style.logo->image->bgra)));
    report["logo"] = {{"sha256", style.logo->sha256}, {"pixels_sha256", pixels.finish()}};
  }
  report["low_contrast"] = low_contrasts(scene);
  return report;
}

}  // namespace chainreel
