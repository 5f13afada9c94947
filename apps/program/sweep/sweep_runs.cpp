#include "apps/program/sweep/sweep_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "apps/program/command_line.hpp"
#include "apps/results/folder/identity_json.hpp"
#include "apps/results/system/interrupt_guard.hpp"
#include "apps/results/system/process_copy.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/results/text/output_stream.hpp"
#include "apps/run/answers/trial_folder.hpp"
#include "apps/run/stored_run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto poll_interval = std::chrono::milliseconds(20);

/// The summary of a finished run; null: there is none.
Json ended_summary(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json";
  if (!std::filesystem::exists(file)) return nullptr;
  Json summary = naming_the_file(file, [&] { return parse_json(whole_file(file)); });
  if (!summary.is_object() || summary.value("status", std::string()) == "interrupted") return nullptr;
  return summary;
}

int exit_status_in(const Json& summary) {
  const std::string status = summary.value("status", std::string());
  return status == "failed" || status == "not converged" ? exit_status::failed : exit_status::done;
}

/// Beginning of the log of a run that replaced results of other files.
constexpr std::string_view again = "run again: ";

/// Treats a finished run: it is kept, run again if files or the program have changed, or refused if the scene has.
int run_over_results(RunOptions run, const Json& summary, std::ostream& log) {
  Diagnostics diagnostics;
  const std::optional<LoadedScene> loaded = load_scene(run.scene, run.overrides, diagnostics);
  const bool has_scene = loaded && summary.contains("scene");
  if (has_scene && Json(to_json(loaded->scene)) == summary.at("scene")) {
    const Json was = summary.contains("identity") ? summary.at("identity") : Json();
    const std::vector<std::string> differences = identity_differences(was, scene_identity(*loaded));
    if (differences.empty()) {
      log << "kept: these results are of this scene\n";
      return exit_status_in(summary);
    }
    log << again << fmt::format("{}\n", fmt::join(differences, "; "));
    run.force = true;
  }
  if (!run.force) {
    diagnostics.print(log);
    const std::string changes =
        has_scene ? changes_since(*run.out, loaded->scene, scene_identity(*loaded)) : "";
    log << fmt::format("ashlar: error: results of another scene ({}), --force or another table is needed{}\n",
                       run.out->string(), changes);
    return exit_status::bad_input;
  }
  return run_command(run, log, log);
}

/// True if an unfinished run left a state to continue from.
bool has_state(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / checkpoint_name) || std::filesystem::exists(folder / trials_name);
}

/// True if a run can continue from the state in its folder. Faults of the scene are reported when it is run.
bool is_of_this_scene(const RunOptions& run) {
  Diagnostics told_later;
  const std::optional<LoadedScene> loaded = load_scene(run.scene, run.overrides, told_later);
  if (!loaded || !std::filesystem::exists(*run.out / checkpoint_name)) return loaded.has_value();
  try {
    (void)read_checkpoint(*run.out / checkpoint_name, scene_identity(*loaded).scene);
    return true;
  } catch (const CheckpointError&) {
    return false;
  }
}

/// One variant: kept, continued, or run. Called in a process of its own.
int run_variant(RunOptions run, std::ostream& log) {
  const Json summary = ended_summary(*run.out);
  if (!summary.is_null()) return run_over_results(std::move(run), summary, log);
  run.resume = has_state(*run.out) && (!run.force || is_of_this_scene(run));
  run.force = run.force && !run.resume;
  return run_command(run, log, log);
}

/// The same with exceptions written to the log.
int logged_variant(const RunOptions& run, std::ostream& log) {
  try {
    return run_variant(run, log);
  } catch (const std::bad_alloc& error) {
    log << "ashlar: error: " << missing_memory(error) << '\n';
  } catch (const std::exception& error) {
    log << "ashlar: error: " << fault_text(error) << '\n';
  }
  return exit_status::failed;
}

