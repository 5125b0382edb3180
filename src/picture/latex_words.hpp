// What LaTeX calls otherwise than our notation does, as far as lectures on mechanics need it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace chainreel {

inline constexpr std::array<std::u32string_view, 5> kLatexSpaces = {U",", U";", U":", U"!", U" "};
inline constexpr std::array<std::u32string_view, 8> kLatexLayout = {U"left", U"right", U"big", U"Big", U"quad", U"qquad", U"displaystyle", U"limits"};
inline constexpr std::array<std::u32string_view, 4> kLatexTexts = {U"mathrm", U"text", U"textrm", U"operatorname"};
inline constexpr std::array<std::pair<std::u32string_view, std::u32string_view>, 14> kLatexWords = {{
    {U"dfrac", U"frac"}, {U"tfrac", U"frac"}, {U"widehat", U"hat"}, {U"overline", U"bar"}, {U"mathbf", U"bold"}, {U"boldsymbol", U"bold"},
    {U"bm", U"bold"}, {U"arcsin", U"asin"}, {U"arccos", U"acos"}, {U"arctan", U"atan"}, {U"varphi", U"phi"}, {U"varepsilon", U"epsilon"},
    {U"vartheta", U"theta"}, {U"varrho", U"rho"},
}};
inline constexpr std::array<std::pair<std::u32string_view, char32_t>, 28> kLatexSigns = {{
    {U"cdot", 0x22C5}, {U"times", 0xD7}, {U"pm", 0xB1}, {U"mp", 0x2213}, {U"le", 0x2264}, {U"leq", 0x2264}, {U"ge", 0x2265}, {U"geq", 0x2265},
    {U"approx", 0x2248}, {U"ne", 0x2260}, {U"neq", 0x2260}, {U"to", 0x2192}, {U"rightarrow", 0x2192}, {U"Rightarrow", 0x21D2}, {U"sim", 0x223C},
    {U"propto", 0x221D}, {U"in", 0x2208}, {U"ll", 0x226A}, {U"gg", 0x226B}, {U"infty", 0x221E}, {U"partial", 0x2202}, {U"nabla", 0x2207},
    {U"sum", 0x2211}, {U"int", 0x222B}, {U"dots", 0x2026}, {U"ldots", 0x2026}, {U"circ", 0x2218}, {U"prime", U'\''},
}};

// The braces of \text{..} and its kin: spaces and signs as they are; `unknown` is the first word that is none, "" where there is none.
struct LatexText {
  std::u32string plain, unknown;
};
LatexText plain_latex_text(std::u32string_view written);

}  // namespace chainreel
