// The key style: a mapping, or the name of a file that holds one.
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

constexpr const char* kNoStyle = "holds no style: write `light: {ink: \"#1A1A1A\"}`, `lines: 1.2` or what else it changes";
constexpr double kThinnest = 0.5, kThickest = 2;          // `lines`
constexpr double kShortestTrail = 0.2, kLongestTrail = 60;  // `trail`, s
const std::string kWholeTrail = "all";
constexpr Name kTrailWords[] = {{"all", "the whole way"}};
constexpr double kSmallestLogo = 0.02, kLargestLogo = 0.2;  // units of H

// "#1A2B3C", or 1A2B3C where nobody wants quotes.
std::optional<std::uint32_t> color_in(const std::string& text) {
  const std::string digits = text.starts_with('#') ? text.substr(1) : text;
  if (digits.size() != 6 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) return std::nullopt;
  return std::uint32_t(std::stoul(digits, nullptr, 16));
}

std::string text_of_color(std::uint32_t color) {
  std::ostringstream text;
  text << '#' << std::uppercase << std::hex << std::setw(6) << std::setfill('0') << color;
  return text.str();
}

class ColorsReader {
 public:
  ColorsReader(Fields fields, StyleColors& colors) : fields_(std::move(fields)), colors_(&colors) {}

  void read() {
    for (const Name& color : kStyleColors) read_color(color.name);
    read_list("links", kMostLinkColors);
    read_list("curves", kMostCurveColors);
    fields_.finish();
  }

 private:
  std::optional<std::uint32_t> color_of(const std::string& key, const YAML::Node& node) {
    const auto color = node.IsScalar() ? color_in(node.Scalar()) : std::nullopt;
    if (!color)
      fields_.problem_at(key, "'" + fields_.path(key) + "' " +
                                  (node.IsScalar() ? "holds '" + node.Scalar() + "'" : "is empty") +
                                  ": colours are six hexadecimal digits in quotes, like \"#1A1A1A\" (without quotes, YAML takes "
                                  "what follows # for a comment)");
    return color;
  }

  void read_color(const std::string& key) {
    const YAML::Node node = fields_.find(key);
    if (!node.IsDefined()) return;
    if (const auto color = color_of(key, node)) (*colors_)[key] = {*color};
  }

  void read_list(const std::string& key, std::size_t most) {
    const YAML::Node node = fields_.find(key);
    if (!node.IsDefined()) return;
    if (!node.IsSequence() || node.size() == 0 || node.size() > most)
      return fields_.problem_at(key, "'" + fields_.path(key) + "' must list one to " + std::to_string(most) +
                                         " colours: " + key + ": [\"#56B4E9\", \"#E69F00\"]");
    std::vector<std::uint32_t> all;
    for (const YAML::Node& one : node)
      if (const auto color = color_of(key, one)) all.push_back(*color);
    if (all.size() == node.size()) (*colors_)[key] = all;
  }

  Fields fields_;
  StyleColors* colors_;
};

void read_logo(Fields& style, std::optional<Logo>& logo) {
  const auto complain = [](Fields& fields, const std::string& key, const std::string& what) {
    fields.problem_at(key, "'" + fields.path(key) + "' " + what);
  };
  std::optional<Fields> fields = style.section("logo", "file, corner, height: logo: {file: lab.png}");
  if (!fields) return;
  Logo read;
  fields->read_path("file", read.file);
  fields->read("corner", read.corner);
  fields->read("height", read.height);
  fields->finish();
  std::error_code ignored;
  const std::string ending = lower_case_ending(read.file);
  if (read.file.empty())
    return complain(*fields, "file", "must name the picture: logo: {file: lab.png}");
  if (!std::filesystem::is_regular_file(read.file, ignored))
    return complain(*fields, "file", "names " + read.file + ", which is not there: paths are relative to the file that holds the style");
  if (ending != ".png" && ending != ".svg")
    return complain(*fields, "file", "names " + read.file + ": a logo is a .png or an .svg file");
  if (!(read.height >= kSmallestLogo && read.height <= kLargestLogo))
    return complain(*fields, "height", "must lie between " + format_shortest(kSmallestLogo) + " and " +
                                           format_shortest(kLargestLogo) + " of the picture's height");
  logo = std::move(read);
}

void read_fonts(Fields& style, StyleFonts& fonts) {
  std::optional<Fields> fields = style.section("fonts", "label, bold, math: fonts: {label: Inter}");
  if (!fields) return;
  fields->read("label", fonts.label);
  fields->read("bold", fonts.bold);
  fields->read("math", fonts.math);
  fields->finish();
}

void read_mapping(Fields& fields, Style& style) {
  for (const auto& [key, colors] : {std::pair{"light", &style.light}, {"dark", &style.dark}})
    if (auto section = fields.section(key, "colours: " + std::string(key) + ": {ink: \"#1A1A1A\", links: [\"#56B4E9\"]}"))
      ColorsReader(std::move(*section), *colors).read();
  if (fields.read("lines", style.lines) && !(style.lines >= kThinnest && style.lines <= kThickest))
    fields.problem_at("lines", "'" + fields.path("lines") + "' must lie between " + format_shortest(kThinnest) + " and " +
                                   format_shortest(kThickest) + ": 1.2 draws lines a fifth wider");
  if (const YAML::Node trail = fields.find("trail"); trail.IsScalar() && trail.Scalar() == kWholeTrail)
    style.trail = std::numeric_limits<double>::infinity();
  else if (fields.read_seconds("trail", style.trail) && !(style.trail >= kShortestTrail && style.trail <= kLongestTrail))
    fields.problem_at("trail", "'" + fields.path("trail") + "' must lie between " + format_shortest(kShortestTrail) + " s and " +
                                   format_shortest(kLongestTrail) + " s: 3s keeps three seconds of the way, all keeps all of it and does not fade");
  read_fonts(fields, style.fonts);
  read_logo(fields, style.logo);
}

