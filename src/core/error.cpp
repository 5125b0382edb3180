#include "core/error.hpp"

#include <algorithm>
#include <utility>

namespace chainreel {

std::string to_string(const Problem& problem) {
  std::string text;
  if (!problem.place.file.empty()) {
    text += problem.place.file + ":";
    if (problem.place.line > 0) text += std::to_string(problem.place.line) + ":";
    if (problem.place.line > 0 && problem.place.column > 0) text += std::to_string(problem.place.column) + ":";
    text += " ";
  }
  return text + problem.message;
}

Error::Error(ExitCode code, std::string message, Place place)
    : Error(code, std::vector<Problem>{{std::move(message), std::move(place)}}) {}

Error::Error(ExitCode code, std::vector<Problem> problems) : code_(code), problems_(std::move(problems)) {
  for (const Problem& problem : problems_) {
    if (!text_.empty()) text_ += "\n";
    text_ += to_string(problem);
  }
}

void ProblemList::throw_if_any(ExitCode code) const {
  if (!problems_.empty()) throw Error(code, problems_);
}

namespace {

// Levenshtein distance, row by row.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : " did you mean '" + nearest + "'?";
}

}  // namespace chainreel
