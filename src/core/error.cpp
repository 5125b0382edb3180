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

// In the ways of writing that people mix up.
std::string folded(std::string_view name) {
  std::string text(name);
  for (char& c : text) c = c == '-' ? '_' : c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return text;
}

// Letters put in, left out, exchanged for another one or with their neighbour, row by row.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool are_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (are_swapped) next[j] = std::min(next[j], before[j - 2] + 1);
    }
    std::swap(before, row);
    std::swap(row, next);
  }
  return row[b.size()];
}

// "euler" is a word of "explicit_euler", and "mass" begins "masses".
bool is_part_of(const std::string& name, const std::string& candidate) {
  constexpr std::size_t kFewLetters = 3;
  if (name.size() < kFewLetters) return false;
  return candidate.starts_with(name) || candidate.ends_with("_" + name) || candidate.find("_" + name + "_") != std::string::npos;
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(folded(name), folded(candidate));
    // Of equal ones that of as many letters: dq was to be qd, not q.
    const bool is_like = distance == best_distance && candidate.size() == name.size() && !best.empty() && best.size() != name.size();
    if (distance < best_distance || is_like) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> candidates) {
  constexpr std::size_t kMostNamed = 4;
  std::vector<std::string> near{nearest_name(name, candidates)};
  if (near.front().empty()) {
    near.clear();
    for (const std::string& candidate : candidates)
      if (near.size() < kMostNamed && is_part_of(folded(name), folded(candidate))) near.push_back(candidate);
  }
  std::string text;
  for (std::size_t i = 0; i < near.size(); ++i)
    text += (i == 0 ? " did you mean '" : i + 1 < near.size() ? "', '" : "' or '") + near[i];
  return text.empty() ? "" : text + "'?";
}

}  // namespace chainreel