void read_file(Fields& fields, const std::string& path, Style& style) {
  try {
    const YamlDocument document = load_yaml(path, {}, kNoStyle);
    Fields inner(document, document.root, "", fields.problems());
    read_mapping(inner, style);
    inner.finish();
  } catch (const Error& error) {
    for (const Problem& problem : error.problems())
      if (problem.place.file.empty())
        fields.problem_at("style", problem.message);
      else
        fields.problems().add(problem.message, problem.place);
  }
}

void emit_colors(YAML::Emitter& out, const char* name, const StyleColors& colors) {
  if (colors.empty()) return;
  out << YAML::Key << name << YAML::Value << YAML::Flow << YAML::BeginMap;
  for (const auto& [key, values] : colors) {
    out << YAML::Key << key << YAML::Value;
    const bool is_list = key == "links" || key == "curves";
    if (is_list) out << YAML::Flow << YAML::BeginSeq;
    for (const std::uint32_t value : values) out << YAML::DoubleQuoted << text_of_color(value);
    if (is_list) out << YAML::EndSeq;
  }
  out << YAML::EndMap;
}

void emit_texts(YAML::Emitter& out, const char* name, const std::vector<std::pair<const char*, std::string>>& texts) {
  out << YAML::Key << name << YAML::Value << YAML::Flow << YAML::BeginMap;
  for (const auto& [key, text] : texts)
    if (!text.empty()) out << YAML::Key << key << YAML::Value << text;
  out << YAML::EndMap;
}

KeyText told_colors(const char* name, const char* help) {
  std::vector<KeyText> parts;
  for (const Name& color : kStyleColors) parts.push_back(told(color.name, KeyForm::text, color.meaning));
  parts.push_back(told_list("links", told("", KeyForm::text, ""), "one to four, of links in turn"));
  parts.push_back(told_list("curves", told("", KeyForm::text, ""), "one to three, of the curves of joints 1, 2, 3, and of three variants or more"));
  return told_record(name, std::move(parts), help);
}

}  // namespace

std::span<const Name> names_of(PageCorner) {
  static constexpr Name kCorners[] = {{"top_right", ""}, {"top_left", ""}, {"bottom_right", ""}, {"bottom_left", ""}};
  return kCorners;
}

KeyText told_style() {
  KeyText style = told_record(
      "", {told_colors("light", "colours of the light theme, like \"#1A1A1A\""), told_colors("dark", "colours of the dark theme"),
           told("lines", KeyForm::number, "times the widths of outlines, curves, ellipses, trails and shafts of arrows").within({kThinnest, kThickest}),
           told_either("trail", {told("", KeyForm::number, "").within({kShortestTrail, kLongestTrail}), told_word("", kTrailWords, "")},
                       "s that the end effector's trail goes back, fading, up to 1 no longer on the page than twice the chain; `all`: the whole way, which does not fade; 1 where left out"),
           told_record("fonts",
                       {told("label", KeyForm::text, "family of words"),
                        told("bold", KeyForm::text, "family of titles, in its bold face; left out: that of `label`"),
                        told("math", KeyForm::text, "family of formulas, with an OpenType MATH table")},
                       "families by their names; a family that is not installed is an error"),
           told_record("logo",
                       {told("file", KeyForm::path, "a .png or .svg file, relative to the file that holds the style").required(),
                        told_word("corner", names_of(PageCorner{}), "where it stands"),
                        told("height", KeyForm::number, "of the picture's height").within({kSmallestLogo, kLargestLogo})},
                       "a picture in a corner")},
      "the style itself");
  return told_either("style", {told("", KeyForm::path, "a file with the keys below, relative to the scene"), std::move(style)},
                     "house style: colours, line widths, faces, a logo");
}

void read_style(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("style");
  if (!node.IsDefined() || node.IsNull()) return;
  if (node.IsMap()) {
    Fields inner(fields.document(), node, fields.path("style"), fields.problems());
    read_mapping(inner, scene.style);
    return inner.finish();
  }
  std::string path;
  if (!fields.read_path("style", path)) return;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    return fields.problem_at("style", "there is no style file " + path + ": " + fields.paths_start("style"));
  read_file(fields, path, scene.style);
}

// What a file said stands in the scene itself, so that a film remembers it whole.
std::string style_text(const Scene& scene) {
  const Style& style = scene.style;
  if (style.empty()) return "";
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::BeginMap;
    emit_colors(out, "light", style.light);
    emit_colors(out, "dark", style.dark);
    if (style.lines != 1) out << YAML::Key << "lines" << YAML::Value << format_shortest(style.lines);
    if (style.trail != 1) out << YAML::Key << "trail" << YAML::Value << (std::isinf(style.trail) ? kWholeTrail : format_shortest(style.trail));
    const StyleFonts& fonts = style.fonts;
    if (!fonts.empty()) emit_texts(out, "fonts", {{"label", fonts.label}, {"bold", fonts.bold}, {"math", fonts.math}});
    if (const auto& logo = style.logo)
      emit_texts(out, "logo", {{"file", logo->file}, {"corner", to_string(logo->corner)}, {"height", format_shortest(logo->height)}});
    out << YAML::EndMap;
  });
}

}  // namespace chainreel
