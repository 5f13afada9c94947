#include "apps/run/run_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <ostream>
#include <string_view>

#include "apps/command_line.hpp"
#include "apps/results/atomic_file.hpp"
#include "apps/results/json_text.hpp"
#include "apps/results/result_folder.hpp"
#include "apps/run/checkpoint_schedule.hpp"
#include "apps/run/factor_analysis.hpp"
#include "apps/run/folder_claim.hpp"
#include "apps/run/initial_state.hpp"
#include "apps/run/interrupt_guard.hpp"
#include "apps/run/loose_blocks.hpp"
#include "apps/run/progress.hpp"
#include "apps/run/run_checkpoint.hpp"
#include "apps/run/run_messages.hpp"
#include "apps/run/run_summary.hpp"
#include "apps/run/space_reserve.hpp"
#include "apps/scene/base_motion.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_stages.hpp"
#include "apps/view/view_file.hpp"

namespace ashlar {
namespace {

constexpr const char* checkpoint_name = "checkpoint";
constexpr const char* trials_name = "factor_trials.json";

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ProgressState progress_of(const Simulation& simulation) {
  const StepReport& report = simulation.report();
  return {simulation.steps(), simulation.time(), report.step, report.locked + report.sliding,
          report.iterations};
}

std::filesystem::path result_folder_of(const RunOptions& options) {
  if (options.out) return *options.out;
  if (options.scene == "-") return "stdin.out";
  return options.scene.stem().string() + ".out";
}

int exit_status_of(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
    case RunStatus::equilibrium:
    case RunStatus::moving:  // a mechanism found is an answer
      return exit_status::done;
    case RunStatus::failed:
    case RunStatus::not_converged:
      return exit_status::failed;
    case RunStatus::interrupted:
      return exit_status::interrupted;
  }
  return exit_status::failed;
}

/// @throws std::runtime_error if blocks cannot be built
BuiltSimulation built_or_thrown(const LoadedScene& loaded, int threads) {
  Diagnostics diagnostics;
  std::optional<BuiltSimulation> built = build_simulation(loaded, threads, diagnostics);
  if (built) return std::move(*built);
  const std::vector<Diagnostic> faults = diagnostics.sorted();
  throw std::runtime_error(faults.empty() ? "blocks cannot be built" : to_string(faults.front()));
}

/// A run from its first step, or from a checkpoint, to its end: one stage after the other.
class Run {
 public:
  /// @param built of the stage that the run begins or goes on in
  /// @param interval s between checkpoints; empty: growing, see CheckpointSchedule
  /// @param bracket of a search for a factor, whose motion this run shows
  Run(const LoadedScene& loaded, int threads, BuiltSimulation built, const FolderClaim& claim,
      const std::optional<RunCheckpoint>& earlier, std::optional<double> interval,
      std::optional<FactorBracket> bracket)
      : loaded_(loaded),
        threads_(threads),
        stages_(earlier ? earlier->stages : std::vector<FinishedStage>()),
        scene_(scene_of_stage(loaded.scene, stages_.size())),
        bracket_(std::move(bracket)),
        hash_(scene_hash(loaded)),
        built_(std::move(built)),
        claim_(claim),
        interval_(interval),
        reserve_(claim.folder()),
        folder_(earlier ? ResultFolder(claim.folder(), loaded.scene, built_.simulation, earlier->folder)
                        : ResultFolder(claim.folder(), loaded.scene, built_.simulation)) {
    if (earlier) earlier_seconds_ = earlier->seconds;
  }

  /// Steps until the end, an interrupt or a failure. @param start wall time at which the program began, s
  RunEnd go(double start, bool quiet, std::ostream& err) {
    seconds_.setup = seconds_now() - start;
    RunStatus status = RunStatus::failed;
    try {
      save(start);
      status = go_through_stage(start, quiet, err);
      while (is_done(status) && stages_.size() + 1 < stage_count(loaded_.scene)) {
        if (!quiet) err << end_of_stage(status) << '\n';
        begin_next_stage(status);
        save(start);
        status = go_through_stage(start, quiet, err);
      }
    } catch (const std::exception& error) {
      status = saved_after(error, start);
    }
    status = summarised(status, start);
    return {status, message_, unsaved_};
  }

