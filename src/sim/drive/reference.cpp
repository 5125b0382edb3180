#include "sim/drive/reference.hpp"

#include <algorithm>
#include <cmath>

#include "core/csv.hpp"
#include "core/format.hpp"
#include "core/scalar.hpp"
#include "expr/affine.hpp"
#include "expr/corners.hpp"
#include "expr/instants.hpp"
#include "expr/pulses.hpp"
#include "sim/drive/prices.hpp"
#include "sim/drive/table_units.hpp"

namespace chainreel {
namespace {

using SecondDual = Dual<Dual<double>>;

class ExpressionReference final : public Reference {
 public:
  ExpressionReference(const std::vector<Expression>& q, const std::vector<Expression>& qd,
                      const std::vector<Expression>& qdd, const Parameters& parameters)
      : polynomials_(polynomials_of(q, qd, uses(parameters))),
        corners_(uses(parameters)),
        values_(1 + parameters.size()),
        first_duals_(values_.size()),
        duals_(values_.size()) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      values_[i + 1] = parameters[i].second;
      first_duals_[i + 1] = Dual<double>(parameters[i].second, 0);
      duals_[i + 1] = SecondDual(Dual<double>(parameters[i].second, 0), Dual<double>(0, 0));
    }
    for (const Expression& one : q) q_.push_back(corners_.add(one));
    for (const Expression& one : qd) qd_.push_back(corners_.add(one));
    for (const Expression& one : qdd) qdd_.push_back(corners_.add(one));
    leave_pieces();
  }

  void evaluate(double t, Vec q, Vec qd, Vec qdd) const override {
    values_[0] = t;
    first_duals_[0] = Dual<double>(t, 1);
    duals_[0] = SecondDual(Dual<double>(t, 1), Dual<double>(1, 0));
    for (std::size_t i = 0; i < q_.size(); ++i) {
      if (qdd.empty()) {
        const Dual<double> y = chainreel::evaluate<Dual<double>>(q_[i], first_duals_, sides_);
        q[i] = y.re;
        qd[i] = y.du;
      } else {
        const SecondDual y = chainreel::evaluate<SecondDual>(q_[i], duals_, sides_);
        q[i] = y.re.re;
        qd[i] = y.re.du;
        qdd[i] = qdd_.empty() ? y.du.du : chainreel::evaluate<double>(qdd_[i], values_, sides_);
      }
      if (!qd_.empty()) qd[i] = chainreel::evaluate<double>(qd_[i], values_, sides_);
    }
  }

  double price(bool with_acceleration) const override {
    double sum = 0;
    for (const CorneredProgram& one : q_) sum += kPriceOfDerivative * price_of(one);
    for (const CorneredProgram& one : qd_) sum += price_of(one);
    for (const CorneredProgram& one : qdd_) sum += with_acceleration ? price_of(one) : 0;
    return sum;
  }
  std::vector<double> breaks(double end) const override { return instants_of(corners_, end); }
  void enter_piece(double t) override {
    leave_pieces();
    set_sides_of_time(corners_, t, sides_);
  }
  void leave_pieces() override { sides_.assign(std::size_t(corners_.count()), kAsWritten); }
  std::optional<ReferencePolynomials> polynomials() const override { return polynomials_; }

 private:
  static std::optional<ReferencePolynomials> polynomials_of(const std::vector<Expression>& q, const std::vector<Expression>& qd,
                                                            const std::vector<VariableUse>& uses) {
    ReferencePolynomials all;
    const auto read = [&](const std::vector<Expression>& from, std::vector<std::vector<Quad>>& to) {
      for (const Expression& one : from) {
        std::optional<AffineForm<Quad>> form = affine_form_of<Quad>(one, uses);
        if (!form) return false;
        to.push_back(std::move(form->powers));
      }
      return true;
    };
    if (!read(q, all.q) || !read(qd, all.qd)) return {};
    for (std::size_t i = 0; i < q.size() && qd.empty(); ++i) {
      std::vector<Quad>& rate = all.qd.emplace_back();
      for (std::size_t k = 1; k < all.q[i].size(); ++k) rate.push_back(all.q[i][k] * Quad(int(k)));
    }
    return all;
  }
  static std::vector<VariableUse> uses(const Parameters& parameters) {
    std::vector<VariableUse> uses{{VariableRole::time, 0}};
    for (const auto& [name, value] : parameters) uses.push_back({VariableRole::constant, value});
    return uses;
  }

