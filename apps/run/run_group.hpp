// The processes that share a run, seen from one of them: all that a run knows of ranks (solver/notes/ranks.md).
#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/results/tables/contact_state.hpp"
#include "apps/scene/assemble/run_ranks.hpp"
#include "solver/ranks/rank_messages.hpp"
#include "solver/shared/gathered_run.hpp"

namespace ashlar {

/// Without others each function is that of this process alone. Those below `shared` and `first` are collective: all
/// processes call them, in the same order.
class RunGroup {
 public:
  /// @param ranks must outlive the group; null: this process alone
  RunGroup(const RunRanks* ranks = nullptr) : ranks_(ranks) {}

  /// For functions that build a simulation of the group; null: this process alone.
  [[nodiscard]] const RunRanks* ranks() const { return ranks_; }
  /// True if there are several processes.
  [[nodiscard]] bool shared() const { return ranks_ != nullptr && ranks_->several(); }
  /// True for the process that writes results.
  [[nodiscard]] bool first() const { return ranks_ == nullptr || ranks_->first(); }

  /// True if true for any process.
  [[nodiscard]] bool any(bool own) const { return shared() ? any_rank(ranks_->ranks, own) : own; }
  /// The decision of the first process. @param own of this process
  [[nodiscard]] bool as_first(bool own) const { return any(own && first()); }
  /// A value of each process, the first one's first.
  template <class Value>
  [[nodiscard]] std::vector<Value> values(const Value& own) const {
    if (!shared()) return {own};
    return values_of_ranks(ranks_->ranks, own);
  }
  /// The value of the first process.
  template <class Value>
  [[nodiscard]] Value value_of_first(const Value& own) const {
    return shared() ? std::move(values(own).front()) : own;
  }
  /// The result of work of the first process. If that throws, all throw as in do_on_each(). @param work not collective
  template <class Work>
  [[nodiscard]] std::invoke_result_t<Work> result_of_first(const Work& work) const {
    return shared() ? ashlar::value_of_first(ranks_->ranks, work) : work();
  }
  /// The values of all processes, put together by the function merged() of their kind.
  template <class Value>
  [[nodiscard]] Value together(const Value& own) const {
    return shared() ? merged(values(own)) : own;
  }
  /// Does work of each process. If it throws on any, all throw: that one its own exception, the others one with its text.
  /// @param work not collective
  void do_on_each(const std::function<void()>& work) const {
    shared() ? do_on_all(ranks_->ranks, work) : work();
  }
  /// Puts results of all processes together on the first one (Simulation::gather_results); nothing without others.
  /// @param counts true: also the counts of contacts, as shown
  void gather(Simulation& simulation, const ResultNeeds& needs, bool counts) const {
    if (shared()) simulation.gather_results(needs, counts ? own_contact_counts(simulation) : ShownContacts{});
  }
  /// Work and memory of each process; empty without others. @param use of this one
  [[nodiscard]] std::vector<RankWork> work(const Simulation& simulation, const ProcessUse& use) const {
    return shared() ? work_of_ranks(simulation, use) : std::vector<RankWork>();
  }

 private:
  const RunRanks* ranks_;
};

}  // namespace ashlar