  [[nodiscard]] const Simulation& simulation() const { return built_.simulation; }
  [[nodiscard]] LargestValues largest() const { return folder_.largest(built_.simulation); }

 private:
  /// Whether a stage has come to its end.
  static bool is_done(RunStatus status) {
    return status == RunStatus::completed || status == RunStatus::equilibrium;
  }

  RunStatus go_through_stage(double start, bool quiet, std::ostream& err) {
    ProgressLine progress(scene_.analysis.end_time, quiet, err);
    RunStatus status =
        is_static(scene_.analysis) ? find_equilibrium(start, progress) : take_steps(start, progress);
    // Before the last frame, which a run that goes on has only if it is due.
    save(start);
    if (status == RunStatus::completed) status = audited();
    if (bracket_) status = answered(status);
    folder_.add_end(built_.simulation);
    return status;
  }

  [[nodiscard]] std::string end_of_stage(RunStatus status) const {
    return fmt::format("stage {}: {} after {} steps{}{}", loaded_.scene.stage[stages_.size()].name,
                       to_string(status), built_.simulation.steps(), message_.empty() ? "" : ": ", message_);
  }

  [[nodiscard]] FinishedStage finished(RunStatus status) const {
    return {to_string(status), message_, built_.simulation.steps(), built_.simulation.time()};
  }

  /// @throws std::runtime_error if its blocks cannot be built, which those of the whole scene could
  void begin_next_stage(RunStatus status) {
    const SimulationSnapshot end = built_.simulation.snapshot();
    const std::vector<bool> was_absent = built_.simulation.system().absent();
    stages_.push_back(finished(status));
    message_.clear();
    const LoadedScene next = stage_of(loaded_, stages_.size());
    built_ = built_or_thrown(next, threads_);
    built_.simulation.start_stage(end, was_absent);
    scene_ = next.scene;
    double elapsed = 0.0;
    for (const FinishedStage& stage : stages_) elapsed += stage.time;
    folder_.begin_stage(built_.simulation, elapsed, loaded_.scene.stage[stages_.size()].reset_displacement);
  }

  RunStatus take_steps(double start, ProgressLine& progress) {
    Simulation& simulation = built_.simulation;
    const double end_time = scene_.analysis.end_time;
    CheckpointSchedule schedule(interval_, seconds_now());
    while (!simulation.reached(end_time)) {
      if (InterruptGuard::interrupted()) return interrupted_here();
      StepStatus status = StepStatus::accepted;
      try {
        status = simulation.step(end_time);
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
      record_step(start, schedule, progress);
    }
    return RunStatus::completed;
  }

  /// Whether blocks are where they may be at the end. After the run is saved: one that goes on has no end
  /// here.
  RunStatus audited() {
    Simulation& simulation = built_.simulation;
    const auto deep = simulation.audit();
    if (!deep) return RunStatus::completed;
    message_ = fmt::format("the run ended at t = {:.9g} s with blocks too deep in each other: {}",
                           simulation.time(), description_of(*deep, simulation));
    return RunStatus::failed;
  }

  /// Of a search for a factor: what was found, once its motion has been shown.
  RunStatus answered(RunStatus status) {
    if (status == RunStatus::interrupted) return status;
    const std::string motion = status == RunStatus::moving ? "; " + message_ : "";
    message_ = describe(*bracket_, scene_.analysis) + motion;
    return bracket_->resolved ? RunStatus::completed : RunStatus::not_converged;
  }

  RunStatus find_equilibrium(double start, ProgressLine& progress) {
    Simulation& simulation = built_.simulation;
    CheckpointSchedule schedule(interval_, seconds_now());
    while (!InterruptGuard::interrupted()) {
      const int before = simulation.steps();
      StaticStatus status = StaticStatus::balancing;
      try {
        status = bracket_ ? trial_step(simulation, scene_.analysis.end_time)
                          : simulation.static_step(scene_.analysis.end_time);
      } catch (const std::exception& error) {
        return failed_in_step(error);
      }
      if (simulation.steps() > before) record_step(start, schedule, progress);
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
          message_ = fmt::format("no equilibrium was found in {} iterations under the loads at t = {} s",
                                 simulation.steps(), simulation.time());
          return RunStatus::not_converged;
      }
    }
    return interrupted_here();
  }

