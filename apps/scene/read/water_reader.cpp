#include "apps/scene/read/water_reader.hpp"

#include <fmt/format.h>

#include <string>

#include "apps/scene/records/file_hash.hpp"
#include "apps/scene/records/record_file.hpp"
#include "apps/scene/toml/required_vectors.hpp"

namespace ashlar {
namespace {

void read_surface(TomlTableReader& level, SceneWater& water) {
  std::string name;
  if (!level.read_name("file", name)) return;
  SceneRecord record{
      .file = name, .time = "x", .values = {"y", "z"}, .scale = 1.0, .sha256 = {}, .in_order = false};
  TomlReading& reading = level.reading();
  const auto rows = read_record(record, reading.folder(), reading.places().value(level.path("file")),
                                reading.diagnostics());
  if (!rows) return;
  record.sha256 = sha256_of(reading.folder() / record.file);
  for (const std::vector<double>& row : *rows) water.surface.emplace_back(row[0], row[1], row[2]);
  water.file = record;
}

void read_level(TomlTableReader level, SceneWater& water) {
  if (!level.given("file")) {
    water.level = {required_place(level, "point"), required_direction(level, "normal")};
    return;
  }
  read_surface(level, water);
  for (const char* key : {"point", "normal"})
    if (level.given(key))
      level.error_at_key(key, fmt::format("{} beside file (both given), only one of both is allowed", key));
}

}  // namespace

SceneWater read_water(TomlTableReader& table) {
  SceneWater water;
  table.read_name("name", water.name);
  for (const char* key : {"level", "unit_weight"}) table.require(key);
  read_level(table.table_or_empty("level"), water);
  table.read_number("unit_weight", water.unit_weight, range::positive);
  table.read_texts("joints", water.joints);
  table.read_texts("faces", water.faces);
  return water;
}

}  // namespace ashlar
