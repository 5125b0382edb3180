// How often this program has asked for memory by operator new.
#pragma once

namespace chainreel::testing {

int allocation_count();

}  // namespace chainreel::testing
