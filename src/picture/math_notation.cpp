#include "picture/math_notation.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.hpp"
#include "picture/latex_words.hpp"
#include "picture/text.hpp"

namespace chainreel {
namespace {

// In the order of their code points from U+03B1; the final sigma stands between rho and sigma.
constexpr std::array<std::u32string_view, 25> kGreek = {
    U"alpha", U"beta",   U"gamma",   U"delta", U"epsilon", U"zeta",    U"eta",  U"theta", U"iota",
    U"kappa", U"lambda", U"mu",      U"nu",    U"xi",      U"omicron", U"pi",   U"rho",   U"varsigma",
    U"sigma", U"tau",    U"upsilon", U"phi",   U"chi",     U"psi",     U"omega"};
constexpr std::array<std::u32string_view, 19> kFunctions = {U"sin", U"cos",  U"tan",  U"sqrt", U"exp",
                                                            U"log", U"abs",  U"min",  U"max",  U"atan2",
                                                            U"det", U"rank", U"diag", U"ln",   U"asin", U"acos", U"atan", U"tanh", U"sign"};
constexpr std::array<std::u32string_view, 17> kUnits = {U"N",  U"m",   U"s",  U"kg", U"rad", U"J",
                                                        U"W",  U"Hz",  U"mm", U"cm", U"ms",  U"g",
                                                        U"Nm", U"deg", U"px", U"us", U"mJ"};
// Words that take what stands in the braces behind them.
struct Construct {
  std::u32string_view name;
  AtomKind kind;
  std::u32string_view ends;  // of its cells
};
constexpr std::array<Construct, 6> kConstructs = {{{U"frac", AtomKind::fraction, U"}"},
                                                   {U"col", AtomKind::matrix, U";}"},
                                                   {U"mat", AtomKind::matrix, U",;}"},
                                                   {U"hat", AtomKind::hat, U"}"},
                                                   {U"bar", AtomKind::bar, U"}"},
                                                   {U"sqrt", AtomKind::root, U"}"}}};
// Words that change the letters in the braces behind them.
constexpr std::array<std::u32string_view, 3> kChanges = {U"dot", U"ddot", U"bold"};
constexpr int kDeepestScript = 8, kDeepestBraces = 8;

template <std::size_t n>
bool contains(const std::array<std::u32string_view, n>& names, std::u32string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_letter(char32_t c) {
  return (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z');
}
bool is_digit(char32_t c) {
  return c >= U'0' && c <= U'9';
}
bool is_capital_greek(char32_t c) {
  return c >= 0x391 && c <= 0x3A9;
}
bool is_small_greek(char32_t c) {
  return c >= 0x3B1 && c <= 0x3C9;
}

// The letter that a name stands for: itself, or the Greek letter of that name.
std::optional<char32_t> letter_of(std::u32string_view name) {
  if (name.size() == 1) return name[0];
  std::u32string small(name);
  const bool capital = small[0] >= U'A' && small[0] <= U'Z';
  if (capital) small[0] += U'a' - U'A';
  const auto at = std::find(kGreek.begin(), kGreek.end(), small);
  if (at == kGreek.end()) return std::nullopt;
  return char32_t((capital ? 0x391 : 0x3B1) + (at - kGreek.begin()));
}

// Italic letters have code points of their own; the italic h was encoded long before the others.
char32_t italic(char32_t c) {
  if (c == U'h') return 0x210E;
  if (c >= U'a' && c <= U'z') return 0x1D44E + (c - U'a');
  if (c >= U'A' && c <= U'Z') return 0x1D434 + (c - U'A');
  if (is_small_greek(c)) return 0x1D6FC + (c - 0x3B1);
  if (is_capital_greek(c)) return 0x1D6E2 + (c - 0x391);
  return c;
}

constexpr char32_t kCapitalLambda = 0x39B;

char32_t bold(char32_t c) {
  if (c >= U'a' && c <= U'z') return 0x1D41A + (c - U'a');
  if (c >= U'A' && c <= U'Z') return 0x1D400 + (c - U'A');
  if (is_small_greek(c)) return 0x1D6C2 + (c - 0x3B1);
  if (is_capital_greek(c)) return 0x1D6A8 + (c - 0x391);
  return c;
}

// Bold upright for the matrices of the dynamics, italic for every other letter.
char32_t variable(char32_t c, bool in_script) {
  const bool is_matrix = c == U'M' || c == U'J' || c == kCapitalLambda;
  return is_matrix && !in_script ? bold(c) : italic(c);
}

struct Sign {
  char32_t character, drawn;
  AtomKind kind;
};
constexpr char32_t kMinus = 0x2212, kTimes = 0xD7, kDot = 0x22C5;
constexpr std::array<Sign, 32> kSigns = {{
    {U'+', U'+', AtomKind::binary},       {U'-', kMinus, AtomKind::binary},
    {kMinus, kMinus, AtomKind::binary},   {0xB1, 0xB1, AtomKind::binary},
    {kTimes, kTimes, AtomKind::binary},   {kDot, kDot, AtomKind::product},
    {0xB7, kDot, AtomKind::product},      {U'*', kDot, AtomKind::product},
    {U'/', U'/', AtomKind::slash},        {U'=', U'=', AtomKind::relation},
    {U'<', U'<', AtomKind::relation},     {U'>', U'>', AtomKind::relation},
    {0x2264, 0x2264, AtomKind::relation}, {0x2265, 0x2265, AtomKind::relation},
    {0x2248, 0x2248, AtomKind::relation}, {0x2260, 0x2260, AtomKind::relation},
    {0x2192, 0x2192, AtomKind::relation}, {U':', U':', AtomKind::relation},
    {0x21D2, 0x21D2, AtomKind::relation}, {0x223C, 0x223C, AtomKind::relation},
    {0x221D, 0x221D, AtomKind::relation}, {0x2208, 0x2208, AtomKind::relation},
    {0x226A, 0x226A, AtomKind::relation}, {0x226B, 0x226B, AtomKind::relation},
    {0x2213, 0x2213, AtomKind::binary},
    {U'(', U'(', AtomKind::open},         {U'[', U'[', AtomKind::open},
    {U')', U')', AtomKind::close},        {U']', U']', AtomKind::close},
    {U',', U',', AtomKind::comma},        {U';', U';', AtomKind::comma},
    {U'\'', 0x2032, AtomKind::operand},
}};

bool ends_operand(const std::vector<MathAtom>& atoms) {
  if (atoms.empty()) return false;
  switch (atoms.back().kind) {
    case AtomKind::operand:
    case AtomKind::number:
    case AtomKind::word:
    case AtomKind::unit:
    case AtomKind::close:
    case AtomKind::fraction:
    case AtomKind::matrix:
    case AtomKind::hat:
    case AtomKind::bar:
    case AtomKind::root:
      return true;
    default:
      return false;
  }
}

class Reader {
 public:
  explicit Reader(std::u32string_view text) : text_(text) {}

  // Up to the end of the text or to one of the characters in `ends` outside of brackets. `depth`: of scripts.
  std::vector<MathAtom> read_list(int depth, std::u32string_view ends = U"") {
    std::vector<MathAtom> atoms;
    int open = 0;
    for (;;) {
      const bool blank = skip_blanks();
      if (at_ >= text_.size()) return atoms;
      if (ends.find(peek()) != ends.npos && (open == 0 || peek() == U'}')) return atoms;
      open += peek() == U'(' ? 1 : peek() == U')' && open > 0 ? -1 : 0;
      const std::size_t first = atoms.size();
      read_token(atoms, depth);
      if (first < atoms.size()) atoms[first].blank_before = blank;
    }
  }

 private:
  char32_t peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : U'\0';
  }

  bool skip_blanks() {
    const std::size_t start = at_;
    while (peek() == U' ') ++at_;
    return at_ > start;
  }

  [[noreturn]] void fail(const std::string& what) const {
    constexpr std::size_t kLongestQuote = 80;
    const bool is_long = text_.size() > kLongestQuote;
    throw Error(ExitCode::bad_input, what + " at character " + std::to_string(at_ + 1) + " of '" +
                                         encode_utf8(text_.substr(0, kLongestQuote)) + (is_long ? ".." : "") + "'");
  }

  void read_token(std::vector<MathAtom>& atoms, int depth) {
    const char32_t c = peek();
    if (is_digit(c) || (c == U'.' && is_digit(peek(1)))) return read_number(atoms);
    if (is_letter(c)) return read_word(atoms, depth);
    if (c == U'\\') return read_latex(atoms, depth);
    if (c == U'"') return read_upright(atoms, c);
    if (c == U'_' || c == U'^') return read_script(atoms, depth);
    if (c == U'{') return read_group(atoms, depth);
    if (c == U'}') fail("a brace that nothing opened");
    if (is_small_greek(c) || is_capital_greek(c))
      atoms.push_back({AtomKind::operand, {variable(c, depth > 0)}, 0, {}, {}, false});
    else
      return read_sign(atoms);
    ++at_;
  }

  // What stands in braces, which are there to hold it together.
  void read_group(std::vector<MathAtom>& atoms, int depth) {
    for (MathAtom& atom : read_braces(depth)) atoms.push_back(std::move(atom));
  }

  std::vector<MathAtom> read_braces(int depth) {
    if (++braces_ > kDeepestBraces) fail("braces nested too deeply");
    ++at_;
    std::vector<MathAtom> inside = read_list(depth, U"}");
    if (peek() != U'}') fail("a brace is not closed");
    ++at_;
    --braces_;
    return inside;
  }

  // \Lambda, \sin, \frac and \cdot, as those write them who know LaTeX; its spaces and sizes of brackets are ours.
  void read_latex(std::vector<MathAtom>& atoms, int depth) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && is_letter(text_[end])) ++end;
    const std::u32string written(text_.substr(at_ + 1, end - at_ - 1));
    if (written.empty() && contains(kLatexSpaces, std::u32string(1, peek(1)))) return void(at_ += 2);
    const auto known = std::find_if(kLatexWords.begin(), kLatexWords.end(), [&](const auto& one) { return one.first == written; });
    const std::u32string word(known == kLatexWords.end() ? std::u32string_view(written) : known->second);
    const auto sign = std::find_if(kLatexSigns.begin(), kLatexSigns.end(), [&](const auto& one) { return one.first == word; });
    const bool is_construct = std::any_of(kConstructs.begin(), kConstructs.end(), [&](const Construct& one) { return one.name == word; });
    const bool has_braces = end < text_.size() && text_[end] == U'{';
    const auto needs_braces = [&] {
      if (!has_braces) fail("\\" + encode_utf8(written) + " without braces behind it");
    };
    if (contains(kLatexLayout, word)) {
      at_ = end;
    } else if (sign != kLatexSigns.end()) {
      at_ = end;
      add_sign(atoms, sign->second);
    } else if (word == U"top") {  // of transposes
      at_ = end;
      atoms.push_back({AtomKind::operand, U"T", 0, {}, {}, false});
    } else if (contains(kLatexTexts, word)) {
      needs_braces();
      at_ = end;
      read_latex_text(atoms);
    } else if (contains(kChanges, word)) {
      at_ = end;
      read_change(atoms, word, depth);
    } else if (is_construct) {
      needs_braces();
      at_ = end;
      read_construct_of(atoms, word, depth);
    } else if ((word.size() > 1 && letter_of(word)) || contains(kFunctions, word)) {
      at_ = end;
      add_name(atoms, word, false, depth);
    } else {
      fail("\\" + encode_utf8(written) + " is not known (a text in quotes stands as it is)");
    }
  }

