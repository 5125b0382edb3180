// The symbols that stand for a chain's numbers. Internal: the only header, with derive.hpp, that knows GiNaC.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "symbols/formula.hpp"

namespace chainreel {

using Algebra3 = std::array<GiNaC::ex, 3>;

// Symbols by their place in a list; each has its GiNaC twin.
class Symbols {
 public:
  GiNaC::ex add(Symbol symbol);

  const std::vector<Symbol>& list() const { return list_; }
  const std::vector<GiNaC::symbol>& twins() const { return twins_; }

 private:
  std::vector<Symbol> list_;
  std::vector<GiNaC::symbol> twins_;
};

struct BodyParameters {
  Algebra3 joint;                // the joint's origin in the parent
  GiNaC::ex mass;
  Algebra3 com;                  // in the body
  GiNaC::ex planar_inertia;      // of a planar chain, about its normal
  std::array<Algebra3, 3> inertia;  // of a chain in space, about the centre of mass
  GiNaC::ex damping, friction;
};

struct ChainParameters {
  std::vector<BodyParameters> bodies;  // as Chain::bodies
  Algebra3 end_effector;               // in its body
  Algebra3 gravity;                    // in W
};

// A number that is a simple one but for rounding is that; others are what they are to the last bit.
GiNaC::numeric exact_number(double value);

ChainParameters parameters_of(const Chain& chain, Symbols& symbols);

}  // namespace chainreel
