#include "apps/run/folder_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <ostream>
#include <system_error>

#include "apps/results/folder/contact_changes.hpp"
#include "apps/run/factor_analysis.hpp"
#include "apps/run/interrupt_guard.hpp"
#include "apps/run/movement_run.hpp"
#include "apps/scene/check/added_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

/// True if a stage has come to its end.
bool is_done(RunStatus status) {
  return status == RunStatus::completed || status == RunStatus::equilibrium;
}

ProgressState progress_of(const Simulation& simulation) {
  const StepReport& report = simulation.report();
  return {simulation.steps(), simulation.time(), report.step, report.locked + report.sliding,
          report.iterations};
}

}  // namespace

BuiltSimulation built_or_thrown(const LoadedScene& stage, int threads) {
  Diagnostics diagnostics;
  std::optional<BuiltSimulation> built = build_simulation(stage, threads, diagnostics);
  if (built) return std::move(*built);
  const std::vector<Diagnostic> faults = diagnostics.sorted();
  throw std::runtime_error(faults.empty() ? "blocks cannot be built" : to_string(faults.front()));
}

FolderRun::FolderRun(const LoadedScene& loaded, const RunManner& manner, RunStart start,
                     const FolderClaim& claim)
    : loaded_(loaded),
      manner_(manner),
      stages_(start.earlier != nullptr ? start.earlier->stages : std::vector<FinishedStage>()),
      scene_(scene_of_stage(loaded.scene, stages_.size())),
      bracket_(std::move(start.bracket)),
      limits_(std::move(start.limits)),
      thrust_(std::move(start.thrust)),
      built_(std::move(start.built)),
      files_(loaded, std::move(start.identity), claim, built_.simulation, start.earlier, start.began),
      saved_(start.earlier != nullptr) {
  if (start.earlier != nullptr) changes_ = start.earlier->changes;
}

