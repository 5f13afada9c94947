// [[crack]]: blocks that crack (scene.hpp).
#pragma once

#include <string>
#include <vector>

#include "mechanics/contact/laws/bond_damage.hpp"

namespace ashlar {

/// Blocks that are divided where their mean tension over least_size reaches the strength. The last entry that matches a
/// block has priority.
struct SceneCracking {
  std::vector<std::string> blocks;  ///< names or globs, each matches a block or its pieces; required
  double tensile_strength = 0.0;    ///< Pa, > 0; required
  FractureEnergy fracture_energy;   ///< J/m^2, both > 0; required
  double friction_angle = 0.0;      ///< deg, of the new faces, 0 to less than 90
  double cohesion = 0.0;            ///< Pa, > 0; required
  double least_size = 0.0;          ///< m, > 0; required
  int most_blocks = 1000;           ///< >= 1, of all blocks of the run
};

}  // namespace ashlar
