#include "solver/step/ghost_models.hpp"

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/ranks/block_share.hpp"
#include "solver/step/agreement.hpp"
#include "solver/step/quiet_release.hpp"

namespace ashlar {

void update_ghost_models(BlockSystem& system, RunState& state, StepCaches& caches) {
  if (!any_of_run(system, !system.quiet().empty())) return;
  const BlockShare& share = *system.share();
  BlockPartsLibrary library;
  share.exchange(
      [&](ByteWriter& writer, int rank) {
        for (const int block : share.lent_to(rank))
          if (const BlockModel& model = system.blocks()[at(block)]; model.quiet())
            writer(block, released_reaction(model));
      },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          int block = -1;
          Eigen::MatrixX3d reaction;
          reader(block, reaction);
          set_reaction_of(system, state, caches, block, reaction, library);
        }
      });
}

}  // namespace ashlar
