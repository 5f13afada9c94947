#include "solver/fracture/divided_run.hpp"

#include <limits>
#include <map>
#include <utility>

#include "geometry/index.hpp"
#include "solver/statics/static_verdict.hpp"

namespace ashlar {
namespace {

std::vector<TieRequest> ties_of(const BlockSystem& system) {
  std::map<PairKey, double> stiffness;
  for (const PairKey& pair : system.left_out()) stiffness[pair] = 1.0;  // without a common face
  for (const TiedBlocks& tie : system.ties()) stiffness[{tie.a, tie.b}] = tie.stiffness;
  std::vector<TieRequest> ties;
  for (const auto& [pair, of_tie] : stiffness) ties.push_back({pair[0], pair[1], of_tie});
  return ties;
}

/// Moves the states of a run from one block to its parts.
class StateDivision {
 public:
  StateDivision(const Simulation& run, const PartNumbers& divided, const std::vector<BlockPart>& parts)
      : whole_(run.blocks()[at(divided.block)]),
        state_(run.states()[at(divided.block)]),
        divided_(divided),
        parts_(parts) {}

  [[nodiscard]] std::vector<BlockState> states() const {
    std::vector<BlockState> states;
    for (const BlockPart& part : parts_) states.push_back(state_of_part(whole_, state_, part.model));
    return states;
  }

  /// Sets values of the parts in a list by block.
  template <class Value, class Of>
  void divide(std::vector<Value>& by_block, const Of& of_part) const {
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const std::size_t number = at(divided_.numbers[k]);
      if (by_block.size() <= number) by_block.resize(number + 1);
      by_block[number] = of_part(k);
    }
  }

  void divide_motion(RunState& run) const {
    const std::vector<BlockState> states = this->states();
    divide(run.states, [&](std::size_t k) { return states[k]; });
    if (!run.accelerations.empty()) {
      const Eigen::MatrixX3d whole = run.accelerations[at(divided_.block)];
      divide(run.accelerations, [&](std::size_t k) { return field_of_part(whole_, whole, parts_[k].model); });
    }
    const double debt = run.spin_debts[at(divided_.block)] / whole_.basis().volume();
    divide(run.spin_debts, [&](std::size_t k) { return debt * parts_[k].model.basis().volume(); });
    divide(run.sleep.rests, [](std::size_t) { return BlockRest{}; });
  }

  void divide_contacts(const SimulationSettings& settings, const JointLaw& joint,
                       PairHistories& pairs) const {
    std::vector<const BlockModel*> models;
    std::vector<BlockModel> copies;
    for (const BlockPart& part : parts_) models.push_back(&part.model), copies.push_back(part.model);
    divide_histories(divided_, whole_.solid(), models, pairs);
    const BlockSystem system(std::move(copies), [joint](int, int) { return joint; }, settings, {});
    for (auto& [blocks, memory] : crack_joints(system, states(), whole_, state_))
      pairs[{divided_.numbers[at(blocks[0])], divided_.numbers[at(blocks[1])]}].memory = std::move(memory);
  }

  /// A load level continues from its start with the parts, under the same loads.
  void divide_level(const std::vector<BlockState>& states, StaticState& statics) const {
    if (statics.level_start.empty()) return;
    StaticState level;
    level.inertia = statics.inertia;
    level.freezes_failure = true;
    level.level_start = std::move(statics.level_start);
    const Eigen::MatrixX3d start = level.level_start[at(divided_.block)];
    divide(level.level_start, [&](std::size_t k) {
      return state_of_part(whole_, {start, start}, parts_[k].model).position;
    });
    for (const BlockState& state : states) level.progress.positions.push_back(state.position);
    level.progress.forces.assign(states.size(), std::numeric_limits<double>::infinity());
    level.progress.displacements.assign(states.size(), 0.0);
    statics = std::move(level);
  }

  /// Factors of loads go with the loads.
  void divide_factors(std::map<std::array<int, 2>, double>& factors) const {
    std::map<std::array<int, 2>, double> result;
    for (const auto& [place, factor] : factors)
      if (place[0] != divided_.block) result.emplace(place, factor);
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (std::size_t n = 0; n < parts_[k].loads.size(); ++n) {
        const auto found = factors.find({divided_.block, parts_[k].loads[n]});
        if (found != factors.end()) result[{divided_.numbers[k], static_cast<int>(n)}] = found->second;
      }
    factors = std::move(result);
  }

  /// Tracks and sub-faces of all other blocks stay.
  void divide_finder(const FinderState& fresh, FinderState& finder) const {
    divide(finder.tracks, [&](std::size_t k) { return fresh.tracks[at(divided_.numbers[k])]; });
    divide(finder.divisions, [&](std::size_t k) { return fresh.divisions[at(divided_.numbers[k])]; });
  }

 private:
  const BlockModel& whole_;
  const BlockState& state_;
  const PartNumbers& divided_;
  const std::vector<BlockPart>& parts_;
};

/// Books the change of energy by the frames of the parts.
void book_division(const Simulation& run, const BlockSystem& system, RunState& state) {
  LedgerKeeper& ledger = state.ledger;
  ledger.measure(run.system(), run.states());
  const double before = ledger.mechanical();
  ledger.measure_elastic(system, state.states);
  ledger.measure(system, state.states);
  ledger.integrator_took(before - ledger.mechanical());
}

}  // namespace

Simulation with_parts(const Simulation& run, const PartNumbers& divided, const std::vector<BlockPart>& parts,
                      Simulation::LawOfPair law) {
  const BlockSystem& system = run.system();
  std::vector<BlockModel> blocks = run.blocks();
  std::vector<bool> absent = system.absent();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k == 0) {
      blocks[at(divided.block)] = parts[k].model;
      continue;
    }
    blocks.push_back(parts[k].model);
    absent.push_back(!system.present(divided.block));
  }
  const std::vector<InitialMotion> motions(blocks.size());
  Simulation result(std::move(blocks), motions, std::move(law), system.settings(), ties_of(system),
                    std::move(absent));
  result.set_joint_pressure(run.joint_pressure());
  if (!system.bolts().empty()) result.add_bolts(system.bolts());
  return result;
}

SimulationSnapshot divided_state(const Simulation& run, const PartNumbers& divided,
                                 const std::vector<BlockPart>& parts, const JointLaw& joint,
                                 const Simulation& divided_run) {
  SimulationSnapshot result = run.snapshot();
  const StateDivision division(run, divided, parts);
  division.divide_motion(result.run);
  division.divide_contacts(run.system().settings(), joint, result.run.pairs);
  division.divide_level(result.run.states, result.run.statics);
  if (!result.run.statics.level_start.empty()) forget_accelerations(result.run);
  division.divide_factors(result.load_factors);
  division.divide_finder(divided_run.finder().state(), result.finder);
  result.run.depths = {};
  result.factors.clear();
  book_division(run, divided_run.system(), result.run);
  return result;
}

}  // namespace ashlar
