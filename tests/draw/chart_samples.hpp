// Made-up measurements that look like real ones: slopes of the methods' orders, failures, a round-off floor.
#pragma once

#include "draw/charts/chart.hpp"
#include "draw/charts/energy_chart.hpp"
#include "draw/charts/stability_map.hpp"

namespace chainreel::test {

WorkPrecision sample_work_precision();
EnergyChart sample_energy();
// A damped oscillator under semi-implicit Euler: stable below omega h = 2 (sqrt(1 + z^2) - z).
StabilityMap sample_map(int nx, int ny);

}  // namespace chainreel::test
