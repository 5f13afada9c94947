#include "apps/program/run/run_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <new>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>

#include "apps/program/command_line.hpp"
#include "apps/program/run/contact_report.hpp"
#include "apps/program/run/rank_agreement.hpp"
#include "apps/program/view/view_file.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/answers/trial_folder.hpp"
#include "apps/run/interrupt_guard.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_messages.hpp"
#include "apps/run/run_progress.hpp"
#include "apps/run/run_setup.hpp"
#include "apps/run/stored_run.hpp"
#include "apps/scene/check/warnings/base_motion.hpp"
#include "apps/scene/toml/fault_text.hpp"

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

/// The pairs that a run needs of its checkpoint: of several ranks those of own blocks. All, if blocks may have other owners
/// then: in later stages, and in the motion that a search shows at its end.
NeededPairs pairs_needed_by(const Run& run) {
  const BlockSystem& system = run.simulation().system();
  if (system.exchange().alone() || !run.whole().stage.empty() || seeks_answer(run.whole().analysis))
    return nullptr;
  return [&system](const PairKey& blocks) { return system.owns(blocks[0]) || system.owns(blocks[1]); };
}

/// The checkpoint that a run continues from. A fault that prevents it is reported at the file.
std::optional<RunCheckpoint> find_checkpoint(const std::filesystem::path& folder, const Run& run,
                                             Diagnostics& diagnostics) {
  try {
    return stored_checkpoint(folder, run.whole(), run.identity(), pairs_needed_by(run));
  } catch (const CheckpointError& error) {
    diagnostics.error({(folder / checkpoint_name).string()}, error.what());
    return std::nullopt;
  }
}