  // dot, ddot and bold, of what stands in the braces behind them or of the next letter.
  void read_change(std::vector<MathAtom>& atoms, std::u32string_view change, int depth) {
    std::vector<MathAtom> letters;
    skip_blanks();
    if (peek() == U'{')
      letters = read_braces(depth);
    else if (at_ < text_.size())
      read_token(letters, depth);
    const bool has_dots = change != U"bold";
    if (letters.empty() || (has_dots && (letters.size() != 1 || letters[0].kind != AtomKind::operand)))
      fail(encode_utf8(change) + " needs " + (has_dots ? "one letter" : "letters") + " behind it");
    for (MathAtom& letter : letters) {
      if (has_dots) letter.dots = change == U"dot" ? 1 : 2;
      if (!has_dots && letter.kind == AtomKind::operand)
        for (char32_t& c : letter.text) c = bold(plain_letter(c));
      atoms.push_back(std::move(letter));
    }
  }

  void read_sign(std::vector<MathAtom>& atoms) {
    const char32_t c = text_[at_++];
    add_sign(atoms, c);
  }

  void add_sign(std::vector<MathAtom>& atoms, char32_t c) {
    const auto sign =
        std::find_if(kSigns.begin(), kSigns.end(), [c](const Sign& s) { return s.character == c; });
    MathAtom atom{AtomKind::operand, {c}, 0, {}, {}, false};
    if (sign != kSigns.end()) {
      atom.kind = sign->kind;
      atom.text = {sign->drawn};
    }
    if ((c == U'<' || c == U'>') && peek() == U'=') {
      ++at_;
      atom.text = {c == U'<' ? char32_t(0x2264) : char32_t(0x2265)};
    }
    if (atom.kind == AtomKind::binary && !ends_operand(atoms)) atom.kind = AtomKind::sign;
    if (c == U'[' || c == U']') in_square_brackets_ = c == U'[';
    atoms.push_back(std::move(atom));
  }

