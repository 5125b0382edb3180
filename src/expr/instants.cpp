#include "expr/instants.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/error.hpp"
#include "core/scalar.hpp"

namespace chainreel {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr long kMostPieces = 4000000;  // looked at for one corner
constexpr double kSmallest = 1e-12;    // of the duration: the shortest piece that is halved

struct Range {
  double low = 0, high = 0;
  bool has_zero() const { return low <= 0 && high >= 0; }
  bool is_zero() const { return low == 0 && high == 0; }
};

constexpr Range kAnything{-kInfinity, kInfinity};

Range range_of(std::initializer_list<double> values) {
  Range range{kInfinity, -kInfinity};
  for (const double x : values) {
    if (std::isnan(x)) return kAnything;
    range.low = std::min(range.low, x);
    range.high = std::max(range.high, x);
  }
  return range;
}

Range operator+(Range a, Range b) {
  return range_of({a.low + b.low, a.high + b.high});
}
Range operator-(Range a, Range b) {
  return range_of({a.low - b.high, a.high - b.low});
}
Range operator*(Range a, Range b) {
  if (a.is_zero() || b.is_zero()) return {};
  return range_of({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}
Range operator/(Range a, Range b) {
  if (b.has_zero()) return kAnything;
  return range_of({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
}

Range sine_of(Range x) {
  if (!(x.high - x.low < 2 * kPi)) return {-1, 1};
  Range range = range_of({sine(x.low), sine(x.high)});
  // The first crest and the first trough at or behind the beginning.
  const auto passes = [&](double at) { return at + 2 * kPi * std::ceil((x.low - at) / (2 * kPi)) <= x.high; };
  if (passes(0.5 * kPi)) range.high = 1;
  if (passes(-0.5 * kPi)) range.low = -1;
  return range;
}

Range cosine_of(Range x) {
  return sine_of({x.low + 0.5 * kPi, x.high + 0.5 * kPi});
}

Range whole_power(Range x, int n) {
  if (n == 0) return {1, 1};
  if (n < 0) return Range{1, 1} / whole_power(x, -n);
  Range range = range_of({power(x.low, double(n)), power(x.high, double(n))});
  if (n % 2 == 0 && x.has_zero()) range.low = 0;
  return range;
}

Range hull(Range a, Range b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

// What values a function of t takes over a piece of time, and its slope.
struct Course {
  Range value, slope;
};

Course course_of(Operation operation, const Course& x, double side) {
  const auto [v, d] = x;
  switch (operation) {
    case Operation::negate:
      return {Range{} - v, Range{} - d};
    case Operation::sine:
      return {sine_of(v), cosine_of(v) * d};
    case Operation::cosine:
      return {cosine_of(v), Range{} - sine_of(v) * d};
    case Operation::tangent: {
      const Range c = cosine_of(v);
      const double low = tangent(v.low), high = tangent(v.high);
      // Between poles it rises; the rounding of a cosine may hide one that lies at an end.
      if (c.has_zero() || !(low <= high)) return {kAnything, kAnything};
      return {{low, high}, d / (c * c)};
    }
    case Operation::square_root: {
      if (v.high < 0) return {kAnything, kAnything};
      const Range root{square_root(std::max(v.low, 0.0)), square_root(v.high)};
      return {root, d / (root + root)};
    }
    case Operation::exponential: {
      const Range e{exponential(v.low), exponential(v.high)};
      return {e, e * d};
    }
    case Operation::logarithm:
      if (v.low <= 0) return {kAnything, kAnything};
      return {{logarithm(v.low), logarithm(v.high)}, d / v};
    default:  // the absolute value
      if (side == 1) return x;
      if (side == -1) return {Range{} - v, Range{} - d};
      return {hull(v, Range{} - v), hull(d, Range{} - d)};
  }
}

Course power_of(const Course& a, const Course& b) {
  const bool constant = b.value.low == b.value.high && b.slope.is_zero();
  const double n = b.value.low;
  if (constant && n == std::floor(n) && std::abs(n) < 1000) {
    const int whole = int(n);
    return {whole_power(a.value, whole), Range{n, n} * whole_power(a.value, whole - 1) * a.slope};
  }
  if (!(a.value.low > 0)) return {kAnything, kAnything};
  const Course log = course_of(Operation::logarithm, a, 0);
  const Course product{b.value * log.value, b.slope * log.value + b.value * log.slope};
  return course_of(Operation::exponential, product, 0);
}

Course course_of(Operation operation, const Course& a, const Course& b, double side) {
  switch (operation) {
    case Operation::add:
      return {a.value + b.value, a.slope + b.slope};
    case Operation::subtract:
      return {a.value - b.value, a.slope - b.slope};
    case Operation::multiply:
      return {a.value * b.value, a.slope * b.value + a.value * b.slope};
    case Operation::divide:
      return {a.value / b.value, (a.slope * b.value - a.value * b.slope) / (b.value * b.value)};
    case Operation::power:
      return power_of(a, b);
    case Operation::minimum:
    case Operation::maximum: {
      const double of_first = operation == Operation::maximum ? 1 : -1;
      if (side == of_first) return a;
      if (side == -of_first) return b;
      return {hull(a.value, b.value), hull(a.slope, b.slope)};
    }
    case Operation::arc_tangent2: {
      const Range norm = a.value * a.value + b.value * b.value;
      return {{-3 * kPi, 3 * kPi}, (b.value * a.slope - a.value * b.slope) / norm};
    }
    default: {  // a comparison; == and != hold never and always
      if (!(std::abs(side) == 1)) return {{0, 1}, {}};
      const bool rises = operation == Operation::greater || operation == Operation::greater_equal;
      const bool falls = operation == Operation::less || operation == Operation::less_equal;
      const double truth = rises ? (side == 1) : falls ? (side == -1) : (operation == Operation::not_equal);
      return {{truth, truth}, {}};
    }
  }
}

// The instants of one corner, between those of the corners that it holds.
class Search {
 public:
  Search(const Corners& corners, const Corner& corner, double end)
      : corner_(corner),
        uses_(corners.uses()),
        smallest_(kSmallest * end),
        sides_(std::size_t(corners.count())) {
    values_.reserve(uses_.size());
    for (const VariableUse& use : uses_) values_.push_back(use.value);
  }

  void look(const Corners& corners, double a, double b, std::vector<double>& found) {
    std::fill(sides_.begin(), sides_.end(), kAsWritten);
    set_sides_of_time(corners, 0.5 * (a + b), sides_);
    found_ = &found;
    begin_ = a;
    end_ = b;
    halve(a, value_at(a), b, value_at(b));
  }

 private:
  double value_at(double t) {
    for (std::size_t i = 0; i < uses_.size(); ++i)
      if (uses_[i].role == VariableRole::time) values_[i] = t;
    return evaluate<double>(corner_.value, values_, sides_);
  }

  Course course(double a, double b) {
    stack_.clear();
    const CorneredProgram& program = corner_.value;
    for (std::size_t i = 0; i < program.instructions.size(); ++i) {
      const Instruction& one = program.instructions[i];
      const int change = stack_change_of(one.operation);
      if (change > 0) {
        stack_.push_back(start(one, a, b));
        continue;
      }
      const CorneredProgram::Turn turn = program.turns[i];
      const double side = turn.corner < 0 ? kAsWritten : turn.sign * sides_[std::size_t(turn.corner)];
      const Course last = stack_.back();
      if (change == 0) {
        stack_.back() = course_of(one.operation, last, side);
        continue;
      }
      stack_.pop_back();
      stack_.back() = course_of(one.operation, stack_.back(), last, side);
    }
    return stack_.back();
  }

  Course start(const Instruction& one, double a, double b) const {
    if (one.operation == Operation::pi) return {{kPi, kPi}, {}};
    if (one.operation == Operation::number) return {{one.number, one.number}, {}};
    const VariableUse& use = uses_[std::size_t(one.slot)];
    if (use.role == VariableRole::time) return {{a, b}, {1, 1}};
    return {{use.value, use.value}, {}};
  }

  void halve(double a, double at_a, double b, double at_b) {
    if (++pieces_ > kMostPieces) fail("cannot be told apart");
    const auto [value, slope] = course(a, b);
    if (!value.has_zero() || slope.is_zero()) return;
    const bool changes = (at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0);
    if (!slope.has_zero()) {
      if (changes) return bisect(a, at_a, b);
      if (at_a == 0) add(a);
      if (at_b == 0) add(b);
      return;
    }
    const double middle = 0.5 * (a + b);
    if (b - a <= smallest_ || !(middle > a && middle < b))
      return changes ? bisect(a, at_a, b) : touch(middle);
    const double at_middle = value_at(middle);
    halve(a, at_a, middle, at_middle);
    halve(middle, at_middle, b, at_b);
  }

  void bisect(double a, double at_a, double b) {
    for (;;) {
      const double middle = a + 0.5 * (b - a);
      if (!(middle > a && middle < b)) return add(b);
      const double y = value_at(middle);
      if (y == 0) return add(middle);
      ((y < 0) == (at_a < 0) ? a : b) = middle;
    }
  }

  // Where zero is only touched, or nearly so: neighbours that cannot be told apart are one instant, or the start or the
  // end of what lies between two that are known.
  void touch(double t) {
    if (t < begin_ + 4 * smallest_ || t > end_ - 4 * smallest_) return;
    if (found_->empty() || t - found_->back() > 4 * smallest_) add(t);
  }

  void add(double t) {
    found_->push_back(t);
    if (long(found_->size()) > kMostInstants) fail("are more than " + std::to_string(kMostInstants));
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::limit, "the instants at which `" + corner_.text + "` jumps or bends " + what +
                                     " within the duration: take a shorter one, or a smooth expression");
  }

  const Corner& corner_;
  std::span<const VariableUse> uses_;
  double begin_ = 0, end_ = 0;  // of the time that is looked at
  double smallest_;
  std::vector<double> sides_, values_;
  std::vector<Course> stack_;
  std::vector<double>* found_ = nullptr;
  long pieces_ = 0;
};

}  // namespace

void set_sides_of_time(const Corners& corners, double t, std::span<double> sides) {
  std::vector<double> values;
  for (const VariableUse& use : corners.uses())
    values.push_back(use.role == VariableRole::time ? t : use.value);
  // Corners come behind those that they hold.
  for (int k = 0; k < corners.count(); ++k) {
    if (!corners[k].time_alone) continue;
    const double value = evaluate<double>(corners[k].value, values, sides);
    sides[std::size_t(k)] = value > 0 ? 1 : value < 0 ? -1 : kAsWritten;
  }
}

std::vector<double> instants_of(const Corners& corners, double end) {
  std::vector<double> known, found;
  for (int k = 0; k < corners.count(); ++k) {
    if (!corners[k].time_alone) continue;
    Search search(corners, corners[k], end);
    found.clear();
    double begin = 0;
    for (std::size_t i = 0; i <= known.size(); ++i) {
      const double next = i < known.size() ? known[i] : end;
      search.look(corners, begin, next, found);
      begin = next;
    }
    known.insert(known.end(), found.begin(), found.end());
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    std::erase_if(known, [end](double t) { return !(t > 0 && t < end); });
    if (long(known.size()) > kMostInstants)
      throw Error(ExitCode::limit, "the corners of the torques have more than " +
                                       std::to_string(kMostInstants) + " instants within the duration, of `" +
                                       corners[k].text + "` among others: take a shorter one");
  }
  return known;
}

}  // namespace chainreel
