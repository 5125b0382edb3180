// Affine forms add, and take constant factors; polynomials in t also multiply, up to a degree. Everything
// else needs constants, for which the operations of the scalar are there.
#include "expr/affine.hpp"

#include <cmath>
#include <utility>

#include "expr/operations.hpp"

namespace chainreel {
namespace {

template <class T>
class Affine {
 public:
  Affine(const T& number, std::size_t names) : form_{{number}, std::vector<T>(names)} {}

  static Affine time(std::size_t names) {
    Affine t(T(0), names);
    t.form_.powers = {T(0), T(1)};
    return t;
  }
  static Affine variable(std::size_t slot, std::size_t names) {
    Affine x(T(0), names);
    x.form_.weights[slot] = T(1);
    x.has_weights_ = true;
    return x;
  }

  bool is_constant() const { return !has_weights_ && form_.powers.size() == 1; }
  bool is_polynomial() const { return !has_weights_; }
  std::size_t degree() const { return form_.powers.size() - 1; }
  const T& constant() const { return form_.powers[0]; }
  AffineForm<T>& form() { return form_; }

  // a + factor b
  static Affine sum(Affine a, const Affine& b, const T& factor) {
    if (a.form_.powers.size() < b.form_.powers.size()) a.form_.powers.resize(b.form_.powers.size(), T(0));
    for (std::size_t k = 0; k <= b.degree(); ++k) a.form_.powers[k] += factor * b.form_.powers[k];
    for (std::size_t i = 0; i < a.form_.weights.size(); ++i)
      a.form_.weights[i] += factor * b.form_.weights[i];
    a.has_weights_ |= b.has_weights_;
    return a;
  }

  template <class Change>
  Affine& change_each(Change&& change) {
    for (T& one : form_.powers) one = change(one);
    for (T& one : form_.weights) one = change(one);
    return *this;
  }

  // The product of two polynomials in t.
  static std::optional<Affine> product(const Affine& a, const Affine& b) {
    if (a.degree() + b.degree() > std::size_t(kHighestPowerOfTime)) return {};
    Affine result(T(0), a.form_.weights.size());
    result.form_.powers.assign(a.degree() + b.degree() + 1, T(0));
    for (std::size_t i = 0; i <= a.degree(); ++i)
      for (std::size_t j = 0; j <= b.degree(); ++j)
        result.form_.powers[i + j] += a.form_.powers[i] * b.form_.powers[j];
    return result;
  }

 private:
  AffineForm<T> form_;
  bool has_weights_ = false;
};

// A polynomial to a power that is a small whole number.
template <class T>
std::optional<Affine<T>> whole_power(const Affine<T>& base, const T& exponent, std::size_t names) {
  const double wanted = value_of(exponent);
  if (!base.is_polynomial() || !(wanted >= 0 && wanted <= kHighestPowerOfTime) ||
      wanted != std::floor(wanted) || exponent != T(wanted))
    return {};
  std::optional<Affine<T>> result(Affine<T>(T(1), names));
  for (int k = 0; k < int(wanted) && result; ++k) result = Affine<T>::product(*result, base);
  return result;
}

template <class T>
std::optional<Affine<T>> result_of_one(Operation operation, Affine<T> x, std::size_t names) {
  if (x.is_constant()) return Affine<T>(result_of(operation, x.constant()), names);
  if (operation != Operation::negate) return {};
  return x.change_each([](const T& one) { return -one; });
}

template <class T>
std::optional<Affine<T>> result_of_two(Operation operation, Affine<T> a, Affine<T> b, std::size_t names) {
  if (a.is_constant() && b.is_constant())
    return Affine<T>(result_of(operation, a.constant(), b.constant()), names);
  switch (operation) {
    case Operation::add:
      return Affine<T>::sum(std::move(a), b, T(1));
    case Operation::subtract:
      return Affine<T>::sum(std::move(a), b, T(-1));
    case Operation::multiply:
      if (a.is_constant()) std::swap(a, b);
      if (b.is_constant()) return a.change_each([&b](const T& one) { return one * b.constant(); });
      if (!a.is_polynomial() || !b.is_polynomial()) return {};
      return Affine<T>::product(a, b);
    case Operation::divide:
      if (!b.is_constant()) return {};
      return a.change_each([&b](const T& one) { return one / b.constant(); });
    case Operation::power:
      if (!b.is_constant()) return {};
      if (b.constant() == T(1)) return a;
      return whole_power(a, b.constant(), names);
    default:
      return {};
  }
}

template <class T>
bool is_finite(const std::vector<T>& values) {
  for (const T& value : values)
    if (!std::isfinite(value_of(value))) return false;
  return true;
}

template <class T>
std::optional<Affine<T>> value_on_stack(const Instruction& instruction, std::span<const VariableUse> uses) {
  if (instruction.operation == Operation::number) return Affine<T>(T(instruction.number), uses.size());
  if (instruction.operation == Operation::pi) return Affine<T>(pi<T>(), uses.size());
  const auto slot = std::size_t(instruction.slot);
  switch (uses[slot].role) {
    case VariableRole::constant:
      return Affine<T>(T(uses[slot].value), uses.size());
    case VariableRole::time:
      return Affine<T>::time(uses.size());
    case VariableRole::linear:
      return Affine<T>::variable(slot, uses.size());
    default:
      return {};
  }
}

}  // namespace

template <class T>
std::optional<AffineForm<T>> affine_form_of(std::span<const Instruction> instructions,
                                            std::span<const VariableUse> uses) {
  std::vector<Affine<T>> stack;
  const auto pop = [&stack] {
    Affine<T> top = std::move(stack.back());
    stack.pop_back();
    return top;
  };
  for (const Instruction& instruction : instructions) {
    std::optional<Affine<T>> result;
    const int change = stack_change_of(instruction.operation);
    if (change > 0) {
      result = value_on_stack<T>(instruction, uses);
    } else if (change == 0) {
      result = result_of_one(instruction.operation, pop(), uses.size());
    } else {
      Affine<T> b = pop();
      result = result_of_two(instruction.operation, pop(), std::move(b), uses.size());
    }
    if (!result) return {};
    stack.push_back(std::move(*result));
  }
  AffineForm<T>& form = stack.back().form();
  if (!is_finite(form.powers) || !is_finite(form.weights)) return {};
  return std::move(form);
}

template std::optional<AffineForm<double>> affine_form_of(std::span<const Instruction>,
                                                           std::span<const VariableUse>);
template std::optional<AffineForm<Quad>> affine_form_of(std::span<const Instruction>,
                                                         std::span<const VariableUse>);

}  // namespace chainreel