  /// What no check of the scene foresaw: the state is that before the step.
  RunStatus failed_in_step(const std::exception& error) {
    message_ = fmt::format("step {} at t = {:.9g} s cannot be taken: {}", built_.simulation.steps() + 1,
                           built_.simulation.time(), error.what());
    return RunStatus::failed;
  }

  RunStatus interrupted_here() {
    message_ = fmt::format("interrupted after step {}", built_.simulation.steps());
    if (!is_static(scene_.analysis))
      message_ +=
          fmt::format(" at t = {:.9g} s of {:.9g} s", built_.simulation.time(), scene_.analysis.end_time);
    return RunStatus::interrupted;
  }

  void record_step(double start, CheckpointSchedule& schedule, ProgressLine& progress) {
    const double before = seconds_now();
    claim_.check();
    folder_.add_step(built_.simulation);
    progress.update(progress_of(built_.simulation));
    if (schedule.due(before)) {
      save(start);
      schedule.saved(seconds_now());
    }
    seconds_.output += seconds_now() - before;
  }

  void save(double start) {
    write_state(start);
    // The next state, which may have more contacts, and the summary fit in beside the state that is there.
    constexpr std::uintmax_t states = 4, scenes = 2, rest = 1U << 18U;
    reserve_.hold(states * state_bytes_ + scenes * scene_bytes_ + rest);
  }

  void write_state(double start) {
    claim_.check();
    state_bytes_ = write_checkpoint(
        folder_.path() / checkpoint_name, hash_,
        {built_.simulation.snapshot(), stages_, folder_.synced_state(), seconds_until_now(start)});
  }

  /// After results could not be written, e.g. on a full disk: saves the state in the space that was kept.
  RunStatus saved_after(const std::exception& error, double start) {
    message_ = fmt::format("results of step {} at t = {:.9g} s could not be written: {}",
                           built_.simulation.steps(), built_.simulation.time(), error.what());
    reserve_.release();
    try {
      write_state(start);
    } catch (const std::exception& fault) {
      unsaved_ = fault.what();
    }
    return RunStatus::failed;
  }

  RunStatus summarised(RunStatus status, double start) {
    const auto write = [&] {
      claim_.check();
      auto summary = run_summary(loaded_.scene, built_, status, message_, seconds_until_now(start),
                                 folder_.frames(), folder_.largest(built_.simulation));
      if (!loaded_.scene.stage.empty()) summary["stages"] = stages_summary(status);
      if (bracket_) summary[factor_name(scene_.analysis)] = factor_summary(*bracket_, built_.simulation);
      write_file_atomically(folder_.path() / "summary.json", json_text(summary, 2) + "\n",
                            Durability::process);
    };
    try {
      write();
    } catch (const std::exception& error) {
      status = RunStatus::failed;
      if (message_.empty()) message_ = fmt::format("the summary could not be written: {}", error.what());
      reserve_.release();
      try {
        write();
      } catch (const std::exception& fault) {
        if (unsaved_.empty()) unsaved_ = fault.what();
      }
    }
    return status;
  }

  /// Stages that have begun.
  [[nodiscard]] nlohmann::ordered_json stages_summary(RunStatus status) const {
    std::vector<FinishedStage> begun = stages_;
    begun.push_back(finished(status));
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < begun.size(); ++k) {
      nlohmann::ordered_json stage = {{"name", loaded_.scene.stage[k].name}, {"status", begun[k].status}};
      if (!begun[k].message.empty()) stage["message"] = begun[k].message;
      stage["steps"] = begun[k].steps;
      stage["time"] = begun[k].time;
      list.push_back(std::move(stage));
    }
    return list;
  }

