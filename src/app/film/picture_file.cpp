#include "app/film/picture_file.hpp"

#include "app/signals.hpp"
#include "core/error.hpp"
#include "core/output_file.hpp"
#include "render/canvas.hpp"

namespace chainreel {

Image rasterise(const Picture& picture, int width, int height, const Fonts& fonts) {
  Canvas canvas(width, height, fonts);
  Image image;
  canvas.draw(picture, image);
  return image;
}

const OutputFormat& picture_format_of(const std::string& path) {
  if (const OutputFormat* format = find_output_format(path, Shows::still)) return *format;
  const auto is_picture = [](const OutputFormat& row) { return row.shows == Shows::still; };
  throw Error(ExitCode::usage, "-o " + path + ": pictures are written as " + endings_of(is_picture, "or"));
}

void write_picture(const Picture& picture, int width, int height, const Fonts& fonts, const std::string& path,
                   bool overwrite, const ClipMemory& memory) {
  OutputFile output(path, overwrite);
  picture_format_of(path).write_still(
      output, {[&] { return picture; }, [&] { return rasterise(picture, width, height, fonts); }, fonts}, memory);
  throw_if_interrupted();
  output.commit();
}

}  // namespace chainreel
