#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "core/error.hpp"
#include "picture/formula_words.hpp"
#include "picture/math_notation.hpp"
#include "picture/text.hpp"
#include "support/fonts.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TextLine lay_out(const std::string& notation, Align align = Align::left) {
  return lay_out_math(fonts(), notation, {Face::math, 1, color_of(0x1A1A1A), align});
}

// What a line says, run by run.
std::vector<std::string> words(const std::string& notation) {
  std::vector<std::string> result;
  for (const GlyphRun& run : lay_out(notation).runs) result.push_back(run.text);
  return result;
}

constexpr double kMathRoundOff = 1e-14;  // sums of a few numbers of size 1 to 10

TEST(Math, VariablesAreItalicNumbersAndUnitsUpright) {
  EXPECT_THAT(words("tau = (10, 10, 10) N m"), ElementsAre("\U0001D70F=(10,10,10)Nm"));
  EXPECT_THAT(words("N m"), ElementsAre("\U0001D441\U0001D45A"));  // no number before: two variables
  EXPECT_THAT(words("M(q) [kg m^2]").at(0), HasSubstr("[kgm"));
  EXPECT_THAT(words("(N)"), ElementsAre("(\U0001D441)"));
  EXPECT_THAT(words("3 m/s"), ElementsAre("3m/s"));
  EXPECT_THAT(words("theta, phi"), ElementsAre("\U0001D703,\U0001D711"));
}

TEST(Math, ItalicHIsTheOneThatUnicodeEncodedBefore) {
  EXPECT_THAT(words("ghi"), ElementsAre("ghi"));  // a word of more letters is upright
  EXPECT_THAT(words("g h i"), ElementsAre("\U0001D454\u210E\U0001D456"));
}

TEST(Math, MatricesAreBoldUprightExceptInScripts) {
  EXPECT_THAT(words("M J Lambda"), ElementsAre("\U0001D40C\U0001D409\U0001D6B2"));
  EXPECT_THAT(words("x_M"), ElementsAre("\U0001D465", "\U0001D440"));
  EXPECT_THAT(words("Omega"), ElementsAre("\U0001D6FA"));
  // As LaTeX has them.
  EXPECT_THAT(words("\\Lambda"), ElementsAre("\U0001D6B2"));
  EXPECT_THAT(words("\\sin q"), ElementsAre("sin\U0001D45E"));
  EXPECT_THAT(words("a \\le b"), words("a <= b"));
  EXPECT_THAT(words("\\left( a \\cdot b \\, \\right)"), words("( a * b )"));
  EXPECT_THAT(words("\\ddot{q} + \\dot q"), words("qdd + qd"));
  EXPECT_THAT(words("\\ddot\\theta_1"), words("thetadd_1"));
  EXPECT_THAT(words("J^{-\\top}"), words("J^{-T}"));
  EXPECT_THAT(words("\\mathbf{C}(q)"), ElementsAre("\U0001D402(\U0001D45E)"));
  EXPECT_THAT(words("\\boldsymbol\\omega \\mathrm{max}"), ElementsAre("\U0001D6DAmax"));
  EXPECT_THAT(words("\\mathrm{N\\,m}"), ElementsAre("N\u2009m"));
  EXPECT_THAT(words("\\text{N \\cdot m}"), ElementsAre("N \u22C5m")) << "the blank ends the word";
  EXPECT_THAT(words("{a + b}_1"), words("a + b_1"));
  EXPECT_THAT(words("\\Rightarrow \\dfrac{1}{2} \\varphi"), words("\\Rightarrow frac{1}{2} phi"));
  EXPECT_EQ(lay_out("\\sqrt{x}").marks.size(), 4u) << "the strokes of a root";
  for (const char* unknown : {"\\nonsense", "\\frac12", "x^2^3", "\\", "\\ddot{a b}", "dot{}", "\\ddot", "}", "\\mathrm{a", "\\text{a \\foo b}", "\\sqrt x"}) EXPECT_THROW(words(unknown), Error) << unknown;
}

TEST(Math, MinusIsASignOfItsOwnAndCloserInFrontThanBetween) {
  EXPECT_THAT(words("0, -100 y_G"), ElementsAre("0,\u2212100\U0001D466", "\U0001D43A"));
  const double in_front = lay_out("-1").advance - lay_out("1").advance;
  const double between = lay_out("2 - 1").advance - lay_out("2").advance - lay_out("1").advance;
  EXPECT_NEAR(between - in_front, 2 * 4.0 / 18, kMathRoundOff);  // a medium space on either side
}

