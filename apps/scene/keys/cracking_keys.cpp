// [[crack]].
#include <limits>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/shape_keys.hpp"

namespace ashlar::keys {
namespace {

using Cracking = SceneCracking;

const Own<Cracking> energy_of_cracking = {
    "a number > 0 or { tension, shear }",
    [] {
      return schema_of_any(
          {both_energies_keys().table().schema(), schema_of_number(range::positive, "number")});
    },
    [](TomlTableReader& table, const std::string& key, Cracking& crack) {
      return read_both_energies(table, key, crack.fracture_energy);
    },
    [](const Cracking& crack) { return both_energies_keys().json(crack.fracture_energy); },
    []() -> const TableKeys& { return both_energies_keys().table(); }};

bool check_cracking(TomlTableReader& table, Cracking& crack) {
  if (!table.given("blocks") || !crack.blocks.empty()) return true;
  table.error_at_value("blocks", "blocks is empty ([]), at least one name or glob is needed");
  return false;
}

const Keys<Cracking> cracking_table(
    "Blocks that crack where their tension reaches a strength",
    {names("blocks", &Cracking::blocks,
           "names or globs of moving blocks of order 1 or more, neither tied nor bolted, or of the blocks "
           "that they "
           "are cut from; the last entry that matches a block has priority")
         .required_always(),
     number("tensile_strength", &Cracking::tensile_strength, range::positive, "Pa", "").required_always(),
     own("fracture_energy", energy_of_cracking, "",
         "of the new faces, as in `[contact]`; `fracture_energy = 50` is 50 for both")
         .required_always(),
     number("friction_angle", &Cracking::friction_angle, range::zero_to_below_90, "", "of the new faces"),
     number("cohesion", &Cracking::cohesion, range::positive, "Pa",
            "of the new faces until they have softened")
         .required_always(),
     number("least_size", &Cracking::least_size, range::positive_length, "m",
            "diameter of the ball over which tension is averaged, and least width of both parts across a "
            "crack; at "
            "most half of the length of a block")
         .required_always(),
     whole("most_blocks", &Cracking::most_blocks, 1, std::numeric_limits<int>::max(), "",
           "of all blocks of the run; a crack beyond it ends the run")},
    {check_cracking});

}  // namespace

const Keys<SceneCracking>& cracking_keys() {
  return cracking_table;
}

}  // namespace ashlar::keys
