// Findings of a run besides the state of its simulation: falls and the verdict on a motion, contacts that keep a static
// analysis from converging, errors of measures and of orders, and the work of processes.
#pragma once

#include <optional>
#include <vector>

#include "apps/results/folder/contact_changes.hpp"
#include "apps/results/folder/motion_verdict.hpp"
#include "apps/run/run_end.hpp"
#include "apps/run/run_group.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/accuracy/goal_error.hpp"
#include "solver/run/order_error.hpp"

namespace ashlar {

class RunFindings {
 public:
  /// @param all_errors true: errors of orders are estimated of all blocks, however long it takes
  explicit RunFindings(const RunGroup& group, bool all_errors = false)
      : group_(group), all_errors_(all_errors) {}

  /// Notes falls of blocks after a step in time.
  void note_step(const Simulation& simulation) { falls_.note(simulation); }
  /// Notes changes of contacts after an iteration of a static analysis.
  void note_iteration(const Simulation& simulation) { changes_.note(simulation); }
  /// Changes of contacts are those of one stage.
  void begin_stage() { changes_.forget(); }
  /// Goes on from those of a checkpoint.
  void resume(const ContactChanges& changes, const FallRecord& falls);

  /// Makes the verdict on a motion at the end of its stage. Collective.
  /// @param end its message becomes the verdict, if it is empty
  void judge(const Simulation& simulation, RunEnd& end);
  /// At the end of a run: errors of measures of an equilibrium, errors of orders, and the work of processes. Collective.
  /// @param whole,present scenes of all stages and of the last one
  void conclude(const Scene& whole, const Scene& present, const Simulation& simulation,
                const GoalValues& goals, const RunEnd& end);

  /// The run goes on after its end.
  void reopen() { order_errors_.reset(); }

  /// True if errors of orders have a meaning: of a motion at any time, of a static analysis in equilibrium, of a process
  /// that has the contacts of all blocks.
  [[nodiscard]] bool has_order_errors(const SceneAnalysis& present, std::optional<RunStatus> status) const;
  /// Errors of orders of the present state, within the work that the summary of a run may take (order_error_work.hpp).
  [[nodiscard]] OrderErrors estimated_orders(const Simulation& simulation) const;

  /// Of all processes. Collective.
  [[nodiscard]] FallRecord falls() const;
  [[nodiscard]] const ContactChanges& changes() const { return changes_; }
  /// Of the last motion that has ended; empty: none has.
  [[nodiscard]] const std::optional<MotionVerdict>& verdict() const { return verdict_; }
  /// By measure; empty: not estimated.
  [[nodiscard]] const std::vector<GoalError>& measure_errors() const { return measure_errors_; }
  /// estimated_orders() of the end; empty: the run has not ended, or has an accuracy, or none are known.
  [[nodiscard]] const std::optional<OrderErrors>& order_errors() const { return order_errors_; }
  /// By process; empty: the run has not ended, or only one process has it.
  [[nodiscard]] const std::vector<RankWork>& work() const { return work_; }

 private:
  RunGroup group_;
  bool all_errors_;
  FallRecord falls_;        ///< of the blocks of this process
  ContactChanges changes_;  ///< in the present stage
  std::optional<MotionVerdict> verdict_;
  std::vector<GoalError> measure_errors_;
  std::optional<OrderErrors> order_errors_;
  std::vector<RankWork> work_;
};

}  // namespace ashlar