/// Claims the folder for this run. @return null if it was refused, which is reported
std::shared_ptr<const FolderClaim> claim_folder(const std::filesystem::path& folder,
                                                const RunOptions& options, std::ostream& err) {
  const ClaimPurpose purpose = options.resume  ? ClaimPurpose::resume
                               : options.force ? ClaimPurpose::replacement
                                               : ClaimPurpose::new_run;
  try {
    auto claim = std::make_shared<const FolderClaim>(folder, purpose);
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
  std::optional<Run> run;            ///< empty: the scene has errors
  CostEstimate cost;                 ///< of the scene
  std::optional<PairKey> explained;  ///< blocks whose contacts are explained at the end
  bool resumes = false;              ///< from a checkpoint
};

std::string text_of(const Diagnostics& diagnostics) {
  std::ostringstream text;
  diagnostics.print(text);
  return text.str();
}

/// Options of one process.
void refuse_for_ranks(const RunOptions& options, Diagnostics& diagnostics) {
  const auto refuse = [&](const char* option, const char* reason) {
    diagnostics.error({option}, fmt::format("{} on several ranks", reason));
  };
  if (options.scene == "-") refuse("SCENE", "standard input (-) cannot be read");
  if (options.explained_pair) refuse("--explain-contacts", "contacts cannot be explained");
  if (options.all_errors) refuse("--all-errors", "errors of orders are not estimated");
}

void refuse_above_limits(const LoadedScene& loaded, const std::string& file, const SceneLimits& limits,
                         Diagnostics& diagnostics) {
  constexpr double gigabyte = 1e9;
  if (const std::size_t blocks = loaded.scene.block.size(); blocks > limits.blocks)
    diagnostics.error({file, 1, 1}, fmt::format("too many blocks ({}), at most {} are allowed here", blocks,
                                                limits.blocks));
  if (loaded.cost.memory > limits.memory)
    diagnostics.error({file, 1, 1},
                      fmt::format("the run would need too much memory ({:.2g} GB), at most {:.2g} GB are "
                                  "allowed here: fewer blocks, lower orders or fewer sub-faces need less",
                                  loaded.cost.memory / gigabyte, limits.memory / gigabyte));
}

/// Reads, checks and builds. Faults go to the diagnostics. Collective: on several ranks none builds what another could not
/// read.
PreparedRun prepare(const RunOptions& options, const std::filesystem::path& folder, double began,
                    Diagnostics& diagnostics, std::ostream& err, const RunRanks* ranks) {
  PreparedRun prepared;
  const int threads = std::max(options.threads, 1);
  if (are_several(ranks)) refuse_for_ranks(options, diagnostics);
  if (!diagnostics.good()) return prepared;
  Preparation preparation(options.quiet || !is_first(ranks), err);
  const int count = ranks == nullptr ? 1 : ranks->ranks.count();
  std::optional<LoadedScene> loaded =
      options.text
          ? load_scene_text(*options.text, options.scene, options.overrides, diagnostics, &preparation, count)
          : load_scene(options.scene, options.overrides, diagnostics, &preparation, LoadPurpose::run, count);
  if (are_several(ranks) && any_rank(ranks->ranks, !loaded)) return prepared;
  if (!loaded) return prepared;
  const auto scene = std::make_shared<const LoadedScene>(std::move(*loaded));
  prepared.cost = scene->cost;
  if (options.limits) refuse_above_limits(*scene, options.scene.string(), *options.limits, diagnostics);
  if (!diagnostics.good()) return prepared;
  std::optional<BuiltSimulation> built =
      build_first_stage(stage_scene(scene, 0), threads, diagnostics, &preparation, ranks);
  if (!built) return prepared;
  const Run& run =
      prepared.run.emplace(scene, std::move(*built),
                           RunManner{threads, options.observer != nullptr, began, ranks, options.all_errors});
  if (options.explained_pair)
    prepared.explained = pair_by_names(*options.explained_pair, run.simulation(), diagnostics);
  prepared.resumes = options.resume && !holds_open_search(folder, run.whole());
  // Without anything to continue from, no folder is made.
  if (prepared.resumes && !std::filesystem::exists(folder / checkpoint_name))
    (void)find_checkpoint(folder, run, diagnostics);
  return prepared;
}

/// @return false if the checkpoint cannot be continued, which is reported. Collective
bool go_on_from_checkpoint(Run& run, const std::filesystem::path& folder, std::ostream& err,
                           const RunRanks* ranks) {
  Diagnostics faults;
  std::optional<RunCheckpoint> earlier = find_checkpoint(folder, run, faults);
  if (!all_go_on(ranks, earlier.has_value(), text_of(faults), err)) return false;
  try {
    run.resume(std::move(*earlier));
    return true;
  } catch (const std::invalid_argument& error) {
    err << "ashlar: error: " << error.what() << '\n';
    return false;
  }
}

void tell_beginning(const PreparedRun& prepared, std::ostream& err) {
  tell_choices(prepared.run->built(), err);
  const Scene& scene = prepared.run->whole();
  err << to_string(prepared.cost, scene.block.size()) << '\n';
  for (const std::string& line : scene.notes) err << line << '\n';
  for (const std::string& line : motion_left(scene)) err << line << '\n';
}

/// Attaches the observers and finds the state that the run starts with. @return an exit status if it ends with that
/// @param claim null: results are those of another rank
std::optional<int> begin(Run& run, std::shared_ptr<const FolderClaim> claim, const RunOptions& options,
                         std::shared_ptr<RunProgress> progress, std::ostream& err) {
  run.observe(std::make_shared<InterruptObserver>());
  const bool writes = claim != nullptr;
  run.record(std::move(claim), options.checkpoint, options.resume);
  if (writes) run.observe(std::move(progress));
  if (options.observer) run.observe(options.observer);
  try {
    run.begin();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    // The folder cannot be written, or its results are not those of the checkpoint: nothing has run.
    err << "ashlar: error: " << fault_text(error) << '\n';
    return exit_status::of(error);
  }
  if (!run.message().empty()) err << "ashlar: " << run.message() << '\n';
  if (!run.status()) return std::nullopt;
  return exit_status_of(*run.status());
}

/// Does not assemble text: there may be no memory for it.
void tell_missing_memory(const std::bad_alloc& error, const Run& run, const std::string& folder,
                         std::ostream& err) {
  err << "ashlar: error: after step " << run.simulation().steps() << ": " << missing_memory(error);
  if (run.saved())
    err << "; the state saved last is in " << folder << ", the same command with --resume goes on\n";
  else
    err << "; nothing was saved\n";
}

/// Steps to the end, which is reported. @return exit status
int go_to_end(PreparedRun& prepared, const std::filesystem::path& folder, RunProgress& progress,
              const RunOptions& options, std::ostream& out, std::ostream& err, const RunRanks* ranks) {
  Run& run = *prepared.run;
  const std::string folder_name = folder.string();  // for a message when there is no memory
  try {
    try {
      while (run.step()) {
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::runtime_error&) {
      // Told below as the message of the run.
      if (run.status() != RunStatus::failed) throw;
    }
    if (is_first(ranks)) tell_results(run, folder, options.quiet, err);
    if (prepared.explained) out << contact_report(run.simulation(), *prepared.explained, run.whole().origin);
    return exit_status_of(*run.status());
  } catch (const std::bad_alloc& error) {
    progress.finish();
    if (are_several(ranks)) throw;
    tell_missing_memory(error, run, folder_name, err);
    return exit_status::failed;
  }
}

}  // namespace

int run_command(const RunOptions& options, std::ostream& out, std::ostream& err, const RunRanks* ranks) {
  const double began = RunClock::now();
  const std::filesystem::path folder = result_folder_of(options);
  Diagnostics diagnostics;
  PreparedRun prepared = prepare(options, folder, began, diagnostics, err, ranks);
  if (!all_go_on(ranks, diagnostics.good(), text_of(diagnostics), err)) return exit_status::bad_input;
  const InterruptGuard guard;
  std::shared_ptr<const FolderClaim> claim;
  if (is_first(ranks)) claim = claim_folder(folder, options, err);
  if (!all_go_on(ranks, claim || !is_first(ranks), "", err)) return exit_status::bad_input;
  if (prepared.resumes && !go_on_from_checkpoint(*prepared.run, folder, err, ranks))
    return exit_status::bad_input;
  if (!options.quiet && is_first(ranks)) tell_beginning(prepared, err);
  const auto progress = std::make_shared<RunProgress>(err, options.quiet);
  if (const auto status = begin(*prepared.run, std::move(claim), options, progress, err)) return *status;
  const int status = go_to_end(prepared, folder, *progress, options, out, err, ranks);
  if (options.view && prepared.run->status() && is_first(ranks)) {
    (void)write_view_file(folder, folder / "view.html");
    if (!options.quiet) err << fmt::format("view: {}\n", (folder / "view.html").string());
  }
  return status;
}

}  // namespace ashlar
