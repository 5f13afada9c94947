// Columns and rows of history.csv.
#pragma once

#include <string>
#include <vector>

#include "apps/results/frames/block_frames.hpp"
#include "apps/results/tables/measure.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Names of the columns of history.csv, the step first; then stresses of measured points (sxx, syy, szz, sxy, syz,
/// sxz; Pa, tension positive); for a run in stages `stage` last.
[[nodiscard]] std::vector<std::string> history_columns(const std::vector<Measure>& measures,
                                                       bool in_stages = false);

/// The values after the step, in the order of history_columns. Points of absent blocks have nan.
/// @param stage 1-based number; 0: the run has none
[[nodiscard]] std::vector<double> history_row(const Simulation& simulation,
                                              const std::vector<Measure>& measures,
                                              const DisplacementOrigin& origin = {}, int stage = 0);

/// Present value of DisplacementOrigin::measures: displacement of a point or block (m), drift; zero of others.
[[nodiscard]] Vector3 measure_origin(const Simulation& simulation, const Measure& measure);

}  // namespace ashlar
