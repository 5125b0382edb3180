#include "sim/forms.hpp"

#include "core/error.hpp"
#include "sim/chain_momenta.hpp"
#include "sim/chain_points.hpp"
#include "sim/chain_series.hpp"

namespace chainreel {

ChainForms::ChainForms(ChainSystem& system, const Method& method) {
  forms_.second_order = &system;
  if (system.constrained() && method.form != Form::second_order)
    throw Error(ExitCode::bad_input,
                "the method " + method.name + " takes no constraints: take dop853, or `method: auto`");
  if (system.chain().has_floating && (method.plain_coordinates || method.form == Form::momenta)) {
    chart_ = std::make_unique<ChainChart>(system);
    forms_.second_order = chart_.get();
    forms_.chart = chart_.get();
  }
  switch (method.form) {
    case Form::second_order:
      return;
    case Form::momenta:
      momenta_ = std::make_unique<ChainMomenta>(system, chart_ ? &chart_->local() : nullptr);
      forms_.momenta = momenta_.get();
      return;
    case Form::series:
      series_ = make_chain_series(system, method.highest_order + 1);
      forms_.series = series_.get();
      return;
    case Form::linked_points:
      linked_points_ = make_chain_points(system, method.name);
      forms_.linked_points = linked_points_.get();
      return;
  }
}

ChainForms::~ChainForms() = default;

}  // namespace chainreel
