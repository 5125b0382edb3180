// Work on data that nobody has checked, done by a child process with limits: readers of mesh files are known
// to overflow and to exhaust memory, and a crash there must not take the program along.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace chainreel {

struct ChildLimits {
  std::size_t memory = std::size_t(1)
                       << 30;  // bytes beyond what the program already has; not kept by sanitizer builds
  int cpu_seconds = 20;
  int seconds = 600;                         // by the clock, for a child that waits and does not work: a busy machine starves it for long
  std::size_t reply = std::size_t(1) << 20;  // bytes
};

struct ChildResult {
  bool finished = false;  // the work returned; otherwise the child died
  std::string reply;      // what the work returned
  std::string trouble;    // how the child died: "ran out of memory or crashed (signal 11)"
};

// Runs `work` in a child and hands back the text that it returns (any bytes). An exception inside counts as
// dying, and so does a longer reply than is allowed. Throws Error (exit 7) where no process can be made.
ChildResult run_in_limited_child(const std::function<std::string()>& work, const ChildLimits& limits = {});

}  // namespace chainreel
