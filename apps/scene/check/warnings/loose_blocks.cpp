#include "apps/scene/check/warnings/loose_blocks.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "mechanics/block/rigid_motions.hpp"

namespace ashlar {

void refuse_loose_blocks(const Scene& scene, Simulation& simulation, Diagnostics& diagnostics) {
  for (const std::vector<int>& blocks : simulation.loose_blocks()) {
    const BlockModel& first = simulation.blocks()[static_cast<std::size_t>(blocks.front())];
    const std::string what =
        blocks.size() == 1
            ? fmt::format("block {} has no contact and its supports leave a rigid motion ({})", first.name(),
                          describe(admissible_rigid_motions(first), first))
            : fmt::format("block {} and {} more touch each other without a support (any rigid motion)",
                          first.name(), blocks.size() - 1);
    diagnostics.error(scene.places.key(fmt::format("block.{}", blocks.front())),
                      what + ", a static analysis needs a support or a contact with a supported block");
  }
}

}  // namespace ashlar
