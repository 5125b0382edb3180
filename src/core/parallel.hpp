// Independent pieces of work on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>

namespace chainreel {

// Each index below `count` once, in this order as threads become free; what the first of them throws is thrown here.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& run);

// The same with tools that a thread has to itself: `begin` is called on each thread, and what it returns lives and ends
// there.
using RunIndex = std::function<void(std::size_t)>;
void for_each_index_with_tools(std::size_t count, int threads, const std::function<RunIndex()>& begin);

// How much of many pieces of work is done, as any of the threads that do them may ask.
class DoneShare {
 public:
  explicit DoneShare(std::size_t all) : all_(double(all)) {}

  void add() { ++done_; }
  // From 0 to 1, with so much of the piece that is at work.
  double with(double part = 0) const { return std::min(1.0, (double(done_) + part) / all_); }

 private:
  double all_;
  std::atomic<std::size_t> done_ = 0;
};

}  // namespace chainreel
