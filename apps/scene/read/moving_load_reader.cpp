#include "apps/scene/read/moving_load_reader.hpp"

#include <utility>

#include "apps/scene/read/history_reader.hpp"

namespace ashlar {

SceneMovingLoad read_moving_load(TomlTableReader& table) {
  SceneMovingLoad load;
  for (const char* key : {"force", "path"}) table.require(key);
  table.read_texts("blocks", load.blocks);
  const bool force_good = table.read_vector("force", load.force);
  if (force_good && load.force.isZero(0.0))
    table.error_at_value("force", "force has no direction ([0, 0, 0]), a vector other than zero is needed");
  table.read_number("spacing", load.spacing, range::positive_length);
  auto path = read_history(table, "path", 4, "[t, x, y, z]");
  if (!path || load.force.isZero(0.0)) return load;
  if (path->rows.size() < 2) {
    table.error_at_value("path", "path has too few places (1), at least 2 are needed");
    return load;
  }
  load.file = std::move(path->file);
  for (const auto& row : path->rows) load.path.push_back({row[0], {row[1], row[2], row[3]}});
  return load;
}

}  // namespace ashlar