TEST(Math, ScriptsAreSmallerAndShifted) {
  const TextLine line = lay_out("lambda_{n_c}^2");
  ASSERT_EQ(line.runs.size(), 4u);
  EXPECT_EQ(line.runs[0].size, 1);
  EXPECT_NEAR(line.runs[1].size, 0.7, kMathRoundOff);
  EXPECT_NEAR(line.runs[1].origin.y, -0.18, kMathRoundOff);
  EXPECT_NEAR(line.runs[2].size, 0.5, kMathRoundOff);
  EXPECT_NEAR(line.runs[2].origin.y, -0.18 - 0.7 * 0.18, kMathRoundOff);
  EXPECT_NEAR(line.runs[3].size, 0.7, kMathRoundOff);
  EXPECT_NEAR(line.runs[3].origin.y, 0.38, kMathRoundOff);
}

TEST(Math, TrailingDigitsAreAnIndex) {
  EXPECT_EQ(words("q1"), words("q_1"));
  EXPECT_EQ(words("lambda12"), words("lambda_{12}"));
  EXPECT_NEAR(lay_out("q1").advance, lay_out("q_1").advance, kMathRoundOff);
  // Control: a superscript says the same at another place.
  EXPECT_EQ(words("q^1"), words("q1"));
  EXPECT_GT(lay_out("q^1").runs.at(1).origin.y, 0);
  EXPECT_LT(lay_out("q1").runs.at(1).origin.y, 0);
}

TEST(Math, DerivativesBearDotsAboveTheInk) {
  EXPECT_TRUE(lay_out("q").marks.empty());
  const TextLine once = lay_out("qd"), twice = lay_out("qdd_2");
  ASSERT_EQ(once.marks.size(), 1u);
  ASSERT_EQ(twice.marks.size(), 2u);
  EXPECT_EQ(once.runs[0].text, twice.runs[0].text);

  const Rect ink = lay_out("q").box;
  const auto& dot = std::get<Ellipse>(once.marks[0]);
  EXPECT_NEAR(dot.center.y, ink.y1 + 0.10, kMathRoundOff);
  EXPECT_NEAR(dot.u.x, 0.11 / 2, kMathRoundOff);
  EXPECT_NEAR(dot.center.x, (ink.x0 + ink.x1) / 2, kMathRoundOff);
  const auto& left = std::get<Ellipse>(twice.marks[0]);
  const auto& right = std::get<Ellipse>(twice.marks[1]);
  EXPECT_NEAR(right.center.x - left.center.x, 0.18, kMathRoundOff);
  EXPECT_NEAR((right.center.x + left.center.x) / 2, dot.center.x, kMathRoundOff);
  EXPECT_NEAR(once.box.y1, ink.y1 + 0.10 + 0.11 / 2, kMathRoundOff);  // the dot is part of the box
}

TEST(Math, DotsMoveWithTheLine) {
  const TextLine right = lay_out("thetad", Align::right), left = lay_out("thetad", Align::left);
  const double shift =
      std::get<Ellipse>(right.marks.at(0)).center.x - std::get<Ellipse>(left.marks.at(0)).center.x;
  EXPECT_NEAR(shift, -left.advance, kMathRoundOff);
  Picture picture;
  draw_text(picture, left, {0.5, 0.25});
  ASSERT_EQ(picture.items.size(), 2u);
  EXPECT_NEAR(std::get<Ellipse>(picture.items[1].shape).center.x,
              0.5 + std::get<Ellipse>(left.marks.at(0)).center.x, kMathRoundOff);
}

TEST(Math, TransposeIsUprightAndInverseHasAMinus) {
  EXPECT_THAT(words("J^T"), ElementsAre("\U0001D409", "T"));
  EXPECT_THAT(words("J_T"), ElementsAre("\U0001D409", "\U0001D447"));
  EXPECT_THAT(words("M^-1"), ElementsAre("\U0001D40C", "\u22121"));
  EXPECT_THAT(words("M^{-1}"), ElementsAre("\U0001D40C", "\u22121"));
}

TEST(Math, SuperscriptsOfSlantedLettersStandClearOfThem) {
  // f leans to the right: its superscript starts farther right than its subscript.
  const TextLine line = lay_out("f_1^1");
  EXPECT_GT(line.runs.at(2).origin.x, line.runs.at(1).origin.x + 0.02);
}

TEST(Math, ProductsOfNumbersNeedNoDot) {
  EXPECT_EQ(words("-100*y_G"), words("-100 y_G"));
  EXPECT_THAT(words("k*q"), ElementsAre("\U0001D458\u22C5\U0001D45E"));
  EXPECT_THAT(words("1.5e-3"), ElementsAre("1.5\u00D710", "\u22123"));
  EXPECT_THAT(words("2*sin(q)"), ElementsAre("2sin(\U0001D45E)"));
  EXPECT_THAT(words("atan2(y, x)"), ElementsAre("atan2(\U0001D466,\U0001D465)"));
}

