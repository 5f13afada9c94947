#include "apps/scene/read/initial_stress_reader.hpp"

#include <fmt/format.h>

namespace ashlar {

SceneInitialStress read_initial_stress(TomlTableReader& table, bool given) {
  SceneInitialStress initial;
  const bool stress = table.given("stress"), k0 = table.given("k0");
  if (given && stress == k0)
    table.error_at_table(stress ? "initial_stress has two sizes (stress, k0), exactly one of both is needed"
                                : "initial_stress has no size (stress, k0), exactly one of both is needed");
  table.read_field("stress", initial.stress, 6, "[sxx, syy, szz, sxy, syz, szx]");
  table.read_number("k0", initial.k0, range::not_negative);
  table.read_number("surface", initial.surface, range::any_number);
  table.read_number("unit_weight", initial.unit_weight, range::positive);
  table.read_texts("blocks", initial.blocks);
  for (const char* key : {"surface", "unit_weight"})
    if (stress && table.given(key))
      table.error_at_key(key, fmt::format("{} beside stress (both given), it belongs to k0", key));
  return initial;
}

}  // namespace ashlar
