#include "solver/run/simulation.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "solver/limit/rigid_model.hpp"
#include "solver/ranks/counted_traffic.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/run/contact_explanation.hpp"
#include "solver/run/lost_strength.hpp"
#include "solver/shared/gathered_run.hpp"
#include "solver/shared/ghost_models.hpp"
#include "solver/shared/rank_balance.hpp"
#include "solver/shared/shared_bolts.hpp"
#include "solver/shared/shared_snapshot.hpp"
#include "solver/shared/shared_verdict.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/loose_blocks.hpp"
#include "solver/statics/static_step.hpp"
#include "solver/statics/static_verdict.hpp"
#include "solver/step/detect/end_state.hpp"
#include "solver/step/detect/sleeping_islands.hpp"

namespace ashlar {

Simulation::Simulation(std::vector<BlockModel> blocks, const std::vector<InitialMotion>& motions,
                       LawOfPair law, const SimulationSettings& settings, const std::vector<TieRequest>& ties,
                       std::vector<bool> absent)
    : Simulation(nullptr, std::move(blocks), motions, std::move(law), settings, ties, std::move(absent)) {}

Simulation::Simulation(BlocksOfRank blocks, const std::vector<InitialMotion>& motions, LawOfPair law,
                       const SimulationSettings& settings, const std::vector<TieRequest>& ties)
    : Simulation(std::move(blocks.shared), std::move(blocks.blocks), motions, std::move(law), settings, ties,
                 {}) {}

Simulation::Simulation(std::unique_ptr<SharedBlocks> shared, std::vector<BlockModel> blocks,
                       const std::vector<InitialMotion>& motions, LawOfPair law,
                       const SimulationSettings& settings, const std::vector<TieRequest>& ties,
                       std::vector<bool> absent)
    : shared_(std::move(shared)),
      system_(std::move(blocks), std::move(law), settings, ties,
              shared_ ? shared_->absent : std::move(absent), shared_ ? *shared_->exchange : no_exchange()),
      caches_{StepContacts(system_), FactorCache(settings.linear_method),
              DepthAudit(system_.blocks().size())} {
  state_.next_step = settings.time_step;
  for (std::size_t k = 0; k < system_.blocks().size(); ++k) {
    const BlockModel& block = system_.blocks()[k];
    state_.states.push_back(block.initial_state());
    state_.spin_debts.push_back(0.0);
    state_.sleep.rests.emplace_back();
    if (block.fixed()) continue;
    const auto velocity = [&](const BlockModel& model) {
      return model.rigid_velocity(motions[k].velocity, motions[k].angular_velocity);
    };
    BlockPartsLibrary library;
    state_.states.back().velocity =
        block.holds_quiet_faces() ? velocity(block.with_quiet_faces(true, library)) : velocity(block);
  }
  state_.ledger.start(system_, state_.states);
}

RunContext Simulation::context() {
  return {system_, state_, caches_, fault_};
}

void Simulation::gather_results(const ResultNeeds& needs, const ShownContacts& shown) {
  told_.reset();
  if (shared_ == nullptr) return;
  const CountedTraffic traffic(shared_->share->ranks(), shared_->for_results);
  ToldResults told{totals_of_run(*this, shown), {}, {}, {}};
  const bool first = system_.exchange().first();
  send_bolts_to_first(system_, state_);
  if (needs.all || !needs.pairs.empty()) told.contacts = contacts_of_run(*this, needs);
  if (needs.all || !needs.blocks.empty()) {
    send_shapes_to_first(system_, needs.all ? nullptr : &needs.blocks);
    std::vector<BlockState> states = states_of_run(*this, needs);
    if (first) state_.states = std::move(states);
  }
  if (needs.all) {
    told.moving = moving_of_run(system_, state_);
    told.without_strength = points_without_strength_of_run(*this);
    const std::vector<PairBonds> bonds = bonds_of_run(*this);
    if (first && !shared_->keeps_models)
      throw std::logic_error("the first rank has no models of blocks elsewhere");
    if (first) {
      for (const auto& [blocks, bonded, broken] : bonds) {
        state_.pairs[blocks].bonded = bonded;
        state_.pairs[blocks].broken = broken;
      }
    }
  }
  if (first) told_ = std::move(told);
}

std::vector<char> Simulation::points_without_strength(const PairRecord& record) const {
  const PairKey blocks = {record.a, record.b};
  if (!told_)
    return ashlar::points_without_strength(system_.law(record.a, record.b), history_of(state_.pairs, blocks),
                                           record);
  const auto told = told_->without_strength.find(blocks);
  return told != told_->without_strength.end() ? told->second : std::vector<char>(record.points.size(), 0);
}

void Simulation::refuse_ranks(const char* what) const {
  if (!system_.exchange().alone())
    throw std::invalid_argument(std::string(what) + " are possible on one rank only so far");
}

RigidModel Simulation::rigid_model(double end_time, const std::vector<bool>& multiplied) const {
  return ashlar::rigid_model(system_, state_, end_time, multiplied);
}

RigidModel Simulation::level_model(double end_time) const {
  RunState start = state_;
  const std::vector<Eigen::MatrixX3d>& positions = state_.statics.level_start;
  for (std::size_t k = 0; k < positions.size(); ++k) start.states[k].position = positions[k];
  return ashlar::rigid_model(system_, start, end_time, {});
}

RigidModel Simulation::spring_model(double end_time, const std::vector<bool>& multiplied) const {
  return ashlar::rigid_model(system_, state_, end_time, multiplied, RigidPointKind::springs);
}

void Simulation::show(const std::vector<Eigen::MatrixX3d>& positions, const std::vector<PairRecord>& contacts,
                      double end_time) {
  told_.reset();
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (system_.here(static_cast<int>(k))) state_.states.at(k).position = positions[k];
  for (BlockState& state : state_.states) state.velocity.setZero();
  state_.records.clear();
  state_.report = {};
  for (const PairRecord& contact : contacts) {
    if (!system_.owns_pair(contact.a, contact.b)) continue;
    count_states(contact.responses, state_.report);
    state_.records.push_back(contact);
  }
  state_.clock = {.start = end_time};
  ++state_.steps;
}

bool Simulation::reached(double end_time) const {
  return state_.reached(system_.settings().time_step, end_time);
}

StepStatus Simulation::step(double end_time) {
  told_.reset();
  return take_step(context(), end_time);
}

StaticStatus Simulation::static_step(double end_time) {
  return static_step(end_time, system_.settings().statics.displacement_limit);
}

StaticStatus Simulation::static_step(double end_time, double far) {
  told_.reset();
  wake_all(system_, state_);
  return judged(context(), end_time, ashlar::static_step(context(), end_time, far));
}

void Simulation::wake() {
  wake_all(system_, state_);
}

std::vector<MovingBlock> Simulation::moving_blocks() const {
  if (told_) return told_->moving;
  const auto [first, later] = ashlar::moving_blocks(system_, state_);
  return first.empty() ? later : first;
}

std::vector<std::vector<int>> Simulation::loose_blocks() {
  return ashlar::loose_blocks(system_, state_, caches_.contacts);
}

void Simulation::set_load_factor(int block, int load, double factor) {
  if (!std::isfinite(factor)) throw std::invalid_argument("the factor of a load is a finite number");
  refuse_ranks("factors of loads");
  system_.set_load_factor(block, load, factor);
  wake_all(system_, state_);
  state_.statics = StaticState{};
}

DroppedByOrder Simulation::change_order(int block, int order) {
  refuse_ranks("changes of order");
  wake_all(system_, state_);
  state_.sleep.rests.at(at(block)) = BlockRest{};
  return ashlar::change_order(system_, state_, caches_, block, order);
}

void Simulation::set_time_step(double step) {
  if (!(step > 0.0)) throw std::invalid_argument("a time step is above zero");
  system_.set_time_step(step);
  state_.next_step = step;
}

void Simulation::set_chord_tolerance(double tolerance) {
  if (!(tolerance > 0.0)) throw std::invalid_argument("a chord tolerance is a length above zero");
  wake_all(system_, state_);
  system_.set_chord_tolerance(tolerance);
  caches_.contacts.finder().set_chord_tolerance(tolerance, state_.pairs);
  state_.statics = StaticState{};
}

ContactExplanation Simulation::explain_contacts(int a, int b) const {
  return ashlar::explain_contacts(system_, state_, caches_.contacts.finder().state(), a, b);
}

SimulationSnapshot Simulation::snapshot() const {
  SimulationSnapshot result = snapshot_without_pairs();
  PairsOfRun pairs = pairs_of_run();
  pairs.visit_histories([](std::size_t) {},
                        [&result](const PairKey& blocks, const PairHistory& history) {
                          result.run.pairs.emplace_hint(result.run.pairs.end(), blocks, history);
                        });
  pairs.visit_records([&result](std::size_t count) { result.run.records.reserve(count); },
                      [&result](const PairRecord& record) { result.run.records.push_back(record); });
  return result;
}

SimulationSnapshot Simulation::snapshot_without_pairs() const {
  SimulationSnapshot part = ashlar::snapshot_without_pairs(system_, state_, caches_);
  if (shared_ == nullptr) return part;
  const CountedTraffic traffic(shared_->share->ranks(), shared_->for_results);
  return whole_without_pairs(system_, std::move(part), told_ ? &told_->totals : nullptr);
}

PairsOfRun Simulation::pairs_of_run(PairVisitors visitors) const {
  return {system_, state_, shared_ ? &shared_->for_results : nullptr, visitors};
}

void Simulation::restore(const SimulationSnapshot& snapshot) {
  told_.reset();
  if (shared_ == nullptr)
    ashlar::restore(system_, state_, caches_, snapshot);
  else
    restore_part(*shared_, system_, state_, caches_, snapshot);
}

std::optional<StateFault> Simulation::audit() {
  return first_of_run(system_, audit_present(system_, state_, caches_).fault);
}

Vector3 Simulation::momentum() const {
  if (told_) return told_->totals.momentum;
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < system_.blocks().size(); ++k) {
    if (system_.moving()[k] && system_.owns(static_cast<int>(k)))
      sum += system_.blocks()[k].momentum(state_.states[k]);
  }
  return sum;
}

Vector3 Simulation::angular_momentum() const {
  if (told_) return told_->totals.angular_momentum;
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < system_.blocks().size(); ++k) {
    if (system_.moving()[k] && system_.owns(static_cast<int>(k)))
      sum += system_.blocks()[k].angular_momentum(state_.states[k]);
  }
  return sum;
}

SimulationCounts Simulation::counts() const {
  return told_ ? told_->totals.counts : own_counts();
}

double Simulation::own_weight() const {
  return shared_ ? weight_of_rank(system_, state_) : 0.0;
}

SimulationCounts Simulation::own_counts() const {
  return counts_of(state_, caches_);
}

}  // namespace ashlar
