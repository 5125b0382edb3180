// What came of a suite, for people, for programs and for services that show test results.
#pragma once

#include <string>
#include <vector>

#include "app/verify/verdict.hpp"

namespace chainreel {

struct SuiteResult {
  std::string suite;                     // its file
  std::string baselines;                 // their folder
  std::vector<PictureVerdict> pictures;  // in the suite's order
  std::vector<std::string> unused;       // baselines of no picture
  std::vector<std::string> pruned;
  std::vector<std::string> notices;  // of what is no picture's state and yet must be known

  int failed() const;
  int count(PictureState state) const;
};

// "accept" with the names of what failed, quoted for a shell: chainreel verify arm.yaml --accept home reach; "" where nothing else
// was drawn than what is accepted.
std::string accept_command(const SuiteResult& result);

Json to_json(const SuiteResult& result);
std::string junit_text(const SuiteResult& result);
std::string markdown_text(const SuiteResult& result);

// Whether the file at `path` is such a report, or one as HTML: what a later run replaces.
bool is_own_report(const std::string& path);
// "2 of 24 pictures failed: 1 changed, 1 missing"
std::string summary_of(const SuiteResult& result);
// "of no picture any more: the baseline home_light; --prune removes it"; "" where there are none.
std::string unused_words(const SuiteResult& result);

}  // namespace chainreel
