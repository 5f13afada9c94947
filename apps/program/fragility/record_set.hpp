// The records of a folder, as they move the base of a scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/fragility/intensity.hpp"
#include "apps/program/fragility/record_places.hpp"

namespace ashlar {

struct FragilityRecord {
  std::string name;            ///< of its file, in the folder
  std::filesystem::path file;  ///< relative to the folder of the scene
  double intensity = 0.0;      ///< of the record as the scene reads it, before factors
  double end = 0.0;            ///< s, time of its last row
};

/// Names of the records in a folder, sorted: .AT2, .V2, .smc, .csv and .txt; other files and hidden ones are left out.
/// @throws std::invalid_argument with the fault and the requirement: no folder, no records in it, records of different
/// units. PEER's are in g, .V2 and .smc in cm/s^2, and tables in the unit that the scene's `scale` converts: a folder has
/// records of one of these units
[[nodiscard]] std::vector<std::string> record_names(const std::filesystem::path& folder);

/// Reads the records by the scene. Each fault is reported at its place: of the file of a record, and of records that are
/// zero throughout, or whose steps differ by more than half without `resample`.
/// @param overrides of the scene without records
/// @return empty after a fault
[[nodiscard]] std::optional<std::vector<FragilityRecord>> read_records(
    const std::filesystem::path& folder, const std::filesystem::path& scene, const RecordPlaces& places,
    const std::vector<std::string>& overrides, const IntensityMeasure& measure, Diagnostics& diagnostics);

}  // namespace ashlar
