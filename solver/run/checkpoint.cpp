#include "solver/run/checkpoint.hpp"

#include <stdexcept>
#include <utility>

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
          memory.normal_multiplier, memory.shear_multiplier, memory.unrubbed, memory.dilation,
          memory.level_dilation);
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
static void visit_members(Archive& archive, ContactMemory& memory) {
  std::vector<ContactMemory::Entry> entries = memory.entries();
  std::vector<PressureCut> cuts = memory.cuts();
  double deepest = memory.deepest();
  double bulge = memory.bulge();
  SpringEnergy held = memory.held();
  archive(entries, cuts, deepest, bulge, held);
  memory = ContactMemory(std::move(entries), std::move(cuts), deepest, held, bulge);
}

template <class Archive>
static void visit_members(Archive& archive, StepReport& report) {
  archive(report.step, report.iterations, report.open, report.locked, report.sliding, report.penetration,
          report.depth);
}

template <class Archive>
static void visit_members(Archive& archive, ContactPoint& point) {
  archive(point.type, point.face_a, point.face_b, point.material_a, point.material_b, point.place_a,
          point.place_b, point.normal, point.tangent_1, point.tangent_2, point.gap, point.area, point.source,
          point.edge_a, point.edge_b);
}

template <class Archive>
static void visit_members(Archive& archive, ViewFrame& frame) {
  archive(frame.origin, frame.e1, frame.e2, frame.w);
}

template <class Archive>
static void visit_members(Archive& archive, PlaneLocation& location) {
  archive(location.dimension, location.index);
}

template <class Archive>
static void visit_members(Archive& archive, OverlapCorner& corner) {
  archive(corner.in_a, corner.in_b, corner.place);
}

template <class Archive>
static void visit_members(Archive& archive, CellOverlap& overlap) {
  archive(overlap.cell_a, overlap.cell_b, overlap.frame, overlap.corners, overlap.gaps);
}

template <class Archive>
static void visit_members(Archive& archive, VertexContact& contact) {
  archive(contact.vertex_of_a, contact.point, contact.own_cell, contact.cell, contact.gap, contact.area);
}

template <class Archive>
static void visit_members(Archive& archive, CrossedSide& side) {
  archive(side.ends, side.cell, side.along);
}

template <class Archive>
static void visit_members(Archive& archive, EdgeContact& contact) {
  archive(contact.of_a, contact.of_b, contact.normal, contact.gap, contact.area);
}

template <class Archive>
static void visit_members(Archive& archive, DecisionCounts& counts) {
  archive(counts.filter, counts.exact);
}

template <class Archive>
static void visit_members(Archive& archive, PairContacts& contacts) {
  archive(contacts.overlaps, contacts.vertices, contacts.edges, contacts.type, contacts.counts);
}

template <class Archive>
static void visit_members(Archive& archive, ResidualStrength& residual) {
  archive(residual.friction, residual.cohesion, residual.tensile_strength);
}

template <class Archive>
static void visit_members(Archive& archive, JointLaw& law) {
  archive(law.normal_stiffness, law.shear_stiffness, law.friction, law.cohesion, law.tensile_strength,
          law.area_springs, law.augmented, law.rounding, law.rigid, law.gives_way, law.residual);
}

template <class Archive>
static void visit_members(Archive& archive, PressureEnd& end) {
  archive(end.point, end.open);
}

template <class Archive>
static void visit_members(Archive& archive, RuledOverlap& overlap) {
  archive(overlap.outline, overlap.degree, overlap.first, overlap.count, overlap.end, overlap.whole);
}

template <class Archive>
static void visit_members(Archive& archive, ContactPoints& found) {
  archive(found.points, found.cuts, found.overlaps);
}

