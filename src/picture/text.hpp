// Text as glyph runs: faces opened by file (never through a font matcher), shaped by HarfBuzz at font units
// without hinting, so that a layout is the same at every output size and on every machine.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "picture/picture.hpp"

struct FT_FaceRec_;

namespace chainreel {

// Families that somebody wants instead of the program's own faces, by their names; "": the program's own.
struct FontFamilies {
  std::string label, bold, math;  // `bold` left out: the bold face of `label`
};

// Takes away, once, what FreeType and HarfBuzz would read of the environment when they start: how they are to hint and shape. To be
// called before the first thread of the process; else fonts do it.
void clear_font_variables();

// The opened faces. Throws Error (exit 4) naming file and Debian package where one is missing.
class Fonts {
 public:
  Fonts() : Fonts(FontFamilies{}) {}
  // A family is looked for by the names that font files (.ttf, .otf) themselves bear, in the folders of fonts in the order of
  // their paths; of its upright faces that nearest to the wanted weight and to normal width is taken. Nothing stands in
  // for a family that is not there: Error (exit 4).
  // Characters that a face lacks are taken from other faces of these folders (`fallback_for`).
  explicit Fonts(const FontFamilies& families);
  explicit Fonts(const std::vector<std::string>& folders);  // searched in this order instead of Debian's, for all of it
  ~Fonts();
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

  FT_FaceRec_* ft_face(Face face) const;  // for the rasteriser; its size may be changed by anyone
  const std::string& file(Face face) const;
  int index(Face face) const;  // in its file: collections hold several
  const std::string& sha256(Face face) const;  // of the font file

  // The faces that stood in so far for characters which the program's own lack, by the paths of their files. Which these are
  // hangs on the texts and on what is installed, not on the order in which texts are laid out.
  std::vector<Face> fallbacks() const;

  struct State;
  State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

// The height of capitals and figures, a share of the em: half of it above its base line is the middle of a row.
inline constexpr double kCapHeight = 0.73;

enum class Align { left, center, right };

struct TextStyle {
  Face face = Face::label;
  double size = 0.028;  // em, units of H
  Color color = color_of(0x1A1A1A);
  Align align = Align::left;
};

// A laid-out line; its runs and marks are relative to the anchor: (0, 0) is on the baseline at the aligned
// side.
struct TextLine {
  std::vector<GlyphRun> runs;
  std::vector<Shape> marks;  // what no glyph says: dots of derivatives, rules of fractions, brackets
  Rect box;                  // ink box relative to the anchor
  double advance = 0;
};

// Plain running text; of characters that the face lacks in another installed one, in the order of Unicode's bidirectional
// algorithm. Throws Error (exit 4) where no installed font has a glyph for a character, exit 3 where the text is not UTF-8.
TextLine lay_out_text(const Fonts& fonts, const std::string& utf8, const TextStyle& style);

// A symbol of a formula that takes the colour of the thing it names.
struct SymbolColor {
  std::string symbol;  // in the notation of lay_out_math: "tau"
  Color color;
};

// A small subset of math notation, in the math face whatever the style says: Greek names (tau, lambda,
// Lambda, also \Lambda ...), `_x`, `_{..}`, `^x`, `^{..}`, an index by trailing digits (q1), dots by a trailing d or dd
// (qd, thetadd) or as `ddot{q}`, `^T`, `frac{a}{b}`, `sqrt{a}`, `col{a; b}` for column vectors, `mat{a, b; c, d}`, `hat{q}`, `bar{q}`,
// `bold{C}`; and the words of LaTeX for these, as far as lectures on mechanics need them (`chainreel help formulas`).
// Variables are italic; the matrices M, J, Lambda bold; numbers, units behind a number or bracket ("N m"),
// function names and other words upright. E.g. "tau = (0, -100 y_G) N m". Symbols take their colours also
// inside of fractions and scripts. Throws Error (exit 3) at an unfinished script or brace.
TextLine lay_out_math(const Fonts& fonts, const std::string& notation, const TextStyle& style,
                      const std::vector<SymbolColor>& symbols = {});

// Running text with formulas between dollar signs: "$tau$ [N m]". A dollar sign without a partner, or behind a backslash,
// is one; what is no notation stands as it is written.
TextLine lay_out_words(const Fonts& fonts, const std::string& words, const TextStyle& style);

// Moves a laid-out line to the anchor and appends it to the picture.
void draw_text(Picture& picture, const TextLine& line, Point anchor, int clip = -1);

// A line around its letters, to be drawn below them: it sets them off from what lies there. `width`: on each side.
void draw_halo(Picture& picture, const TextLine& line, Point anchor, Color color, double width, int clip = -1);

// UTF-8 to characters and back.

// Throws Error (exit 3) where the bytes are not well-formed UTF-8 (overlong forms and surrogates included).
std::u32string decode_utf8(std::string_view utf8);
std::string encode_utf8(std::u32string_view text);

}  // namespace chainreel
