// The three ways of writing an equation.
#include "symbols/notation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/chains.hpp"

namespace chainreel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Notation, TakesTogetherWhatHasTheSameFactor) {
  const SymbolicEquation rrr = symbolic_equation_of(rrr_chain());
  EXPECT_EQ(formula_in(Notation::text, rrr, rrr.C.at(0, 1)),
            "-1/2 m_3 L_2 L_3 qd_3 sin(q_3) - (1/2 m_2 + m_3) L_1 L_2 (qd_1 + qd_2) sin(q_2) - "
            "1/2 m_3 L_1 L_3 (qd_1 + qd_2 + qd_3) sin(q_2 + q_3)");
  const SymbolicEquation pp = symbolic_equation_of(pp_chain());
  EXPECT_EQ(formula_in(Notation::text, pp, pp.M.at(0, 0)), "m_1 + m_2");
}

TEST(Notation, OfLatexHasBracesAndOneMatrixOrOneLineAnEntry) {
  const std::string latex = latex_of(symbolic_equation_of(rr_chain()), {"theta", {}});
  EXPECT_THAT(latex, AllOf(HasSubstr("M = \\begin{bmatrix}\n  (m_{1} + m_{2}) L_{1}^{2} + m_{2} L_{2}^{2} + 2 m_{2} L_{1} L_{2} \\cos \\theta_{2}"),
                           HasSubstr("\\dot{\\theta}_{2}"), HasSubstr("\\begin{bmatrix}"), HasSubstr("\\Lambda = J^{-T} M J^{-1}"),
                           HasSubstr("% m_{1} = 1 kg"), Not(HasSubstr("q_"))));
  EXPECT_EQ(std::count(latex.begin(), latex.end(), '{'), std::count(latex.begin(), latex.end(), '}'));
}

TEST(Notation, OfADocumentStandsByItself) {
  SymbolicEquation equation = symbolic_equation_of(rr_chain());
  equation.notes.push_back("a_b & 50 % of c^2 in C:\\d");
  const std::string latex = latex_document_of(equation);
  EXPECT_TRUE(latex.starts_with("\\documentclass{article}"));
  EXPECT_TRUE(latex.ends_with("\\end{document}\n"));
  EXPECT_THAT(latex, AllOf(HasSubstr("$m_{1}$ & 1 kg & mass of b1 \\\\"), HasSubstr("\\mathbf{g}(q) = \\begin{bmatrix}"), HasSubstr("9.81 m/s$^{2}$"),
                           HasSubstr("a\\_b \\& 50 \\% of c\\textasciicircum{}2 in C:\\textbackslash{}d.")));
  for (const char* name : {"document", "bmatrix", "aligned", "tabular"}) {
    const auto count = [&](const std::string& word) {
      std::size_t found = 0;
      for (std::size_t at = latex.find(word); at != std::string::npos; at = latex.find(word, at + 1)) ++found;
      return found;
    };
    EXPECT_EQ(count(std::string("\\begin{") + name + "}"), count(std::string("\\end{") + name + "}")) << name;
  }
}

TEST(Notation, TellsEverySymbolWithValueAndUnit) {
  const std::string text = text_of(symbolic_equation_of(rr_chain({.L1 = 0.7})));
  EXPECT_THAT(text, AllOf(HasSubstr("L_1     = 0.7 m "), HasSubstr("g       = 9.81 m/s^2"), HasSubstr("qd_1    in rad/s")));
}

}  // namespace
}  // namespace chainreel::test