template <class Archive>
static void visit_members(Archive& archive, LastingContacts& lasting) {
  archive(lasting.contacts, lasting.positions, lasting.divisions, lasting.reach, lasting.law, lasting.found);
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
static void visit_members(Archive& archive, StaticProgress& progress) {
  archive(progress.milestones, progress.forces, progress.travels, progress.lacking);
}

template <class Archive>
static void visit_members(Archive& archive, StaticOnset& onset) {
  archive(onset.sliding, onset.least_lacking, onset.unbalanced, onset.rigid, onset.gives_way, onset.starts);
}

template <class Archive>
static void visit_members(Archive& archive, StaticState& state) {
  archive(state.inertia, state.iterations, state.still_iterations, state.holds_bonds,
          state.multiplier_iterations, state.balanced, state.moving, state.level_start, state.progress,
          state.onset);
}

template <class Archive>
static void visit_members(Archive& archive, BlockRest& rest) {
  archive(rest.last_path, rest.path, rest.motion, rest.velocity);
}

template <class Archive>
static void visit_members(Archive& archive, SleepingIsland& island) {
  archive(island.blocks, island.held);
}

template <class Archive>
static void visit_members(Archive& archive, Sleep& sleep) {
  archive(sleep.rests, sleep.window_steps, sleep.window_time, sleep.islands);
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
static void visit_members(Archive& archive, DilatingSlip& slip) {
  archive(slip.all, slip.in_flight);
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
static void visit_members(Archive& archive, FinderCounts& counts) {
  archive(counts.block_pairs_tested, counts.convex_pairs, counts.block_pairs_skipped, counts.block_pairs_kept,
          counts.block_pairs_far, counts.motions_checked, counts.divisions, counts.divisions_at_limit,
          counts.predicates);
}

template <class Archive>
static void visit_members(Archive& archive, Box& box) {
  archive(box.low, box.high);
}

template <class Archive>
static void visit_members(Archive& archive, PairDepth& depth) {
  archive(depth.blocks, depth.depth, depth.place, depth.face, depth.normal, depth.materials);
}

template <class Archive>
static void visit_members(Archive& archive, MeasuredDepth& depth) {
  archive(depth.pair, depth.places);
}

template <class Archive>
static void visit_members(Archive& archive, PairRoom& room) {
  archive(room.blocks, room.room);
}

template <class Archive>
static void visit_members(Archive& archive, KnownDepths& known) {
  archive(known.positions, known.boxes, known.depths, known.rooms);
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
static void visit_members(Archive& archive, BlockTrack& track) {
  archive(track.box, track.box_path, track.path, track.motion, track.checked_motion);
}

template <class Archive>
static void visit_members(Archive& archive, FinderState& state) {
  archive(state.tracks, state.divisions, state.counts);
}

template <class Archive>
static void visit_members(Archive& archive, FactorCounts& counts) {
  archive(counts.analyses, counts.factorizations, counts.factorizations_reused, counts.solves,
          counts.gradient_iterations);
}

template <class Archive>
static void visit_members(Archive& archive, SimulationCounts& counts) {
  archive(counts.finder, counts.contact_points, counts.open_close_iterations, counts.open_close_fallbacks,
          counts.passing_contacts, counts.islands_put_to_sleep, counts.sleeping_block_steps, counts.factors);
}

template <class Archive>
static void visit_members(Archive& archive, PhaseSeconds& seconds) {
  archive(seconds.contact_search, seconds.contact_points, seconds.solve, seconds.motion_check,
          seconds.depth_audit);
}

template <class Archive>
static void visit_members(Archive& archive, PairHistory& pair) {
  archive(pair.memory, pair.lasting, pair.clearance, pair.entrance, pair.work, pair.taken, pair.bonded,
          pair.broken, pair.depth);
}

template <class Archive>
static void visit_members(Archive& archive, ContactExtremes& extremes) {
  archive(extremes.penetration, extremes.deepest, extremes.sliding_friction, extremes.dilating_slip);
}

template <class Archive>
static void visit_members(Archive& archive, RunLog& log) {
  archive(log.rejections, log.counts, log.seconds);
}

template <class Archive>
static void visit_members(Archive& archive, RunState& run) {
  archive(run.clock, run.next_step, run.steps, run.remembers_statics, run.states, run.accelerations,
          run.spin_debts, run.pairs, run.depths, run.statics, run.sleep, run.ledger, run.report, run.records,
          run.extremes, run.log);
}

template <class Archive>
static void visit_members(Archive& archive, KeptFactor& factor) {
  archive(factor.key, factor.sizes, factor.pairs, factor.values, factor.inertia);
}

template <class Archive>
static void visit_members(Archive& archive, SimulationSnapshot& snapshot) {
  archive(snapshot.run, snapshot.carried, snapshot.finder, snapshot.factors, snapshot.load_factors);
}

void write_snapshot(ByteWriter& writer, const SimulationSnapshot& snapshot) {
  writer(snapshot);
}

SimulationSnapshot read_snapshot(ByteReader& reader) {
  SimulationSnapshot snapshot;
  reader(snapshot);
  return snapshot;
}

std::string to_bytes(const SimulationSnapshot& snapshot) {
  ByteWriter writer;
  writer(snapshot);
  return writer.take();
}

SimulationSnapshot snapshot_from_bytes(std::string_view bytes) {
  ByteReader reader(bytes);
  SimulationSnapshot snapshot = read_snapshot(reader);
  if (!reader.at_end()) throw std::runtime_error("more is stored than a snapshot has");
  return snapshot;
}

}  // namespace ashlar
