// Pages for browsers: the texts of src/app/gallery/pages, embedded when the program is built, with {{names}} to fill
// in.
#pragma once

#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <string_view>

namespace chainreel {

struct EmbeddedPage {
  std::string_view name;  // "card.html"
  std::string_view text;
};

extern const EmbeddedPage kEmbeddedPages[];
extern const int kEmbeddedPageCount;

// Throws std::logic_error for a name that is not embedded.
std::string_view embedded_page(std::string_view name);

// What stands in the place of a {{name}}: written when it is its turn, so that films need not lie in memory.
using Filler = std::function<void(std::ostream&)>;
using Fillers = std::map<std::string, Filler, std::less<>>;

Filler plain(std::string text);   // escaped, for content and for attributes in double quotes
Filler markup(std::string text);  // as it is

std::string escape_html(std::string_view text);

// Throws std::logic_error for a {{name}} without a filler.
void fill_page(std::ostream& stream, std::string_view page, const Fillers& fillers);
std::string filled_page(std::string_view page, const Fillers& fillers);

}  // namespace chainreel
