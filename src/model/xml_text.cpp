#include "model/xml_text.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

// Walks over markup without building anything; comments, CDATA and quoted attributes are stepped over whole.
class XmlScanner {
 public:
  explicit XmlScanner(std::string_view text) : text_(text) {}

  enum class Markup { open, close, empty, end };

  // Moves behind the next element tag. Unclosed markup ends the scan: the parser will say what is wrong with
  // it.
  Markup next() {
    for (;;) {
      at_ = text_.find('<', at_);
      if (at_ == std::string_view::npos) return Markup::end;
      tag_begin_ = at_;
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with("<!--")) {
        if (!skip_behind("-->", 4)) return Markup::end;
      } else if (rest.starts_with("<![CDATA[")) {
        if (!skip_behind("]]>", 9)) return Markup::end;
      } else if (rest.starts_with("<?")) {
        if (!skip_behind("?>", 2)) return Markup::end;
      } else if (rest.starts_with("<!")) {
        if (!skip_behind(">", 2)) return Markup::end;
      } else {
        return element();
      }
    }
  }

  // What the last tag had: attributes, counted by their quotes, and characters.
  int attributes() const { return attributes_; }
  std::size_t length() const { return at_ - tag_begin_; }
  int line() const {
    return 1 + int(std::count(text_.begin(), text_.begin() + std::ptrdiff_t(tag_begin_), '\n'));
  }

 private:
  bool skip_behind(std::string_view mark, std::size_t from) {
    const std::size_t found = text_.find(mark, at_ + from);
    if (found == std::string_view::npos) return false;
    at_ = found + mark.size();
    return true;
  }

  Markup element() {
    const bool closes = text_.substr(at_).starts_with("</");
    char quote = 0;
    attributes_ = 0;
    for (++at_; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
        ++attributes_;
      } else if (c == '>') {
        const bool is_empty = text_[at_ - 1] == '/';
        ++at_;
        return closes ? Markup::close : is_empty ? Markup::empty : Markup::open;
      }
    }
    return Markup::end;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t tag_begin_ = 0;
  int attributes_ = 0;
};

// Elements, their attributes and their words, each on one line.
class ElementPrinter : public tinyxml2::XMLPrinter {
 public:
  ElementPrinter() : XMLPrinter(nullptr, true) {}
  bool Visit(const tinyxml2::XMLComment&) override { return true; }
};

}  // namespace

void check_xml_limits(const std::string& text, const std::string& path) {
  XmlScanner scanner(text);
  const auto refuse = [&](const std::string& message) {
    throw Error(ExitCode::limit, message, {path, scanner.line()});
  };
  int depth = 0;
  int elements = 0;
  for (auto markup = scanner.next(); markup != XmlScanner::Markup::end; markup = scanner.next()) {
    if (markup == XmlScanner::Markup::close) {
      --depth;
      continue;
    }
    if (markup == XmlScanner::Markup::open) ++depth;
    if (++elements > kMostXmlElements)
      refuse("has more than " + std::to_string(kMostXmlElements) + " elements: split or simplify the model");
    if (scanner.attributes() > kMostXmlAttributes)
      refuse("a tag has more than " + std::to_string(kMostXmlAttributes) + " attributes: a URDF needs 6");
    if (scanner.length() > kLongestXmlTag)
      refuse("a tag is longer than " + std::to_string(kLongestXmlTag) +
             " characters: shorten its names or paths");
    if (depth > kDeepestXml) {
      refuse("elements are nested deeper than " + std::to_string(kDeepestXml) +
             " levels; a URDF needs 5: is a closing tag missing?");
    }
  }
}

std::string read_xml_text(const std::string& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) throw Error(ExitCode::bad_input, "no such file", {path});
  if (!fs::is_regular_file(status)) throw Error(ExitCode::bad_input, "is not a file with text", {path});
  const auto size = fs::file_size(path, code);
  if (code) throw Error(ExitCode::bad_input, "cannot be read: " + code.message(), {path});
  if (size > kLargestXmlFile) {
    throw Error(
        ExitCode::limit,
        "is larger than " + std::to_string(kLargestXmlFile >> 20) + " MiB: put shapes into mesh files",
        {path});
  }

  note_input(path);
  std::ifstream stream(path, std::ios::binary);
  std::string text(size, '\0');
  stream.read(text.data(), std::streamsize(size));
  if (!stream) throw Error(ExitCode::bad_input, "cannot be read: is it yours to read?", {path});
  if (text.find('\0') != std::string::npos)
    throw Error(ExitCode::bad_input, "holds zero bytes: it is no XML text in UTF-8", {path});
  check_xml_limits(text, path);
  return text;
}

std::string sha256_of_elements(const std::string& text, const std::string& path) {
  tinyxml2::XMLDocument document(true, tinyxml2::COLLAPSE_WHITESPACE);
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
    throw Error(ExitCode::bad_input, "is no XML", {path, document.ErrorLineNum()});
  ElementPrinter printer;
  document.Print(&printer);
  return sha256_of({printer.CStr(), std::size_t(printer.CStrSize() - 1)});
}

}  // namespace chainreel
