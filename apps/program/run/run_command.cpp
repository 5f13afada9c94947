#include "apps/program/run/run_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <new>
#include <optional>
#include <ostream>

#include "apps/program/command_line.hpp"
#include "apps/program/run/contact_report.hpp"
#include "apps/program/view/view_file.hpp"
#include "apps/run/factor_analysis.hpp"
#include "apps/run/folder_run.hpp"
#include "apps/run/interrupt_guard.hpp"
#include "apps/run/kept_trial.hpp"
#include "apps/run/limit_run.hpp"
#include "apps/run/movement_run.hpp"
#include "apps/run/run_messages.hpp"
#include "apps/scene/build/initial_state.hpp"
#include "apps/scene/check/base_motion.hpp"
#include "apps/scene/check/loose_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "solver/state/step_clock.hpp"

namespace ashlar {
namespace {

std::filesystem::path result_folder_of(const RunOptions& options) {
  if (options.out) return *options.out;
  if (options.scene == "-") return "stdin.out";
  return options.scene.stem().string() + ".out";
}

int exit_status_of(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
    case RunStatus::equilibrium:
    case RunStatus::moving:  // a mechanism is a result
      return exit_status::done;
    case RunStatus::failed:
    case RunStatus::not_converged:
      return exit_status::failed;
    case RunStatus::interrupted:
      return exit_status::interrupted;
  }
  return exit_status::failed;
}

/// The checkpoint that a run continues from. A fault that prevents it is reported at the file.
std::optional<RunCheckpoint> find_checkpoint(const std::filesystem::path& folder, const LoadedScene& loaded,
                                             const SceneIdentity& identity, Diagnostics& diagnostics) {
  const std::filesystem::path path = folder / checkpoint_name;
  try {
    return read_checkpoint(path, identity.scene);
  } catch (const OtherSceneError& error) {
    diagnostics.error({path.string()}, error.what() + changes_since(folder, loaded.scene, identity));
    return std::nullopt;
  } catch (const CheckpointError& error) {
    diagnostics.error({path.string()}, error.what());
    return std::nullopt;
  }
}

/// True if a search for a factor was interrupted before its motion was shown.
bool is_in_search(const std::filesystem::path& folder, const Scene& scene) {
  return seeks_factor(scene.analysis) &&
         (std::filesystem::exists(folder / trials_name) ||
          std::filesystem::exists(folder / trial_state_name)) &&
         !std::filesystem::exists(folder / checkpoint_name);
}

/// Bounds found by limit analysis; empty if one of them is unknown.
std::optional<ExpectedFactor> expected_factor(const std::optional<LimitFindings>& limits) {
  if (!limits || !limits->answer.released.resolved) return std::nullopt;
  const LimitBracket& released = limits->answer.released;
  if (!released.lower || !released.upper) return std::nullopt;
  return ExpectedFactor{*released.lower, *released.upper};
}

/// Searches for the scene's factor by static analyses. Earlier trials in the folder are used.
FactorBracket seek_factor(const LoadedScene& loaded, std::uint64_t scene, const RunOptions& options,
                          const FolderClaim& claim, const std::optional<ExpectedFactor>& expected,
                          std::ostream& err) {
  TrialFile known(claim.folder() / trials_name, scene, options.resume);
  KeptTrial kept(loaded, scene, claim.folder(),
                 {std::max(options.threads, 1), options.checkpoint, options.quiet});
  if (!options.resume) kept.forget();
  const auto attempt = [&](double factor) {
    std::optional<FactorTrial> trial = known.find(factor);
    std::string reason;
    if (!trial) {
      trial = kept.run(
          factor, [] { return !InterruptGuard::interrupted(); }, err);
      if (!trial) {
        err << fmt::format("factor {:.5g}: stopped after {} iterations\n", factor, kept.iterations());
        return trial;
      }
      if (!kept.reason().empty()) reason = ": " + kept.reason();
      claim.check();
      known.add(*trial);
      kept.forget();
    }
    if (!options.quiet)
      err << fmt::format("factor {:.5g}: {} ({} iterations){}\n", factor, to_string(trial->outcome),
                         trial->iterations, reason);
    return trial;
  };
  return find_factor(search_of(loaded.scene.analysis), attempt, expected);
}

/// Claims the folder for this run. @return null if it was refused, which is reported
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

/// A run before its first step.
struct PreparedRun {
  std::optional<LoadedScene> loaded;     ///< the whole scene
  SceneIdentity identity;                ///< of that
  std::optional<LoadedScene> staged;     ///< its first stage, if it has any
  std::optional<BuiltSimulation> built;  ///< of the stage in which the run begins or continues
  std::optional<RunCheckpoint> earlier;  ///< checkpoint that it continues from
  std::optional<PairKey> explained;      ///< blocks whose contacts are explained at the end

