#include "apps/scene/read/history_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "apps/scene/records/file_hash.hpp"
#include "apps/scene/records/record_file.hpp"
#include "apps/scene/records/record_processing.hpp"

namespace ashlar {
namespace {

constexpr std::array<const char*, 6> history_record_keys = {"file",  "time",     "values",
                                                            "scale", "baseline", "resample"};
constexpr const char* of_accelerations = "acceleration_history";

/// @return true if the key is absent or valid
bool read_scale(TomlTableReader& table, SceneRecord& record) {
  std::string word;
  if (!table.text_at("scale") || !table.read_text("scale", word) || word != "g")
    return table.read_number("scale", record.scale, range::any_number) || !table.given("scale");
  std::string kind = record.file.extension().string();
  for (char& letter : kind) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  record.scale = standard_gravity;
  if (kind != ".v2" && kind != ".smc") return true;
  table.error_at_value("scale",
                       fmt::format("scale of a {} record is not \"g\": its values are in cm/s^2, scale = "
                                   "0.01 is needed",
                                   kind.substr(1)));
  return false;
}

/// @return true if the keys are absent or valid
bool read_processing(TomlTableReader& table, bool accelerations, SceneRecord& record) {
  bool good = table.read_number("resample", record.resample, range::positive) || !table.given("resample");
  good = (table.read_integer("baseline", record.baseline, 0, largest_baseline_order) ||
          !table.given("baseline")) &&
         good;
  if (record.baseline && !accelerations) {
    table.error_at_key("baseline", fmt::format("baseline of a history that is none of accelerations ({}), it "
                                               "belongs to {}",
                                               *record.baseline, of_accelerations));
    return false;
  }
  return good;
}

std::optional<SceneRecord> read_record_table(TomlTableReader table, std::size_t values, bool accelerations) {
  SceneRecord record;
  std::string file;
  for (const char* key : {"file", "values"}) table.require(key);
  bool good = table.read_name("file", file);
  record.file = file;
  good = (table.read_name("time", record.time) || !table.given("time")) && good;
  good = read_scale(table, record) && good;
  good = read_processing(table, accelerations, record) && good;
  if (!table.read_texts("values", record.values)) return std::nullopt;
  if (record.values.size() != values) {
    table.error_at_value(
        "values", fmt::format("values has the wrong length ({} entries), {} column {} needed (\"\" for zero)",
                              record.values.size(), values, values == 1 ? "name is" : "names are"));
    return std::nullopt;
  }
  if (!good) return std::nullopt;
  return record;
}

/// @param table of the record. @return false after a fault
bool process(TomlTableReader& table, const std::string& key, const SceneRecord& record,
             std::vector<std::vector<double>>& rows) {
  const auto fault = [&](const char* of, std::string message) {
    table.reading().error(table.reading().places().value(key + of), std::move(message));
    return false;
  };
  if (record.baseline) {
    if (rows.size() <= static_cast<std::size_t>(*record.baseline))
      return fault(".baseline",
                   fmt::format("record is too short for its baseline ({} rows), more than {} are needed",
                               rows.size(), *record.baseline));
    remove_baseline(rows, *record.baseline);
  }
  if (!record.resample) return true;
  const double length = rows.back()[0] - rows.front()[0];
  if (!(length / *record.resample < most_resampled_rows))
    return fault(".resample",
                 fmt::format("resample makes too many rows ({:g} s every {:g} s), at least {:.3g} s is "
                             "needed",
                             length, *record.resample, length / most_resampled_rows));
  rows = resampled(rows, *record.resample);
  return true;
}

}  // namespace

std::optional<HistoryRows> read_history(TomlTableReader& table, std::string_view key, std::size_t width,
                                        const char* words) {
  HistoryRows history;
  const toml::table* content = table.table_at(key);
  const auto given = [&](const char* name) { return content->contains(name); };
  if (content == nullptr || std::none_of(history_record_keys.begin(), history_record_keys.end(), given)) {
    if (!table.read_history(key, history.rows, width, words, " or { file, time, values, scale }"))
      return std::nullopt;
    return history;
  }
  history.file = read_record_table(*table.table(key), width - 1, key == of_accelerations);
  if (!history.file) return std::nullopt;
  TomlReading& reading = table.reading();
  auto rows = read_record(*history.file, reading.folder(), reading.places().value(table.path(key) + ".file"),
                          reading.diagnostics());
  if (!rows || !process(table, table.path(key), *history.file, *rows)) return std::nullopt;
  history.file->sha256 = sha256_of(reading.folder() / history.file->file);
  history.rows = std::move(*rows);
  return history;
}

}  // namespace ashlar
