#include "solver/run/checkpoint.hpp"

#include <stdexcept>

#include "solver/run/byte_archive.hpp"

namespace ashlar {

template <class Archive>
static void visit_members(Archive& archive, StepClock& clock) {
  archive(clock.start, clock.step, clock.count);
}

template <class Archive>
static void visit_members(Archive& archive, BlockState& state) {
  archive(state.position, state.velocity);
}

template <class Archive>
static void visit_members(Archive& archive, CarriedShape& shape) {
  archive(shape.points, shape.followed, shape.stress);
}

template <class Archive>
static void visit_members(Archive& archive, PointMemory& memory) {
  archive(memory.slip, memory.level_slip, memory.in_level, memory.compression, memory.state, memory.intact,
          memory.normal_multiplier, memory.shear_multiplier, memory.unrubbed);
}

template <class Archive>
static void visit_members(Archive& archive, ContactMemory::Entry& entry) {
  archive(entry.material_a, entry.material_b, entry.face_a, entry.face_b, entry.normal, entry.area,
          entry.memory);
}

template <class Archive>
static void visit_members(Archive& archive, PressureCut& cut) {
  archive(cut.cell_a, cut.cell_b, cut.of_a, cut.start, cut.end);
}

template <class Archive>
static void visit_members(Archive& archive, SpringEnergy& held) {
  archive(held.normal, held.shear);
}

template <class Archive>
static void visit_members(Archive& archive, RememberedPair& pair) {
  archive(pair.blocks, pair.entries, pair.cuts, pair.deepest, pair.bulge, pair.held);
}

template <class Archive>
static void visit_members(Archive& archive, StepReport& report) {
  archive(report.step, report.iterations, report.open, report.locked, report.sliding, report.penetration,
          report.depth);
}

template <class Archive>
static void visit_members(Archive& archive, ContactPoint& point) {
  archive(point.type, point.face_a, point.face_b, point.material_a, point.material_b, point.place_a,
          point.place_b, point.normal, point.tangent_1, point.tangent_2, point.gap, point.area);
}

template <class Archive>
static void visit_members(Archive& archive, PointResponse& response) {
  archive(response.state, response.force, response.tangent, response.normal_energy, response.shear_energy);
}

template <class Archive>
static void visit_members(Archive& archive, PairRecord& record) {
  archive(record.a, record.b, record.points, record.responses, record.gaps, record.work);
}

template <class Archive>
static void visit_members(Archive& archive, StaticState& state) {
  archive(state.inertia, state.iterations, state.still_iterations, state.balanced, state.moving,
          state.holds_bonds, state.multiplier_iterations, state.level_start, state.milestones,
          state.milestone_forces, state.travels, state.sliding, state.least_lacking, state.rigid,
          state.gives_way, state.starts, state.unbalanced);
}

template <class Archive>
static void visit_members(Archive& archive, Ledger& ledger) {
  archive(ledger.kinetic, ledger.elastic, ledger.gravity, ledger.contact, ledger.friction, ledger.damping,
          ledger.applied, ledger.numerical, ledger.refound_gained, ledger.refound_lost, ledger.residual);
}

template <class Archive>
static void visit_members(Archive& archive, FrictionTally& tally) {
  archive(tally.due, tally.acted);
}

template <class Archive>
static void visit_members(Archive& archive, DeepestPoint& deepest) {
  archive(deepest.blocks, deepest.depth, deepest.share, deepest.time, deepest.place);
}

template <class Archive>
static void visit_members(Archive& archive, Rejection& rejection) {
  archive(rejection.time, rejection.step, rejection.reason);
}

template <class Archive>
static void visit_members(Archive& archive, DecisionCounts& counts) {
  archive(counts.filter, counts.exact);
}

template <class Archive>
static void visit_members(Archive& archive, FinderCounts& counts) {
  archive(counts.block_pairs_tested, counts.convex_pairs, counts.block_pairs_skipped, counts.block_pairs_far,
          counts.motions_checked, counts.divisions, counts.divisions_at_limit, counts.predicates);
}

template <class Archive>
static void visit_members(Archive& archive, Box& box) {
  archive(box.low, box.high);
}

template <class Archive>
static void visit_members(Archive& archive, Clearance& clearance) {
  archive(clearance.distance, clearance.path);
}

template <class Archive>
static void visit_members(Archive& archive, EntranceName& name) {
  archive(name.kind, name.a, name.b, name.reversed);
}

template <class Archive>
static void visit_members(Archive& archive, FinderState& state) {
  archive(state.paths, state.boxes, state.box_paths, state.clearances, state.entrances, state.divisions,
          state.counts);
}

template <class Archive>
static void visit_members(Archive& archive, FactorCounts& counts) {
  archive(counts.analyses, counts.factorizations, counts.factorizations_reused, counts.solves);
}

template <class Archive>
static void visit_members(Archive& archive, SimulationCounts& counts) {
  archive(counts.finder, counts.contact_points, counts.open_close_iterations, counts.open_close_fallbacks,
          counts.passing_contacts, counts.factors);
}

template <class Archive>
static void visit_members(Archive& archive, PhaseSeconds& seconds) {
  archive(seconds.contact_search, seconds.contact_points, seconds.solve, seconds.motion_check,
          seconds.depth_audit);
}

template <class Archive>
static void visit_members(Archive& archive, SimulationSnapshot& snapshot) {
  archive(snapshot.clock, snapshot.next_step, snapshot.steps, snapshot.remembers_statics, snapshot.states,
          snapshot.carried, snapshot.accelerations, snapshot.spin_debts, snapshot.memory,
          snapshot.contact_work, snapshot.taken, snapshot.finder, snapshot.report, snapshot.records,
          snapshot.ledger, snapshot.statics, snapshot.start_balance, snapshot.largest_step_residual,
          snapshot.largest_energy, snapshot.largest_penetration, snapshot.deepest, snapshot.sliding_friction,
          snapshot.true_depths, snapshot.rejections, snapshot.counts, snapshot.seconds);
}

std::string to_bytes(const SimulationSnapshot& snapshot) {
  ByteWriter writer;
  writer(snapshot);
  return writer.take();
}

SimulationSnapshot snapshot_from_bytes(std::string_view bytes) {
  SimulationSnapshot snapshot;
  ByteReader reader(bytes);
  reader(snapshot);
  if (!reader.at_end()) throw std::runtime_error("more is stored than a snapshot has");
  return snapshot;
}

SimulationSnapshot Simulation::snapshot() const {
  SimulationSnapshot result;
  result.clock = clock_;
  result.next_step = next_step_;
  result.steps = steps_;
  result.remembers_statics = remembers_statics_;
  result.states = states_;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (blocks_[k].incremental() != nullptr)
      result.carried.emplace(static_cast<int>(k), blocks_[k].carried());
  }
  result.accelerations = accelerations_;
  result.spin_debts = spin_debts_;
  for (const auto& [blocks, memory] : memory_) {
    result.memory.push_back(
        {blocks, memory.entries(), memory.cuts(), memory.deepest(), memory.bulge(), memory.held()});
  }
  result.contact_work = contact_work_;
  result.taken = taken_;
  result.finder = finder_.state();
  result.report = report_;
  result.records = records_;
  result.ledger = ledger_;
  result.statics = static_;
  result.start_balance = start_balance_;
  result.largest_step_residual = largest_step_residual_;
  result.largest_energy = largest_energy_;
  result.largest_penetration = largest_penetration_;
  result.deepest = deepest_;
  result.sliding_friction = sliding_friction_;
  result.true_depths = true_depths_;
  result.rejections = rejections_;
  result.counts = counts();
  result.seconds = seconds_;
  return result;
}