  /// The scene that the run starts with. @pre it is loaded
  [[nodiscard]] const LoadedScene& first() const { return staged ? *staged : *loaded; }
};

/// Refuses searches by limit analysis with nothing to find.
void refuse_idle_searches(const Scene& scene, const Simulation& simulation, Diagnostics& diagnostics) {
  const std::optional<RigidModel> model = limit_model(scene, simulation);
  refuse_idle_limits(scene, model, diagnostics);
  refuse_movements(scene, model, diagnostics);
}

/// Reads, checks and builds. Faults go to the diagnostics.
PreparedRun prepare(const RunOptions& options, int threads, Diagnostics& diagnostics, std::ostream& err) {
  PreparedRun run;
  Preparation preparation(options.quiet, err);
  run.loaded = options.text ? load_scene_text(*options.text, options.scene, options.overrides, diagnostics,
                                              &preparation)
                            : load_scene(options.scene, options.overrides, diagnostics, &preparation);
  if (!run.loaded) return run;
  run.identity = scene_identity(*run.loaded);
  if (!run.loaded->scene.stage.empty()) run.staged = stage_of(*run.loaded, 0);
  run.built = build_simulation(run.first(), threads, diagnostics, &preparation);
  if (run.built && is_static(run.first().scene.analysis))
    refuse_loose_blocks(run.first().scene, run.built->simulation, diagnostics);
  if (run.built && diagnostics.good())
    refuse_idle_searches(run.first().scene, run.built->simulation, diagnostics);
  if (run.built && !options.explained_pair.empty())
    run.explained = pair_by_names(options.explained_pair, run.built->simulation, diagnostics);
  return run;
}

/// @return false if the checkpoint cannot be continued, which is reported
bool go_on_from_checkpoint(PreparedRun& run, const std::filesystem::path& folder, int threads,
                           std::ostream& err) {
  Diagnostics faults;
  run.earlier = find_checkpoint(folder, *run.loaded, run.identity, faults);
  faults.print(err);
  if (!faults.good()) return false;
  if (!run.earlier->stages.empty())
    run.built = built_or_thrown(stage_of(*run.loaded, run.earlier->stages.size()), threads);
  Simulation& simulation = run.built->simulation;
  simulation.restore(run.earlier->simulation);
  const SceneAnalysis analysis = scene_of_stage(run.loaded->scene, run.earlier->stages.size()).analysis;
  const double end_time = analysis.end_time;
  if (simulation.time() - end_time <= time_rounding(analysis.time_step, end_time)) return true;
  err << fmt::format(
      "ashlar: error: end_time ({} s) is before the time that the run has reached ({} s), a later "
      "one, or a new folder, is needed\n",
      end_time, simulation.time());
  return false;
}

void tell_beginning(const PreparedRun& run, std::ostream& err) {
  tell_choices(*run.built, err);
  const Scene& scene = run.loaded->scene;
  err << to_string(run.loaded->cost, scene.block.size()) << '\n';
  for (const std::string& line : scene.notes) err << line << '\n';
  for (const std::string& line : motion_left(scene)) err << line << '\n';
}

/// Finds the equilibrium that a motion starts from. @return an exit status if the run ends with it
std::optional<int> start_statically(PreparedRun& run, std::ostream& err) {
  if (!starts_from_statics(run.first().scene) || run.earlier) return std::nullopt;
  const StaticStart statics =
      start_in_statics(run.built->simulation, [] { return !InterruptGuard::interrupted(); });
  if (!statics.message.empty()) err << "ashlar: " << statics.message << '\n';
  if (statics.end == StaticStart::End::failed) return exit_status::failed;
  if (statics.end == StaticStart::End::interrupted) return exit_status::interrupted;
  return std::nullopt;
}

/// Finds the scene's factor by limit analysis. @return empty if interrupted, which is reported
std::optional<LimitFindings> find_limits_first(const PreparedRun& run, RigidModel model,
                                               const RunOptions& options, std::ostream& err) {
  LimitFindings findings = find_limits(run.loaded->scene, std::move(model), std::max(options.threads, 1),
                                       [] { return !InterruptGuard::interrupted(); });
  if (!options.quiet) {
    for (const LimitTrial& trial : findings.answer.trials)
      err << fmt::format(
          "factor {:.5g}, {}: {} ({} iterations)\n", trial.factors.strength * trial.factors.load,
          trial.released ? "released" : "associated", to_string(trial.outcome), trial.iterations);
  }
  if (!findings.answer.interrupted) return findings;
  err << fmt::format("ashlar: interrupted after {} trials of limit analysis, which a new run begins with\n",
                     findings.answer.trials.size());
  return std::nullopt;
}

/// Finds thrust and movements of supports. @return empty if interrupted, which is reported
std::optional<ThrustFindings> find_thrust_first(const Scene& scene, RigidModel model,
                                                const Simulation& placed, int threads, std::ostream& err) {
  ThrustFindings findings =
      find_thrust(scene, std::move(model), placed, threads, [] { return !InterruptGuard::interrupted(); });
  if (!InterruptGuard::interrupted()) return findings;
  err << "ashlar: interrupted while supports moved, which a new run begins with\n";
  return std::nullopt;
}

/// Finds the scene's factor and builds the simulation that shows it. @return false if interrupted, which is reported
bool find_factor_first(PreparedRun& run, const RunOptions& options, const FolderClaim& claim,
                       const std::optional<LimitFindings>& limits, std::optional<FactorBracket>& bracket,
                       std::ostream& err) {
  const SceneAnalysis& analysis = run.loaded->scene.analysis;
  bracket = seek_factor(*run.loaded, run.identity.scene, options, claim, expected_factor(limits), err);
  if (bracket->interrupted) {
    err << fmt::format(
        "ashlar: interrupted after {} static analyses, {}; they and the state of the one that was stopped "
        "are in {}, the same command with --resume goes on\n",
        bracket->trials.size(), bracket_so_far(*bracket), claim.folder().string());
    return false;
  }
  Diagnostics ignored;
  const double shown = shown_factor(*bracket, search_of(analysis));
  run.built = build_simulation(*run.loaded, std::max(options.threads, 1), ignored, nullptr,
                               trial_factors(analysis, shown));
  if (run.earlier) run.built->simulation.restore(run.earlier->simulation);
  return true;
}

void tell_results(const FolderRun& run, const RunEnd& end, const std::filesystem::path& folder, bool quiet,
                  std::ostream& err) {
  tell_end(end, folder, quiet, err);
  if (!quiet && !run.drawn_only()) tell_answers(run.simulation(), run.largest(), err);
  warn_of_depth(run.simulation(), err);
  warn_of_friction(run.simulation(), err);
  warn_of_hops(run.simulation(), err);
}

/// Does not assemble text: there may be no memory for it.
void tell_missing_memory(const std::bad_alloc& error, const FolderRun& run,
                         const std::filesystem::path& folder, std::ostream& err) {
  err << "ashlar: error: after step " << run.simulation().steps() << ": " << missing_memory(error);
  if (run.saved())
    err << "; the state saved last is in " << folder.native() << ", the same command with --resume goes on\n";
  else
    err << "; nothing was saved\n";
}

}  // namespace

