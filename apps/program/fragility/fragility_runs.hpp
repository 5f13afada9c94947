// The runs of a fragility analysis: records x scales x samples, each in a process of its own.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/fragility/limit_watch.hpp"
#include "apps/program/fragility/record_set.hpp"
#include "apps/program/run/run_options.hpp"
#include "apps/program/sweep/variants.hpp"

namespace ashlar {

/// Settings that all runs share.
struct FragilityPlan {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< of all runs
  RecordPlaces places;
  std::vector<FragilityRecord> records;
  std::vector<double> scales;
  std::vector<VariedKey> drawn;  ///< random keys
  Samples samples;
  std::vector<Limit> limits;
  double after = 5.0;   ///< s of a run after its record, at most; of a scene without stages
  bool staged = false;  ///< the scene has stages, whose times are kept
  bool frames = false;  ///< frames as the scene asks, otherwise of the first and the last state alone
  bool force = false;   ///< replace results of other scenes
};

/// One run.
struct PlannedRun {
  std::size_t record = 0;  ///< index
  double scale = 1.0;
  std::vector<std::string> values;  ///< of random keys
  std::string name;                 ///< "A.AT2, scale = 0.2, ..."
  RunOptions options;
};

/// By record, then scale, then sample. @param folder of all runs. @throws std::invalid_argument as variants_of()
[[nodiscard]] std::vector<PlannedRun> planned_runs(const FragilityPlan& plan,
                                                   const std::filesystem::path& folder);

/// Runs what is not there. Runs whose outcome is certain are kept, others continue.
/// @return exit status, as run_processes()
[[nodiscard]] int execute(const FragilityPlan& plan, const std::vector<PlannedRun>& runs, int jobs,
                          bool quiet, std::ostream& err);

}  // namespace ashlar