  // 12, 0.5, and 1e-3 as 1 x 10 to the power -3.
  void read_number(std::vector<MathAtom>& atoms) {
    std::u32string digits;
    while (is_digit(peek()) || (peek() == U'.' && is_digit(peek(1)))) digits += text_[at_++];
    atoms.push_back({AtomKind::number, digits, 0, {}, {}, false});
    if (peek() != U'e' && peek() != U'E') return;
    const bool has_sign = peek(1) == U'+' || peek(1) == U'-';
    if (!is_digit(peek(has_sign ? 2 : 1))) return;

    ++at_;
    MathAtom ten{AtomKind::number, U"10", 0, {}, {}, false};
    if (has_sign) {
      if (peek() == U'-') ten.sup.push_back({AtomKind::sign, {kMinus}, 0, {}, {}, false});
      ++at_;
    }
    std::u32string exponent;
    while (is_digit(peek())) exponent += text_[at_++];
    ten.sup.push_back({AtomKind::number, exponent, 0, {}, {}, false});
    atoms.push_back({AtomKind::binary, {kTimes}, 0, {}, {}, false});
    atoms.push_back(std::move(ten));
  }

  bool is_unit_here(const std::vector<MathAtom>& atoms, bool blank, std::u32string_view word) const {
    if (!contains(kUnits, word) || atoms.empty() || peek() == U'_' || peek() == U'(') return false;
    if (in_square_brackets_) return true;  // "M(q) [kg m^2]"
    const AtomKind before = atoms.back().kind;
    if (before == AtomKind::slash) return atoms.size() > 1 && atoms[atoms.size() - 2].kind == AtomKind::unit;
    return blank && (before == AtomKind::number || before == AtomKind::close || before == AtomKind::unit ||
                     before == AtomKind::matrix || before == AtomKind::fraction);
  }

