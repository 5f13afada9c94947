#include "solver/shared/shared_verdict.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/shared/shared_step.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/motion_doubt.hpp"
#include "solver/statics/rigid_verdict.hpp"

namespace ashlar {
namespace {

/// A tie as it was requested.
struct TieOfRank {
  int a;
  int b;
  double stiffness;  ///< Pa/m
};

/// Answer of the first rank.
struct ToldVerdict {
  StaticStatus status = StaticStatus::balancing;
  std::vector<double> displacements;         ///< by block, if blocks move
  std::vector<Eigen::MatrixX3d> unbalanced;  ///< likewise
  std::vector<Eigen::MatrixX3d> positions;   ///< by block, if rigid blocks stand
  std::vector<PairRecord> records;           ///< likewise
};

/// All blocks of the run, on one rank.
struct WholeRun {
  BlockSystem system;
  RunState state;
};

/// @param ties of all ranks
WholeRun whole_run(const RunContext& run, const std::vector<TieOfRank>& ties) {
  const BlockSystem& system = run.system;
  std::vector<BlockModel> blocks;
  for (int k = 0; k < system.count(); ++k) {
    const bool known = shared_blocks_of(run.system)->keeps_models || system.here(k) || !system.present(k);
    blocks.push_back(known ? system.blocks()[at(k)] : shared_blocks_of(run.system)->load(k));
  }
  std::vector<TieRequest> requests;
  for (const TieOfRank& tie : ties) requests.push_back({tie.a, tie.b, tie.stiffness});
  WholeRun whole{BlockSystem(
                     std::move(blocks), [&system](int a, int b) { return system.law(a, b); },
                     system.settings(), requests, system.absent()),
                 {}};
  for (const BlockModel& block : whole.system.blocks()) whole.state.states.push_back(block.initial_state());
  for (const auto& [pair, history] : run.state.pairs)
    if (history.overlap > 0.0) whole.state.pairs[pair].overlap = history.overlap;
  whole.state.clock = run.state.clock;
  whole.state.remembers_statics = run.state.remembers_statics;
  whole.state.statics.level_start.resize(at(system.count()));
  return whole;
}

ToldVerdict answer_of(WholeRun& whole, double end_time, StaticStatus status) {
  ToldVerdict told;
  told.status = status == StaticStatus::balancing
                    ? rigid_collapse(whole.system, whole.state, end_time)
                    : rigid_verdict(whole.system, whole.state, end_time, status);
  if (told.status == status) return told;
  if (told.status == StaticStatus::moving) {
    told.displacements = whole.state.statics.progress.displacements;
    told.unbalanced = whole.state.statics.onset.unbalanced;
  } else {
    for (const BlockState& block : whole.state.states) told.positions.push_back(block.position);
    told.records = whole.state.records;
  }
  return told;
}

/// @param keeps_accelerations true: those that the iterations have recorded stay
void take_motion(const ToldVerdict& told, bool keeps_accelerations, StaticState& statics) {
  statics.moving = true;
  statics.balanced = false;
  statics.progress.displacements = told.displacements;
  if (keeps_accelerations) return;
  statics.onset.unbalanced = told.unbalanced;
  statics.onset.rigid = true;
}

void take_equilibrium(const BlockSystem& system, const ToldVerdict& told, double end_time, RunState& state) {
  for (int k = 0; k < system.count(); ++k)
    if (system.here(k)) state.states[at(k)].position = told.positions[at(k)];
  state.records.clear();
  for (const PairRecord& record : told.records)
    if (system.concerns(record.a, record.b)) state.records.push_back(record);
  state.statics.balanced = true;
  state.statics.moving = false;
  state.clock = {.start = end_time};
}

}  // namespace

StaticStatus shared_verdict(const RunContext& run, double end_time, StaticStatus status) {
  const BlockSystem& system = run.system;
  const BlockShare& share = share_of(system);
  Ranks& ranks = share.ranks();
  // The verdict has no bolts. All ranks know which are installed.
  const std::vector<BoltState>& bolts = run.state.bolts;
  if (std::any_of(bolts.begin(), bolts.end(), [](const BoltState& bolt) { return bolt.installed(); }))
    return status;
  std::vector<TieOfRank> ties;
  for (const TiedBlocks& tie : system.ties())
    if (system.owns_pair(tie.a, tie.b)) ties.push_back({tie.a, tie.b, tie.stiffness});
  std::vector<TieOfRank> all_ties;
  for (const std::vector<TieOfRank>& of_rank : values_of_ranks(ranks, ties))
    all_ties.insert(all_ties.end(), of_rank.begin(), of_rank.end());
  const bool first = ranks.own() == 0;
  std::optional<WholeRun> whole;
  do_on_all(ranks, [&] {
    if (first) whole.emplace(whole_run(run, all_ties));
  });
  const auto take = [&](int block, Eigen::MatrixX3d position, Eigen::MatrixX3d start) {
    whole->state.states.at(at(block)).position = std::move(position);
    whole->state.statics.level_start.at(at(block)) = std::move(start);
  };
  const std::vector<Eigen::MatrixX3d>& starts = run.state.statics.level_start;
  const auto each_own = [&](const auto& visit) {
    for (const int k : share.own())
      visit(k, run.state.states[at(k)].position, starts.empty() ? Eigen::MatrixX3d() : starts[at(k)]);
  };
  if (first) each_own(take);
  send_to_first(
      ranks, [&](ByteWriter& writer) { each_own([&writer](const auto&... values) { writer(values...); }); },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          int block = -1;
          Eigen::MatrixX3d position, start;
          reader(block, position, start);
          take(block, std::move(position), std::move(start));
        }
      });
  const bool keeps_accelerations =
      status == StaticStatus::balancing && any_of_run(system, has_accelerations(run.state.statics));
  const ToldVerdict told = value_of_first(ranks, [&] {
    if (starts.empty()) whole->state.statics.level_start.clear();
    return answer_of(*whole, end_time, status);
  });
  if (told.status == status) return status;
  if (told.status == StaticStatus::moving)
    take_motion(told, keeps_accelerations, run.state.statics);
  else if (told.status == StaticStatus::equilibrium)
    take_equilibrium(system, told, end_time, run.state);
  else
    run.state.statics.moving = false;
  return told.status;
}

StaticStatus judged(const RunContext& run, double end_time, StaticStatus status) {
  // Where many iterations are needed blocks often move, which rigid blocks tell in less time than the remaining ones.
  const bool several = !run.system.exchange().alone();
  if (status == StaticStatus::balancing &&
      run.state.statics.iterations != StaticSettings::rigid_question_after)
    return status;
  const std::vector<BoltState>& bolts = run.state.bolts;
  const bool bolted = any_of_run(
      run.system,
      std::any_of(bolts.begin(), bolts.end(), [](const BoltState& bolt) { return bolt.installed(); }));
  if (status == StaticStatus::balancing)
    return bolted    ? status
           : several ? shared_verdict(run, end_time, status)
                     : rigid_collapse(run.system, run.state, end_time);
  if (status == StaticStatus::moving && doubt_of_motion(run.system, run.state) == MotionDoubt::none)
    return status;
  const StaticStatus verdict = bolted    ? status
                               : several ? shared_verdict(run, end_time, status)
                                         : rigid_verdict(run.system, run.state, end_time, status);
  if (verdict != StaticStatus::moving ||
      doubt_of_motion(run.system, run.state) != MotionDoubt::no_acceleration)
    return verdict;
  run.state.statics.moving = false;
  return StaticStatus::not_converged;
}

}  // namespace ashlar
