#include "apps/scene/read/measure_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "apps/scene/read/region_reader.hpp"

namespace ashlar {
namespace {

void refuse_beside(TomlTableReader& table, const char* kind, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (table.given(key))
      table.error_at_key(key,
                         fmt::format("{} beside {} (both given), only one of both is allowed", key, kind));
}

void read_pair(TomlTableReader& table, SceneMeasure& measure) {
  std::vector<std::string> pair;
  if (table.read_texts("pair", pair) && pair.size() == 2)
    measure.pair = {pair[0], pair[1]};
  else if (!pair.empty())
    table.error_at_value(
        "pair",
        fmt::format("pair has the wrong length ({} entries), two block names are needed", pair.size()));
}

SceneDrift read_drift(TomlTableReader table) {
  SceneDrift drift;
  read_blocks_or_inside(table, drift.blocks, drift.inside);
  table.require("heights");
  std::vector<double> heights;
  if (!table.read_row("heights", heights, 2, "[lower, upper]")) return drift;
  if (heights[0] < heights[1])
    drift.heights = {heights[0], heights[1]};
  else
    table.error_at_value(
        "heights", fmt::format("heights do not increase ({} and {}); give the lower level first", heights[0],
                               heights[1]));
  return drift;
}

SceneCrack read_crack(TomlTableReader table) {
  SceneCrack crack;
  table.read_texts("joints", crack.joints);
  table.read_texts("to", crack.to);
  return crack;
}

void read_block(TomlTableReader& table, SceneMeasure& measure) {
  measure.inside = read_inside(table);
  if (!table.given("inside")) table.require("block");
  if (table.read_name("block", measure.block) && table.given("inside"))
    table.error_at_key("inside", "inside beside block (both given), only one of both is allowed");
  if (!table.given("point")) return;
  // Not finite until read, so that no later check applies to a missing point.
  measure.point = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  table.read_place("point", *measure.point);
}

}  // namespace

SceneMeasure read_measure(TomlTableReader& table) {
  SceneMeasure measure;
  table.require("name");
  table.read_name("name", measure.name);
  if (table.given("pair")) {
    read_pair(table, measure);
    refuse_beside(table, "pair", {"block", "inside", "point", "bolt", "drift", "crack"});
  } else if (table.given("bolt")) {
    table.read_name("bolt", measure.bolt);
    refuse_beside(table, "bolt", {"block", "inside", "point", "drift", "crack"});
  } else if (table.given("drift")) {
    measure.drift = read_drift(table.table_or_empty("drift"));
    refuse_beside(table, "drift", {"block", "inside", "point", "crack"});
  } else if (table.given("crack")) {
    measure.crack = read_crack(table.table_or_empty("crack"));
    refuse_beside(table, "crack", {"block", "inside", "point"});
  } else {
    read_block(table, measure);
  }
  return measure;
}

}  // namespace ashlar
