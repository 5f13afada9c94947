// The part of Simulation about its start: overlaps, stress, bolts, equilibria and stages before contacts are detected.
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/ranks/rank_messages.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/stage_start.hpp"
#include "solver/shared/shared_snapshot.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/static_start.hpp"
#include "solver/step/accept/accepted_bolts.hpp"
#include "solver/step/accept/block_changes.hpp"

namespace ashlar {

void Simulation::refuse_late(const char* call) const {
  if (state_.has_begun())
    throw std::logic_error(std::string(call) +
                           " belongs to the start of a run, before contacts are detected");
}

void Simulation::start_overlapping(const std::map<PairKey, double>& depths) {
  refuse_late("start_overlapping");
  if (!state_.pairs.empty()) throw std::logic_error("initial overlaps are set before the initial stress");
  const auto take = [&] {
    for (const auto& [blocks, depth] : depths) {
      if (system_.blocks().at(at(blocks[0])).incremental() != nullptr ||
          system_.blocks().at(at(blocks[1])).incremental() != nullptr)
        throw std::invalid_argument("incremental blocks have no initial positions");
      state_.pairs[blocks].overlap = depth;
    }
  };
  system_.exchange().on_all(take);
  if (depths.empty()) return;
  // The initial depth of contacts determines the depth that later contacts may have without force.
  std::map<PairKey, double> placed;
  StepContacts contacts(system_);  // a stage moves blocks before its own are evaluated
  const std::vector<FoundContacts> found = contacts.detect(system_, state_, 0.0);
  for (const ContactPair& pair : contacts.pairs(system_, state_, found, PairUse::statics)) {
    double& deepest = placed[{pair.a(), pair.b()}];
    for (const ContactPoint& point : pair.points()) deepest = std::max(deepest, point.overlap);
  }
  for (const auto& of_process : values_of_run(system_, std::map(placed)))
    placed.insert(of_process.begin(), of_process.end());
  state_.pairs.clear();
  for (const auto& [blocks, deepest] : placed)
    if (deepest > 0.0) state_.pairs[blocks].overlap = deepest;
}

std::optional<StressImbalance> Simulation::start_stressed() {
  refuse_late("start_stressed");
  StressedContacts start = contacts_under_stress(system_, state_);
  for (auto& [blocks, memory] : start.contacts) state_.pairs[blocks].memory = std::move(memory);
  // Points under stress reach farther than those without.
  system_.exchange().find_neighbours(context(), 0.0);
  return start.worst;
}

void Simulation::add_bolts(std::vector<Bolt> bolts) {
  refuse_late("add_bolts");
  if (!system_.bolts().empty()) throw std::logic_error("all bolts of a run are added together");
  system_.exchange().on_all([&] { system_.set_bolts(std::move(bolts)); });
  system_.exchange().find_neighbours(context(), 0.0);
  state_.ledger.springs_hold(install_bolts(system_, state_));
  state_.ledger.start(system_, state_.states);
}

std::vector<int> Simulation::settle_supported_blocks() {
  refuse_late("settle_supported_blocks");
  std::vector<int> balanced;
  for (int k = 0; k < system_.count(); ++k) {
    const BlockModel& block = system_.blocks()[at(k)];
    if (block.fixed() || !system_.present(k) || !block.supported() || system_.is_tied(k)) continue;
    auto position = block.equilibrium(system_.settings().gravity_at(0.0), 0.0);
    if (!position) continue;
    balanced.push_back(k);
    BlockState& state = state_.states[at(k)];
    if (block.incremental() == nullptr) {
      state.position = std::move(*position);
      continue;
    }
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < system_.settings().settling_steps; ++step) {
      const double travel = (*position - state.position).norm();
      start_carried_step(system_, state_, caches_, k, block.carried_on(*position));
      // Steps that no longer shrink are rounding errors.
      if (!(travel < last)) break;
      last = travel;
      position = block.equilibrium(system_.settings().gravity_at(0.0), 0.0);
    }
  }
  state_.ledger.start(system_, state_.states);
  return balanced;
}

StaticStatus Simulation::start_from_statics(const std::function<bool()>& may_continue) {
  refuse_late("start_from_statics");
  told_.reset();
  return ashlar::start_from_statics(context(), may_continue);
}

StaticStatus Simulation::start_from_statics() {
  return start_from_statics([] { return true; });
}

void Simulation::start_stage(const SimulationSnapshot& end, const std::vector<bool>& was_absent) {
  refuse_late("start_stage");
  refuse_ranks("stages after a snapshot alone");
  ashlar::start_stage(context(), end, was_absent);
}

void Simulation::start_stage(const Simulation& last) {
  if (shared_ == nullptr) return start_stage(last.snapshot(), last.system_.absent());
  refuse_late("start_stage");
  told_.reset();
  const bool first = system_.exchange().first();
  SimulationSnapshot end = last.snapshot_without_pairs();
  if (!first) end = {};
  end = std::move(values_of_run(system_, end).front());
  PairsOfRun pairs = last.pairs_of_run(PairVisitors::all);
  add_pairs_of_rank(system_, pairs, end);
  ashlar::start_stage(context(), end, last.system_.absent());
  // The snapshot has sums of all ranks.
  state_.report = last.state_.report;
  state_.extremes = last.state_.extremes;
  state_.log = last.state_.log;
  state_.log.counts = last.own_counts();
  continue_work(*last.shared_, *shared_);
}

}  // namespace ashlar
