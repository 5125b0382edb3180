#include "expr/pulses.hpp"

#include <algorithm>
#include <cmath>

#include "expr/course.hpp"
#include "expr/instants.hpp"

namespace chainreel {
namespace {

constexpr int kCells = 1024;   // of the duration
constexpr double kTall = 0.1;  // of the largest value: what a pulse reaches
// The share of its height at which a pulse begins and ends: long steps that end there feel less of it than of what is within.
constexpr double kFoot = 1e-9;
constexpr int kParts = 32;          // that it is divided into
constexpr int kMostPieces = 512;    // looked at within a cell
constexpr std::size_t kMost = 100;  // pulses

struct Pulse {
  double begin, middle, end;
};

struct Piece {
  double a, b, tallest;
};

// Parts of the instructions that read t and nothing else that changes, as large as they come.
std::vector<CorneredProgram> parts_of_time(const CorneredProgram& program,
                                           std::span<const VariableUse> uses) {
  struct Waiting {
    std::size_t begin;
    bool reads_state, reads_time;
  };
  std::vector<Waiting> stack;
  std::vector<CorneredProgram> parts;
  const auto add = [&](const Waiting& one, std::size_t end) {
    if (one.reads_state || !one.reads_time || end - one.begin < 3) return;
    const auto b = std::ptrdiff_t(one.begin), e = std::ptrdiff_t(end);
    parts.push_back({{program.instructions.begin() + b, program.instructions.begin() + e},
                     {program.turns.begin() + b, program.turns.begin() + e},
                     program.stack_size});
  };
  for (std::size_t i = 0; i < program.instructions.size(); ++i) {
    const Instruction& one = program.instructions[i];
    const int change = stack_change_of(one.operation);
    if (change > 0) {
      const bool variable = one.operation == Operation::variable;
      const VariableRole role = variable ? uses[std::size_t(one.slot)].role : VariableRole::constant;
      const bool is_time = role == VariableRole::time;
      stack.push_back({i, role != VariableRole::constant && !is_time, is_time});
    } else if (change < 0) {
      const Waiting second = stack.back();
      stack.pop_back();
      Waiting& first = stack.back();
      if (first.reads_state != second.reads_state) {
        add(first, second.begin);
        add(second, i);
      }
      first.reads_state = first.reads_state || second.reads_state;
      first.reads_time = first.reads_time || second.reads_time;
    }
  }
  add(stack.back(), program.instructions.size());
  return parts;
}

// The pulses of one function.
class Search {
 public:
  Search(const CorneredProgram& program, const Corners& corners, std::span<const double> known, double end)
      : program_(program), corners_(corners), courses_(corners.uses()), sides_(std::size_t(corners.count())) {
    for (const VariableUse& use : corners.uses()) values_.push_back(use.value);
    double begin = 0;
    for (std::size_t i = 0; i <= known.size(); ++i) {
      const double next = i < known.size() ? known[i] : end;
      const int cells = std::max(1, int(std::ceil(kCells * (next - begin) / end)));
      for (int k = 0; k < cells; ++k)
        cells_.push_back({begin + (next - begin) * k / cells, begin + (next - begin) * (k + 1) / cells, 0});
      begin = next;
    }
  }

  // Those found are added; too many are none.
  void add_to(std::vector<double>& instants) {
    for (const Piece& cell : cells_) {
      enter(cell);
      const Range range = courses_.over(program_, sides_, cell.a, cell.b).value;
      const double largest = std::max(std::fabs(range.low), std::fabs(range.high));
      if (std::isfinite(largest)) scale_ = std::max(scale_, largest);
    }
    for (const Piece& cell : cells_) {
      enter(cell);
      const double at_a = value_at(cell.a), at_b = value_at(cell.b);
      low_ = std::min(at_a, at_b);
      high_ = std::max(at_a, at_b);
      look(cell.a, cell.b);
      if (pulses_.size() > kMost) return;
    }
    for (const Pulse& one : pulses_) {
      instants.push_back(one.middle);  // the others may all lie beside a thin one with a broad foot
      for (int k = 0; k <= kParts; ++k) instants.push_back(one.begin + (one.end - one.begin) * k / kParts);
    }
  }

 private:
  void enter(const Piece& cell) {
    std::fill(sides_.begin(), sides_.end(), kAsWritten);
    set_sides_of_time(corners_, 0.5 * (cell.a + cell.b), sides_);
  }

  double value_at(double t) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (corners_.uses()[i].role == VariableRole::time) values_[i] = t;
    return evaluate<double>(program_, values_, sides_);
  }

  // By how much values leave those at the ends of the cell.
  double beyond(double low, double high) const { return std::max(high - high_, low_ - low); }

  void look(double a, double b) {
    std::vector<Piece> pieces;
    const auto add = [&](double from, double to) {
      const Range range = courses_.over(program_, sides_, from, to).value;
      const double tallest = beyond(range.low, range.high);
      if (std::isfinite(tallest) && tallest > kTall * scale_) pieces.push_back({from, to, tallest});
    };
    add(a, b);
    for (int looks = 0; looks < kMostPieces && !pieces.empty(); ++looks) {
      const auto best = std::max_element(
          pieces.begin(), pieces.end(), [](const Piece& x, const Piece& y) { return x.tallest < y.tallest; });
      const Piece piece = *best;
      pieces.erase(best);
      const double middle = 0.5 * (piece.a + piece.b), y = value_at(middle), height = beyond(y, y);
      if (!(middle > piece.a && middle < piece.b)) continue;
      if (height > kTall * scale_) return take(a, middle, b, height);
      add(piece.a, middle);
      add(middle, piece.b);
    }
  }

  // From foot to foot, and what is beside it.
  void take(double a, double middle, double b, double height) {
    const auto foot = [&](double outside) {
      double inside = middle;
      for (;;) {
        const double t = 0.5 * (inside + outside);
        if (!(std::fabs(inside - outside) > 1e-3 * std::fabs(middle - outside)) || t == inside || t == outside) return outside;
        const double y = value_at(t);
        (beyond(y, y) > kFoot * height ? inside : outside) = t;
      }
    };
    const double begin = foot(a), end = foot(b);
    pulses_.push_back({begin, middle, end});
    if (pulses_.size() > kMost) return;
    look(a, begin);
    look(end, b);
  }

  const CorneredProgram& program_;
  const Corners& corners_;
  Courses courses_;
  std::vector<double> sides_, values_;
  std::vector<Piece> cells_;
  double scale_ = 0, low_ = 0, high_ = 0;
  std::vector<Pulse> pulses_;
};

}  // namespace

std::vector<double> pulses_of(const std::vector<CorneredProgram>& programs, const Corners& corners,
                              std::span<const double> known, double end) {
  std::vector<double> instants;
  for (const CorneredProgram& program : programs)
    for (const CorneredProgram& part : parts_of_time(program, corners.uses()))
      Search(part, corners, known, end).add_to(instants);
  std::sort(instants.begin(), instants.end());
  std::erase_if(instants, [end](double t) { return !(t > 0 && t < end); });
  return instants;
}

}  // namespace chainreel
