// A map over two parameters, coloured by the error of the runs that held, or another number of theirs, and hatched where they
// failed; of methods with the boundary that theory predicts drawn over it.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "draw/charts/chart_page.hpp"

namespace chainreel {

struct MapCell {
  bool failed = false;
  double error = 0;  // of a run that held; 0 and below count as the least error of the map
  bool doubtful = false;  // its number is not to be relied on: it has a dot
};

struct MapBoundary {
  std::vector<Point> points;  // in the units of the axes
  std::string label;          // math notation: "omega h = 2"
};

struct StabilityMap {
  std::string title, subtitle;
  Axis x, y;  // the cells divide them evenly, log axes in ratio
  int nx = 0, ny = 0;
  std::vector<MapCell> cells;  // nx * ny, row by row from the lower left
  std::string error_title = "final error";
  bool is_linear = false;  // of numbers that are no errors: an even scale from the least to the largest, with their signs
  double most = std::numeric_limits<double>::infinity();  // cells with a larger error, or one that is no number, are pale
  std::string pale = "more";
  std::string hatched = "failed";  // what the cells are that have no number
  std::string dotted = "doubtful";  // what the cells are that have a dot
  std::vector<MapBoundary> boundaries;
  std::string footer;
};

// Throws Error (exit 3) where the cells are not nx * ny.
Picture stability_map(const StabilityMap& data, const ChartLook& look);

// The lines between cells where this holds and those where it does not, as corners of a grid of nx * ny
// cells, (0, 0) at the lower left; cells where it is not known have no edge.
std::vector<std::vector<Point>> edges_between(const std::vector<std::optional<bool>>& cells, int nx, int ny);

// A map of colours with even steps for the eye, readable in grey and by the colour-blind: dark violet at 0,
// yellow at 1.
Color map_color(double share);

}  // namespace chainreel