  // "a_name", or what a word of LaTeX has in braces: upright, as it stands.
  void read_upright(std::vector<MathAtom>& atoms, char32_t close) {
    const std::size_t end = text_.find(close, at_ + 1);
    if (end == text_.npos) fail(close == U'"' ? "a quote that does not close" : "a brace is not closed");
    atoms.push_back({AtomKind::function, std::u32string(text_.substr(at_ + 1, end - at_ - 1)), 0, {}, {}, false});
    at_ = end + 1;
  }

  void read_latex_text(std::vector<MathAtom>& atoms) {
    const std::size_t begin = at_;
    read_upright(atoms, U'}');
    const LatexText read = plain_latex_text(atoms.back().text);
    if (!read.unknown.empty()) {
      at_ = begin;
      fail("\\" + encode_utf8(read.unknown) + " within \\text{..} is not known: leave the braces before it");
    }
    atoms.back().text = read.plain;
  }

  void read_word(std::vector<MathAtom>& atoms, int depth) {
    const bool blank = at_ > 0 && text_[at_ - 1] == U' ';
    std::u32string word;
    while (is_letter(peek()) || is_digit(peek())) word += text_[at_++];
    if (peek() == U'{' && contains(kChanges, word)) return read_change(atoms, word, depth);
    if (peek() == U'{' && read_construct_of(atoms, word, depth)) return;
    add_name(atoms, word, blank, depth);
  }

  void add_name(std::vector<MathAtom>& atoms, const std::u32string& word, bool blank, int depth) {
    if (is_unit_here(atoms, blank, word)) {
      atoms.push_back({AtomKind::unit, word, 0, {}, {}, false});
    } else if (contains(kFunctions, word)) {
      atoms.push_back({AtomKind::function, word, 0, {}, {}, false});
    } else {
      atoms.push_back(read_name(word, depth));
    }
  }

  bool read_construct_of(std::vector<MathAtom>& atoms, std::u32string_view word, int depth) {
    const auto construct = std::find_if(kConstructs.begin(), kConstructs.end(),
                                        [&](const Construct& c) { return c.name == word; });
    if (construct == kConstructs.end()) return false;
    atoms.push_back(read_construct(*construct, depth));
    return true;
  }

  // The cells in braces behind a word: frac{a}{b}, col{a; b}, mat{a, b; c, d}.
  MathAtom read_construct(const Construct& construct, int depth) {
    if (++braces_ > kDeepestBraces) fail("braces nested too deeply");
    MathAtom atom;
    atom.kind = construct.kind;
    const int groups = construct.kind == AtomKind::fraction ? 2 : 1;
    for (int group = 0; group < groups; ++group) {
      if (peek() != U'{') fail("frac{..}{..} needs two pairs of braces");
      atom.cells.emplace_back();
      for (char32_t end = U'{'; end != U'}';) {
        ++at_;
        if (end == U';') atom.cells.emplace_back();
        atom.cells.back().push_back(read_list(depth, construct.ends));
        end = peek();
        if (at_ >= text_.size()) fail("a brace is not closed");
        if (atom.cells.back().back().empty()) fail("nothing stands here");
      }
      ++at_;
    }
    for (const auto& row : atom.cells)
      if (row.size() != atom.cells.front().size()) fail("the rows of a matrix differ in length");
    --braces_;
    return atom;
  }

