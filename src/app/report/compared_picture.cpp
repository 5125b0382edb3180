#include "app/report/compared_picture.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "core/input_file.hpp"
#include "encode/png.hpp"

namespace chainreel {

bool is_compared_picture(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return false;
  try {
    const std::map<std::string, std::string> text = read_png_text(path);
    return text.contains(compared_picture_text().begin()->first);
  } catch (const Error&) {
    return false;  // no picture, whatever its name
  }
}

const std::map<std::string, std::string>& compared_picture_text() {
  static const std::map<std::string, std::string> text{{"chainreel_compared", "what a comparison showed"}};
  return text;
}

void remove_compared_picture(const std::string& path) {
  if (!noted_input(path).empty() || !is_compared_picture(path)) return;
  std::error_code code;
  std::filesystem::remove(path, code);
  if (code)
    throw Error(ExitCode::file, "is no more true and cannot be removed (" + code.message() + "): remove it",
                {path});
}

}  // namespace chainreel
