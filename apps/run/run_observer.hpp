// Observers of a run: progress, results, checkpoints and interrupts are attached to it, each independent of the others.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ashlar {

class Run;
struct FactorTrial;
struct LimitFindings;

/// Each member does nothing unless overridden. An exception of a member from stage_begins on ends the run as failed:
/// results could not be written.
class RunObserver {
 public:
  RunObserver() = default;
  virtual ~RunObserver() = default;
  RunObserver(const RunObserver&) = delete;
  RunObserver& operator=(const RunObserver&) = delete;

  /// Asked before each step, iteration and search; false ends the run as interrupted.
  [[nodiscard]] virtual bool may_continue() { return true; }

  // A search for a factor, before the run begins.
  /// @param limit true: by limit analysis, false: by static analyses. @param reason why; the scene leaves it open
  virtual void method_chosen(bool /*limit*/, const std::string& /*reason*/) {}
  /// Limit analysis has ended, possibly by an interrupt.
  virtual void limits_found(const LimitFindings& /*findings*/) {}
  /// @param iterations of a static analysis that has not ended
  virtual void trial_continues(double /*factor*/, int /*iterations*/) {}
  /// @param reason of an inconclusive trial; empty: none
  virtual void trial_ends(const FactorTrial& /*trial*/, const std::string& /*reason*/) {}
  /// A static analysis was interrupted.
  virtual void trial_stops(double /*factor*/, int /*iterations*/) {}

  /// The simulation is in its initial state, or in that of the checkpoint. An exception leaves the run not begun.
  virtual void run_begins(const Run& /*run*/) {}
  /// Before the first step of each stage, also of a run without stages.
  virtual void stage_begins(const Run& /*run*/) {}
  /// A step was accepted, or a static analysis has taken an iteration.
  virtual void step_taken(const Run& /*run*/) {}
  /// Blocks have cracked after a step or at an equilibrium: Run::cracks() has new events.
  virtual void blocks_crack(const Run& /*run*/) {}
  /// The last step of a stage is taken. Blocks are not audited yet: a run that is continued from here has no end here.
  virtual void stage_stops(const Run& /*run*/) {}
  /// stage_status() and message() are those of the end of the stage.
  virtual void stage_ends(const Run& /*run*/) {}
  /// status() is known. A run may end several times (Run::set_load_factor).
  virtual void run_ends(const Run& /*run*/) {}
  /// The run has failed as results could not be written: saves its state and summary by other means.
  virtual void save_after_failure(const Run& /*run*/) {}
};

/// Observers in the order in which they were attached.
class RunObservers {
 public:
  void add(std::shared_ptr<RunObserver> observer) { all_.push_back(std::move(observer)); }
  /// False if one of them ends the run.
  [[nodiscard]] bool go_on() const {
    for (const auto& observer : all_)
      if (!observer->may_continue()) return false;
    return true;
  }
  template <class... Parameters, class... Arguments>
  void tell(void (RunObserver::*event)(Parameters...), const Arguments&... arguments) const {
    for (const auto& observer : all_) ((*observer).*event)(arguments...);
  }
  [[nodiscard]] const std::vector<std::shared_ptr<RunObserver>>& all() const { return all_; }

 private:
  std::vector<std::shared_ptr<RunObserver>> all_;
};

}  // namespace ashlar
