#include "apps/program/fragility/record_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>

#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/check/water_checks.hpp"

namespace ashlar {
namespace {

namespace fs = std::filesystem;

/// Units of records by the ending of their names.
const std::map<std::string, const char*>& units_by_ending() {
  constexpr const char* of_scene = "the unit of a table, by the scene's scale";
  static const std::map<std::string, const char*> units = {
      {".at2", "g"}, {".v2", "cm/s^2"}, {".smc", "cm/s^2"}, {".csv", of_scene}, {".txt", of_scene}};
  return units;
}

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return ending;
}

/// Ratio of the longest to the shortest step; the time of its end in the record.
struct StepRatio {
  double ratio = 1.0, time = 0.0;
};

StepRatio step_ratio(const std::vector<SceneFix::Motion>& rows) {
  StepRatio result;
  if (rows.size() < 3) return result;
  const double first = rows[1].time - rows[0].time;
  for (std::size_t k = 2; k < rows.size(); ++k) {
    const double step = rows[k].time - rows[k - 1].time;
    const double ratio = std::max(step / first, first / step);
    if (ratio > result.ratio) result = {ratio, rows[k].time};
  }
  return result;
}

/// Rounded times, as of 1/60 s in milliseconds, have steps that differ by less.
constexpr double most_step_ratio = 1.5;

/// @return empty after a fault
std::optional<FragilityRecord> read_one(const fs::path& file, const fs::path& scene_file,
                                        const RecordPlaces& places, std::vector<std::string> overrides,
                                        const IntensityMeasure& measure, Diagnostics& diagnostics) {
  const fs::path folder = fs::absolute(scene_file).parent_path();
  FragilityRecord record{file.filename().string(), fs::absolute(file).lexically_proximate(folder), 0.0, 0.0};
  const std::vector<std::string> of_record = places.overrides(record.file, 1.0);
  overrides.insert(overrides.end(), of_record.begin(), of_record.end());
  Diagnostics faults;
  const Scene scene = read_scene(scene_file, overrides, faults);
  if (!faults.good()) {
    for (const Diagnostic& fault : faults.sorted())
      if (fault.severity == Severity::error) diagnostics.error(fault.place, fault.message);
    return std::nullopt;
  }
  const SceneFix* support = record_support(scene);
  if (support == nullptr) throw std::logic_error("a scene with a record has no support with one");
  const auto fault = [&](std::string what) {
    diagnostics.error({file.string(), 1, 1}, std::move(what));
    return std::nullopt;
  };
  const auto intensity = intensity_of(measure, support->history, up_of(scene));
  if (!intensity) return fault("record is zero throughout, accelerations are needed");
  if (const StepRatio steps = step_ratio(support->history);
      !places.resampled && steps.ratio > most_step_ratio)
    return fault(
        fmt::format("steps of the record differ ({:.3g} times, at {:.6g} s), equal ones are needed, or "
                    "resample in the scene's acceleration_history",
                    steps.ratio, steps.time));
  record.intensity = *intensity;
  record.end = support->history.back().time;
  return record;
}

}  // namespace

std::vector<std::string> record_names(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw std::invalid_argument(fmt::format("--records {}: {}, a folder of records is needed",
                                            folder.string(),
                                            fs::exists(folder) ? "is no folder" : "there is no such folder"));
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && !name.starts_with('.') && units_by_ending().contains(ending_of(name)))
      names.push_back(name);
  }
  if (names.empty())
    throw std::invalid_argument(fmt::format(
        "--records {}: the folder has no records, files named *.AT2, *.V2, *.smc, *.csv or *.txt are needed",
        folder.string()));
  std::sort(names.begin(), names.end());
  const auto unit = [](const std::string& name) {
    return std::string_view(units_by_ending().at(ending_of(name)));
  };
  for (const std::string& name : names)
    if (unit(name) != unit(names.front()))
      throw std::invalid_argument(fmt::format(
          "--records {}: records have different units: {} has {}, {} has {}; records of one unit are "
          "needed, as the scene's scale is that of all",
          folder.string(), names.front(), unit(names.front()), name, unit(name)));
  return names;
}

std::optional<std::vector<FragilityRecord>> read_records(const fs::path& folder, const fs::path& scene,
                                                         const RecordPlaces& places,
                                                         const std::vector<std::string>& overrides,
                                                         const IntensityMeasure& measure,
                                                         Diagnostics& diagnostics) {
  std::vector<FragilityRecord> records;
  const std::vector<std::string> names = record_names(folder);
  for (const std::string& name : names)
    if (auto record = read_one(folder / name, scene, places, overrides, measure, diagnostics))
      records.push_back(std::move(*record));
  if (records.size() < names.size()) return std::nullopt;
  return records;
}

}  // namespace ashlar