  // A letter or Greek name, with dots for a trailing d or dd and an index for trailing digits; else a word.
  static MathAtom read_name(std::u32string word, int depth) {
    MathAtom atom;
    const std::size_t last_letter = word.find_last_not_of(U"0123456789");
    if (last_letter + 1 < word.size())
      atom.sub.push_back({AtomKind::number, word.substr(last_letter + 1), 0, {}, {}, false});
    word.resize(last_letter + 1);

    for (int dots = 0; dots <= 2 && std::size_t(dots) < word.size(); ++dots) {
      const auto letter = letter_of(word.substr(0, word.size() - std::size_t(dots)));
      if (!letter) {
        if (word[word.size() - 1 - std::size_t(dots)] != U'd') break;
        continue;
      }
      atom.text = {variable(*letter, depth > 0)};
      atom.dots = dots;
      return atom;
    }
    atom.kind = AtomKind::word;
    atom.text = word;
    return atom;
  }

  void read_script(std::vector<MathAtom>& atoms, int depth) {
    const bool below = text_[at_++] == U'_';
    if (atoms.empty()) fail("a script without anything before it");
    if (depth >= kDeepestScript) fail("scripts nested too deeply");
    std::vector<MathAtom> script;
    if (peek() == U'{') {
      ++at_;
      script = read_list(depth + 1, U"}");
      if (peek() != U'}') fail("a brace is not closed");
      ++at_;
    } else {
      if (at_ >= text_.size() || peek() == U' ' || peek() == U'}') fail("a script is missing");
      read_token(script, depth + 1);
      if (script.size() == 1 && script[0].kind == AtomKind::sign && at_ < text_.size() && peek() != U' ')
        read_token(script, depth + 1);  // ^-1
    }
    // The transpose is an operator, not a variable; so is its inverse.
    const bool is_transpose = script.size() == 1 || (script.size() == 2 && script[0].kind == AtomKind::sign);
    if (!below && is_transpose && script.back().text == std::u32string{italic(U'T')}) script.back().text = U"T";
    std::vector<MathAtom>& place = below ? atoms.back().sub : atoms.back().sup;
    if (!below && !place.empty()) fail("two powers of one symbol: put braces around one of them");
    place.insert(place.end(), script.begin(), script.end());
  }

  std::u32string_view text_;
  std::size_t at_ = 0;
  int braces_ = 0;
  bool in_square_brackets_ = false;  // units stand there
};

}  // namespace

char32_t plain_letter(char32_t c) {
  struct Alphabet {
    char32_t first, last, plain;
  };
  constexpr Alphabet kAlphabets[] = {{0x1D400, 0x1D419, U'A'}, {0x1D41A, 0x1D433, U'a'}, {0x1D434, 0x1D44D, U'A'}, {0x1D44E, 0x1D467, U'a'},
                                     {0x1D6A8, 0x1D6C0, 0x391}, {0x1D6C2, 0x1D6DA, 0x3B1}, {0x1D6E2, 0x1D6FA, 0x391}, {0x1D6FC, 0x1D714, 0x3B1}};
  if (c == 0x210E) return U'h';
  for (const Alphabet& one : kAlphabets)
    if (c >= one.first && c <= one.last) return one.plain + (c - one.first);
  return c;
}

namespace {

// Beside M the other matrices of the equation of motion: C, D and K.
void set_matrices(std::vector<MathAtom>& atoms) {
  const auto has_letter = [](const MathAtom& atom, char32_t letter) { return atom.kind == AtomKind::operand && atom.text.size() == 1 && atom.text[0] == letter; };
  if (std::none_of(atoms.begin(), atoms.end(), [&](const MathAtom& atom) { return has_letter(atom, bold(U'M')); })) return;
  for (MathAtom& atom : atoms)
    for (const char32_t matrix : {U'C', U'D', U'K'})
      if (has_letter(atom, italic(matrix))) atom.text[0] = bold(matrix);
}

}  // namespace

std::vector<MathAtom> parse_math(std::string_view notation) {
  const std::u32string text = decode_utf8(notation);
  std::vector<MathAtom> atoms = Reader(text).read_list(0);
  set_matrices(atoms);
  return atoms;
}

}  // namespace chainreel
