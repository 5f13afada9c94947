#include "apps/scene/read/region_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <limits>

#include "apps/scene/read/block_reader.hpp"

namespace ashlar {
namespace {

constexpr std::array<const char*, 5> region_keys = {"box", "mesh", "hull", "sphere", "halfspace"};

/// @return not finite after a fault
SceneHalfspace read_halfspace(TomlTableReader table) {
  const Vector3 none = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  SceneHalfspace half{none, none};
  for (const char* key : {"point", "normal"}) table.require(key);
  table.read_place("point", half.point);
  if (table.read_vector("normal", half.normal) && half.normal.isZero(0.0)) {
    table.error_at_value("normal", "normal has no direction ([0, 0, 0]), a vector other than zero is needed");
    half.normal = none;
  }
  return half;
}

std::optional<SceneRegion> read_region(TomlTableReader table) {
  std::vector<std::string> given;
  for (const char* key : region_keys)
    if (table.given(key)) given.emplace_back(key);
  if (given.size() != 1) {
    table.error_at_table(fmt::format("inside has {} ({}), exactly one of {} is needed",
                                     given.empty() ? "no shape" : fmt::format("{} shapes", given.size()),
                                     given.empty() ? "none given" : fmt::format("{}", fmt::join(given, ", ")),
                                     fmt::join(region_keys, ", ")));
    return std::nullopt;
  }
  if (given.front() == region_keys.back()) {
    if (table.table_at("halfspace") == nullptr) {
      (void)table.table("halfspace");
      return std::nullopt;
    }
    const SceneHalfspace half = read_halfspace(*table.table("halfspace"));
    if (!half.point.allFinite() || !half.normal.allFinite()) return std::nullopt;
    return SceneRegion{half};
  }
  SceneShape shape = read_shape(table, "inside", MeshKeys::as_it_is);
  if (std::holds_alternative<std::monostate>(shape)) return std::nullopt;
  return SceneRegion{std::move(shape)};
}

}  // namespace

std::optional<SceneRegion> read_inside(TomlTableReader& table) {
  std::optional<TomlTableReader> inside = table.table("inside");
  return inside ? read_region(*inside) : std::nullopt;
}

void read_block_list(TomlTableReader& table, std::string_view key, std::vector<std::string>& names,
                     std::optional<SceneRegion>& inside) {
  const toml::table* content = table.table_at(key);
  const bool chosen = content != nullptr && (content->contains("inside") || content->contains("blocks"));
  if (!chosen) {
    table.read_texts(key, names, " or { blocks, inside }");
    return;
  }
  TomlTableReader list = *table.table(key);
  read_blocks_or_inside(list, names, inside);
}

void read_blocks_or_inside(TomlTableReader& table, std::vector<std::string>& names,
                           std::optional<SceneRegion>& inside) {
  inside = read_inside(table);
  if (table.given("inside"))
    names = {"*"};
  else
    table.require("blocks");
  table.read_texts("blocks", names);
}

}  // namespace ashlar
