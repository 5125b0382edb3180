// How often this program has asked for memory, through operator new or, as Eigen does, through malloc. A test
// program counts if it lists allocation_count.cpp among its own sources.
#pragma once

namespace chainreel {

long allocation_count();

}  // namespace chainreel
