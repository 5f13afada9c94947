#include "apps/run/run_findings.hpp"

#include <limits>

#include "apps/results/system/this_process.hpp"
#include "solver/run/order_error_work.hpp"

namespace ashlar {

void RunFindings::resume(const ContactChanges& changes, const FallRecord& falls) {
  changes_ = changes;
  falls_ = falls;
}

FallRecord RunFindings::falls() const {
  return group_.together(falls_);
}

void RunFindings::judge(const Simulation& simulation, RunEnd& end) {
  falls_ = falls();
  verdict_ = group_.together(verdict_of(simulation, falls_));
  if (end.message.empty()) end.message = describe(*verdict_, simulation);
}

void RunFindings::conclude(const Scene& whole, const Scene& present, const Simulation& simulation,
                           const GoalValues& goals, const RunEnd& end) {
  // A process knows the contacts of its own blocks only.
  if (!group_.shared() && present.analysis.type == SceneAnalysis::Type::statics &&
      end.status == RunStatus::equilibrium && !whole.analysis.accuracy)
    measure_errors_ = goal_errors(simulation, goals);
  order_errors_.reset();
  if (!whole.analysis.accuracy && has_order_errors(present.analysis, end.status))
    order_errors_ = estimated_orders(simulation);
  work_ = group_.work(simulation, {processor_time(), peak_memory_bytes()});
}

bool RunFindings::has_order_errors(const SceneAnalysis& present, std::optional<RunStatus> status) const {
  if (group_.shared()) return false;
  return present.type == SceneAnalysis::Type::dynamic ||
         (present.type == SceneAnalysis::Type::statics && status == RunStatus::equilibrium);
}

OrderErrors RunFindings::estimated_orders(const Simulation& simulation) const {
  return order_errors_within(
      simulation, all_errors_ ? std::numeric_limits<double>::infinity() : largest_estimate_work(simulation));
}

}  // namespace ashlar
