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
  std::size_t lack = 0;  // without a value: which of the chart's
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

// Curves of one quantity, on axes of their own.
struct ResponsePanel {
  std::string y_title;
  bool from_zero = false;  // sizes, whose axis begins at zero
  std::vector<ResponseCurve> curves;
};

// Why a run has no value: its mark in the strip above the panel.
struct ResponseLack {
  std::string words;
  Marker marker = Marker::cross;
  std::optional<std::size_t> curve{};  // the colour of that curve; none: muted
};

struct ResponseChart {
  std::string title, subtitle;
  std::string warning{};  // what speaks against the numbers: stands on every page
  Axis x;
  std::vector<ResponsePanel> panels;  // one below the other
  std::string footer;
  std::string needed{};  // of the footer, in few words: what a small page tells
  std::vector<ResponseLack> lacks{{"no value"}};
  std::vector<ResponseEdge> edges{};
};

// Runs without a value have marks in a strip above the panel, doubtful ones rings, which no line joins. Curves of one panel that are equal are one
// with all names. A curve that ends before the last run is named beside its last mark. Panels that have no room are left out, which the foot says.
Picture response_chart(const ResponseChart& data, const ChartLook& look);

}  // namespace chainreel