int run_command(const RunOptions& options, std::ostream& out, std::ostream& err) {
  const double began = seconds_now();
  const std::filesystem::path folder = result_folder_of(options);
  const int threads = std::max(options.threads, 1);
  Diagnostics diagnostics;
  PreparedRun prepared = prepare(options, threads, diagnostics, err);
  // Without anything to continue from, no folder is made.
  const bool resumes = options.resume && !(prepared.loaded && is_in_search(folder, prepared.loaded->scene));
  if (prepared.built && resumes && !std::filesystem::exists(folder / checkpoint_name))
    (void)find_checkpoint(folder, *prepared.loaded, prepared.identity, diagnostics);
  diagnostics.print(err);
  if (!diagnostics.good()) return exit_status::bad_input;
  const InterruptGuard guard;
  const std::unique_ptr<FolderClaim> claim = claim_folder(folder, options, err);
  if (!claim) return exit_status::bad_input;
  if (resumes && !go_on_from_checkpoint(prepared, folder, threads, err)) return exit_status::bad_input;
  if (!options.quiet) tell_beginning(prepared, err);
  if (const auto status = start_statically(prepared, err)) return *status;
  std::optional<FolderRun> run;
  try {
    std::optional<FactorBracket> bracket;
    std::optional<LimitFindings> limits;
    std::optional<ThrustFindings> thrust;
    // A continued run has drawn the onset of motion already.
    std::optional<BuiltSimulation> placed;
    if (prepared.earlier && is_static(prepared.loaded->scene.analysis))
      placed = built_or_thrown(prepared.first(), threads);
    const Simulation& as_placed = placed ? placed->simulation : prepared.built->simulation;
    const Scene& scene = prepared.loaded->scene;
    std::optional<RigidModel> model = limit_model(scene, as_placed);
    if (scene.analysis.type == SceneAnalysis::Type::thrust) {
      thrust = find_thrust_first(scene, std::move(model.value()), as_placed, threads, err);
      if (!thrust) return exit_status::interrupted;
    }
    // A search by static analyses begins with the result of limit analysis for the same strengths.
    const bool by_limits = uses_limit_analysis(scene, model);
    if (by_limits || (seeks_factor(scene.analysis) && model && !loses_strength(*model))) {
      limits = find_limits_first(prepared, std::move(model.value()), options, err);
      if (!limits) return exit_status::interrupted;
    }
    if (seeks_factor(scene.analysis) && !by_limits &&
        !find_factor_first(prepared, options, *claim, limits, bracket, err)) {
      return exit_status::interrupted;
    }
    RunStart start{std::move(*prepared.built),
                   prepared.earlier ? &*prepared.earlier : nullptr,
                   std::move(prepared.identity),
                   std::move(bracket),
                   std::move(limits),
                   std::move(thrust),
                   began};
    run.emplace(*prepared.loaded, RunManner{threads, options.checkpoint, options.quiet}, std::move(start),
                *claim);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    // The folder cannot be written, or its results are not those of the checkpoint: nothing has run.
    err << "ashlar: error: " << fault_text(error) << '\n';
    return exit_status::bad_input;
  }
  RunStatus status = RunStatus::failed;
  try {
    const RunEnd end = run->go(err);
    status = end.status;
    tell_results(*run, end, folder, options.quiet, err);
    if (prepared.explained) out << contact_report(run->simulation(), *prepared.explained);
  } catch (const std::bad_alloc& error) {
    tell_missing_memory(error, *run, folder, err);
    return exit_status::failed;
  }
  if (options.view) {
    (void)write_view_file(folder, folder / "view.html");
    if (!options.quiet) err << fmt::format("view: {}\n", (folder / "view.html").string());
  }
  return exit_status_of(status);
}

}  // namespace ashlar