  std::optional<ReferencePolynomials> polynomials_;
  Corners corners_;
  std::vector<CorneredProgram> q_, qd_, qdd_;
  std::vector<double> sides_;
  mutable std::vector<double> values_;
  mutable std::vector<Dual<double>> first_duals_;
  mutable std::vector<SecondDual> duals_;
};

class TableReference final : public Reference {
 public:
  TableReference(std::shared_ptr<const std::vector<double>> t, std::vector<Spline> q, std::vector<Spline> qd,
                 std::vector<Spline> qdd)
      : t_(std::move(t)), q_(std::move(q)), qd_(std::move(qd)), qdd_(std::move(qdd)) {}

  void evaluate(double t, Vec q, Vec qd, Vec qdd) const override {
    for (std::size_t i = 0; i < q_.size(); ++i) {
      const Spline::Value position = q_[i].at(t);
      const Spline::Value rate = qd_.empty() ? Spline::Value{position.yd, position.ydd, 0} : qd_[i].at(t);
      q[i] = position.y;
      qd[i] = rate.y;
      if (!qdd.empty()) qdd[i] = qdd_.empty() ? rate.yd : qdd_[i].at(t).y;
    }
  }
  double price(bool with_acceleration) const override {
    return kPriceOfSpline * double(q_.size() + qd_.size() + (with_acceleration ? qdd_.size() : 0));
  }
  // The accelerations of a spline bend at its rows.
  std::vector<double> breaks(double) const override { return *t_; }

 private:
  std::shared_ptr<const std::vector<double>> t_;
  std::vector<Spline> q_, qd_, qdd_;
};

std::vector<Expression> parse_all(const std::vector<Entry>& entries, const std::vector<std::string>& names,
                                  ProblemList& problems) {
  std::vector<Expression> parsed;
  for (const Entry& entry : entries) {
    try {
      parsed.push_back(Expression::parse(entry.text, names, entry.place));
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  return parsed;
}

std::vector<Spline> splines(const std::shared_ptr<const std::vector<double>>& t, const std::vector<std::vector<double>>& columns) {
  std::vector<Spline> all;
  for (const std::vector<double>& column : columns) all.push_back(Spline::over(t, column));
  return all;
}

// Values that are finite may have derivatives that are not.
void require_finite(const Reference& reference, const TimeTable& table, int n, const std::string& path) {
  std::vector<double> q(std::size_t(n), 0.0), qd(q), qdd(q);
  for (std::size_t k = 0; k < table.t.size(); ++k) {
    reference.evaluate(table.t[k], q, qd, qdd);
    for (std::size_t i = 0; i < q.size(); ++i) {
      if (std::isfinite(q[i]) && std::isfinite(qd[i]) && std::isfinite(qdd[i])) continue;
      throw Error(ExitCode::numerical,
                  "the motion in column q" + std::to_string(i + 1) + " has no finite derivatives at t = " +
                      format_shortest(table.t[k]) +
                      " s: what stands here and in the rows about it changes too fast for numbers",
                  {path, table.lines[k]});
    }
  }
}

}  // namespace

std::unique_ptr<Reference> make_expression_reference(const std::vector<Entry>& q,
                                                     const std::vector<Entry>& qd,
                                                     const std::vector<Entry>& qdd,
                                                     const Parameters& parameters) {
  std::vector<std::string> names{"t"};
  for (const auto& [name, value] : parameters) names.push_back(name);
  ProblemList problems;
  auto reference =
      std::make_unique<ExpressionReference>(parse_all(q, names, problems), parse_all(qd, names, problems),
                                            parse_all(qdd, names, problems), parameters);
  problems.throw_if_any();
  return reference;
}

std::unique_ptr<Reference> make_table_reference(const TimeTable& table, const std::string& path) {
  const auto t = std::make_shared<const std::vector<double>>(table.t);
  auto reference =
      std::make_unique<TableReference>(t, splines(t, table.groups[0]), splines(t, table.groups[1]), splines(t, table.groups[2]));
  require_finite(*reference, table, int(table.groups[0].size()), path);
  return reference;
}

std::unique_ptr<Reference> make_table_reference(const std::string& path, const Chain& chain) {
  const std::vector<std::string> quantities{"q", "qd", "qdd"};
  const Table file = read_table(path, {});
  const TimeTable table = time_table_of(file, quantities, chain.coordinate_names);
  check_table_units(chain, file, table, quantities);
  if (table.groups[0].empty())
    throw Error(ExitCode::bad_input, "has no columns q1 to q" + std::to_string(chain.coordinate_names.size()) + ", one a freedom",
                {path});
  return make_table_reference(table, path);
}

namespace {

// Solves the tridiagonal system in place (Thomas); diagonally dominant for splines of rising t.
void solve_tridiagonal(std::vector<double>& lower, std::vector<double>& diagonal, std::vector<double>& upper,
                       std::vector<double>& right) {
  const std::size_t n = right.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = lower[i] / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] -= factor * right[i - 1];
  }
  right[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) right[i] = (right[i] - upper[i] * right[i + 1]) / diagonal[i];
}

