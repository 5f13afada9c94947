// The columns of history.csv: the register of their names, units, meanings and values.
//
// The order is that of the file: the step; measures in the order of the scene; the run as a whole; then what later
// versions have added to measures; for a run in stages `stage` last.
#pragma once

#include <string>
#include <vector>

#include "apps/results/columns/column.hpp"
#include "apps/results/frames/block_frames.hpp"
#include "apps/results/tables/measure.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

[[nodiscard]] std::vector<Column> history_columns(const std::vector<Measure>& measures,
                                                  bool in_stages = false);

/// The values after the step, in the order of history_columns without the step. Points of absent blocks have nan.
/// @param stage 1-based number; 0: the run has none
[[nodiscard]] std::vector<double> history_row(const Simulation& simulation,
                                              const std::vector<Measure>& measures,
                                              const DisplacementOrigin& origin = {}, int stage = 0);

/// A kind of measure and its columns, for references. @param kind word of the scene: "block", "pair", ...
struct MeasureColumns {
  const char* kind;
  std::vector<Column> columns;  ///< "NAME.x"
};
[[nodiscard]] std::vector<MeasureColumns> columns_by_kind();

[[nodiscard]] std::vector<std::string> names_of(const std::vector<Column>& columns);

/// The present name of a column that an earlier version wrote under another one; other names unchanged.
[[nodiscard]] inline std::string present_name(const std::string& column) {
  if (column == "energy.refound_gained") return "energy.redetection_gained";
  if (column == "energy.refound_lost") return "energy.redetection_lost";
  return column;
}

/// history.units.json: {NAME: {"unit", "measure", "group", "meaning"}}, `measure` empty for columns of the run, in the order of the columns.
[[nodiscard]] std::string column_units(const std::vector<Column>& columns);

/// Present value of DisplacementOrigin::measures: displacement of a point or block (m), drift; zero of others.
[[nodiscard]] Vector3 measure_origin(const Simulation& simulation, const Measure& measure);

}  // namespace ashlar
