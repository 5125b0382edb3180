// Columns of a sweep's table as curves over its one axis, or one of them as a map over its two.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "draw/charts/response_chart.hpp"
#include "draw/charts/stability_map.hpp"
#include "scene/run/grid.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// Whether -o names a picture, which a sweep draws as curves or a map.
bool is_map_path(const std::string& path);
// Throws Error (usage) where the grid has not one axis of rising numbers, or two of evenly rising ones.
void require_map_grid(const Grid& grid);

// Throws Error (usage) where `wanted` means no column of a table with these names, as `sweep_map` takes it.
void require_map_column(const std::vector<std::string>& names, const Grid& grid, const std::vector<std::string>& last, const std::string& wanted);

// Of the table at `path`, a row each run of the grid. `wanted`: a column's name with or without its peak_, or "": the first of --peaks, else of
// `last`, the expressions that stand in it.
// Runs that failed, or that have no such number, as of an event that did not come, are hatched. Throws Error (usage) where no column is meant.
StabilityMap sweep_map(const Grid& grid, const Scene& scene, const std::string& path, const std::vector<std::string>& last, const std::string& wanted);

// The same of a grid of one axis; of the peaks of all joints a curve each. Runs that failed, or that have no such number, have no value.
ResponseChart sweep_curves(const Grid& grid, const Scene& scene, const std::string& path, const std::vector<std::string>& last, const std::string& wanted);

}  // namespace chainreel
