#include "apps/program/new/starting_scenes.hpp"

#include <array>

#include "apps/program/embedded_file.hpp"

ASHLAR_EMBED(ashlar_new_arch, ASHLAR_NEW_ARCH)
ASHLAR_EMBED(ashlar_new_slope, ASHLAR_NEW_SLOPE)
ASHLAR_EMBED(ashlar_new_tunnel, ASHLAR_NEW_TUNNEL)
ASHLAR_EMBED(ashlar_new_wall, ASHLAR_NEW_WALL)

namespace ashlar {

std::span<const StartingScene> starting_scenes() {
  static const std::array<StartingScene, 4> scenes = {{{"arch", ASHLAR_EMBEDDED(ashlar_new_arch)},
                                                       {"slope", ASHLAR_EMBEDDED(ashlar_new_slope)},
                                                       {"tunnel", ASHLAR_EMBEDDED(ashlar_new_tunnel)},
                                                       {"wall", ASHLAR_EMBEDDED(ashlar_new_wall)}}};
  return scenes;
}

}  // namespace ashlar
