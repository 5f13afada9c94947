#include "solver/shared/ghost_models.hpp"

#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/ranks/block_share.hpp"
#include "solver/shared/shared_step.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/accept/quiet_release.hpp"

namespace ashlar {
namespace {

bool may_change(const BlockModel& block) {
  return block.quiet() || block.incremental() != nullptr;
}

void take_shape(BlockSystem& system, int block, CarriedShape shape) {
  system.carry_on(block, system.blocks()[at(block)].with_shape(std::move(shape)));
}

}  // namespace

ModelChange change_of(const BlockModel& block) {
  return {released_reaction(block), block.incremental() != nullptr ? block.carried() : CarriedShape()};
}

void apply_change(BlockSystem& system, RunState& state, StepCaches& caches, int block, ModelChange change,
                  BlockPartsLibrary& library) {
  const BlockModel& model = system.blocks()[at(block)];
  if (model.quiet()) set_reaction_of(system, state, caches, block, change.reaction, library);
  if (model.incremental() == nullptr) return;
  take_shape(system, block, std::move(change.shape));
  caches.contacts.finder().start_step(block);
  caches.audit.forget(block);
}

void update_ghost_models(BlockSystem& system, RunState& state, StepCaches& caches) {
  if (!any_of_run(system, !system.quiet().empty() || system.any_incremental())) return;
  const BlockShare& share = share_of(system);
  BlockPartsLibrary library;
  share.exchange(
      [&](ByteWriter& writer, int rank) {
        for (const int block : share.lent_to(rank))
          if (const BlockModel& model = system.blocks()[at(block)]; may_change(model))
            writer(block, change_of(model));
      },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          int block = -1;
          ModelChange change;
          reader(block, change);
          apply_change(system, state, caches, block, std::move(change), library);
        }
      });
}

void send_shapes_to_first(BlockSystem& system, const std::vector<int>* blocks) {
  if (!any_of_run(system, system.any_incremental())) return;
  const BlockShare& share = share_of(system);
  send_to_first(
      share.ranks(),
      [&](ByteWriter& writer) {
        for (const int block : blocks == nullptr ? share.own() : *blocks)
          if (share.owns(block) && system.blocks()[at(block)].incremental() != nullptr)
            writer(block, system.blocks()[at(block)].carried());
      },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          int block = -1;
          CarriedShape shape;
          reader(block, shape);
          // Ghosts have it already.
          if (!system.here(block) && system.blocks()[at(block)].incremental() != nullptr)
            take_shape(system, block, std::move(shape));
        }
      });
}

}  // namespace ashlar