RunEnd FolderRun::go(std::ostream& err) {
  files_.note_setup();
  RunStatus status = RunStatus::failed;
  try {
    save();
    status = go_through_stage(err);
    while (is_done(status) && stages_.size() + 1 < stage_count(loaded_.scene)) {
      if (!manner_.quiet) err << end_of_stage(status) << '\n';
      status = begin_next_stage(status) ? go_through_stage(err) : RunStatus::failed;
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    status = saved_after(error);
  }
  status = summarised(status);
  return {status, message_, unsaved_};
}

void FolderRun::save() {
  files_.save(built_.simulation.snapshot(), stages_, changes_);
  saved_ = true;
}

RunStatus FolderRun::go_through_stage(std::ostream& err) {
  ProgressLine progress(scene_.analysis.end_time, manner_.quiet, err);
  RunStatus status = limits_ && !bracket_         ? show_limits(progress)
                     : thrust_                    ? show_thrust(progress)
                     : is_static(scene_.analysis) ? find_equilibrium(progress)
                                                  : take_steps(progress);
  // Before the last frame, which a continued run has only if it is due.
  save();
  if (status == RunStatus::completed && !drawn_only()) status = audited();
  if (bracket_) status = answered(status);
  files_.tables().add_end(built_.simulation);
  return status;
}

std::string FolderRun::end_of_stage(RunStatus status) const {
  return fmt::format("stage {}: {} after {} steps{}{}", loaded_.scene.stage[stages_.size()].name,
                     to_string(status), built_.simulation.steps(), message_.empty() ? "" : ": ", message_);
}

FinishedStage FolderRun::finished(RunStatus status) const {
  return {to_string(status), message_, built_.simulation.steps(), built_.simulation.time()};
}

/// @return false if added blocks overlap others: the run stays at the end of the last stage
/// @throws std::runtime_error if its blocks cannot be built although those of the whole scene could
bool FolderRun::begin_next_stage(RunStatus status) {
  const std::vector<bool> was_absent = built_.simulation.system().absent();
  const LoadedScene next = stage_of(loaded_, stages_.size() + 1);
  BuiltSimulation built = built_or_thrown(next, manner_.threads);
  built.simulation.start_stage(built_.simulation.snapshot(), was_absent);
  if (const auto overlap = overlap_of_added(built.simulation, was_absent)) {
    message_ =
        fmt::format("stage {} cannot begin: {}", loaded_.scene.stage[stages_.size() + 1].name, *overlap);
    return false;
  }
  stages_.push_back(finished(status));
  message_.clear();
  changes_.forget();
  built_ = std::move(built);
  scene_ = next.scene;
  double elapsed = 0.0;
  for (const FinishedStage& stage : stages_) elapsed += stage.time;
  files_.tables().begin_stage(built_.simulation, elapsed,
                              loaded_.scene.stage[stages_.size()].reset_displacement);
  save();
  return true;
}

RunStatus FolderRun::take_steps(ProgressLine& progress) {
  Simulation& simulation = built_.simulation;
  const double end_time = scene_.analysis.end_time;
  CheckpointSchedule schedule(manner_.checkpoint_interval, seconds_now());
  while (!simulation.reached(end_time)) {
    if (InterruptGuard::interrupted()) return interrupted_here();
    StepStatus status = StepStatus::accepted;
    try {
      status = simulation.step(end_time);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      return failed_in_step(error);
    }
    if (status != StepStatus::accepted) {
      const Rejection& last = simulation.rejections().back();
      message_ =
          fmt::format("step {} at t = {:.9g} s was rejected down to a time step of {:.3g} s: {}",
                      simulation.steps() + 1, simulation.time(), last.step, reason_of(last, simulation));
      return RunStatus::failed;
    }
    record_step(schedule, progress);
  }
  return RunStatus::completed;
}

/// Audits depths at the end. After the run is saved, as a continued one has no end here.
RunStatus FolderRun::audited() {
  Simulation& simulation = built_.simulation;
  const auto deep = simulation.audit();
  if (!deep) return RunStatus::completed;
  message_ = fmt::format("the run ended at t = {:.9g} s with blocks too deep in each other: {}",
                         simulation.time(), description_of(*deep, simulation));
  return RunStatus::failed;
}

/// For a search for a factor: its result, once its motion has been shown.
RunStatus FolderRun::answered(RunStatus status) {
  if (status == RunStatus::interrupted) return status;
  const std::string motion = status == RunStatus::moving ? "; " + message_ : "";
  message_ = describe(*bracket_, scene_.analysis) + motion;
  return bracket_->resolved ? RunStatus::completed : RunStatus::not_converged;
}

/// The result of limit analysis: the onset of motion is drawn.
RunStatus FolderRun::show_limits(ProgressLine& progress) {
  Simulation& simulation = built_.simulation;
  if (simulation.steps() == 0) {
    simulation.displace(drawn_motion(limits_->released, simulation));
    CheckpointSchedule schedule(manner_.checkpoint_interval, seconds_now());
    record_step(schedule, progress);
  }
  message_ = describe(*limits_, scene_.analysis, simulation);
  return limits_->answer.released.resolved ? RunStatus::completed : RunStatus::not_converged;
}

RunStatus FolderRun::show_thrust(ProgressLine& progress) {
  Simulation& simulation = built_.simulation;
  if (simulation.steps() == 0) {
    simulation.displace({});
    CheckpointSchedule schedule(manner_.checkpoint_interval, seconds_now());
    record_step(schedule, progress);
  }
  draw_thrust(*thrust_, scene_, simulation, files_.tables().path() / "thrust.svg");
  draw_movement(thrust_->movements, scene_, simulation, files_.tables().path() / "movement.svg");
  message_ = describe(*thrust_, simulation);
  if (!thrust_->collapse.empty()) return RunStatus::moving;
  const bool known = std::none_of(thrust_->movements.begin(), thrust_->movements.end(),
                                  [](const SupportMovement& movement) { return is_open(movement); });
  return thrust_->supports.empty() || !known ? RunStatus::not_converged : RunStatus::completed;
}

RunStatus FolderRun::find_equilibrium(ProgressLine& progress) {
  Simulation& simulation = built_.simulation;
  CheckpointSchedule schedule(manner_.checkpoint_interval, seconds_now());
  while (!InterruptGuard::interrupted()) {
    const int before = simulation.steps();
    StaticStatus status = StaticStatus::balancing;
    try {
      status = bracket_ ? trial_step(simulation, scene_.analysis.end_time)
                        : simulation.static_step(scene_.analysis.end_time);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      return failed_in_step(error);
    }
    if (simulation.steps() > before) {
      changes_.note(simulation);
      record_step(schedule, progress);
    }
    switch (status) {
      case StaticStatus::balancing:
        continue;
      case StaticStatus::equilibrium:
        message_ = describe_displaced(simulation);
        return RunStatus::equilibrium;
      case StaticStatus::moving:
        message_ = describe_motion(simulation);
        return RunStatus::moving;
      case StaticStatus::not_converged:
        message_ = describe_unconverged(simulation, changes_);
        return RunStatus::not_converged;
    }
  }
  return interrupted_here();
}

/// A fault that no check of the scene detected: the state is that before the step.
RunStatus FolderRun::failed_in_step(const std::exception& error) {
  message_ = fmt::format("step {} at t = {:.9g} s cannot be taken: {}", built_.simulation.steps() + 1,
                         built_.simulation.time(), error.what());
  return RunStatus::failed;
}

RunStatus FolderRun::interrupted_here() {
  message_ = fmt::format("interrupted after step {}", built_.simulation.steps());
  if (!is_static(scene_.analysis))
    message_ +=
        fmt::format(" at t = {:.9g} s of {:.9g} s", built_.simulation.time(), scene_.analysis.end_time);
  return RunStatus::interrupted;
}

void FolderRun::record_step(CheckpointSchedule& schedule, ProgressLine& progress) {
  const double before = seconds_now();
  files_.add_step(built_.simulation);
  progress.update(progress_of(built_.simulation));
  if (schedule.due(before)) {
    save();
    schedule.saved(seconds_now());
  } else if (files_.outgrown(built_.simulation)) {
    try {
      save();
    } catch (const std::system_error&) {
      // The reserve was for later; the failure to write the last files is reported at the end.
    }
  }
  files_.add_output_seconds(seconds_now() - before);
}

/// After results could not be written, e.g. on a full disk.
RunStatus FolderRun::saved_after(const std::exception& error) {
  message_ = fmt::format("results of step {} at t = {:.9g} s could not be written: {}",
                         built_.simulation.steps(), built_.simulation.time(), fault_text(error));
  try {
    files_.save_in_reserve(built_.simulation.snapshot(), stages_, changes_);
  } catch (const std::exception& fault) {
    unsaved_ = fault_text(fault);
  }
  return RunStatus::failed;
}

RunStatus FolderRun::summarised(RunStatus status) {
  try {
    files_.write_summary(summary_of(status));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    status = RunStatus::failed;
    if (message_.empty()) message_ = fmt::format("the summary could not be written: {}", fault_text(error));
    try {
      files_.write_summary_in_reserve(summary_of(status));
    } catch (const std::exception& fault) {
      if (unsaved_.empty()) unsaved_ = fault_text(fault);
    }
  }
  return status;
}

nlohmann::ordered_json FolderRun::summary_of(RunStatus status) const {
  std::vector<FinishedStage> begun;
  if (!loaded_.scene.stage.empty()) {
    begun = stages_;
    begun.push_back(finished(status));
  }
  auto summary = run_summary(
      loaded_.scene, files_.identity(), built_,
      {status, message_, files_.seconds(), files_.tables().frames(), largest(), std::move(begun)});
  if (thrust_) summary["thrust"] = thrust_summary(*thrust_, built_.simulation);
  if (bracket_) {
    summary[factor_name(scene_.analysis)] = factor_summary(*bracket_, built_.simulation);
    if (limits_) summary[factor_name(scene_.analysis)]["limit"] = limit_summary(*limits_, built_.simulation);
  } else if (limits_) {
    summary[factor_name(scene_.analysis)] = limit_summary(*limits_, built_.simulation);
  }
  return summary;
}

}  // namespace ashlar
