#include "apps/program/mcp/workspace.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "apps/program/run/run_command.hpp"
#include "apps/results/folder/folder_claim.hpp"

namespace ashlar {

Workspace::Workspace(const std::filesystem::path& folder, const ServerLimits& limits)
    : folder_(folder), limits_(limits) {}

std::filesystem::path Workspace::scratch_name() {
  return scratch_.path() / fmt::format("call-{}", ++names_);
}

void Workspace::refuse_in_use(const RunOptions& options) const {
  const std::string folder = options.out->string();
  std::vector<std::string> active;
  for (const std::unique_ptr<ServedRun>& run : runs_) {
    if (run->process->status()) continue;
    active.push_back(run->name);
    if (std::filesystem::weakly_canonical(folder_.root() / run->folder) ==
        std::filesystem::weakly_canonical(folder_.root() / folder))
      throw ToolRefusal(
          fmt::format("{} writes its results to {}: wait for it (run_status), stop it (run_stop), or give "
                      "another folder as out",
                      run->name, folder));
  }
  if (active.size() >= static_cast<std::size_t>(limits_.runs))
    throw ToolRefusal(fmt::format(
        "{} run(s) at a time are allowed, {} work: wait for one (run_status) or stop one (run_stop)",
        limits_.runs, fmt::join(active, ", ")));
  if (!options.resume && !options.force && holds_results(folder_.root() / folder))
    throw ToolRefusal(
        fmt::format("{} holds results: resume: true goes on with them, replace: true computes them again, or "
                    "give another folder as out",
                    folder));
  if (options.resume && !holds_results(folder_.root() / folder))
    throw ToolRefusal(fmt::format("{} holds no results to go on with: start without resume", folder));
}

ServedRun& Workspace::start(RunOptions options) {
  refuse_in_use(options);
  options.limits = limits_.scene;
  auto run = std::make_unique<ServedRun>();
  run->name = fmt::format("run-{}", runs_.size() + 1);
  run->scene = options.scene;
  run->folder = *options.out;
  run->process = std::make_unique<WorkProcess>([&] { return run_command(options, std::cout, std::cerr); },
                                               scratch_name(), readable(), CopyEnd::asked);
  return *runs_.emplace_back(std::move(run));
}

ServedRun& Workspace::run_of(const std::string& name) {
  const auto found =
      std::find_if(runs_.begin(), runs_.end(), [&](const auto& run) { return run->name == name; });
  if (found != runs_.end()) return **found;
  if (runs_.empty()) throw ToolRefusal("this server has started no run; run_start starts one");
  throw ToolRefusal(
      fmt::format("there is no run of that name; this server has started run-1 to {}", runs_.back()->name));
}

void Workspace::look_after_runs() {
  constexpr double hour = 3600.0;
  for (const std::unique_ptr<ServedRun>& run : runs_) {
    if (run->asked_to_end || run->process->status() || run->process->seconds() < hour * limits_.hours)
      continue;
    run->process->ask_to_end();
    run->asked_to_end = run->too_long = true;
  }
}

bool Workspace::end_runs() {
  bool ended = true;
  for (const std::unique_ptr<ServedRun>& run : runs_) {
    if (run->process->status()) continue;
    ended = false;
    // A second request would end it without its state.
    if (!std::exchange(run->asked_to_end, true)) run->process->ask_to_end();
  }
  return ended;
}

}  // namespace ashlar