// The rules of fractions and brackets: capsules among the marks.
std::vector<Capsule> rules(const TextLine& line) {
  std::vector<Capsule> found;
  for (const Shape& mark : line.marks)
    if (const auto* rule = std::get_if<Capsule>(&mark)) found.push_back(*rule);
  return found;
}

TEST(Math, FractionsStandAboveAndBelowTheirRule) {
  const TextLine line = lay_out("frac{1}{2 m}");
  ASSERT_EQ(rules(line).size(), 1u);
  const double rule = rules(line)[0].a.y;
  EXPECT_NEAR(rule, 0.25, kMathRoundOff);
  ASSERT_EQ(line.runs.size(), 2u);
  EXPECT_GT(line.runs[0].origin.y, rule);
  EXPECT_LT(line.runs[1].origin.y, 0);
  EXPECT_LT(line.runs[1].size, 1);
  EXPECT_GT(line.advance, lay_out("2 m").advance * 0.7);
  EXPECT_GT(lay_out("x = frac{1}{2}").advance, lay_out("x =").advance);
}

TEST(Math, ColumnsAndMatricesStandInBrackets) {
  const TextLine column = lay_out("col{10; -2.5; q1}");
  EXPECT_EQ(rules(column).size(), 6u);  // two brackets of three strokes
  ASSERT_GE(column.runs.size(), 3u);
  EXPECT_NEAR(column.runs[0].origin.y, 1.3, kMathRoundOff);
  EXPECT_NEAR(column.runs[1].origin.y, 0, kMathRoundOff);
  EXPECT_NEAR(column.runs[2].origin.y, -1.3, kMathRoundOff);
  // Commas in brackets part arguments, not cells.
  EXPECT_EQ(words("mat{f(a, b), 1; 2, 3}").size(), 4u);
  // What holds a matrix is as tall as its brackets, and they stand about it.
  EXPECT_NEAR((column.box.y0 + column.box.y1) / 2, 0.25, kMathRoundOff);
  // The transpose stands at the top, a unit behind.
  EXPECT_GT(lay_out("col{1; 2}^T").runs.back().origin.y, 0.8);
  EXPECT_EQ(words("col{1; 2} kg").back(), "kg");
}

TEST(Math, HatsAndBarsStandAboveTheInk) {
  const double ink = lay_out("q").box.y1;
  ASSERT_EQ(rules(lay_out("hat{q}")).size(), 2u);
  ASSERT_EQ(rules(lay_out("bar{q}")).size(), 1u);
  EXPECT_GT(rules(lay_out("bar{q}"))[0].a.y, ink);
  EXPECT_NEAR(lay_out("hat{q}").advance, lay_out("q").advance, kMathRoundOff);
}

TEST(Math, RulesMoveWithTheLine) {
  Picture picture;
  const TextLine line = lay_out("bar{q}");
  draw_text(picture, line, {0.5, 0.25});
  EXPECT_NEAR(std::get<Capsule>(picture.items.at(1).shape).a.x, 0.5 + rules(line)[0].a.x, kMathRoundOff);
}

TEST(Math, NumbersSetOffByBlanksStayApart) {
  EXPECT_GT(lay_out("(10 10)").advance, lay_out("(1010)").advance + 0.2);
}

TEST(Math, SymbolsTakeTheirColours) {
  const Color red = color_of(0xFF0000);
  const TextLine line = lay_out_math(fonts(), "M(q) qdd = frac{tau}{2} + tau_1", {Face::math, 1}, {{"tau", red}});
  int colored = 0;
  for (const GlyphRun& run : line.runs) {
    if (run.color != red) continue;
    EXPECT_EQ(run.text, "\U0001D70F");
    ++colored;
  }
  EXPECT_EQ(colored, 2);
  // Control: without colours everything has the style's.
  for (const GlyphRun& run : lay_out("frac{tau}{2}").runs) EXPECT_EQ(run.color, color_of(0x1A1A1A));
}

TEST(Math, UnicodeMayBeGivenDirectly) {
  EXPECT_EQ(words("\u03c4 = \u22121"), words("tau = -1"));
  EXPECT_EQ(words("x <= 1"), words("x \u2264 1"));
}

