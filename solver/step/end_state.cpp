#include "solver/step/end_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geometry/index.hpp"
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
  const double volume = block.basis().volume();
  const Eigen::MatrixX3d way = position - block.basis().identity_map();
  const double rounding = std::numeric_limits<double>::epsilon() * way.row(0).norm() / std::sqrt(volume);
  return rounding > share * std::cbrt(volume);
}

/// Allowed depth of two blocks beyond their initial overlap, m. @param share of the smaller one's size
double allowed_depth(const RunContext& run, int a, int b, double share) {
  const double allowed = run.settings().depth.allowed_depth;
  return history_of(run.state.pairs, {a, b}).overlap +
         (allowed > 0.0 ? allowed : share * run.system.smaller_size({a, b}));
}

/// Depths of blocks in each other. @param fine see SimulationSettings::depth::fine_interval
/// @param known of earlier audits
Audit measure_depths(const RunContext& run, const std::vector<BlockState>& states, bool fine,
                     const KnownDepths& known) {
  const SimulationSettings& settings = run.settings();
  const AuditScope scope{[&run](int a, int b) { return !run.contacts.finder().leaves_out(a, b); },
                         run.system.moving(),
                         (fine ? settings.search.passing_share : 1.0) * settings.contact_distance,
                         settings.threads,
                         settings.cached_motion(),
                         fine};
  return run.audit.run(run.blocks(), states, run.contacts.finder().surfaces(), scope, known);
}

/// The pair that exceeds its allowed depth by most. @param known depths of contacts, m
std::optional<StateFault> too_deep_of(const RunContext& run, const std::vector<PairDepth>& depths,
                                      const std::map<PairKey, double>& known) {
  std::optional<StateFault> fault;
  double most = 0.0;
  const auto hold_against = [&](const PairDepth& pair, double allowed) {
    if (pair.depth - allowed <= most) return;
    most = pair.depth - allowed;
    fault = StateFault{RejectionReason::too_deep, pair.blocks, pair.depth, allowed, pair.place};
  };
  for (const PairDepth& pair : depths) {
    const auto [a, b] = std::minmax(pair.blocks[0], pair.blocks[1]);
    const auto contact = known.find({a, b});
    hold_against(pair, allowed_depth(run, a, b, run.settings().depth.unknown_depth_share) +
                           (contact == known.end() ? 0.0 : contact->second));
    // A joint of given stiffness deforms as its user has specified.
    if (run.system.law(a, b).rigid)
      hold_against(pair, allowed_depth(run, a, b, run.settings().depth.allowed_depth_share));
  }
  return fault;
}

}  // namespace

std::optional<StateFault> broken_block(const RunContext& run, const StepProblem& problem) {
  for (std::size_t k = 0; k < run.blocks().size(); ++k) {
    if (!run.system.moving()[k]) continue;
    const Eigen::MatrixX3d position = run.state.states[k].position + problem.bodies[k].motion();
    const int block = static_cast<int>(k);
    if (is_lost(run.blocks()[k], problem.bodies[k], position, run.settings().depth.lost_share))
      return StateFault{RejectionReason::not_finite, {block, block}};
    const Eigen::MatrixXd* gradients = run.system.asked_gradients(block);
    if (gradients == nullptr) continue;
    const Eigen::MatrixX3d deformation = *gradients * position;
    for (Eigen::Index row = 0; row < deformation.rows(); row += 3) {
      if (!(deformation.middleRows<3>(row).determinant() > 0.0))
        return StateFault{RejectionReason::inside_out, {block, block}};
    }
  }
  return std::nullopt;
}

std::optional<StateFault> audit_depths(const RunContext& run, StepProblem& problem, bool fine) {
  const Stopwatch watch(run.state.log.seconds.depth_audit);
  problem.audit = measure_depths(run, states_after(run.system, run.state, problem), fine, run.state.depths);
  std::map<PairKey, double> known;
  for (const ContactPair& pair : problem.pairs) {
    if (pair.tied()) continue;
    double& deepest = known[{pair.a(), pair.b()}];
    for (const double gap :
         pair.gaps(problem.bodies[at(pair.a())].change, problem.bodies[at(pair.b())].change))
      deepest = std::max(deepest, -gap);
  }
  return too_deep_of(run, problem.audit.depths, known);
}

PresentDepths audit_present(const RunContext& run) {
  const Stopwatch watch(run.state.log.seconds.depth_audit);
  std::map<PairKey, double> known;
  for (const PairRecord& pair : run.state.records) {
    double& deepest = known[{pair.a, pair.b}];
    for (const double gap : pair.gaps) deepest = std::max(deepest, -gap);
  }
  PresentDepths present;
  const Audit audit = measure_depths(run, run.state.states, true, {});
  for (const PairDepth& pair : audit.depths) {
    const auto [a, b] = std::minmax(pair.blocks[0], pair.blocks[1]);
    const auto contact = known.find({a, b});
    const PairHistory& noted = history_of(run.state.pairs, {a, b});
    const double expected =
        std::max(noted.depth, noted.overlap + (contact == known.end() ? 0.0 : contact->second));
    present.unexpected = present.unexpected || pair.depth > expected + run.settings().contact_distance;
  }
  note_depths(run, audit.depths);
  present.fault = too_deep_of(run, audit.depths, known);
  return present;
}

void note_depths(const RunContext& run, const std::vector<PairDepth>& depths) {
  for (auto& [blocks, pair] : run.state.pairs) {
    if (run.system.moving()[at(blocks[0])] || run.system.moving()[at(blocks[1])]) pair.depth = 0.0;
    run.state.report.depth = std::max(run.state.report.depth, pair.depth - pair.overlap);
  }
  for (const PairDepth& pair : depths) {
    const auto [a, b] = std::minmax(pair.blocks[0], pair.blocks[1]);
    PairHistory& history = run.state.pairs[{a, b}];
    history.depth = std::max(history.depth, pair.depth);
    const double depth = pair.depth - history.overlap;
    run.state.report.depth = std::max(run.state.report.depth, depth);
    if (depth > run.state.extremes.deepest.depth)
      run.state.extremes.deepest = {pair.blocks, depth, depth / run.system.smaller_size(pair.blocks),
                                    run.state.time(), pair.place};
  }
}

void reject(const RunContext& run, double step, const StateFault& fault) {
  reject(run, step, fault.reason);
  run.fault = fault;
}

void reject(const RunContext& run, double step, RejectionReason reason) {
  run.state.log.rejections.push_back({run.state.time(), step, reason});
}

void reject_unsettled(const RunContext& run, double step, IslandStatus status, const StepProblem& problem) {
  // A step that overflows cannot converge.
  if (const auto broken = broken_block(run, problem); broken && broken->reason == RejectionReason::not_finite)
    return reject(run, step, *broken);
  run.fault.reset();
  const auto found =
      std::find_if(problem.results.begin(), problem.results.end(), [](const IslandResult& result) {
        return result.status == IslandStatus::not_converged && result.alternating[0] >= 0;
      });
  if (status == IslandStatus::not_converged && found != problem.results.end())
    return reject(run, step, StateFault{RejectionReason::open_close_not_settled, found->alternating});
  reject(run, step,
         status == IslandStatus::not_converged ? RejectionReason::open_close_not_settled
                                               : RejectionReason::not_positive_definite);
}

}  // namespace ashlar
