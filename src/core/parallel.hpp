// Independent pieces of work on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace chainreel {

// Each index below `count` once, in this order as threads become free; what the first of them throws is thrown here.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& run);

// The same with tools that a thread has to itself: `begin` is called on each thread, and what it returns lives and ends
// there.
using RunIndex = std::function<void(std::size_t)>;
void for_each_index_with_tools(std::size_t count, int threads, const std::function<RunIndex()>& begin);

}  // namespace chainreel
