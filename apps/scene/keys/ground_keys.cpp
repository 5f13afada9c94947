// [[water]], [initial_stress], [[boundary]] and [[load]].
#include <fmt/format.h>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/schema_parts.hpp"
#include "apps/scene/keys/values.hpp"
#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/records/file_hash.hpp"
#include "apps/scene/records/record_file.hpp"

namespace ashlar::keys {
namespace {

using Water = SceneWater;
using Stress = SceneInitialStress;
using Boundary = SceneBoundary;
using MovingLoad = SceneMovingLoad;

/// Points of a surface from a file.
bool read_surface(TomlTableReader& level, const std::string& key, Water& water) {
  std::string name;
  if (!level.read_name(key, name)) return false;
  SceneRecord record{
      .file = name, .time = "x", .values = {"y", "z"}, .scale = 1.0, .sha256 = {}, .in_order = false};
  TomlReading& reading = level.reading();
  const auto rows =
      read_record(record, reading.folder(), reading.places().value(level.path(key)), reading.diagnostics());
  if (!rows) return false;
  record.sha256 = sha256_of(reading.folder() / record.file);
  for (const std::vector<double>& row : *rows) water.surface.emplace_back(row[0], row[1], row[2]);
  water.file = record;
  return true;
}

bool is_level(const Water& water) {
  return !water.file;
}

const Keys<Water> level_table(
    "",
    {of(&Water::level, place("point", &ScenePlane::point, "or `level.file` instead")
                           .required_unless_given({"file"})
                           .not_beside({"file"}))
         .written_if(is_level),
     of(&Water::level,
        direction("normal", &ScenePlane::normal, "",
                  "of the plane of the level, not across gravity. An inclined level is piezometric: the "
                  "pressure is `unit_weight` times its height above the place")
            .required_unless_given({"file"})
            .not_beside({"file"}))
         .written_if(is_level),
     own<Water>("file",
                {"a text in quotes", schema_of_text, read_surface,
                 [](const Water& water) { return water.file ? Json(water.file->file.string()) : Json(); }},
                "",
                "CSV with columns x, y and z: points of the level, linear between their Delaunay "
                "triangles. It reaches over all faces that it presses on; up is z"),
     found<Water>("sha256",
                  [](const Water& water) { return water.file ? Json(water.file->sha256) : Json(); })});

const Keys<Water>& level_keys() {
  return level_table;
}

const Keys<Water> water_table(
    "Hydrostatic pressure on joints and free faces",
    {name("name", &Water::name,
          "each its own; a `[[stage.water]]` replaces the one of its name from there on"),
     part<level_keys, Water>("level", "").required_always(),
     number("unit_weight", &Water::unit_weight, range::positive, "N/m^3", "").required_always(),
     names("joints", &Water::joints, "names or globs of `[[cut]]`s, and of blocks on either side"),
     names("faces", &Water::faces, "names or globs of blocks whose free faces are pressed")});

bool has_ratio(const Stress& stress) {
  return !stress.stress.given();
}

bool check_size(TomlTableReader& table, Stress&) {
  return check_one_of(table, "size", {"stress", "k0"});
}

constexpr const char* stress_components = "[sxx, syy, szz, sxy, syz, szx]";

const Keys<Stress> stress_table(
    "The stress of blocks and joints at the start",
    {field("stress", &Stress::stress, 6, stress_components, "Pa",
           "tension positive; each a number or a formula of x, y and z (m, as placed). Or `k0`"),
     number("k0", &Stress::k0, range::not_negative, "",
            "horizontal over vertical stress; the vertical one is the weight of what is above, along gravity")
         .written_if(has_ratio),
     number("surface", &Stress::surface, range::any_number, "m",
            "height (against gravity) where the vertical stress begins")
         .not_beside({"stress"})
         .written_if(has_ratio),
     number("unit_weight", &Stress::unit_weight, range::positive, "N/m^3", "of what is above")
         .not_beside({"stress"})
         .written_if(has_ratio)
         .otherwise("density times gravity"),
     names("blocks", &Stress::blocks, "names or globs")},
    {check_size});

/// The direction belongs to a file with one column. @return true if there is one and it is right
bool has_direction(TomlTableReader& table, const Boundary& boundary, bool& good) {
  if (!boundary.direction || !boundary.direction->allFinite()) return false;
  if (table.table_at("wave") != nullptr) return true;
  table.error_at_key("direction",
                     fmt::format("direction of {}, it belongs to a wave from a file with one column",
                                 table.given("wave") ? "rows with three components" : "no wave"));
  return good = false;
}

/// Three components in each row, or with a direction one.
bool read_wave(TomlTableReader& table, Boundary& boundary) {
  bool good = true;
  const bool along = has_direction(table, boundary, good);
  const Vector3 direction = boundary.direction.value_or(Vector3::Zero());
  boundary.direction.reset();
  std::optional<HistoryRows> rows =
      along ? read_history(table, "wave", 2, "[t, v]") : read_history(table, "wave", 4, "[t, vx, vy, vz]");
  if (!rows) return good && !table.given("wave");
  boundary.file = std::move(rows->file);
  if (along) boundary.direction = direction;
  for (const std::vector<double>& row : rows->rows)
    boundary.wave.push_back(
        {row[0], along ? Vector3(row[1] * direction.normalized()) : Vector3(row[1], row[2], row[3])});
  return good;
}

const Keys<Boundary> boundary_table(
    "A plane in which the model ends and the ground goes on",
    {table<plane_keys>("plane", &Boundary::plane, "").required_always(),
     choice("kind", &Boundary::kind, boundary_kind_names,
            "`quiet`: dashpots alone; `free-field`: they act against the motion of a column of the ground, "
            "which the wave of the quiet boundary below moves. Its layers are those of the blocks beside it, "
            "from the base up")
         .required_always(),
     own<Boundary>("wave",
                   {history_words("[t, vx, vy, vz]"), [] { return history_schema(4); },
                    // Its columns depend on the direction: read_wave.
                    [](TomlTableReader&, const std::string&, Boundary&) { return true; },
                    [](const Boundary& boundary) { return json_of_rows(boundary.file, boundary.wave); }},
                   "s, m/s",
                   "velocity of a wave that comes in through a quiet boundary, constant before the first row "
                   "and after the last. With stages it acts in the first dynamic one"),
     direction("direction", &Boundary::direction, "",
               "of a `wave` from a file with one column in `values`, any length")},
    {read_wave});

bool check_path(TomlTableReader& table, MovingLoad& load) {
  const bool good = load.path.size() != 1;
  if (!good) table.error_at_value("path", "path has too few places (1), at least 2 are needed");
  if (!good || !load.force.allFinite()) load.path.clear();
  return good;
}

const Keys<MovingLoad> load_table(
    "A force that moves",
    {names("blocks", &MovingLoad::blocks, "names or globs of the blocks that it may stand on"),
     direction("force", &MovingLoad::force, "N", "").required_always(),
     number("spacing", &MovingLoad::spacing, range::positive_length, "m",
            "largest distance of its points, at most 10,000 of them")
         .otherwise("1/100 of the path"),
     history<MovingLoad>("path",
                         {4, "[t, x, y, z]",
                          [](MovingLoad& load, HistoryRows history) {
                            load.file = std::move(history.file);
                            for (const auto& row : history.rows)
                              load.path.push_back({row[0], {row[1], row[2], row[3]}});
                          },
                          [](const MovingLoad& load) { return json_of_rows(load.file, load.path); }},
                         "s, m", "at least two rows, times increase")
         .required_always()},
    {check_path});

const Keys<ScenePlane> plane_table(
    "", {place("point", &ScenePlane::point, "any point of the plane").required_always(),
         direction("normal", &ScenePlane::normal, "", "any length").required_always()});

}  // namespace

const Keys<ScenePlane>& plane_keys() {
  return plane_table;
}

const Keys<SceneWater>& water_keys() {
  return water_table;
}

const Keys<SceneInitialStress>& initial_stress_keys() {
  return stress_table;
}

const Keys<SceneBoundary>& boundary_keys() {
  return boundary_table;
}

const Keys<SceneMovingLoad>& moving_load_keys() {
  return load_table;
}

}  // namespace ashlar::keys
