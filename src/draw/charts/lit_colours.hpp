// Colours of the curves that a chart shows in colour.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace chainreel {

// Looks of curve_style: they stay where their colours differ; one that is like another before it becomes that which is least like all
// others.
void tell_colours_apart(std::span<int* const> looks);

// Places of curves in the order in which they are drawn: those in colour over the others.
template <class Curves>
std::vector<std::size_t> quiet_first(const Curves& curves) {
  std::vector<std::size_t> order;
  for (const bool lit : {false, true})
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (curves[i].is_lit == lit) order.push_back(i);
  return order;
}

}  // namespace chainreel
