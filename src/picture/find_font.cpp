#include "picture/find_font.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_TRUETYPE_TABLES_H

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <tuple>
#include <vector>

#include "core/error.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr int kRegular = 400, kBold = 700, kNormalWidth = 5;  // OS/2: usWeightClass, usWidthClass

// Sorted, so that the order in which a file system lists names means nothing.
std::vector<std::string> font_files(const std::vector<std::string>& folders) {
  std::set<std::string> files;
  for (const std::string& folder : folders) {
    std::error_code code;
    for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, code), end;
         !code && entry != end; entry.increment(code)) {
      std::error_code ignored;
      const std::string ending = entry->path().extension().string();
      if ((ending == ".ttf" || ending == ".otf" || ending == ".ttc") && entry->is_regular_file(ignored))
        files.insert(entry->path().string());
    }
  }
  return {files.begin(), files.end()};
}

int weight_of(FT_Face face) {
  const auto* os2 = static_cast<const TT_OS2*>(FT_Get_Sfnt_Table(face, FT_SFNT_OS2));
  if (os2 != nullptr && os2->version != 0xFFFF) return os2->usWeightClass;
  return (face->style_flags & FT_STYLE_FLAG_BOLD) != 0 ? kBold : kRegular;
}

int width_of(FT_Face face) {
  const auto* os2 = static_cast<const TT_OS2*>(FT_Get_Sfnt_Table(face, FT_SFNT_OS2));
  return os2 != nullptr && os2->version != 0xFFFF ? os2->usWidthClass : kNormalWidth;
}

}  // namespace

std::vector<std::string> font_folders() {
  std::vector<std::string> folders{"/usr/local/share/fonts", "/usr/share/fonts", "/usr/share/texmf/fonts/opentype"};
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != 0)
    folders.push_back((fs::path(home) / ".local/share/fonts").string());
  return folders;
}

std::vector<InstalledFace> installed_faces(FT_LibraryRec_* library, const std::vector<std::string>& folders) {
  std::vector<InstalledFace> faces;
  for (const std::string& file : font_files(folders)) {
    long count = 1;
    for (int index = 0; index < count; ++index) {
      FT_Face face = nullptr;
      if (FT_New_Face(library, file.c_str(), index, &face) != 0) break;
      count = face->num_faces;
      if ((face->style_flags & FT_STYLE_FLAG_ITALIC) == 0 && FT_IS_SCALABLE(face) && !FT_HAS_COLOR(face))
        faces.push_back({{file, index}, face->family_name != nullptr ? face->family_name : "", weight_of(face), width_of(face)});
      FT_Done_Face(face);
    }
  }
  return faces;
}

FontFile find_font(FT_LibraryRec_* library, const std::string& family, WantedFace wanted) {
  const bool is_bold = wanted == WantedFace::bold;
  std::vector<std::tuple<int, int, std::string, int>> found;
  std::set<std::string> families;
  for (const InstalledFace& face : installed_faces(library, font_folders())) {
    families.insert(face.family);
    // A light face is no bold one, nor the other way round.
    if (face.family == family && (face.weight > (kRegular + kBold) / 2) == is_bold)
      found.emplace_back(std::abs(face.weight - (is_bold ? kBold : kRegular)), std::abs(face.width - kNormalWidth),
                         face.at.file, face.at.index);
  }
  if (!found.empty()) {
    const auto& [weight, width, file, index] = *std::min_element(found.begin(), found.end());
    return {file, index};
  }
  const bool is_known = families.contains(family);
  const std::vector<std::string> names(families.begin(), families.end());
  throw Error(ExitCode::no_renderer,
              "font family '" + family + "' " +
                  (is_known ? std::string("has no upright ") + (is_bold ? "bold" : "regular") + " face: name another family for `" +
                                  (is_bold ? "bold" : "label") + "`"
                            : "is not installed:" + did_you_mean(family, names) +
                                  " install it in /usr/local/share/fonts (.ttf, .otf, .ttc), or name one that is there"));
}

}  // namespace chainreel
