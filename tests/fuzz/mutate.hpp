// Texts and bytes spoilt at random, the same on every machine for one seed.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace chainreel {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits();                                                   // SplitMix64
  std::size_t below(std::size_t n) { return n == 0 ? 0 : bits() % n; }    // 0 .. n-1
  bool one_in(std::size_t n) { return below(n) == 0; }
  template <class List>
  auto& pick(List& list) {
    return list[below(std::size(list))];
  }

 private:
  std::uint64_t state_;
};

// One to six changes: bits, pieces taken out, doubled, moved; numbers replaced by nasty ones; words of the dictionary and
// others put in; the end cut off.
std::string mutated(std::string text, Dice& dice, std::span<const std::string> dictionary);

// A word of a command line or a number as nobody should give it.
std::string nasty_number(Dice& dice);

}  // namespace chainreel