  [[nodiscard]] RunSeconds seconds_until_now(double start) const {
    return {earlier_seconds_.total + seconds_now() - start, earlier_seconds_.setup + seconds_.setup,
            earlier_seconds_.output + seconds_.output};
  }

  const LoadedScene& loaded_;
  int threads_;
  std::vector<FinishedStage> stages_;  ///< those before the present one
  Scene scene_;                        ///< of the present stage
  std::optional<FactorBracket> bracket_;
  std::uint64_t hash_;
  BuiltSimulation built_;
  const FolderClaim& claim_;
  std::optional<double> interval_;
  SpaceReserve reserve_;
  ResultFolder folder_;
  std::uintmax_t scene_bytes_ = json_text(to_json(loaded_.scene), 2).size();  ///< in the summary
  std::uintmax_t state_bytes_ = 0;                                            ///< of the last checkpoint
  RunSeconds earlier_seconds_;
  RunSeconds seconds_;
  std::string message_;
  std::string unsaved_;
};

/// The checkpoint a run goes on from; a fault that keeps it from doing so is reported at the file.
std::optional<RunCheckpoint> find_checkpoint(const std::filesystem::path& folder, const LoadedScene& loaded,
                                             Diagnostics& diagnostics) {
  const std::filesystem::path path = folder / checkpoint_name;
  try {
    return read_checkpoint(path, scene_hash(loaded));
  } catch (const OtherSceneError& error) {
    diagnostics.error({path.string()}, error.what() + changed_keys(folder, loaded.scene));
    return std::nullopt;
  } catch (const CheckpointError& error) {
    diagnostics.error({path.string()}, error.what());
    return std::nullopt;
  }
}

/// Whether a search for a factor was ended before its motion was shown.
bool is_in_search(const std::filesystem::path& folder, const Scene& scene) {
  return seeks_factor(scene.analysis) && std::filesystem::exists(folder / trials_name) &&
         !std::filesystem::exists(folder / checkpoint_name);
}

/// Looks for the scene's factor. What earlier trials in the folder found counts.
FactorBracket seek_factor(const LoadedScene& loaded, const RunOptions& options, const FolderClaim& claim,
                          std::ostream& err) {
  TrialFile known(claim.folder() / trials_name, scene_hash(loaded), options.resume);
  const auto attempt = [&](double factor) {
    std::optional<FactorTrial> trial = known.find(factor);
    if (!trial) {
      trial = run_trial(loaded, std::max(options.threads, 1), factor,
                        [] { return !InterruptGuard::interrupted(); });
      if (!trial) return trial;
      claim.check();
      known.add(*trial);
    }
    if (!options.quiet)
      err << fmt::format("factor {:.5g}: {} ({} iterations)\n", factor, to_string(trial->outcome),
                         trial->iterations);
    return trial;
  };
  return find_factor(search_of(loaded.scene.analysis), attempt);
}

/// The folder for this run alone. @return null: refused, and told why
std::unique_ptr<FolderClaim> claim_folder(const std::filesystem::path& folder, const RunOptions& options,
                                          std::ostream& err) {
  const ClaimPurpose purpose = options.resume  ? ClaimPurpose::resume
                               : options.force ? ClaimPurpose::replacement
                                               : ClaimPurpose::new_run;
  try {
    auto claim = std::make_unique<FolderClaim>(folder, purpose);
    if (!claim->unlocked().empty()) {
      err << fmt::format(
          "ashlar: warning: {} cannot be locked ({}): a second run into it would not be noticed\n",
          folder.string(), claim->unlocked());
    }
    return claim;
  } catch (const ClaimRefused& refused) {
    err << "ashlar: error: " << refused.what() << '\n';
    return nullptr;
  }
}

}  // namespace

