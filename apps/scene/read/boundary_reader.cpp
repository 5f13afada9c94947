#include "apps/scene/read/boundary_reader.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/read/history_reader.hpp"
#include "apps/scene/toml/required_vectors.hpp"

namespace ashlar {
namespace {

/// The direction of a record of one column; zero: there is none.
Vector3 read_direction(TomlTableReader& table) {
  Vector3 direction = Vector3::Zero();
  if (!table.read_vector("direction", direction)) return Vector3::Zero();
  if (direction.isZero(0.0)) {
    table.error_at_value("direction", "direction is zero ([0, 0, 0]), a vector of any length is needed");
  } else if (table.table_at("wave") == nullptr) {
    table.error_at_key("direction",
                       fmt::format("direction of {}, it belongs to a wave from a file with one column",
                                   table.given("wave") ? "rows with three components" : "no wave"));
    direction.setZero();
  }
  return direction;
}

/// Three components in each row, or with a direction one.
void read_wave(TomlTableReader& table, SceneBoundary& boundary) {
  const Vector3 direction = read_direction(table);
  const bool along = !direction.isZero(0.0);
  std::optional<HistoryRows> rows =
      along ? read_history(table, "wave", 2, "[t, v]") : read_history(table, "wave", 4, "[t, vx, vy, vz]");
  if (!rows) return;
  boundary.file = std::move(rows->file);
  if (along) boundary.direction = direction;
  for (const std::vector<double>& row : rows->rows)
    boundary.wave.push_back(
        {row[0], along ? Vector3(row[1] * direction.normalized()) : Vector3(row[1], row[2], row[3])});
}

}  // namespace

SceneBoundary read_boundary(TomlTableReader& table) {
  SceneBoundary boundary;
  for (const char* key : {"plane", "kind"}) table.require(key);
  TomlTableReader plane = table.table_or_empty("plane");
  boundary.plane = {required_place(plane, "point"), required_direction(plane, "normal")};
  table.read_choice("kind", boundary.kind, boundary_kind_names);
  read_wave(table, boundary);
  return boundary;
}

}  // namespace ashlar
