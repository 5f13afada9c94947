#include "apps/program/sweep/sweep_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string_view>
#include <utility>

#include "apps/program/command_line.hpp"
#include "apps/program/sweep/run_processes.hpp"
#include "apps/results/folder/identity_json.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/answers/trial_folder.hpp"
#include "apps/run/stored_run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// The summary of a finished run; null: there is none.
Json ended_summary(const std::filesystem::path& folder, const SufficientResults& suffice) {
  const std::filesystem::path file = folder / "summary.json";
  if (!std::filesystem::exists(file)) return nullptr;
  Json summary = naming_the_file(file, [&] { return parse_json(whole_file(file)); });
  if (!summary.is_object()) return nullptr;
  if (summary.value("status", std::string()) == "interrupted" && !(suffice && suffice(folder)))
    return nullptr;
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

}  // namespace

int run_variant(RunOptions run, std::ostream& log, const SufficientResults& suffice) {
  const Json summary = ended_summary(*run.out, suffice);
  if (!summary.is_null()) return run_over_results(std::move(run), summary, log);
  run.resume = has_state(*run.out) && (!run.force || is_of_this_scene(run));
  run.force = run.force && !run.resume;
  return run_command(run, log, log);
}

std::string reason_for_another_run(const std::filesystem::path& log) {
  std::ifstream stream(log);
  std::string line;
  std::getline(stream, line);
  return line.starts_with(again) ? line : "";
}

std::filesystem::path log_of(const RunOptions& run) {
  return run.out->string() + ".log";
}

int run_sweep(const std::vector<SweepRun>& runs, int jobs, bool quiet, std::ostream& err) {
  std::vector<ProcessRun> processes;
  processes.reserve(runs.size());
  for (const SweepRun& run : runs) {
    const std::filesystem::path log = log_of(run.options);
    processes.push_back({run.name, log,
                         [options = run.options](std::ostream& to) { return run_variant(options, to); },
                         [log] { return reason_for_another_run(log); }});
  }
  return run_processes(std::move(processes), {.jobs = jobs, .quiet = quiet}, err);
}

}  // namespace ashlar