int run_command(const RunOptions& options, std::ostream& err) {
  const double start = seconds_now();
  const std::filesystem::path folder = result_folder_of(options);
  Diagnostics diagnostics;
  const int threads = std::max(options.threads, 1);
  std::optional<LoadedScene> loaded, staged;
  const LoadedScene* first = nullptr;  // of its stages, or the whole
  std::optional<BuiltSimulation> built;
  {
    Preparation preparation(options.quiet, err);
    loaded = load_scene(options.scene, options.overrides, diagnostics, &preparation);
    if (loaded) first = loaded->scene.stage.empty() ? &*loaded : &staged.emplace(stage_of(*loaded, 0));
    if (first != nullptr) built = build_simulation(*first, threads, diagnostics, &preparation);
    if (built && is_static(first->scene.analysis))
      refuse_loose_blocks(first->scene, built->simulation, diagnostics);
  }
  // Where there is nothing to go on from, nothing is made.
  const bool resumes = options.resume && !(loaded && is_in_search(folder, loaded->scene));
  if (built && resumes && !std::filesystem::exists(folder / checkpoint_name))
    (void)find_checkpoint(folder, *loaded, diagnostics);
  diagnostics.print(err);
  if (!diagnostics.good()) return exit_status::bad_input;
  const InterruptGuard guard;
  const std::unique_ptr<FolderClaim> claim = claim_folder(folder, options, err);
  if (!claim) return exit_status::bad_input;
  std::optional<RunCheckpoint> earlier;
  if (resumes) {
    Diagnostics faults;
    earlier = find_checkpoint(folder, *loaded, faults);
    faults.print(err);
    if (!faults.good()) return exit_status::bad_input;
    if (!earlier->stages.empty()) built = built_or_thrown(stage_of(*loaded, earlier->stages.size()), threads);
    built->simulation.restore(earlier->simulation);
  }
  if (!options.quiet) {
    tell_choices(*built, err);
    err << to_string(loaded->cost, loaded->scene.block.size()) << '\n';
    for (const std::string& line : loaded->scene.notes) err << line << '\n';
    for (const std::string& line : motion_left(loaded->scene)) err << line << '\n';
  }
  if (starts_from_statics(first->scene) && !earlier) {
    const StaticStart statics =
        start_in_statics(built->simulation, [] { return !InterruptGuard::interrupted(); });
    if (!statics.message.empty()) err << "ashlar: " << statics.message << '\n';
    if (statics.end == StaticStart::End::failed) return exit_status::failed;
    if (statics.end == StaticStart::End::interrupted) return exit_status::interrupted;
  }
  std::optional<Run> started;
  try {
    std::optional<FactorBracket> bracket;
    if (seeks_factor(loaded->scene.analysis)) {
      bracket = seek_factor(*loaded, options, *claim, err);
      if (bracket->interrupted) {
        err << fmt::format(
            "ashlar: interrupted after {} static analyses; they are in {}, the same command with "
            "--resume goes on\n",
            bracket->trials.size(), folder.string());
        return exit_status::interrupted;
      }
      Diagnostics ignored;
      const double shown = shown_factor(*bracket, search_of(loaded->scene.analysis));
      built =
          build_simulation(*loaded, threads, ignored, nullptr, trial_factors(loaded->scene.analysis, shown));
      if (earlier) built->simulation.restore(earlier->simulation);
    }
    started.emplace(*loaded, threads, std::move(*built), *claim, earlier, options.checkpoint,
                    std::move(bracket));
  } catch (const std::exception& error) {
    // A folder that cannot be written, or results that are not those of the checkpoint: nothing has run.
    err << "ashlar: error: " << error.what() << '\n';
    return exit_status::bad_input;
  }
  Run& run = *started;
  const RunEnd end = run.go(start, options.quiet, err);
  tell_end(end, folder, options.quiet, err);
  if (!options.quiet) tell_answers(run.simulation(), run.largest(), err);
  warn_of_depth(run.simulation(), err);
  warn_of_friction(run.simulation(), err);
  if (options.view) {
    (void)write_view_file(folder, folder / "view.html");
    if (!options.quiet) err << fmt::format("view: {}\n", (folder / "view.html").string());
  }
  return exit_status_of(end.status);
}

}  // namespace ashlar
