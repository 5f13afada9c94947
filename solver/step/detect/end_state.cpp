#include "solver/step/detect/end_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

/// True if the motion of a block exceeds the range of double precision: a force or change whose square is not finite,
/// or a displacement so large that the block's coordinates would be rounded to more than a share of its size
/// (notes/lost_blocks.md).
bool is_lost(const BlockModel& block, const BodyStep& body, const Eigen::MatrixX3d& position, double share) {
  for (const Eigen::VectorXd* vector : {&body.external_force, &body.free_change, &body.change})
    if (!std::isfinite(vector->squaredNorm())) return true;
  if (!std::isfinite(position.squaredNorm())) return true;
  const Eigen::MatrixX3d displacement = position - block.basis().identity_map();
  const double rounding =
      std::numeric_limits<double>::epsilon() * displacement.row(0).norm() / std::sqrt(block.basis().volume());
  return rounding > share * block.size();
}

/// Allowed depth of two blocks beyond their initial overlap, m. @param share of the smaller one's size
double allowed_depth(const BlockSystem& system, const PairHistories& pairs, const PairKey& blocks,
                     double share) {
  const double allowed = system.settings().depth.allowed_depth;
  return history_of(pairs, blocks).overlap + (allowed > 0.0 ? allowed : share * system.smaller_size(blocks));
}

/// Depths of blocks in each other. @param fine see SimulationSettings::depth::fine_interval
/// @param known of earlier audits
Audit measure_depths(const BlockSystem& system, StepCaches& caches, const std::vector<BlockState>& states,
                     bool fine, const KnownDepths& known) {
  const SimulationSettings& settings = system.settings();
  const ContactFinder& finder = caches.contacts.finder();
  const AuditScope scope{[&](int a, int b) { return !finder.leaves_out(a, b) && system.concerns(a, b); },
                         system.moving(),
                         (fine ? settings.search.passing_share : 1.0) * settings.contact_distance,
                         settings.threads,
                         settings.cached_motion(),
                         fine,
                         system.away()};
  return caches.audit.run(system.blocks(), states, finder.surfaces(), scope, known);
}

/// The pair that exceeds its allowed depth by most. @param known depths of contacts, m
std::optional<StateFault> too_deep_of(const BlockSystem& system, const PairHistories& pairs,
                                      const std::vector<PairDepth>& depths,
                                      const std::map<PairKey, double>& known) {
  std::optional<StateFault> fault;
  double most = 0.0;
  const auto hold_against = [&](const PairDepth& pair, double allowed) {
    if (pair.depth - allowed <= most) return;
    most = pair.depth - allowed;
    fault = StateFault{RejectionReason::too_deep, pair.blocks, pair.depth, allowed, pair.place};
  };
  for (const PairDepth& pair : depths) {
    const auto [a, b] = key_of(pair.blocks);
    const auto contact = known.find({a, b});
    hold_against(pair, allowed_depth(system, pairs, {a, b}, system.settings().depth.unknown_depth_share) +
                           (contact == known.end() ? 0.0 : contact->second));
    // A joint of given stiffness deforms as its user has specified.
    if (system.law(a, b).rigid)
      hold_against(pair, allowed_depth(system, pairs, {a, b}, system.settings().depth.allowed_depth_share));
  }
  return fault;
}

}  // namespace

std::optional<StateFault> broken_block(const BlockSystem& system, const RunState& state,
                                       const StepProblem& problem) {
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    if (!system.moving()[k] || !system.owns(static_cast<int>(k))) continue;
    const Eigen::MatrixX3d position = state.states[k].position + problem.bodies[k].motion();
    const int block = static_cast<int>(k);
    if (is_lost(system.blocks()[k], problem.bodies[k], position, system.settings().depth.lost_share))
      return StateFault{RejectionReason::not_finite, {block, block}};
    const Eigen::MatrixXd* gradients = system.asked_gradients(block);
    if (gradients == nullptr) continue;
    const Eigen::MatrixX3d deformation = *gradients * position;
    for (Eigen::Index row = 0; row < deformation.rows(); row += 3) {
      if (!(deformation.middleRows<3>(row).determinant() > 0.0))
        return StateFault{RejectionReason::inside_out, {block, block}};
    }
  }
  return std::nullopt;
}