/// Reason from a log for replacing results; empty: they were kept, or there were none.
std::string reason_in(const std::filesystem::path& log) {
  std::ifstream stream(log);
  std::string line;
  std::getline(stream, line);
  return line.starts_with(again) ? line : "";
}

/// Runs of variants in processes, some at a time.
class Runs {
 public:
  Runs(std::vector<SweepRun> runs, int jobs, bool quiet, std::ostream& err)
      : runs_(std::move(runs)), jobs_(jobs), quiet_(quiet), err_(err) {}

  /// @return exit status of the sweep
  int go() {
    const InterruptGuard guard;
    const std::size_t jobs =
        jobs_ > 0 ? static_cast<std::size_t>(jobs_) : std::max(1U, std::thread::hardware_concurrency());
    std::size_t next = 0;
    while (next < runs_.size() || !children_.empty()) {
      if (InterruptGuard::interrupted()) {
        stop();
        next = runs_.size();
      }
      while (next < runs_.size() && children_.size() < jobs) start(next++);
      if (!collect()) std::this_thread::sleep_for(poll_interval);
    }
    return stopped_ ? exit_status::interrupted : status_;
  }

 private:
  [[nodiscard]] static std::filesystem::path log_of(const RunOptions& run) {
    return run.out->string() + ".log";
  }

  void start(std::size_t run) {
    std::optional<OutputFile> log;
    try {
      log.emplace(log_of(runs_[run].options), OutputFile::Start::empty);
    } catch (const std::runtime_error& fault) {
      err_ << fmt::format("ashlar: error: {}; a plain file is written there\n", fault_text(fault));
      note(run, exit_status::of(fault));
      return;
    }
    try {
      children_.emplace_back(ProcessCopy([&] {
                               OutputStreamBuffer buffer(std::move(*log));
                               std::ostream stream(&buffer);
                               return logged_variant(runs_[run].options, stream);
                             }),
                             run);
    } catch (...) {
      stop();
      throw;
    }
  }

  /// Records a finished run. @return true if there was one
  bool collect() {
    for (auto child = children_.begin(); child != children_.end(); ++child) {
      const std::optional<int> status = child->first.ended();
      if (!status) continue;
      note(child->second, *status >= 0 ? *status : exit_status::failed);
      children_.erase(child);
      return true;
    }
    return false;
  }

  void note(std::size_t run, int status) {
    ++done_;
    // Refused is worse than failed; interrupts are recorded in stopped_.
    if (status == exit_status::interrupted)
      stopped_ = true;
    else
      status_ = std::max(status_, status);
    if (quiet_ && status == exit_status::done) return;
    const char* word = status == exit_status::done          ? "done"
                       : status == exit_status::failed      ? "failed"
                       : status == exit_status::interrupted ? "interrupted"
                                                            : "refused";
    err_ << fmt::format("{} of {}: {}: {}", done_, runs_.size(), runs_[run].name, word);
    if (status != exit_status::done) err_ << fmt::format(", see {}", log_of(runs_[run].options).string());
    if (const std::string reason = reason_in(log_of(runs_[run].options)); !reason.empty())
      err_ << fmt::format(" ({})", reason);
    err_ << std::endl;
  }

  void stop() {
    if (stopped_) return;
    stopped_ = true;
    for (const auto& [child, run] : children_) child.ask_to_end();
  }

  std::vector<SweepRun> runs_;
  int jobs_;
  bool quiet_;
  std::ostream& err_;
  std::vector<std::pair<ProcessCopy, std::size_t>> children_;  ///< with the numbers of their runs
  std::size_t done_ = 0;
  int status_ = exit_status::done;
  bool stopped_ = false;
};

}  // namespace

int run_sweep(std::vector<SweepRun> runs, int jobs, bool quiet, std::ostream& err) {
  return Runs(std::move(runs), jobs, quiet, err).go();
}

}  // namespace ashlar