void Simulation::restore(const SimulationSnapshot& snapshot) {
  bool fits = snapshot.states.size() == blocks_.size();
  std::map<std::size_t, int> orders;  // that were changed in the run
  for (std::size_t k = 0; fits && k < blocks_.size(); ++k) {
    const Eigen::Index rows = snapshot.states[k].position.rows();
    const bool incremental = blocks_[k].incremental() != nullptr;
    fits = snapshot.states[k].velocity.rows() == rows &&
           snapshot.carried.contains(static_cast<int>(k)) == incremental;
    if (rows == states_[k].position.rows()) continue;
    int order = 1;
    while (order < PolynomialBasis::max_order && polynomial_count(order) < rows) ++order;
    fits = fits && polynomial_count(order) == rows && moving_[k] && !incremental;
    orders.emplace(k, order);
  }
  if (!fits) throw std::invalid_argument("the snapshot is one of other blocks");
  for (const auto& [k, order] : orders) replace_model(k, blocks_[k].with_order(order));
  clock_ = snapshot.clock;
  next_step_ = snapshot.next_step;
  steps_ = snapshot.steps;
  remembers_statics_ = snapshot.remembers_statics;
  states_ = snapshot.states;
  for (const auto& [block, shape] : snapshot.carried) {
    blocks_[static_cast<std::size_t>(block)] = blocks_[static_cast<std::size_t>(block)].with_shape(shape);
    finder_.start_step(block);
  }
  accelerations_ = snapshot.accelerations;
  spin_debts_ = snapshot.spin_debts;
  memory_.clear();
  for (const RememberedPair& pair : snapshot.memory) {
    memory_.emplace(pair.blocks, ContactMemory(pair.entries, pair.cuts, pair.deepest, pair.held, pair.bulge));
  }
  contact_work_ = snapshot.contact_work;
  taken_ = snapshot.taken;
  finder_.restore(snapshot.finder);
  report_ = snapshot.report;
  records_ = snapshot.records;
  ledger_ = snapshot.ledger;
  static_ = snapshot.statics;
  start_balance_ = snapshot.start_balance;
  largest_step_residual_ = snapshot.largest_step_residual;
  largest_energy_ = snapshot.largest_energy;
  largest_penetration_ = snapshot.largest_penetration;
  deepest_ = snapshot.deepest;
  sliding_friction_ = snapshot.sliding_friction;
  true_depths_ = snapshot.true_depths;
  rejections_ = snapshot.rejections;
  solvers_ = IslandSolvers();
  lone_factors_ = LoneBodyFactors();
  note_elastic_energies();
  counts_ = snapshot.counts;
  seconds_ = snapshot.seconds;
}

}  // namespace ashlar
