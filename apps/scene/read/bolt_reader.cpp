#include "apps/scene/read/bolt_reader.hpp"

#include <fmt/format.h>

#include <limits>

#include "apps/scene/model/scene_names.hpp"

namespace ashlar {
namespace {

const Vector3 unknown_place = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());

/// A direction of any length but zero.
bool read_direction(TomlTableReader& table, const char* key, Vector3& result) {
  if (!table.read_vector(key, result)) return false;
  if (!result.isZero(0.0)) return true;
  table.error_at_value(
      key, fmt::format("{} has no direction ([0, 0, 0]), a vector other than zero is needed", key));
  return false;
}

void read_ends(TomlTableReader& table, Vector3& from, Vector3& to) {
  from = to = unknown_place;
  table.require("from");
  table.require("to");
  const bool good = table.read_place("from", from) && table.read_place("to", to);
  if (!good || from != to) return;
  table.error_at_value("to", fmt::format("both ends are the same point ([{}, {}, {}]), two points are needed",
                                         to.x(), to.y(), to.z()));
  from = to = unknown_place;
}

std::optional<SceneBolt::Pattern> read_pattern(TomlTableReader table) {
  SceneBolt::Pattern pattern;
  for (const char* key : {"plane", "spacing", "length"}) table.require(key);
  TomlTableReader plane = table.table_or_empty("plane");
  plane.require("point");
  plane.require("normal");
  bool good = plane.read_place("point", pattern.plane.point);
  good = read_direction(plane, "normal", pattern.plane.normal) && good;
  Vector3 direction;
  if (read_direction(table, "direction", direction)) pattern.direction = direction;
  good = table.read_number("length", pattern.length, range::positive_length) && good;
  std::vector<double> spacing;
  good = table.read_row("spacing", spacing, 2, "[a, b]") && good;
  if (good && !(spacing[0] > 0.0 && spacing[1] > 0.0)) {
    table.error_at_value("spacing", fmt::format("spacing is not positive ([{}, {}]), lengths > 0 are needed",
                                                spacing[0], spacing[1]));
    good = false;
  }
  if (!good) return std::nullopt;
  pattern.spacing = {spacing[0], spacing[1]};
  return pattern;
}

}  // namespace

SceneBolt read_bolt(TomlTableReader& table) {
  SceneBolt bolt;
  table.require("name");
  table.require("area");
  table.read_name("name", bolt.name);
  if (table.given("pattern")) {
    bolt.from = bolt.to = unknown_place;
    if (auto pattern = table.table("pattern")) bolt.pattern = read_pattern(*pattern);
    for (const char* key : {"from", "to"})
      if (table.given(key))
        table.error_at_key(key,
                           fmt::format("{} beside pattern (both given), only one of both is allowed", key));
  } else {
    read_ends(table, bolt.from, bolt.to);
  }
  table.read_number("area", bolt.area, range::positive);
  table.read_number("young_modulus", bolt.young_modulus, range::positive);
  table.read_number("yield_force", bolt.yield_force, range::positive);
  table.read_number("rupture_strain", bolt.rupture_strain, range::positive);
  table.read_choice("anchored", bolt.anchored, anchorage_names);
  const bool grouted = bolt.anchored == SceneBolt::Anchorage::grouted;
  for (const char* key : {"bond_stiffness", "bond_strength", "shear_stiffness", "shear_strength"})
    if (!grouted && table.given(key))
      table.error_at_key(
          key,
          fmt::format("{} of a bolt without grout (anchored = \"ends\"), leave it out or choose anchored = "
                      "\"grouted\"",
                      key));
  if (grouted) table.require("bond_stiffness");
  table.read_number("bond_stiffness", bolt.bond_stiffness, range::positive);
  table.read_number("bond_strength", bolt.bond_strength, range::positive);
  table.read_number("shear_stiffness", bolt.shear_stiffness, range::not_negative);
  table.read_number("shear_strength", bolt.shear_strength, range::positive);
  table.read_number("pretension", bolt.pretension, range::not_negative);
  if (bolt.yield_force && bolt.pretension > *bolt.yield_force)
    table.error_at_value("pretension",
                         fmt::format("pretension is above yield_force ({} N), at most {} N is allowed",
                                     bolt.pretension, *bolt.yield_force));
  return bolt;
}

SceneProp read_prop(TomlTableReader& table) {
  SceneProp prop;
  table.require("name");
  table.require("stiffness");
  table.read_name("name", prop.name);
  read_ends(table, prop.from, prop.to);
  table.read_number("stiffness", prop.stiffness, range::positive);
  table.read_number("yield_force", prop.yield_force, range::positive);
  table.read_bool("tension", prop.tension);
  return prop;
}

}  // namespace ashlar
