#include "apps/scene/read/cut_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/read/block_reader.hpp"
#include "apps/scene/read/region_reader.hpp"

namespace ashlar {
namespace {

constexpr int largest_integer = std::numeric_limits<int>::max();

void read_radius(TomlTableReader& table, SceneCut& cut) {
  constexpr NumberRange words = {0.0, largest_coordinate, false, true, "a number > 0 and <= 1e150, or inf"};
  if (!table.holds_infinity("radius")) table.read_number("radius", cut.radius, words);
}

void read_number_of_planes(TomlTableReader& table, SceneCut& cut) {
  if (!table.holds_infinity("number")) table.read_integer("number", cut.number, 0, largest_integer);
}

/// Standard deviation of a spacing relative to its mean: beyond it nearly all planes coincide within rounding error.
constexpr double most_deviation = 100.0;

void read_spacing_law(TomlTableReader table, SceneCut& cut) {
  table.require("mean");
  table.read_number("mean", cut.spacing, range::positive_length);
  const bool given = table.read_number("deviation", cut.deviation, range::not_negative);
  table.read_choice("distribution", cut.law, spacing_names);
  if (!cut.spacing) return;
  const double mean = *cut.spacing;
  if (cut.law == SceneCut::Spacing::exponential) {
    if (given && cut.deviation != mean)
      table.error_at_value(
          "deviation", fmt::format("deviation of exponential spacings is not their mean ({}), {} is needed; "
                                   "it may be left out",
                                   cut.deviation, mean));
    cut.deviation = mean;
    return;
  }
  if (cut.deviation > most_deviation * mean)
    table.error_at_value("deviation", fmt::format("deviation is out of range ({}), at most {} times the mean "
                                                  "({}) is needed",
                                                  cut.deviation, most_deviation, most_deviation * mean));
  const double most = mean / std::sqrt(3.0);
  if (cut.law == SceneCut::Spacing::uniform && cut.deviation >= most)
    table.error_at_value(
        "deviation", fmt::format("deviation lets spacings be zero or less ({}), less than mean / sqrt(3) = "
                                 "{:.6g} is needed",
                                 cut.deviation, most));
}

void read_planes(TomlTableReader& table, SceneCut& cut, bool needed) {
  if (needed) {
    table.require("dip");
    table.require("dip_direction");
  }
  table.read_number("dip", cut.dip, range::zero_to_90);
  table.read_number("dip_direction", cut.dip_direction, range::any_number);
  table.read_place("point", cut.point);
  if (table.table_at("spacing") != nullptr)
    read_spacing_law(table.table_or_empty("spacing"), cut);
  else
    table.read_number("spacing", cut.spacing, range::positive_length);
  table.read_number("fisher", cut.fisher, range::not_negative);
  table.read_number("persistence", cut.persistence, range::zero_to_one);
  read_radius(table, cut);
  read_number_of_planes(table, cut);
  if (needed && !table.given("spacing") && cut.number.value_or(0) != 0)
    table.error_at_value(
        "number",
        fmt::format("number of planes without their spacing ({}), a spacing is needed", *cut.number));
}

void read_discs(TomlTableReader& table, SceneCut& cut) {
  cut.kind = SceneCut::Kind::discs;
  std::string file;
  table.read_name("file", file);
  cut.file = file;
}

/// `fracture_energy` of a bond: of both kinds, or a number for each.
void read_energy_of_bond(TomlTableReader& table, SceneBond& bond) {
  FractureEnergy read;
  if (table.table_at("fracture_energy") != nullptr) {
    TomlTableReader energy = table.table_or_empty("fracture_energy");
    for (const char* key : {"tension", "shear"}) energy.require(key);
    energy.read_number("tension", read.tension, range::positive);
    energy.read_number("shear", read.shear, range::positive);
    bond.fracture_energy = read;
    return;
  }
  constexpr NumberRange words = {0.0, range::no_limit, false, false, "a number > 0 or { tension, shear }"};
  if (!table.read_number("fracture_energy", read.tension, words)) return;
  read.shear = read.tension;
  bond.fracture_energy = read;
}

void read_bond(TomlTableReader& table, SceneCut& cut) {
  std::optional<TomlTableReader> reader = table.table("bonded");
  if (!reader) return;
  if (cut.glued) table.error_at_key("bonded", "bonded beside glued (both given); give one of both");
  for (const char* key : {"tensile_strength", "cohesion"}) reader->require(key);
  SceneBond bond;
  reader->read_number("tensile_strength", bond.tensile_strength, range::positive);
  reader->read_number("cohesion", bond.cohesion, range::positive);
  reader->read_number("friction_angle", bond.friction_angle, range::zero_to_below_90);
  read_energy_of_bond(*reader, bond);
  cut.bonded = bond;
}

/// Refuses keys that apply to planes only.
void refuse_plane_keys(TomlTableReader& table, const char* kind) {
  for (const char* key :
       {"dip", "dip_direction", "point", "spacing", "fisher", "persistence", "radius", "number"})
    if (table.given(key))
      table.error_at_key(key, fmt::format("{} beside {} (both given); give one of both", key, kind));
}

}  // namespace

SceneCut read_cut(TomlTableReader& table) {
  SceneCut cut;
  table.require("name");
  table.read_name("name", cut.name);
  read_blocks_or_inside(table, cut.blocks, cut.inside);
  if (table.given("blocks") && cut.blocks.empty())
    table.error_at_value("blocks", "blocks is empty ([]), at least one name or glob is needed");
  const bool solid = table.given("solid"), voronoi = table.given("voronoi"), discs = table.given("file");
  read_planes(table, cut, !solid && !voronoi && !discs);
  if (discs) {
    read_discs(table, cut);
    refuse_plane_keys(table, "file");
    for (const char* key : {"solid", "voronoi"})
      if (table.given(key))
        table.error_at_key(key, fmt::format("{} beside file (both given), only one of both is allowed", key));
  }
  if (solid) {
    cut.kind = SceneCut::Kind::solid;
    if (auto shape = table.table("solid")) cut.solid = read_shape(*shape, "solid", MeshKeys::as_it_is);
    refuse_plane_keys(table, "solid");
  }
  table.read_integer("seed", cut.seed, 0, largest_integer);
  if (voronoi) {
    cut.kind = SceneCut::Kind::voronoi;
    TomlTableReader cells = table.table_or_empty("voronoi");
    cells.require("count");
    cells.read_integer("count", cut.count, 1, largest_integer);
    cells.read_integer("seed", cut.seed, 0, largest_integer);
    refuse_plane_keys(table, "voronoi");
    if (solid) table.error_at_key("voronoi", "voronoi beside solid (both given); give one of both");
  }
  table.read_number("min_volume", cut.min_volume, range::not_negative);
  table.read_bool("glued", cut.glued);
  read_bond(table, cut);
  table.read_integer("most_blocks", cut.most_blocks, 1, largest_integer);
  return cut;
}

}  // namespace ashlar