// Second derivatives M_i: h_{i-1} M_{i-1} + 2 (h_{i-1} + h_i) M_i + h_i M_{i+1} = 6 (slope_i - slope_{i-1}),
// the ends eliminated by the not-a-knot condition (the third derivative continues over the second and the
// last but one sample).
std::vector<double> curvatures(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  std::vector<double> curvature(n, 0.0);
  if (n < 3) return curvature;
  const auto h = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / h(i); };
  if (n == 3) {
    const double all = 2 * (slope(1) - slope(0)) / (h(0) + h(1));
    return {all, all, all};
  }
  const std::size_t inner = n - 2;
  std::vector<double> lower(inner), diagonal(inner), upper(inner), right(inner);
  for (std::size_t k = 0; k < inner; ++k) {
    lower[k] = h(k);
    diagonal[k] = 2 * (h(k) + h(k + 1));
    upper[k] = h(k + 1);
    right[k] = 6 * (slope(k + 1) - slope(k));
  }
  const double first = h(0) / h(1), last = h(n - 2) / h(n - 3);
  diagonal.front() += h(0) * (1 + first);
  upper.front() -= h(0) * first;
  diagonal.back() += h(n - 2) * (1 + last);
  lower.back() -= h(n - 2) * last;
  solve_tridiagonal(lower, diagonal, upper, right);
  std::copy(right.begin(), right.end(), curvature.begin() + 1);
  curvature[0] = curvature[1] + first * (curvature[1] - curvature[2]);
  curvature[n - 1] = curvature[n - 2] + last * (curvature[n - 2] - curvature[n - 3]);
  return curvature;
}

}  // namespace

Spline Spline::over(std::shared_ptr<const std::vector<double>> t, std::vector<double> y) {
  Spline spline;
  spline.curvature_ = curvatures(*t, y);
  spline.t_ = std::move(t);
  spline.y_ = std::move(y);
  return spline;
}

Spline::Spline(std::vector<double> t, std::vector<double> y)
    : Spline(over(std::make_shared<const std::vector<double>>(std::move(t)), std::move(y))) {}

Spline::Value Spline::at(double instant) const {
  const std::vector<double>& t = *t_;
  if (instant < t.front() || t.size() == 1) return {y_.front(), 0, 0};
  if (instant > t.back()) return {y_.back(), 0, 0};
  const auto above = std::upper_bound(t.begin() + 1, t.end() - 1, instant);
  const auto i = std::size_t(above - t.begin()) - 1;
  const double h = t[i + 1] - t[i], s = instant - t[i], r = t[i + 1] - instant;
  const double c0 = curvature_[i], c1 = curvature_[i + 1];
  const double a0 = y_[i] / h - c0 * h / 6, a1 = y_[i + 1] / h - c1 * h / 6;
  const double y = s == 0 ? y_[i] : r == 0 ? y_[i + 1] : c0 * r * r * r / (6 * h) + c1 * s * s * s / (6 * h) + a0 * r + a1 * s;
  return {y, (c1 * s * s - c0 * r * r) / (2 * h) + a1 - a0, (c0 * r + c1 * s) / h};
}

}  // namespace chainreel
