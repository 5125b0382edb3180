#include "scene/keys/key_text.hpp"

#include <cmath>
#include <numbers>

#include "core/format.hpp"

namespace chainreel {
namespace {

// People write angles in degrees.
std::string bound_text(double value, const std::string& unit) {
  if (unit == "rad") return format_shortest(value * 180 / std::numbers::pi) + "deg";
  std::string text = format_shortest(value);
  if (const std::size_t plus = text.find("e+0"); plus != std::string::npos) text.erase(plus + 1, 2);
  return text;
}

}  // namespace

KeyText KeyText::in(std::string its_unit) && {
  unit = std::move(its_unit);
  return std::move(*this);
}

KeyText KeyText::within(KeyRange its_range) && {
  range = its_range;
  return std::move(*this);
}

KeyText KeyText::required() && {
  is_required = true;
  return std::move(*this);
}

KeyText told(std::string name, KeyForm form, std::string help) {
  KeyText text;
  text.name = std::move(name);
  text.form = form;
  text.help = std::move(help);
  return text;
}

KeyText told_word(std::string name, std::span<const Name> words, std::string help) {
  KeyText text = told(std::move(name), KeyForm::word, std::move(help));
  text.words = words;
  return text;
}

KeyText told_list(std::string name, KeyText item, std::string help) {
  KeyText text = told(std::move(name), KeyForm::list, std::move(help));
  text.parts.push_back(std::move(item));
  return text;
}

KeyText told_mapping(std::string name, KeyText value, std::string help) {
  KeyText text = told(std::move(name), KeyForm::mapping, std::move(help));
  text.parts.push_back(std::move(value));
  return text;
}

KeyText told_record(std::string name, std::vector<KeyText> parts, std::string help) {
  KeyText text = told(std::move(name), KeyForm::record, std::move(help));
  text.parts = std::move(parts);
  return text;
}

KeyText told_either(std::string name, std::vector<KeyText> parts, std::string help) {
  KeyText text = told(std::move(name), KeyForm::either, std::move(help));
  text.parts = std::move(parts);
  return text;
}

std::string range_text(const KeyRange& range, const std::string& unit) {
  const std::string behind = unit.empty() || unit == "rad" ? "" : " " + unit;
  if (range.is_all()) return "";
  const std::string least = bound_text(range.least, unit), most = bound_text(range.most, unit);
  if (!std::isfinite(range.most)) return (range.is_open ? "above " : "at least ") + least + behind;
  if (range.is_open) return "above " + least + " and up to " + most + behind;
  return "between " + least + " and " + most + behind;
}

}  // namespace chainreel
