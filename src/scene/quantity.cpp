#include "scene/quantity.hpp"

#include <numbers>

#include "expr/expression.hpp"

namespace chainreel {

double parse_quantity(const std::string& text, const Place& place) {
  const bool degrees = text.size() > 3 && text.ends_with("deg");
  const std::string value = degrees ? text.substr(0, text.size() - 3) : text;
  const std::optional<double> number = Expression::parse(value, {}, place).constant();
  if (!number || !(*number - *number == 0))
    throw Error(ExitCode::bad_input, "'" + text + "' is not a finite number", place);
  return degrees ? *number * std::numbers::pi / 180 : *number;
}

}  // namespace chainreel
