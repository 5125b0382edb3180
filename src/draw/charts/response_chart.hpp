// What becomes of a number as one key of the scene changes: a mark a run, joined where neighbours have a value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/charts/chart_page.hpp"

namespace chainreel {

struct ResponsePoint {
  double x = 0;
  std::optional<double> y{};  // nothing of a run that failed or has no such number
  bool is_doubtful = false;
};

struct ResponseCurve {
  std::string title;  // formulas between dollar signs
  std::vector<ResponsePoint> points;  // x rising
};

// Where what becomes of runs changes: a line across the plot, its value at the top.
struct ResponseEdge {
  double x = 0;
  std::string value;
};

struct ResponseChart {
  std::string title, subtitle;
  Axis x;
  std::string y_title;
  bool from_zero = false;  // sizes, whose axis begins at zero
  std::vector<ResponseCurve> curves;
  std::string footer;
  std::vector<ResponseEdge> edges{};
};

// Runs without a value are crosses on the axis, doubtful ones rings.
Picture response_chart(const ResponseChart& data, const ChartLook& look);

}  // namespace chainreel
