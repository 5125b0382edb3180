#include "app/film/clip_memory.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "app/cli/shell_word.hpp"
#include "app/film/formats.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "encode/pdf_streams.hpp"
#include "picture/formula_words.hpp"
#include "picture/text.hpp"

namespace chainreel {
namespace {

constexpr const char* kScene = "chainreel_scene";
constexpr const char* kAudit = "chainreel_audit";
constexpr const char* kFigure = "chainreel_figure";

constexpr std::uintmax_t kLargestPage = std::uintmax_t(256) << 20;  // bytes of an SVG or PDF

[[noreturn]] void remembers_nothing(const std::string& path) {
  throw Error(ExitCode::bad_input,
              "remembers no scene: it was not made by `chainreel render` or `snapshot`, or "
              "what it said was taken out since",
              {path});
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

// The text of <metadata>, as our writer of SVG leaves it.
std::string svg_words(const std::string& svg, const std::string& path) {
  const std::string open = "<metadata>";
  const std::size_t begin = svg.find(open), end = svg.find("</metadata>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) remembers_nothing(path);
  std::string text = svg.substr(begin + open.size(), end - begin - open.size());
  for (const auto& [entity, letter] :
       {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}})
    replace_all(text, entity, letter);
  return text;
}

int hex_digit(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                : -1;
}

// A literal string of a PDF (ISO 32000-1, 7.3.4.2) that begins at `first`: brackets in pairs stand for themselves, others and
// backslashes behind one. Nothing where it does not end.
std::optional<std::string> literal_string(const std::string& pdf, std::size_t first) {
  std::string text;
  int open = 0;
  for (std::size_t i = first; i < pdf.size(); ++i) {
    const char c = pdf[i];
    if (c == ')' && open-- == 0) return text;
    if (c == '(') ++open;
    if (c != '\\') {
      text += c;
      continue;
    }
    if (++i == pdf.size()) break;
    const std::size_t known = std::string_view("nrtbf").find(pdf[i]);
    if (known != std::string_view::npos) {
      text += "\n\r\t\b\f"[known];
    } else if (pdf[i] >= '0' && pdf[i] <= '7') {
      int code = 0;
      for (int digits = 0; digits < 3 && i < pdf.size() && pdf[i] >= '0' && pdf[i] <= '7'; ++digits, ++i) code = 8 * code + (pdf[i] - '0');
      text += char(code);
      --i;
    } else if (pdf[i] != '\n') {  // else the line goes on
      text += pdf[i];
    }
  }
  return std::nullopt;
}

// The keywords of a PDF that Cairo wrote: a literal string where they are ASCII (with older versions only without brackets and
// backslashes), else a hexadecimal one in UTF-16 behind a byte order mark (ISO 32000-1, 7.3.4 and 7.9.2.2). Our JSON is ASCII.
std::string pdf_words(const std::string& pdf, const std::string& path) {
  const std::string literal = "/Keywords (", open = "/Keywords <FEFF";
  if (const std::size_t at = pdf.rfind(literal); at != std::string::npos) {
    const std::optional<std::string> words = literal_string(pdf, at + literal.size());
    if (!words) remembers_nothing(path);
    return *words;
  }
  const std::size_t begin = pdf.rfind(open);
  const std::size_t end = begin == std::string::npos ? begin : pdf.find('>', begin);
  if (end == std::string::npos) remembers_nothing(path);
  std::string text;
  int unit = 0, digits = 0;
  for (std::size_t i = begin + open.size(); i < end; ++i) {
    const int digit = hex_digit(pdf[i]);
    if (digit < 0) continue;  // lines may be broken
    unit = unit * 16 + digit;
    if (++digits % 4 != 0) continue;
    if (unit > 127) remembers_nothing(path);
    text += char(unit);
    unit = 0;
  }
  return text;
}

// Scene and audit as one text, in ASCII: for files that hold one text.
Tags words_of(const std::string& text, const std::string& path) {
  const Json json = parse_json(text);
  if (json.is_object() && json.contains(kFigure)) return {{kFigure, json[kFigure].dump()}};
  if (!json.is_object() || !json.contains(kScene) || !json[kScene].is_string()) remembers_nothing(path);
  return {{kScene, json[kScene].get<std::string>()},
          {kAudit, json.contains(kAudit) ? json[kAudit].dump() : "{}"}};
}

Tags tags_in(const std::string& path) {
  if (const OutputFormat* format = find_output_format(path); format && format->read_tags)
    return format->read_tags(path);
  const auto remembers = [](const OutputFormat& row) { return row.read_tags != nullptr; };
  throw Error(ExitCode::bad_input, "only " + endings_of(remembers, "and") + " remember a scene", {path});
}

}  // namespace

Tags read_svg_words(const std::string& path) {
  return words_of(svg_words(read_plain_file(path, kLargestPage), path), path);
}

Tags read_pdf_words(const std::string& path) {
  const std::string pdf = read_plain_file(path, kLargestPage);
  return words_of(pdf_words(pdf.find("/Keywords") == std::string::npos ? objects_in_streams(pdf) : pdf, path), path);
}

Tags ClipMemory::tags() const {
  Tags tags;
  if (!figure.is_null())
    tags[kFigure] = figure.dump();
  else
    tags = {{kScene, scene}, {kAudit, audit.dump()}};
  if (!title.empty()) tags["title"] = title;
  if (!description.empty()) tags["description"] = description;
  return tags;
}

VectorPage ClipMemory::page() const {
  VectorPage page;
  // Browsers show it, in letters alone; the audit's says when it falls.
  const bool is_told = audit.is_object() && audit.value("title", Json()).is_string();
  page.title = in_plain_words(is_told ? audit["title"].get<std::string>() : title);
  page.description = description;
  page.width_mm = width_mm;
  const Json json = figure.is_null() ? Json{{kScene, scene}, {kAudit, audit}} : Json{{kFigure, figure}};
  page.metadata = json.dump(-1, ' ', true);
  return page;
}

namespace {

// What a spoilt clip says may hold any bytes; everything behind this deals in text.
void require_text(const std::string& name, const std::string& value, const std::string& path) {
  try {
    decode_utf8(value);
  } catch (const Error&) {
    throw Error(ExitCode::bad_input, "what it remembers as '" + name + "' is damaged: it is no UTF-8", {path});
  }
}

}  // namespace

ClipMemory recall(const std::string& path) {
  require_plain_file(path, kLargestInput * 64);  // films are not read as a whole
  const Tags tags = tags_in(path);
  const auto text = [&](const char* name) {
    const auto place = tags.find(name);
    return place == tags.end() ? std::string() : place->second;
  };
  ClipMemory memory{text("title"), text("description"), text(kScene), {}, {}};
  const Json figure = parse_json(text(kFigure));
  if (figure.is_object() && figure.contains("arguments") && figure["arguments"].is_array()) {
    memory.figure = figure;
    return memory;
  }
  if (memory.scene.empty()) remembers_nothing(path);
  for (const char* name : {"title", "description", kScene}) require_text(name, text(name), path);
  memory.audit = parse_json(text(kAudit));
  if (!memory.audit.is_object()) memory.audit = Json::object();
  return memory;
}

std::string command_line(const Json& figure) {
  std::vector<std::string> words{"chainreel"};
  for (const Json& word : figure.at("arguments")) words.push_back(word.is_string() ? word.get<std::string>() : word.dump());
  return shell_line(words);
}

}  // namespace chainreel
