#include "solver/run/stage_start.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/shared/ghosts.hpp"
#include "solver/shared/shared_snapshot.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/static_start.hpp"
#include "solver/step/accept/accepted_bolts.hpp"
#include "solver/step/accept/quiet_release.hpp"

namespace ashlar {
namespace {

/// Gap of a tie of an added block, of the search distance: larger ones are refused, as the tie would begin with stress.
constexpr double allowed_tie_gap = 1e-3;

/// True if the snapshot fits the blocks of this process: it has states with these numbers of functions.
bool fits(const BlockSystem& system, const RunState& state, const SimulationSnapshot& end,
          const std::vector<bool>& was_absent) {
  const std::vector<BlockState>& states = end.run.states;
  if (end.run.bolts.size() != state.bolts.size()) return false;
  bool same = states.size() == system.blocks().size() && was_absent.size() == states.size();
  for (int k = 0; same && k < system.count(); ++k) {
    if (!system.exchange().alone() && !system.here(k)) continue;
    same = states[at(k)].position.rows() == state.states[at(k)].position.rows() &&
           end.carried.contains(k) == (system.blocks()[at(k)].incremental() != nullptr);
  }
  return same;
}

/// A tie of an added block to one that has moved.
struct StrainedTie {
  PairKey blocks = {-1, -1};
  std::string fault;  ///< empty: there is none
};

/// The first one of this process. Ties of added blocks to others are relative to the placed blocks.
StrainedTie strained_tie(const BlockSystem& system, const RunState& state,
                         const std::vector<bool>& was_absent) {
  const std::vector<BlockModel>& blocks = system.blocks();
  for (const TiedBlocks& tied : system.ties()) {
    if (was_absent[at(tied.a)] == was_absent[at(tied.b)] || !system.present(tied.a) ||
        !system.present(tied.b))
      continue;
    const Eigen::MatrixX3d gap =
        tied.tie->a * state.states[at(tied.a)].position - tied.tie->b * state.states[at(tied.b)].position;
    const double mean = gap.norm() / std::sqrt(tied.tie->area);
    if (!(mean > allowed_tie_gap * system.settings().contact_distance)) continue;
    const auto [added, other] =
        was_absent[at(tied.a)] ? std::array{tied.a, tied.b} : std::array{tied.b, tied.a};
    return {{tied.a, tied.b},
            "block " + blocks[at(added)].name() + " is added with a tie to block " +
                blocks[at(other)].name() + ", which has moved (by " + std::to_string(mean) +
                " m at their common face); a tie begins without a gap: add both in one stage, or "
                "join them without `tied`"};
  }
  return {};
}

/// With several processes collective.
void refuse_strained_ties(const BlockSystem& system, const RunState& state,
                          const std::vector<bool>& was_absent) {
  StrainedTie first = strained_tie(system, state, was_absent);
  if (!system.exchange().alone())
    for (StrainedTie& tie : values_of_run(system, first))
      if (first.fault.empty() || (!tie.fault.empty() && tie.blocks < first.blocks)) first = std::move(tie);
  if (!first.fault.empty()) throw std::invalid_argument(first.fault);
}

/// The start of a stage, seen from one process.
class StageStart {
 public:
  StageStart(const RunContext& run, const SimulationSnapshot& end, const std::vector<bool>& was_absent)
      : run_(run), system_(run.system), state_(run.state), end_(end), was_absent_(was_absent) {}

  /// Not collective.
  void take_blocks();
  /// With several processes collective.
  void take_contacts();

 private:
  [[nodiscard]] bool stays(int block) const { return system_.present(block) && !was_absent_[at(block)]; }
  [[nodiscard]] bool stay(int a, int b) const { return stays(a) && stays(b); }
  void take_history(const PairKey& blocks, PairHistory history);
  [[nodiscard]] double take_records();

  const RunContext& run_;
  BlockSystem& system_;
  RunState& state_;
  const SimulationSnapshot& end_;
  const std::vector<bool>& was_absent_;
};

void StageStart::take_blocks() {
  if (!fits(system_, state_, end_, was_absent_))
    throw std::invalid_argument("the stage before has other blocks");
  for (int k = 0; k < system_.count(); ++k) {
    if (!stays(k) || !system_.here(k)) continue;
    state_.states[at(k)] = end_.run.states[at(k)];
    if (system_.blocks()[at(k)].fixed() || system_.blocks()[at(k)].incremental() == nullptr) continue;
    system_.carry_on(k, system_.blocks()[at(k)].with_shape(end_.carried.at(k)));
    run_.caches.contacts.finder().start_step(k);
  }
  std::map<int, Eigen::MatrixX3d> reactions = end_.reactions;
  std::erase_if(reactions, [this](const auto& one) { return !stays(one.first); });
  set_reactions(system_, state_, run_.caches, reactions);
  for (const auto& [place, factor] : end_.load_factors)
    if (at(place[1]) < system_.blocks()[at(place[0])].loads().size())
      system_.set_load_factor(place[0], place[1], factor);
}

void StageStart::take_contacts() {
  // Pairs with an added block keep their initial history.
  std::erase_if(state_.pairs, [this](const auto& pair) { return stay(pair.first[0], pair.first[1]); });
  const auto take = [this](const PairKey& blocks, PairHistory history) {
    if (stay(blocks[0], blocks[1])) take_history(blocks, std::move(history));
  };
  if (system_.exchange().alone()) {
    for (const auto& [blocks, history] : end_.run.pairs) take(blocks, history);
  } else {
    // Dilation lets joints reach farther, and so determines neighbours.
    take_histories(system_, end_.run.pairs, take);
    system_.exchange().find_neighbours(run_, 0.0);
    take_histories(system_, end_.run.pairs, take);
    system_.exchange().tell_contacts(system_, state_);
  }
  refuse_strained_ties(system_, state_, was_absent_);
  double in_springs = take_records();
  // Bolts of this stage are installed where the blocks are now.
  state_.bolts = end_.run.bolts;
  commit_bolts(state_);
  in_springs += install_bolts(system_, state_) + energy_of_ties(system_, state_, run_.caches.contacts);
  state_.ledger.clear(in_springs);
}

void StageStart::take_history(const PairKey& blocks, PairHistory history) {
  // It counts paths of blocks, which start at zero again.
  history.clearance.reset();
  history.cache.reset();
  history.work = 0.0;
  state_.pairs[blocks] = std::move(history);
}

/// @return energy of their springs, J, of own pairs
double StageStart::take_records() {
  state_.records.clear();
  double in_springs = 0.0;
  for (PairRecord record : end_.run.records) {
    if (!stay(record.a, record.b) || !system_.here(record.a) || !system_.here(record.b)) continue;
    record.work = 0.0;
    if (system_.owns_pair(record.a, record.b))
      for (const PointResponse& response : record.responses) in_springs += response.energy();
    state_.records.push_back(std::move(record));
  }
  return in_springs;
}

}  // namespace

void start_stage(const RunContext& run, const SimulationSnapshot& end, const std::vector<bool>& was_absent) {
  RunState& state = run.state;
  StageStart stage(run, end, was_absent);
  run.system.exchange().on_all([&stage] { stage.take_blocks(); });
  stage.take_contacts();
  state.steps = end.run.steps;
  state.remembers_statics = true;
  state.report = end.run.report;
  state.extremes = end.run.extremes;
  state.log = end.run.log;
  state.ledger.start(run.system, state.states);
}

}  // namespace ashlar
