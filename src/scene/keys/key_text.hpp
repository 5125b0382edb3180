// What people and editors are told of a key: its form, unit, range and meaning. The reference, the JSON Schema and the
// messages about values out of range are made of it.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/names.hpp"

namespace chainreel {

// The numbers that a key takes.
struct KeyRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool is_open = false;  // `least` itself is too little

  bool holds(double value) const { return (is_open ? value > least : value >= least) && value <= most; }
  bool is_all() const { return *this == KeyRange{}; }
  friend bool operator==(const KeyRange&, const KeyRange&) = default;
};

// How a value is written.
enum class KeyForm {
  number,      // or a constant expression: 90deg, pi/2
  whole,       // a whole number
  truth,       // true or false
  text,        //
  path,        // relative to the scene file
  word,        // one of `words`
  rate,        // 60, 29.97, 30000/1001
  accuracy,    // 0.1 px
  expression,  // a number or an expression
  list,        // of what parts[0] is
  mapping,     // from names of one's own to what parts[0] is
  record,      // keys of its own: `parts`
  either,      // one of `parts`
};

struct KeyText {
  std::string name;  // "", of what stands in a list or an alternative without one
  KeyForm form = KeyForm::text;
  std::string help;  // half a sentence
  std::string unit;
  KeyRange range;
  std::span<const Name> words;
  std::vector<KeyText> parts;
  bool is_required = false;  // of a part: without it the record says nothing
  std::string example;       // in one line of YAML

  KeyText in(std::string its_unit) &&;
  KeyText within(KeyRange its_range) &&;
  KeyText required() &&;
};

KeyText told(std::string name, KeyForm form, std::string help);
KeyText told_word(std::string name, std::span<const Name> words, std::string help);
KeyText told_list(std::string name, KeyText item, std::string help);
KeyText told_mapping(std::string name, KeyText value, std::string help);
KeyText told_record(std::string name, std::vector<KeyText> parts, std::string help);
KeyText told_either(std::string name, std::vector<KeyText> parts, std::string help);

// "above 0 s", "between 16 and 16384 px", "between -90deg and 90deg"; "" where all numbers are taken.
std::string range_text(const KeyRange& range, const std::string& unit);

}  // namespace chainreel
