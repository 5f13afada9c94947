#include "apps/scene/read/history_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/scene/read/file_hash.hpp"
#include "apps/scene/read/record_file.hpp"

namespace ashlar {
namespace {

constexpr std::array<const char*, 4> record_keys = {"file", "time", "values", "scale"};

std::optional<SceneRecord> read_record_table(TomlTableReader table, std::size_t values) {
  SceneRecord record;
  std::string file;
  for (const char* key : {"file", "time", "values"}) table.require(key);
  bool good = table.read_name("file", file);
  record.file = file;
  good = table.read_name("time", record.time) && good;
  good = (table.read_number("scale", record.scale, range::any_number) || !table.given("scale")) && good;
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

}  // namespace

std::optional<HistoryRows> read_history(TomlTableReader& table, std::string_view key, std::size_t width,
                                        const char* words) {
  HistoryRows history;
  const toml::table* content = table.table_at(key);
  const auto given = [&](const char* name) { return content->contains(name); };
  if (content == nullptr || std::none_of(record_keys.begin(), record_keys.end(), given)) {
    if (!table.read_history(key, history.rows, width, words, " or { file, time, values, scale }"))
      return std::nullopt;
    return history;
  }
  history.file = read_record_table(*table.table(key), width - 1);
  if (!history.file) return std::nullopt;
  TomlReading& reading = table.reading();
  auto rows = read_record(*history.file, reading.folder(), reading.places().value(table.path(key) + ".file"),
                          reading.diagnostics());
  if (!rows) return std::nullopt;
  history.file->sha256 = sha256_of(reading.folder() / history.file->file);
  history.rows = std::move(*rows);
  return history;
}

}  // namespace ashlar