TEST(Math, UnfinishedNotationIsAnErrorThatSaysWhere) {
  for (const char* bad : {"q_", "q_{1", "^2", "x}", "q_ 1", "x_{a}}", "_", "q_{}}", "x_{_}",
                          "frac{1}", "frac{1}{", "col{1; }", "mat{1, 2; 3}", "hat{", "col{1"}) {
    try {
      lay_out(bad);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input) << bad;
      EXPECT_THAT(error.what(), HasSubstr(bad));
    }
  }
  EXPECT_NO_THROW(lay_out("q_{1}"));
}

TEST(Math, NestingHasAnEnd) {
  std::string deep = "x";
  for (int i = 0; i < 1000; ++i) deep += "_{x";
  EXPECT_THROW(lay_out(deep + std::string(1000, '}')), Error);
}

TEST(Math, MissingGlyphIsAnError) {
  try {
    lay_out("x = \u5b57");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_renderer);
    EXPECT_THAT(error.what(), HasSubstr("Latin Modern Math"));
  }
}

// Anything is either laid out with finite measures or refused with an Error.
TEST(Math, EveryStringIsLaidOutOrRefused) {
  const std::vector<std::string> pieces = {"tau", "q", "dd", "_",      "^", "{",   "}",     "(", ")",
                                           " ",   "1", "-",  "*",      "e", "N",   ".",     ",", "=",
                                           "/",   "<", "'",  "\u03c4", "M", "sin", "\u22C5"};
  std::mt19937 random(20240817);
  int laid_out = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string notation;
    for (unsigned k = random() % 12; k > 0; --k) notation += pieces[random() % pieces.size()];
    try {
      const TextLine line = lay_out(notation);
      EXPECT_TRUE(std::isfinite(line.advance)) << notation;
      EXPECT_GE(line.advance, 0) << notation;
      ++laid_out;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(laid_out, 100);
  EXPECT_GT(refused, 100);
}

TEST(PlainFormula, HasGreekLettersAndLoweredDigits) {
  EXPECT_EQ(plain_formula("tau_1 = 5 sin(2 t)"), "\u03C4\u2081 = 5 sin(2 t)");
  EXPECT_EQ(plain_formula("theta_12 + Omega"), "\u03B8\u2081\u2082 + \u03A9");
  EXPECT_EQ(plain_formula("x_G + taub + 3"), "x_G + taub + 3") << "no name of a letter, no digit";
  EXPECT_EQ(plain_formula("M(q) qdd + g(q) = \\tau - D\\dot{q}"), "M(q) q\u0308 + g(q) = \u03C4 \u2212 Dq\u0307");
  EXPECT_EQ(plain_formula("frac{1}{2} m v^2"), "1/2 m v\u00B2");
  EXPECT_EQ(plain_formula("J^{-T} M J^-1"), "J^(\u2212T) M J\u207B\u00B9");
  EXPECT_EQ(plain_formula("\\nonsense{x}"), "\\nonsense{x}") << "what is no notation stands as it is written";
  EXPECT_EQ(plain_formula(""), "");
}

TEST(FormulaWords, AreWholeFormulasAndTheWordsThatTheyTouch) {
  EXPECT_THAT(formula_words("  torque $tau = 5 sin(2 t)$, damped  "),
              ElementsAre("torque", "$tau = 5 sin(2 t)$,", "damped"));
  EXPECT_THAT(formula_words("costs $5 a day"), ElementsAre("costs", "$5", "a", "day")) << "a sign without a partner is one";
  EXPECT_THAT(formula_words("\\$5 or \\$6 a day"), ElementsAre("\\$5", "or", "\\$6", "a", "day")) << "no formula between";
  EXPECT_THAT(formula_words("8 N m at 2.5 s, -9.81 m/s^2 (3 kg) on 4 wheels: 1.2 s later a m"),
              ElementsAre("8 N m", "at", "2.5 s,", "-9.81 m/s^2", "(3 kg)", "on", "4", "wheels:", "1.2 s", "later", "a", "m"))
      << "no line ends between a number and its unit";
  EXPECT_TRUE(formula_words("").empty());
  EXPECT_TRUE(formula_words("   ").empty());
}

TEST(FormulaWords, AreCutOutsideOfFormulasAlone) {
  const std::string text = "a $x y$ \\$b";
  for (std::size_t i = 0; i <= text.size(); ++i)
    EXPECT_EQ(is_outside_formula(text, i), i <= 2 || (i >= 7 && i != 9)) << i;
}

TEST(FormulaWords, ArePlainWhereLettersAreAlone) {
  EXPECT_EQ(in_plain_words("$tau_1$ costs \\$5"), "\u03C4\u2081 costs $5");
  EXPECT_EQ(in_plain_words("$5 alone"), "$5 alone");
}

}  // namespace
}  // namespace chainreel
