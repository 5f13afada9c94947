#include "solver/shared/shared_step.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"
#include "solver/shared/ghost_models.hpp"
#include "solver/shared/known_contacts.hpp"
#include "solver/shared/rank_balance.hpp"
#include "solver/shared/shared_island.hpp"
#include "solver/shared/shared_snapshot.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

SharedStep::SharedStep(SharedBlocks& shared)
    : shared_(shared), placed_{shared.share->places(), shared.share->axes()} {}

void SharedStep::before_step(const RunContext& run, double step) {
  if (step > 0.0) balance_ranks(shared_, run.system, run.state, run.caches);
  find_ghosts_for(shared_, run.system, run.state, run.caches, step);
}

void SharedStep::agree_on_kept(const BlockSystem& system, const std::vector<NearPair>& near,
                               std::vector<std::shared_ptr<const KeptContacts>>& kept) const {
  drop_unknown_elsewhere(system, near, kept);
}

void SharedStep::add_recipes_of_others(const BlockSystem& system, const RunState& state,
                                       const std::function<JointLaw(const PairKey&)>& law_of,
                                       std::vector<PairRecipe>& recipes) {
  for (PairRecipe& recipe : shared_.border.exchange(system, state, recipes, law_of))
    recipes.push_back(std::move(recipe));
  std::sort(recipes.begin(), recipes.end(),
            [](const PairRecipe& x, const PairRecipe& y) { return x.blocks < y.blocks; });
}

int SharedStep::join_islands(const BlockSystem& system, std::vector<Island>& islands) const {
  return join_shared_islands(system, islands);
}

std::map<int, int> SharedStep::first_blocks(const BlockSystem& system, const Island& joined,
                                            const std::vector<ContactPair>& pairs) const {
  return ashlar::first_blocks(system, joined, pairs);
}

std::unique_ptr<JoinedSystem> SharedStep::joined_system(const BlockSystem& system, const Island& joined,
                                                        const std::vector<BodyStep>& bodies,
                                                        const std::vector<ContactPair>& pairs,
                                                        SharedFactor* kept) const {
  return std::make_unique<SharedIslandSystem>(system, joined, bodies, pairs, kept);
}

void SharedStep::tell_neighbours(const std::function<void(ByteWriter&, int)>& write,
                                 const std::function<void(ByteReader&, int)>& read) const {
  share().exchange(
      [&](ByteWriter& writer, int rank) {
        for (const int block : share().lent_to(rank)) {
          ByteWriter of_block;
          write(of_block, block);
          if (const std::string value = of_block.take(); !value.empty()) writer(block, value);
        }
      },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          int block = -1;
          std::string value;
          reader(block, value);
          ByteReader of_block(value);
          read(of_block, block);
        }
      });
}

void SharedStep::tell_contacts(const BlockSystem& system, RunState& state) const {
  update_ghost_contacts(system, state);
}

double SharedStep::travel_beyond(const BlockSystem& system, const ContactFinder& finder,
                                 const std::function<Eigen::MatrixX3d(int)>& motion) const {
  const double most = max_of_ranks(share().ranks(), farthest_path(shared_, system, finder, motion));
  return most > shared_.margin ? most : 0.0;
}

void SharedStep::find_neighbours(const RunContext& run, double travel) {
  find_ghosts_within(shared_, run.system, run.state, run.caches, travel);
}

void SharedStep::tell_models(BlockSystem& system, RunState& state, StepCaches& caches) const {
  update_ghost_models(system, state, caches);
}

void SharedStep::restore_neighbours(const RunContext& run, const std::any& neighbours) {
  restore_ghosts(shared_, run.system, run.state, run.caches, std::any_cast<const GhostsThen&>(neighbours));
}

void SharedStep::restore_start(const RunContext& run, const SimulationSnapshot& start) {
  restore_own(shared_, run.system, run.state, run.caches, start);
}

SharedBlocks* shared_blocks_of(const BlockSystem& system) {
  const auto* step = dynamic_cast<const SharedStep*>(&system.exchange());
  return step == nullptr ? nullptr : &step->blocks();
}

BlockShare& share_of(const BlockSystem& system) {
  return dynamic_cast<const SharedStep&>(system.exchange()).share();
}

}  // namespace ashlar
