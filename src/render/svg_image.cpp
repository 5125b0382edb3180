#include "render/svg_image.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "core/error.hpp"
#include "render/cairo_functions.hpp"

namespace chainreel {
namespace {

constexpr int kWidestImage = 8192;  // px

// The few declarations of librsvg 2.52 and of GLib that are needed, so that their headers are not.
struct RsvgHandle;
struct GError {
  std::uint32_t domain;
  int code;
  char* message;
};
struct RsvgRectangle {
  double x, y, width, height;
};

struct Librsvg {
  RsvgHandle* (*rsvg_handle_new_from_data)(const std::uint8_t* data, std::size_t size, GError** error) = nullptr;
  int (*rsvg_handle_get_intrinsic_size_in_pixels)(RsvgHandle* handle, double* width, double* height) = nullptr;
  void (*rsvg_handle_get_intrinsic_dimensions)(RsvgHandle* handle, int* has_width, void* width, int* has_height, void* height,
                                               int* has_box, RsvgRectangle* box) = nullptr;
  int (*rsvg_handle_render_document)(RsvgHandle* handle, cairo_t* cairo, const RsvgRectangle* area, GError** error) = nullptr;
  void (*g_object_unref)(void* object) = nullptr;
};

Librsvg load() {
  void* const library = dlopen("librsvg-2.so.2", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    throw Error(ExitCode::no_renderer, std::string("no SVG can be read: ") + dlerror() +
                                           "; install the Debian package librsvg2-2, or take a PNG");
  Librsvg functions;
  const auto find = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    if (function == nullptr)
      throw Error(ExitCode::no_renderer, std::string("librsvg has no function ") + name + ": version 2.52 or newer is needed");
  };
  find(functions.rsvg_handle_new_from_data, "rsvg_handle_new_from_data");
  find(functions.rsvg_handle_get_intrinsic_size_in_pixels, "rsvg_handle_get_intrinsic_size_in_pixels");
  find(functions.rsvg_handle_get_intrinsic_dimensions, "rsvg_handle_get_intrinsic_dimensions");
  find(functions.rsvg_handle_render_document, "rsvg_handle_render_document");
  find(functions.g_object_unref, "g_object_unref");  // of a library that librsvg brings along
  return functions;
}

[[noreturn]] void fail(const std::string& path, const GError* error) {
  throw Error(ExitCode::bad_input,
              std::string("cannot be read as SVG") + (error != nullptr ? std::string(": ") + error->message : ""), {path});
}

// Width over height, by its size or else by its viewBox.
double aspect_of(const Librsvg& rsvg, RsvgHandle* handle, const std::string& path) {
  double width = 0, height = 0;
  if (rsvg.rsvg_handle_get_intrinsic_size_in_pixels(handle, &width, &height) == 0 || !(width > 0 && height > 0)) {
    struct Length {
      double length;
      int unit;
    } unused[2];
    int has_width = 0, has_height = 0, has_box = 0;
    RsvgRectangle box{};
    rsvg.rsvg_handle_get_intrinsic_dimensions(handle, &has_width, &unused[0], &has_height, &unused[1], &has_box, &box);
    width = has_box != 0 ? box.width : 0;
    height = box.height;
  }
  if (!(width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height)))
    throw Error(ExitCode::bad_input, "says of no size: give its <svg> a width and a height, or a viewBox", {path});
  return width / height;
}

}  // namespace

Image svg_image(const std::string& bytes, const std::string& path, int height) {
  static const Librsvg rsvg = load();
  GError* error = nullptr;
  const std::unique_ptr<RsvgHandle, void (*)(void*)> handle(
      rsvg.rsvg_handle_new_from_data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), &error),
      rsvg.g_object_unref);
  if (handle == nullptr) fail(path, error);
  const double aspect = aspect_of(rsvg, handle.get(), path);
  if (aspect > double(kWidestImage) / height)
    throw Error(ExitCode::bad_input, "is more than " + std::to_string(kWidestImage / height) + " times as wide as high", {path});
  const int width = std::max(1, int(std::lround(height * aspect)));

  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      libcairo().cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height), libcairo().cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo(libcairo().cairo_create(surface.get()), libcairo().cairo_destroy);
  const RsvgRectangle area{0, 0, double(width), double(height)};
  if (rsvg.rsvg_handle_render_document(handle.get(), cairo.get(), &area, &error) == 0) fail(path, error);
  if (libcairo().cairo_status(cairo.get()) != CAIRO_STATUS_SUCCESS) throw Error(ExitCode::limit, "no memory to draw it", {path});
  libcairo().cairo_surface_flush(surface.get());

  Image image(width, height);
  const unsigned char* pixels = libcairo().cairo_image_surface_get_data(surface.get());
  const auto stride = std::size_t(libcairo().cairo_image_surface_get_stride(surface.get()));
  for (std::size_t y = 0; y < std::size_t(height); ++y)
    std::copy_n(pixels + y * stride, 4 * std::size_t(width), &image.bgra[4 * y * std::size_t(width)]);
  for (std::size_t i = 0; i < image.bgra.size(); i += 4) divide_by_alpha(&image.bgra[i]);
  return image;
}

}  // namespace chainreel