std::optional<StateFault> audit_depths(const BlockSystem& system, RunState& state, StepCaches& caches,
                                       StepProblem& problem, bool fine) {
  const Stopwatch watch(state.log.seconds.depth_audit);
  problem.audit = measure_depths(system, caches, states_after(system, state, problem), fine, state.depths);
  std::map<PairKey, double> known;
  for (const ContactPair& pair : problem.pairs) {
    if (pair.tied()) continue;
    double& deepest = known[{pair.a(), pair.b()}];
    for (const double gap :
         pair.gaps(problem.bodies[at(pair.a())].change, problem.bodies[at(pair.b())].change))
      deepest = std::max(deepest, -gap);
  }
  return too_deep_of(system, state.pairs, problem.audit.depths, known);
}

PresentDepths audit_present(const BlockSystem& system, RunState& state, StepCaches& caches) {
  const Stopwatch watch(state.log.seconds.depth_audit);
  std::map<PairKey, double> known;
  for (const PairRecord& pair : state.records) {
    double& deepest = known[{pair.a, pair.b}];
    for (const double gap : pair.gaps) deepest = std::max(deepest, -gap);
  }
  PresentDepths present;
  const Audit audit = measure_depths(system, caches, state.states, true, {});
  for (const PairDepth& pair : audit.depths) {
    const auto [a, b] = key_of(pair.blocks);
    const auto contact = known.find({a, b});
    const PairHistory& noted = history_of(state.pairs, {a, b});
    const double expected =
        std::max(noted.depth, noted.overlap + (contact == known.end() ? 0.0 : contact->second));
    present.unexpected = present.unexpected || pair.depth > expected + system.settings().contact_distance;
  }
  note_depths(system, state, audit.depths);
  present.fault = too_deep_of(system, state.pairs, audit.depths, known);
  return present;
}

void note_depths(const BlockSystem& system, RunState& state, const std::vector<PairDepth>& depths) {
  for (auto& [blocks, pair] : state.pairs) {
    if (system.moving()[at(blocks[0])] || system.moving()[at(blocks[1])]) pair.depth = 0.0;
    state.report.depth = std::max(state.report.depth, pair.depth - pair.overlap);
  }
  for (const PairDepth& pair : depths) {
    const auto [a, b] = key_of(pair.blocks);
    PairHistory& history = state.pairs[{a, b}];
    history.depth = std::max(history.depth, pair.depth);
    const double depth = pair.depth - history.overlap;
    state.report.depth = std::max(state.report.depth, depth);
    if (depth > state.extremes.deepest.depth)
      state.extremes.deepest = {pair.blocks, depth, depth / system.smaller_size(pair.blocks), state.time(),
                                pair.place};
  }
}

namespace {

RejectionCause cause_here(const BlockSystem& system, const RunState& state, const StepProblem& problem,
                          IslandStatus status) {
  // A step that overflows cannot converge.
  if (const auto broken = broken_block(system, state, problem);
      broken && broken->reason == RejectionReason::not_finite)
    return {broken->reason, broken};
  if (status != IslandStatus::not_converged) return {RejectionReason::not_positive_definite, std::nullopt};
  constexpr RejectionReason reason = RejectionReason::open_close_not_converged;
  const auto found =
      std::find_if(problem.results.begin(), problem.results.end(), [](const IslandResult& result) {
        return result.status == IslandStatus::not_converged && result.alternating[0] >= 0;
      });
  if (found == problem.results.end()) return {reason, std::nullopt};
  return {reason, StateFault{reason, found->alternating}};
}

}  // namespace

RejectionCause cause_of_failure(const BlockSystem& system, const RunState& state, const StepProblem& problem,
                                IslandStatus status) {
  const std::vector<RejectionCause> causes =
      values_of_run(system, cause_here(system, state, problem, status));
  for (const RejectionCause& cause : causes)
    if (cause.reason == RejectionReason::not_finite) return cause;
  for (const RejectionCause& cause : causes)
    if (cause.fault) return cause;
  return causes.front();
}

void reject(RunState& state, double step, RejectionReason reason) {
  state.log.rejections.push_back({state.time(), step, reason});
}

}  // namespace ashlar
