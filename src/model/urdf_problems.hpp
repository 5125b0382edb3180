// The problems of one URDF file, gathered while it is read. A file that is broken everywhere is reported by
// its first problems and their number: nobody reads ten thousand lines, and looking for near names costs
// time.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace chainreel {

// A doubt about a URDF file that is noted while it is read, for the doctor to tell.

// What a file says that is read, but probably not as it was meant; or that is not read.
struct UrdfRemark {
  std::string kind;  // what several such are: "attributes that are not read"
  std::string message;
  int line = 0;
  bool is_harmless = false;  // good to know, no more
};

class UrdfProblems {
 public:
  explicit UrdfProblems(std::string path) : path_(std::move(path)) {}
  // Of a text that no file holds: all is told of the place that asks for it.
  explicit UrdfProblems(Place asked) : path_(asked.file), asked_(std::move(asked)) {}

  void add(int line, std::string message) {
    if (++count_ <= kMostShown) shown_.push_back({std::move(message), asked_ ? *asked_ : Place{path_, line, 0}});
  }
  void remark(UrdfRemark remark) {
    if (remarks_.size() < kMostRemarks) remarks_.push_back(std::move(remark));
  }
  std::vector<UrdfRemark> take_remarks() { return std::move(remarks_); }

  bool is_full() const { return count_ >= kMostShown; }  // what follows is only counted

  void throw_if_any() {
    if (shown_.empty()) return;
    // Later passes look at earlier lines again: the user reads the file from the top.
    std::stable_sort(shown_.begin(), shown_.end(),
                     [](const Problem& a, const Problem& b) { return a.place.line < b.place.line; });
    if (count_ > kMostShown)
      shown_.push_back({"and " + std::to_string(count_ - kMostShown) + " more problems", {path_}});
    throw Error(ExitCode::bad_input, shown_);
  }

 private:
  static constexpr int kMostShown = 30;
  static constexpr std::size_t kMostRemarks = 10'000;

  std::string path_;
  std::optional<Place> asked_;
  std::vector<Problem> shown_;
  std::vector<UrdfRemark> remarks_;
  int count_ = 0;
};

// "did you mean 'x'?" behind a space, or "": comparing costs the product of all lengths, so it is not done
// for files and names beyond what people write.
inline std::string near_name(const std::string& name, std::span<const std::string> candidates) {
  return name.size() > 64 || candidates.size() > 1000 ? "" : did_you_mean(name, candidates);
}

}  // namespace chainreel
