#include "app/film/house_logo.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/film/prepared.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "draw/page/house_style.hpp"
#include "encode/png.hpp"
#include "picture/text.hpp"
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

bool has_letters_beyond_ascii(const std::string& words) {
  return std::any_of(words.begin(), words.end(), [](char c) { return static_cast<unsigned char>(c) > 0x7F; });
}

// librsvg opens no other file and says nothing of it: what a picture takes from outside would be missing in silence, as would what
// it does not draw at all. Where the text is no XML, librsvg says so.
class Missing : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute* attribute) override {
    const std::string_view name = element.Name();
    if (name.ends_with("foreignObject")) say(std::string("<") + element.Name() + "> is not drawn");
    const bool is_link = name == "a" || name.ends_with(":a");  // where a click would lead
    for (; attribute != nullptr && !is_link; attribute = attribute->Next()) {
      const std::string_view value = attribute->Value();
      if (std::string_view(attribute->Name()).ends_with("href") && !is_inside(value)) say_outside(value);
      look_at_style(value);
    }
    return true;
  }
  bool Visit(const tinyxml2::XMLText& text) override {
    if (text.Parent() != nullptr && text.Parent()->ToElement() != nullptr && std::string_view(text.Parent()->ToElement()->Name()).ends_with("style"))
      look_at_style(text.Value());
    return true;
  }
  bool Visit(const tinyxml2::XMLDeclaration& declaration) override {
    if (std::string_view(declaration.Value()).starts_with("xml-stylesheet")) say_outside("a style sheet");
    return true;
  }

  const std::string& found() const { return found_; }

 private:
  static bool is_inside(std::string_view place) { return place.empty() || place.front() == '#' || place.starts_with("data:"); }
  void say(const std::string& what) {
    if (found_.empty()) found_ = what;
  }
  void say_outside(std::string_view place) {
    constexpr std::size_t kLongest = 60;
    say("takes '" + std::string(place.substr(0, kLongest)) + "' from outside of the file, which is not opened");
  }
  void look_at_style(std::string_view text) {
    if (text.find("@import") != text.npos) say_outside("@import");
    for (std::size_t at = text.find("url("); at != text.npos; at = text.find("url(", at + 1)) {
      std::string_view place = text.substr(at + 4);
      place.remove_prefix(std::min(place.find_first_not_of(" \t\r\n'\""), place.size()));
      if (!is_inside(place)) say_outside(place.substr(0, place.find_first_of("'\")")));
    }
  }

  std::string found_;
};

void require_whole(const std::string& bytes, const std::string& path) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) return;
  Missing missing;
  document.Accept(&missing);
  if (!missing.found().empty())
    throw Error(ExitCode::bad_input, missing.found() + ": save the logo as plain shapes, with its pictures inside (as data:)", {path});
}

// What a scene has to say in words of one's own.
void collect_words(const Scene& scene, std::vector<std::string>& words) {
  words.push_back(scene.title);
  for (const AnnotationEntry& one : scene.annotate) words.push_back(one.text);
  for (const PlotEntry& one : scene.plot) words.push_back(one.title);
  for (const EventEntry& one : scene.events) words.push_back(one.title());
  for (const Scene& panel : scene.compare) collect_words(panel, words);
}

// The faces that stand in for what those of the scene lack, in both weights: which of them it is decided by what is installed.
Json fallback_report(const Scene& scene) {
  std::vector<std::string> words;
  collect_words(scene, words);
  std::erase_if(words, [](const std::string& one) { return !has_letters_beyond_ascii(one); });
  Json report = Json::array();
  if (words.empty()) return report;
  const Fonts fonts(families_of(scene));
  for (const std::string& one : words)
    for (const Face face : {Face::label, Face::label_bold}) {
      try {
        lay_out_words(fonts, one, {.face = face});
      } catch (const Error&) {
        // Told where it is drawn.
      }
    }
  for (const Face face : fonts.fallbacks())
    report.push_back({{"file", fs::path(fonts.file(face)).filename().string()}, {"face", fonts.index(face)}, {"sha256", fonts.sha256(face)}});
  return report;
}

void read_logo(Logo& logo) {
  note_input(logo.file);
  const std::string bytes = read_plain_file(logo.file, kLargestLogoFile);
  const bool is_svg = lower_case_ending(logo.file) == ".svg";
  if (is_svg) require_whole(bytes, logo.file);
  logo.image = std::make_shared<const Image>(is_svg
                                                 ? svg_image(bytes, logo.file, kPixelsOfSvg)
                                                 : decode_png(bytes, logo.file));
  logo.sha256 = sha256_of(bytes);
}

}  // namespace

void load_logo(Scene& scene) {
  if (scene.style.logo) read_logo(*scene.style.logo);
}

std::optional<PageLogo> page_logo(const Scene& scene, int page_height) {
  if (!scene.style.logo) return std::nullopt;
  Logo logo = *scene.style.logo;
  if (!logo.image) read_logo(logo);
  return PageLogo{logo.image, logo.corner, logo.height, page_height};
}

Json style_report(const PreparedFilm& film) {
  const Scene& scene = film.scene;
  const Style& style = scene.style;
  const Json fallbacks = fallback_report(scene);
  if (style.empty() && fallbacks.empty()) return nullptr;
  Json report = Json::object();
  if (!fallbacks.empty()) report["fallback_fonts"] = fallbacks;
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
  report["low_contrast"] = low_contrasts(scene, bars_of(film));
  return report;
}

}  // namespace chainreel
