#include "sim/forms.hpp"

#include "core/error.hpp"

namespace chainreel {

ChainForms::ChainForms(ChainSystem& system, const Method& method) {
  forms_.second_order = &system;
  if (method.form != Form::second_order)
    throw Error(ExitCode::bad_input, "the method " + method.name + " does not take this chain; take dop853");
}

ChainForms::~ChainForms() = default;

}  // namespace chainreel
