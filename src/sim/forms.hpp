// A chain under a torque law in the form that a method asks for.
#pragma once

#include <memory>
#include <string>

#include "integrate/method.hpp"
#include "sim/chain_chart.hpp"
#include "sim/chain_system.hpp"

namespace chainreel {

class ChainForms {
 public:
  // Makes the form that the method's row names. Throws Error (bad input) that says why this chain or torque
  // has none, and which method to take instead. `system` must outlive it.
  ChainForms(ChainSystem& system, const Method& method);
  ~ChainForms();

  const Forms& forms() const { return forms_; }

 private:
  Forms forms_;
  std::unique_ptr<ChainChart> chart_;  // where the method needs plain coordinates and the chain has none
  std::unique_ptr<Momenta> momenta_;
  std::unique_ptr<Series> series_;
  std::unique_ptr<LinkedPoints> linked_points_;
};

}  // namespace chainreel
