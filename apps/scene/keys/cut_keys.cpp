// [[cut]].
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/shape_keys.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar::keys {
namespace {

using Cut = SceneCut;
using Bond = SceneBond;

constexpr int largest_integer = std::numeric_limits<int>::max();

bool of_planes(const Cut& cut) {
  return cut.kind == Cut::Kind::planes;
}
bool of_discs(const Cut& cut) {
  return cut.kind == Cut::Kind::discs;
}
bool of_solid(const Cut& cut) {
  return cut.kind == Cut::Kind::solid;
}
bool of_voronoi(const Cut& cut) {
  return cut.kind == Cut::Kind::voronoi;
}
bool not_of_voronoi(const Cut& cut) {
  return !of_voronoi(cut);
}

/// Standard deviation of a spacing relative to its mean: beyond it nearly all planes coincide within rounding error.
constexpr double most_deviation = 100.0;

bool check_exponential(TomlTableReader& table, Cut& cut) {
  const bool good = !table.given("deviation") || cut.deviation == *cut.spacing;
  if (!good)
    table.error_at_value("deviation",
                         fmt::format("deviation of exponential spacings is not their mean ({}), {} is "
                                     "needed; it may be left out",
                                     cut.deviation, *cut.spacing));
  cut.deviation = *cut.spacing;
  return good;
}

bool check_deviation(TomlTableReader& table, Cut& cut) {
  if (!cut.spacing) return true;
  if (cut.law == Cut::Spacing::exponential) return check_exponential(table, cut);
  const double mean = *cut.spacing;
  bool good = true;
  if (cut.deviation > most_deviation * mean) {
    table.error_at_value("deviation", fmt::format("deviation is out of range ({}), at most {} times the mean "
                                                  "({}) is needed",
                                                  cut.deviation, most_deviation, most_deviation * mean));
    good = false;
  }
  const double most = mean / std::sqrt(3.0);
  if (cut.law == Cut::Spacing::uniform && cut.deviation >= most) {
    table.error_at_value(
        "deviation", fmt::format("deviation lets spacings be zero or less ({}), less than mean / sqrt(3) = "
                                 "{:.6g} is needed",
                                 cut.deviation, most));
    good = false;
  }
  return good;
}

const Keys<Cut> spacing_table(
    "",
    {number("mean", &Cut::spacing, range::positive_length, "m", "without `spacing` the set is one plane")
         .required_always(),
     number("deviation", &Cut::deviation, range::not_negative, "m",
            "standard deviation, at most 100 times the mean; of exponential spacings it is the mean"),
     choice("distribution", &Cut::law, spacing_names,
            "normal: draws of zero and less are drawn again; uniform: the deviation is less than mean / "
            "sqrt(3)")},
    {check_deviation});

const Own<Cut> spacing = {range::positive_length.words,
                          [] {
                            return schema_of_any({spacing_table.table().schema(),
                                                  schema_of_number(range::positive_length, "number")});
                          },
                          [](TomlTableReader& table, const std::string& key, Cut& cut) {
                            return table.table_at(key) != nullptr
                                       ? spacing_table.read_table(table, key.c_str(), cut)
                                       : table.read_number(key, cut.spacing, range::positive_length);
                          },
                          [](const Cut& cut) { return cut.spacing ? spacing_table.json(cut) : Json(); },
                          []() -> const TableKeys& { return spacing_table.table(); }};

constexpr NumberRange radius_range = {0.0, largest_coordinate, false, true,
                                      "a number > 0 and <= 1e150, or inf"};

const Own<Cut> radius = {radius_range.words, [] { return schema_of_number(radius_range, "number"); },
                         [](TomlTableReader& table, const std::string& key, Cut& cut) {
                           return table.holds_infinity(key) ||
                                  table.read_number(key, cut.radius, radius_range);
                         },
                         [](const Cut& cut) { return cut.radius ? Json(*cut.radius) : Json(); }};

const Own<Cut> number_of_planes = {
    whole_number_words(0, largest_integer),
    [] {
      return schema_of_number({0.0, largest_integer, true, true, ""}, "integer");
    },
    [](TomlTableReader& table, const std::string& key, Cut& cut) {
      return table.holds_infinity(key) || table.read_integer(key, cut.number, 0, largest_integer);
    },
    [](const Cut& cut) { return cut.number ? Json(*cut.number) : Json(); }};

std::vector<Key<Cut>> keys_of_planes() {
  std::vector<Key<Cut>> keys = {
      number("dip", &Cut::dip, range::zero_to_90, "", "below the horizontal, which is z = 0")
          .required_unless_given({"file", "solid", "voronoi"}),
      number("dip_direction", &Cut::dip_direction, range::any_number, "",
             "degrees from north, which is y, towards east, which is x. Directions of 90 degrees and their "
             "multiples are exact")
          .required_unless_given({"file", "solid", "voronoi"}),
      place("point", &Cut::point, "plane 0 of the set goes through it, positive numbers are above"),
      own("spacing", spacing, "", ""),
      number(
          "fisher", &Cut::fisher, range::not_negative, "",
          "k of Fisher's scatter of orientation, each plane about its point above or below `point`; 0: none"),
      number("persistence", &Cut::persistence, range::zero_to_one, "",
             "chance that a plane cuts a block that it parts, drawn for each"),
      own("radius", radius, "m",
          "planes are discs about their points above or below `point`, and cut the blocks that the disc "
          "meets, as a whole; `ashlar blocks` has the number of pieces in which a disc ends")
          .otherwise("`inf`"),
      own("number", number_of_planes, "", "planes to each side of plane 0").otherwise("`inf`")};
  for (Key<Cut>& key : keys)
    key = std::move(key).not_beside({"file", "solid", "voronoi"}).written_if(of_planes);
  return keys;
}

bool check_solid_of_cut(TomlTableReader& table, Cut& cut) {
  const bool good = check_one_of(table, "shape", {"box", "mesh", "hull", "sphere"});
  if (!good) cut.solid = {};
  return good;
}

const Keys<Cut> solid_of_cut_table("",
                                   {alternative<box_keys, SceneBox>("box", &Cut::solid, ""),
                                    alternative<solid_mesh_keys, SceneMesh>("mesh", &Cut::solid, ""),
                                    alternative<hull_keys, SceneHull>("hull", &Cut::solid, ""),
                                    alternative<sphere_keys, SceneSphere>("sphere", &Cut::solid, "")},
                                   {check_solid_of_cut});

const Keys<Cut>& solid_of_cut_keys() {
  return solid_of_cut_table;
}

const Keys<Cut> voronoi_table("",
                              {whole("count", &Cut::count, 1, largest_integer, "",
                                     "instead of planes: points in each block, evenly spread; the block is "
                                     "convex, and no cut came before")
                                   .required_always(),
                               whole("seed", &Cut::seed, 0, largest_integer, "", "").otherwise("as `seed`")});

const Keys<Cut>& voronoi_keys() {
  return voronoi_table;
}

bool read_energy_of_bond(TomlTableReader& table, const std::string& key, Bond& bond) {
  FractureEnergy energy;
  if (!read_both_energies(table, key, energy)) return false;
  bond.fracture_energy = energy;
  return true;
}

const Own<Bond> energy_of_bond = {
    "a number > 0 or { tension, shear }",
    [] {
      return schema_of_any(
          {both_energies_keys().table().schema(), schema_of_number(range::positive, "number")});
    },
    read_energy_of_bond,
    [](const Bond& bond) {
      return bond.fracture_energy ? fracture_energy_keys().json(*bond.fracture_energy) : Json();
    },
    []() -> const TableKeys& { return both_energies_keys().table(); }};

const Keys<Bond> bond_table(
    "", {number("tensile_strength", &Bond::tensile_strength, range::positive, "Pa",
                "without `bonded` faces have the joint of any blocks. Blocks on both sides are one stone up "
                "to this strength, with springs of a tie ([how to](../howto/bonded-blocks.md), "
                "[compliance](../../notes/bonded_blocks.md)): as by `[[joint]] tied = { tension, shear }` "
                "for all pairs with a common face that the cut made, before all `[[joint]]`s, which override "
                "it key by key. `tied` or `glued` for these pairs, and a cut that makes no face, are errors. "
                "Of `[contact]` it has friction, `restitution` and `compressive_strength` alone")
             .required_always(),
         number("cohesion", &Bond::cohesion, range::positive, "Pa", "").required_always(),
         number("friction_angle", &Bond::friction_angle, range::zero_to_below_90, "",
                "beside `cohesion`, and alone once the bond has failed")
             .otherwise("as `[contact]`"),
         own("fracture_energy", energy_of_bond, "", "")});

const Keys<Bond>& bond_keys() {
  return bond_table;
}

std::vector<Key<Cut>> keys_of_rock() {
  return {
      name("name", &Cut::name, "not empty, one line, each its own; `[[joint]] cut` names it")
          .required_always(),
      blocks(&Cut::blocks,
             "names or globs; a block's name means all of its pieces. With `inside` they may be left out"),
      inside(&Cut::inside, "only pieces whose centroid is inside before the cut, as in `[[assign]]`")
          .described_elsewhere()};
}

std::vector<Key<Cut>> keys_of_pieces() {
  return {
      name("file", &Cut::file,
           "instead of planes: a table with the columns `x`, `y`, `z` (m), `dip`, `dip_direction` (degrees) "
           "and, if they are finite, `radius` (m; empty or `inf`: infinite), a joint in each line. A joint "
           "cuts the pieces that its disc meets, as a whole: one that ends inside a piece is extended to its "
           "faces; a warning has the number of such pieces. `check` reads it")
          .written_if(of_discs),
      part<solid_of_cut_keys, Cut>("solid", "").not_beside({"file"}).written_if(of_solid),
      part<voronoi_keys, Cut>("voronoi", "").not_beside({"file", "solid"}).written_if(of_voronoi),
      whole("seed", &Cut::seed, 0, largest_integer, "",
            "of the random numbers; the same planes on every machine")
          .written_if(not_of_voronoi),
      number("min_volume", &Cut::min_volume, range::not_negative, "m^3",
             "smaller pieces are glued to the neighbour that they share most area with, the smallest first"),
      flag("glued", &Cut::glued, "blocks on both sides are tied, as by `[[joint]] tied`"),
      table<bond_keys>("bonded", &Cut::bonded, ""),
      whole("most_blocks", &Cut::most_blocks, 1, largest_integer, "",
            "a cut that would leave more blocks in the scene is refused before it is made, and one of more "
            "planes than this (than 100,000 if this is less, than 10,000,000 if it is more), also where few "
            "of them cut")};
}

bool check_cut(TomlTableReader& table, Cut& cut) {
  bool good = true;
  const auto refuse = [&](const char* key, const std::string& message) {
    table.error_at_value(key, message);
    good = false;
  };
  for (const auto& [key, kind] : {std::pair("file", Cut::Kind::discs), std::pair("solid", Cut::Kind::solid),
                                  std::pair("voronoi", Cut::Kind::voronoi)})
    if (table.given(key)) cut.kind = kind;
  if (table.given("blocks") && cut.blocks.empty())
    refuse("blocks", "blocks is empty ([]), at least one name or glob is needed");
  if (of_planes(cut) && !table.given("spacing") && cut.number.value_or(0) != 0)
    refuse("number",
           fmt::format("number of planes without their spacing ({}), a spacing is needed", *cut.number));
  if (cut.glued && table.given("bonded")) good = refuse_beside(table, "bonded", "glued");
  return good;
}

const Keys<Cut> cut_table("Cuts blocks by planes, along a solid or into cells",
                          joined(joined(keys_of_rock(), keys_of_planes()), keys_of_pieces()),
                          {all_inside<Cut>, check_cut});

}  // namespace

const Keys<SceneCut>& cut_keys() {
  return cut_table;
}

}  // namespace ashlar::keys
