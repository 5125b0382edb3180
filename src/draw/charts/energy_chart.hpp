// How far the energy strays with each method: |energy error| against time, both on log axes; or the energies themselves.
#pragma once

#include <string>
#include <vector>

#include "draw/charts/chart_page.hpp"

namespace chainreel {

struct EnergyCurve {
  std::string method;
  std::vector<double> t, error;  // of equal length, t rising; signs of errors are dropped
  std::string trouble;  // why the run ended early, in a word or two: "diverged"; empty for a whole run
  int look = -1;        // of curve_style; -1: the place in the list
  std::string title{};  // what the picture calls it; "": `method`
  bool is_lit = true;  // in colour, with markers; else a grey line, so that the others stand out
  std::vector<double> energy{};  // kinetic, potential and that of springs at these t, J
};

struct EnergyChart {
  std::string title, subtitle;
  std::string error_title = "|energy error| [J]";
  bool shows_energy = false;  // instead of its error, on axes that are no log ones
  std::vector<EnergyCurve> curves;
  std::string footer;
};

Picture energy_chart(const EnergyChart& data, const ChartLook& look);

// The largest |error| in each of `columns` equal parts of log t between `from` and the last t, at the instant
// where it occurs: an error that oscillates through zero is shown by its crests. Parts without a point are
// left out, and so are zeros.
std::vector<Point> crests(const EnergyCurve& curve, double from, int columns);

}  // namespace chainreel
