#include "app/report/page_template.hpp"

#include <span>
#include <sstream>
#include <stdexcept>

namespace chainreel {

std::string_view embedded_page(std::string_view name) {
  for (const EmbeddedPage& page : std::span(kEmbeddedPages, std::size_t(kEmbeddedPageCount)))
    if (page.name == name) return page.text;
  throw std::logic_error("page " + std::string(name) + " is not part of this build");
}

// A byte that no page may hold (HTML, 13.2.3.5) becomes a space.
std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const bool forbidden = static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t';
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += forbidden || c == 127 ? ' ' : c;
  }
  return escaped;
}

Filler plain(std::string text) {
  return [escaped = escape_html(text)](std::ostream& stream) { stream << escaped; };
}

Filler markup(std::string text) {
  return [text = std::move(text)](std::ostream& stream) { stream << text; };
}

void fill_page(std::ostream& stream, std::string_view page, const Fillers& fillers) {
  for (;;) {
    const std::size_t open = page.find("{{");
    stream << page.substr(0, open);
    if (open == std::string_view::npos) return;
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto filler = fillers.find(name);
    if (filler == fillers.end()) throw std::logic_error("nothing fills {{" + std::string(name) + "}}");
    filler->second(stream);
    page.remove_prefix(close + 2);
  }
}

std::string filled_page(std::string_view page, const Fillers& fillers) {
  std::ostringstream stream;
  fill_page(stream, page, fillers);
  return stream.str();
}

}  // namespace chainreel
