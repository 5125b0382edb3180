// Independent pieces of work on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace chainreel {

// Each index below `count` once; what the first of them throws is thrown here.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& run);

}  // namespace chainreel
