// Which expressions are polynomials in t plus multiples of variables: the form must give what the expression
// gives, and what has no form must be refused.
#include "expr/affine.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace chainreel {
namespace {

const std::vector<std::string> kAffineNames = {"t", "q1", "qd1", "k", "x_G"};
const std::vector<VariableUse> kUses = {{VariableRole::time, 0},
                                        {VariableRole::linear, 0},
                                        {VariableRole::linear, 0},
                                        {VariableRole::constant, 2.5},
                                        {VariableRole::other, 0}};

std::optional<AffineForm<double>> form_of(const std::string& text) {
  return affine_form_of<double>(Expression::parse(text, kAffineNames, {}), kUses);
}

double value_of_form(const AffineForm<double>& form, const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t k = form.powers.size(); k-- > 0;) sum = sum * values[0] + form.powers[k];
  for (std::size_t i = 0; i < values.size(); ++i) sum += form.weights[i] * values[i];
  return sum;
}

TEST(AffineForm, HasTheValueOfItsExpression) {
  for (const char* text : {"0", "1.5", "sin(0.3) + pi/2", "t", "-t^2 + 3*t", "q1", "-k*q1 - 0.2*qd1",
                           "k*(q1 - 2*t)/4 + 1", "(t + 1)^8", "(t^2 - 1)*(t^3 + k)", "2^3*q1", "q1^1", "t^0",
                           "max(1, k)*qd1", "(1 < 2)*q1", "-(q1 + qd1)", "sqrt(k)*q1 + exp(-1)*t*t"}) {
    const Expression expression = Expression::parse(text, kAffineNames, {});
    const auto form = form_of(text);
    ASSERT_TRUE(form) << text;
    for (const double t : {-1.25, 0.0, 0.7}) {
      const std::vector<double> values = {t, 0.9, -1.7, 2.5, NAN};
      const double exact = expression.evaluate(std::span<const double>(values));
      // Sums of up to nine terms, rounded in another order; the largest is 1.7^8 = 70.
      EXPECT_NEAR(value_of_form(*form, {t, 0.9, -1.7, 2.5, 0}), exact, 1e-13) << text << " at " << t;
    }
  }
}

TEST(AffineForm, IsRefusedWhereThereIsNone) {
  for (const char* text :
       {"q1*qd1",    "q1*t",   "t*q1",        "sin(q1)", "sin(t)", "q1^2",       "t^0.5",
        "t^-1",      "t^9",    "(t^5)*(t^4)", "1/t",     "q1/t",   "2^t",        "abs(t)",
        "max(t, 1)", "q1 < 0", "x_G",         "0*x_G",   "q1/0",   "log(-1)*q1", "atan2(q1, 1)",
        "(t + q1)*t", "t*(q1 - t)", "(t - q1)^2", "t/(t + q1)", "-(q1 + t)*t^2"})
    EXPECT_FALSE(form_of(text)) << text;
}

TEST(AffineForm, KeepsTheDigitsOfQuad) {
  const auto form = affine_form_of<Quad>(Expression::parse("pi*q1/3", kAffineNames, {}), kUses);
  ASSERT_TRUE(form);
  // pi/3 = 1.0471975511965977461542144610931676; one and a half roundings of 2^-113.
  const Quad exact = 1.0471975511965977461542144610931676Q;
  EXPECT_LT(std::abs(double(form->weights[1] - exact)), 4e-34);
  EXPECT_GT(std::abs(double(Quad(double(form->weights[1])) - exact)), 1e-18);  // as a double would
}

}  // namespace
}  // namespace chainreel
