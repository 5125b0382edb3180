#include "sim/system/even_sides.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace chainreel {
namespace {

// Of the largest in a row and a column: far above the rounding of rates, far below what masses of one robot
// make of regular rows.
constexpr double kDependent = 1e-10;
constexpr double kNothing = 1e-12;  // of the largest of all: a row or a column of rounding alone

constexpr std::uint32_t bit(std::size_t column) {
  return std::uint32_t(1) << column;
}

}  // namespace

EvenSides::EvenSides(std::size_t corners)
    : n_(corners),
      rows_{n_ + 1, std::vector<double>(n_ * (n_ + 1)), std::vector<std::size_t>(n_)},
      zeros_{n_, std::vector<double>(n_ * n_), std::vector<std::size_t>(n_)},
      weight_(n_),
      y_(n_),
      lambda_(n_),
      best_(n_) {}

// By Gauss and Jordan with complete pivoting among the active columns: the rank, and as many rows.
std::size_t EvenSides::reduce(Rows& rows, std::size_t count, std::size_t of_columns, Columns active) {
  std::size_t rank = 0;
  for (; rank < count; ++rank) {
    std::size_t row = rank, column = of_columns;
    double largest = kDependent;
    for (std::size_t i = rank; i < count; ++i)
      for (std::size_t j = 0; j < of_columns; ++j)
        if ((active & bit(j)) && std::fabs(rows(i, j)) > largest) largest = std::fabs(rows(i, j)), row = i, column = j;
    if (column == of_columns) break;
    active &= ~bit(column);
    rows.basic[rank] = column;
    const double pivot = rows(row, column);
    for (std::size_t j = 0; j < rows.width; ++j) {
      std::swap(rows(rank, j), rows(row, j));
      rows(rank, j) /= pivot;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double factor = rows(i, column);
      if (i == rank || factor == 0) continue;
      for (std::size_t j = 0; j < rows.width; ++j) rows(i, j) -= factor * rows(rank, j);
      rows(i, column) = 0;
    }
  }
  return rank;
}

// Rows and columns to a largest of one; those of rounding alone are left out.
void EvenSides::scale(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (const double one : a) largest = std::max(largest, std::fabs(one));
  count_ = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    double in_row = 0;
    for (std::size_t j = 0; j < n_; ++j) in_row = std::max(in_row, std::fabs(a[i * n_ + j]));
    if (!(in_row > kNothing * largest)) continue;
    for (std::size_t j = 0; j < n_; ++j) rows_(count_, j) = a[i * n_ + j] / in_row;
    rows_(count_++, n_) = b[i] / in_row;
  }
  active_ = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    weight_[j] = 0;
    for (std::size_t i = 0; i < count_; ++i) weight_[j] = std::max(weight_[j], std::fabs(rows_(i, j)));
    if (!(weight_[j] > kNothing)) continue;
    active_ |= bit(j);
    for (std::size_t i = 0; i < count_; ++i) rows_(i, j) /= weight_[j];
  }
}

// The combination of the reduced rows, one less than there are, that reads none of the columns left out:
// y into y_, its columns into lambda_. False where there are several.
bool EvenSides::find_combination(Columns left_out) {
  std::size_t equations = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    if (!(left_out & bit(j))) continue;
    for (std::size_t k = 0; k < n_; ++k) zeros_(equations, k) = k < rank_ ? rows_(k, j) : 0;
    ++equations;
  }
  const std::size_t rank = reduce(zeros_, equations, rank_, bit(rank_) - 1);
  if (rank + 1 != rank_) return false;
  Columns free = bit(rank_) - 1;
  for (std::size_t i = 0; i < rank; ++i) free &= ~bit(zeros_.basic[i]);
  const std::size_t one = std::size_t(std::countr_zero(free));
  y_[one] = 1;
  for (std::size_t i = 0; i < rank; ++i) y_[zeros_.basic[i]] = -zeros_(i, one);
  double largest = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    lambda_[j] = 0;
    if (!(active_ & bit(j)) || (left_out & bit(j))) continue;
    for (std::size_t k = 0; k < rank_; ++k) lambda_[j] += y_[k] * rows_(k, j);
    largest = std::max(largest, std::fabs(lambda_[j]));
  }
  for (double& one_of : lambda_)
    if (std::fabs(one_of) <= kDependent * largest) one_of = 0;
  return true;
}

// Any combination says sum_j lambda_j u_j = y c, so that some |x_j| = |u_j| / w_j is at least
// |y c| / sum_j w_j |lambda_j|; the largest such bound, over combinations that leave out one column less than
// there are rows, is reached (duality of linear programs), and by all that it reads.
void EvenSides::fix_largest(std::span<double> x) {
  double level = -1;
  for (Columns left_out = 0; left_out < bit(n_); ++left_out) {
    if ((left_out & ~active_) || std::size_t(std::popcount(left_out)) + 1 != rank_) continue;
    if (!find_combination(left_out)) continue;
    double sum = 0, wanted = 0;
    for (std::size_t k = 0; k < rank_; ++k) wanted += y_[k] * rows_(k, n_);
    for (std::size_t j = 0; j < n_; ++j) sum += weight_[j] * std::fabs(lambda_[j]);
    if (!(std::fabs(wanted) / sum > level)) continue;
    level = std::fabs(wanted) / sum;
    for (std::size_t j = 0; j < n_; ++j) best_[j] = wanted < 0 ? -lambda_[j] : lambda_[j];
  }
  if (level < 0) {  // numbers that are none
    active_ = 0;
    return;
  }
  for (std::size_t j = 0; j < n_; ++j) {
    if (best_[j] == 0) continue;
    x[j] = best_[j] > 0 ? level : -level;
    active_ &= ~bit(j);
    for (std::size_t k = 0; k < rank_; ++k) rows_(k, n_) -= rows_(k, j) * weight_[j] * x[j];
  }
}

bool EvenSides::solve(std::span<const double> a, std::span<const double> b, std::span<double> x) {
  if (n_ > kMost) return false;
  const auto is_number = [](double one) { return std::isfinite(one); };
  if (!std::all_of(a.begin(), a.end(), is_number) || !std::all_of(b.begin(), b.end(), is_number)) return false;
  scale(a, b);
  rank_ = reduce(rows_, count_, n_, active_);
  if (rank_ == n_) return false;
  std::fill(x.begin(), x.end(), count_ < n_ ? std::numeric_limits<double>::quiet_NaN() : 0.0);
  if (count_ < n_) return true;
  while (rank_ > 0) {
    if (rank_ == std::size_t(std::popcount(active_))) {
      for (std::size_t k = 0; k < rank_; ++k) x[rows_.basic[k]] = rows_(k, n_) / weight_[rows_.basic[k]];
      break;
    }
    fix_largest(x);
    rank_ = reduce(rows_, rank_, n_, active_);
  }
  return true;
}

}  // namespace chainreel
