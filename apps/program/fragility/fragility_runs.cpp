#include "apps/program/fragility/fragility_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/program/command_line.hpp"
#include "apps/program/run/run_command.hpp"
#include "apps/program/sweep/run_processes.hpp"
#include "apps/program/sweep/sweep_runs.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

/// True if a run has reached the end of its scene, but its outcome was lost.
bool ended_without_outcome(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json";
  if (std::filesystem::exists(outcome_file(folder)) || !std::filesystem::exists(file)) return false;
  const nlohmann::ordered_json summary = naming_the_file(file, [&] { return parse_json(whole_file(file)); });
  return !summary.is_object() || summary.value("status", std::string()) == "completed";
}

/// Called in a process of its own. @param record_end s. @return exit status; done if the outcome is certain
int judged_run(RunOptions options, const std::vector<Limit>& limits, double record_end, std::ostream& log) {
  const std::filesystem::path folder = *options.out;
  const auto watch = std::make_shared<LimitWatch>(limits, folder, record_end);
  options.observer = watch;
  if (ended_without_outcome(folder)) {
    options.force = true;
    return run_command(options, log, log);
  }
  const int status = run_variant(options, log, [&](const std::filesystem::path& of) {
    const std::optional<JudgedRun> stored = stored_outcome(of, limits);
    return stored && stored->certain();
  });
  if (watch->outcome().certain()) {
    log << fmt::format("{} at t = {:.6g} s\n", watch->outcome().state, watch->outcome().time);
    return exit_status::done;
  }
  // Demands of limits that were not asked for before are stored, so that they are computed once.
  if (status == exit_status::done)
    if (const std::optional<JudgedRun> stored = stored_outcome(folder, limits))
      store_outcome(*stored, folder);
  return status;
}

std::vector<std::string> overrides_of_all(const FragilityPlan& plan) {
  std::vector<std::string> all = plan.overrides;
  // Limits are judged in each step, also when a run continues.
  all.emplace_back("output.history_every=1");
  if (!plan.frames) all.push_back(fmt::format("output.every={}", std::numeric_limits<int>::max()));
  return all;
}

}  // namespace

std::vector<PlannedRun> planned_runs(const FragilityPlan& plan, const std::filesystem::path& folder) {
  std::vector<VariedKey> keys = {{"record", {}}, {"scale", {}}};
  for (const FragilityRecord& record : plan.records) keys[0].values.push_back(record.name);
  for (const double scale : plan.scales) keys[1].values.push_back(fmt::format("{}", scale));
  keys.insert(keys.end(), plan.drawn.begin(), plan.drawn.end());
  const std::vector<std::string> of_all = overrides_of_all(plan);
  const std::size_t samples = std::max<std::size_t>(plan.samples.count, 1);
  std::vector<PlannedRun> runs;
  for (const Variant& variant : variants_of(keys, plan.samples)) {
    PlannedRun& run = runs.emplace_back();
    const std::size_t number = (runs.size() - 1) / samples;
    run.record = number / plan.scales.size();
    run.scale = plan.scales[number % plan.scales.size()];
    run.values.assign(variant.values.begin() + 2, variant.values.end());
    const FragilityRecord& record = plan.records[run.record];
    run.options.scene = plan.scene;
    run.options.overrides = of_all;
    const std::vector<std::string> of_record = plan.places.overrides(record.file, run.scale);
    run.options.overrides.insert(run.options.overrides.end(), of_record.begin(), of_record.end());
    if (!plan.staged)
      run.options.overrides.push_back(fmt::format("analysis.end_time={}", record.end + plan.after));
    run.name = fmt::format("{}, scale = {}", record.name, variant.values[1]);
    for (std::size_t k = 0; k < plan.drawn.size(); ++k) {
      const std::string setting = fmt::format("{}={}", plan.drawn[k].key, run.values[k]);
      run.options.overrides.push_back(setting);
      run.name += ", " + setting;
    }
    run.options.out = folder / variant.folder;
    run.options.force = plan.force;
    run.options.quiet = true;
  }
  return runs;
}

int execute(const FragilityPlan& plan, const std::vector<PlannedRun>& runs, int jobs, bool quiet,
            std::ostream& err) {
  std::vector<ProcessRun> processes;
  std::set<std::filesystem::path> known;  // equal samples are run once
  for (const PlannedRun& run : runs) {
    if (!known.insert(*run.options.out).second) continue;
    const std::filesystem::path log = log_of(run.options);
    processes.push_back({run.name, log,
                         [&plan, &run](std::ostream& to) {
                           return judged_run(run.options, plan.limits, plan.records[run.record].end, to);
                         },
                         [log] { return reason_for_another_run(log); }});
  }
  return run_processes(std::move(processes), {.jobs = jobs, .quiet = quiet, .tells_time = true}, err);
}

}  // namespace ashlar
