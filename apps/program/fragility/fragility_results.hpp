// Results of a fragility analysis: the table of runs, the fits, the curves and their pictures.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/fragility/fragility_fit.hpp"
#include "apps/program/fragility/fragility_runs.hpp"
#include "apps/program/plot/plot.hpp"
#include "apps/program/sweep/sweep_table.hpp"

namespace ashlar {

/// A run and what became of it.
struct FragilityRow {
  const PlannedRun* run;
  double intensity;
  std::optional<JudgedRun> outcome;  ///< empty: none yet
  std::string status;                ///< JudgedRun::state, or "failed", "refused", "interrupted", "not run"

  /// True if the run exceeds a limit; empty: not known. @param limit index
  [[nodiscard]] std::optional<bool> exceeded(std::size_t limit) const;
};

/// Reads the outcomes of runs. @throws std::runtime_error with path and reason if results are damaged
[[nodiscard]] std::vector<FragilityRow> rows_of(const FragilityPlan& plan,
                                                const std::vector<PlannedRun>& runs);

/// The fit by one limit, of the runs whose outcome is known.
[[nodiscard]] FragilityFit fit_of(const std::vector<FragilityRow>& rows, std::size_t limit, double level);

/// A row for each run: record, scale, random keys, the intensity, folder, status, time (s, up to which it was judged),
/// collapse (1 or 0) and the first block of it, the demand of each limit, and 1 or 0 for each limit: exceeded or not. Fields
/// that are not known are empty.
[[nodiscard]] SweepTable fragility_table(const FragilityPlan& plan, const IntensityMeasure& measure,
                                         const std::vector<FragilityRow>& rows);

/// fragility.json: the first limit at the top, all of them in `limits`.
[[nodiscard]] nlohmann::ordered_json fragility_json(const FragilityPlan& plan,
                                                    const IntensityMeasure& measure,
                                                    const std::vector<FragilityRow>& rows,
                                                    const std::vector<FragilityFit>& fits);

/// The fitted curves with their bounds, and the shares of runs at groups of intensities.
[[nodiscard]] Plot fragility_plot(const FragilityPlan& plan, const IntensityMeasure& measure,
                                  const std::vector<FragilityRow>& rows,
                                  const std::vector<FragilityFit>& fits);

/// IDA curves of a limit (Vamvatsikos and Cornell 2002): intensity against demand, a line for each record, that of a
/// sample. A line ends where a run collapses. Empty: the limit is the collapse
[[nodiscard]] std::optional<Plot> ida_plot(const FragilityPlan& plan, const IntensityMeasure& measure,
                                           const std::vector<FragilityRow>& rows, std::size_t limit);

}  // namespace ashlar
