#include "expr/instants.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "expr/course.hpp"

namespace chainreel {
namespace {

constexpr long kMostPieces = 4000000;  // looked at for one corner
constexpr double kSmallest = 1e-12;    // of the duration: the shortest piece that is halved

// The instants of one corner, between those of the corners that it holds.
class Search {
 public:
  Search(const Corners& corners, const Corner& corner, double end)
      : corner_(corner),
        uses_(corners.uses()),
        smallest_(kSmallest * end),
        sides_(std::size_t(corners.count())),
        courses_(uses_) {
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

  void halve(double a, double at_a, double b, double at_b) {
    if (++pieces_ > kMostPieces) fail("cannot be told apart");
    const auto [value, slope] = courses_.over(corner_.value, sides_, a, b);
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
  Courses courses_;
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
