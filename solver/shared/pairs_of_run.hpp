// Pairs of all blocks of a run, visited in the order of their blocks on the first rank, or on all. Ranks send theirs some at
// a time, so that none ever has more of the others' than those of one message: a pair of bricks takes 20 to 30 kB.
//
// Histories and records are two series. Each is visited once, histories first, as a checkpoint stores them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "solver/contact/pair_history.hpp"
#include "solver/ranks/counted_traffic.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// Ranks that visit the pairs of a run.
enum class PairVisitors {
  first,  ///< the first one; others call nothing
  all,
};

class PairsOfRun {
 public:
  /// @param system,state of a simulation, must outlive this, and not change before the end of both visits
  /// @param sent sum to which the traffic of the visits is added, must outlive this; null: none
  PairsOfRun(const BlockSystem& system, const RunState& state, RankTraffic* sent, PairVisitors visitors)
      : system_(system), state_(state), sent_(sent), visitors_(visitors) {}

  using Begin = std::function<void(std::size_t count)>;
  /// Visits the histories of all pairs, as one rank would have them. Collective.
  /// @param begin called first, with their number. @param visit called for each pair, in increasing order
  /// @throws exceptions of begin and visit, after the end of the collective work
  void visit_histories(const Begin& begin,
                       const std::function<void(const PairKey& blocks, const PairHistory& history)>& visit);
  /// The same of the records of the last step.
  void visit_records(const Begin& begin, const std::function<void(const PairRecord& record)>& visit);
  /// Takes part in the visits that have not been made yet, and visits nothing. Collective
  void finish();

 private:
  [[nodiscard]] std::unique_ptr<CountedTraffic> counted_traffic() const;

  const BlockSystem& system_;
  const RunState& state_;
  RankTraffic* sent_;
  PairVisitors visitors_;
  bool histories_visited_ = false;
  bool records_visited_ = false;
};

}  // namespace ashlar
