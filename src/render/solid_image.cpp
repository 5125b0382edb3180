#include "render/solid_image.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "render/cairo_functions.hpp"

namespace chainreel {
namespace {

constexpr int kHeight = 2160;  // px of the page
constexpr int kWidest = 8192;  // px; wider pages take fewer a unit

// The part of an image that is not empty.
struct Part {
  int left = 0, top = 0, right = 0, bottom = 0;
};

Part part_of(const Image& image) {
  Part part{image.width, image.height, 0, 0};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y).a > 0)
        part = {std::min(part.left, x), std::min(part.top, y), std::max(part.right, x + 1),
                std::max(part.bottom, y + 1)};
  return part;
}

Image cut(const Image& image, const Part& part) {
  Image result(part.right - part.left, part.bottom - part.top);
  const auto row_bytes = std::ptrdiff_t(4) * result.width;
  for (int y = 0; y < result.height; ++y)
    std::copy_n(
        image.bgra.begin() + std::ptrdiff_t(4) * (std::ptrdiff_t(part.top + y) * image.width + part.left),
        row_bytes, result.bgra.begin() + y * row_bytes);
  return result;
}

}  // namespace

SolidImages::SolidImages(double aspect, const Fonts& fonts) : aspect_(aspect), fonts_(fonts) {}

SolidImages::~SolidImages() = default;

std::optional<SolidImage> SolidImages::draw(const Solids& solids) {
  const int height = std::max(1, std::min(kHeight, int(kWidest / aspect_)));
  const int width = std::max(1, int(std::lround(height * aspect_)));
  if (!canvas_) canvas_ = std::make_unique<Canvas>(width, height, fonts_);
  Picture picture;
  picture.aspect = aspect_;
  picture.background.a = 0;
  picture.add(solids);
  Image page;
  canvas_->draw(picture, page);
  const Part part = part_of(page);
  if (part.left >= part.right) return std::nullopt;
  const auto unit = [height](int pixels) { return double(pixels) / height; };
  return SolidImage{cut(page, part),
                    {unit(part.left), 1 - unit(part.bottom), unit(part.right), 1 - unit(part.top)}};
}

cairo_surface_t* image_surface(const Image& image) {
  cairo_surface_t* surface = libcairo().cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height);
  if (libcairo().cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) return surface;
  unsigned char* pixels = libcairo().cairo_image_surface_get_data(surface);
  const auto stride = std::size_t(libcairo().cairo_image_surface_get_stride(surface));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Pixel p = image.at(x, y);
      const auto level = [&p](unsigned value) { return (value * p.a + 127) / 255; };
      const std::uint32_t argb = std::uint32_t(p.a) << 24 | level(p.r) << 16 | level(p.g) << 8 | level(p.b);
      std::copy_n(reinterpret_cast<const unsigned char*>(&argb), 4,
                  pixels + std::size_t(y) * stride + 4 * std::size_t(x));
    }
  libcairo().cairo_surface_mark_dirty(surface);
  return surface;
}

std::string png_text(const Image& image) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(image_surface(image),
                                                                                   libcairo().cairo_surface_destroy);
  std::string bytes;
  const cairo_status_t status = libcairo().cairo_surface_write_to_png_stream(
      surface.get(),
      [](void* to, const unsigned char* data, unsigned length) {
        static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
      },
      &bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(ExitCode::no_renderer,
                std::string("Cairo failed while writing bodies: ") + libcairo().cairo_status_to_string(status));
  return bytes;
}

}  // namespace chainreel
