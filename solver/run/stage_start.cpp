#include "solver/run/stage_start.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "geometry/index.hpp"
#include "solver/statics/static_start.hpp"
#include "solver/step/accepted_bolts.hpp"
#include "solver/step/quiet_release.hpp"

namespace ashlar {
namespace {

/// True if the snapshot fits blocks with these numbers of functions.
bool fits(const BlockSystem& system, const RunState& state, const SimulationSnapshot& end,
          const std::vector<bool>& was_absent) {
  const std::vector<BlockState>& states = end.run.states;
  if (end.run.bolts.size() != state.bolts.size()) return false;
  bool same = states.size() == system.blocks().size() && was_absent.size() == states.size();
  for (int k = 0; same && k < system.count(); ++k)
    same = states[at(k)].position.rows() == state.states[at(k)].position.rows() &&
           end.carried.contains(k) == (system.blocks()[at(k)].incremental() != nullptr);
  return same;
}

/// Ties of added blocks to others are relative to the placed blocks.
void refuse_strained_ties(const BlockSystem& system, const RunState& state,
                          const std::vector<bool>& was_absent) {
  // Of the search distance: a tie of this gap has hardly any stress.
  constexpr double allowed = 1e-3;
  const std::vector<BlockModel>& blocks = system.blocks();
  for (const TiedBlocks& tied : system.ties()) {
    if (was_absent[at(tied.a)] == was_absent[at(tied.b)] || !system.present(tied.a) ||
        !system.present(tied.b))
      continue;
    const Eigen::MatrixX3d gap =
        tied.tie->a * state.states[at(tied.a)].position - tied.tie->b * state.states[at(tied.b)].position;
    const double mean = gap.norm() / std::sqrt(tied.tie->area);
    if (!(mean > allowed * system.settings().contact_distance)) continue;
    const auto [added, other] =
        was_absent[at(tied.a)] ? std::array{tied.a, tied.b} : std::array{tied.b, tied.a};
    throw std::invalid_argument(
        "block " + blocks[at(added)].name() + " is added with a tie to block " + blocks[at(other)].name() +
        ", which has moved (by " + std::to_string(mean) +
        " m at their common face); a tie begins without a gap: add both in one stage, or "
        "join them without `tied`");
  }
}

}  // namespace

void start_stage(BlockSystem& system, RunState& state, StepCaches& caches, const SimulationSnapshot& end,
                 const std::vector<bool>& was_absent) {
  if (!fits(system, state, end, was_absent)) throw std::invalid_argument("the stage before has other blocks");
  const auto stays = [&](int block) { return system.present(block) && !was_absent[at(block)]; };
  for (int k = 0; k < system.count(); ++k) {
    if (!stays(k)) continue;
    state.states[at(k)] = end.run.states[at(k)];
    if (system.blocks()[at(k)].fixed() || system.blocks()[at(k)].incremental() == nullptr) continue;
    system.carry_on(k, system.blocks()[at(k)].with_shape(end.carried.at(k)));
    caches.contacts.finder().start_step(k);
  }
  std::map<int, Eigen::MatrixX3d> reactions = end.reactions;
  std::erase_if(reactions, [&](const auto& one) { return !stays(one.first); });
  set_reactions(system, state, caches, reactions);
  for (const auto& [place, factor] : end.load_factors)
    if (at(place[1]) < system.blocks()[at(place[0])].loads().size())
      system.set_load_factor(place[0], place[1], factor);
  // Pairs with an added block keep their initial history.
  std::erase_if(state.pairs, [&](const auto& pair) { return stays(pair.first[0]) && stays(pair.first[1]); });
  for (const auto& [blocks, pair] : end.run.pairs) {
    if (!stays(blocks[0]) || !stays(blocks[1])) continue;
    PairHistory& kept = state.pairs.emplace(blocks, pair).first->second;
    // It counts paths of blocks, which start at zero again.
    kept.clearance.reset();
    kept.cache.reset();
    kept.work = 0.0;
  }
  refuse_strained_ties(system, state, was_absent);
  state.records.clear();
  double in_springs = 0.0;
  for (PairRecord record : end.run.records) {
    if (!stays(record.a) || !stays(record.b)) continue;
    record.work = 0.0;
    for (const PointResponse& response : record.responses) in_springs += response.energy();
    state.records.push_back(std::move(record));
  }
  // Bolts of this stage are installed where the blocks are now.
  state.bolts = end.run.bolts;
  commit_bolts(state);
  in_springs += install_bolts(system, state) + energy_of_ties(system, state, caches.contacts);
  state.steps = end.run.steps;
  state.remembers_statics = true;
  state.report = end.run.report;
  state.extremes = end.run.extremes;
  state.log = end.run.log;
  state.ledger.clear(in_springs);
  state.ledger.start(system, state.states);
}

}  // namespace ashlar
