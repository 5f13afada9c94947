#include "apps/run_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <optional>

#include "apps/atomic_file.hpp"
#include "apps/command_line.hpp"
#include "apps/progress.hpp"
#include "apps/result_folder.hpp"
#include "apps/run_summary.hpp"

namespace ashlar {
namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void on_interrupt(int) {
  interrupted = 1;
}

/// Turns an interrupt into a request to stop after the present step; a second one ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard() {
    interrupted = 0;
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &old_interrupt_);
    sigaction(SIGTERM, &action, &old_terminate_);
  }
  ~InterruptGuard() {
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

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
  return options.scene.stem().string() + ".out";
}

int exit_status_of(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return exit_status::done;
    case RunStatus::failed:
      return exit_status::failed;
    case RunStatus::interrupted:
      return exit_status::interrupted;
  }
  return exit_status::failed;
}

/// Steps until the end, an interrupt or a failure. @param message why it failed
RunStatus run_steps(Simulation& simulation, double end_time, ResultFolder& folder, ProgressLine& progress,
                    RunSeconds& seconds, std::string& message) {
  while (simulation.time() < end_time) {
    if (interrupted != 0) return RunStatus::interrupted;
    if (simulation.step(end_time) != StepStatus::accepted) {
      const Rejection& last = simulation.rejections().back();
      message = fmt::format("step {} at t = {} s was rejected down to a time step of {} s: {}",
                            simulation.steps() + 1, simulation.time(), last.step, to_string(last.reason));
      return RunStatus::failed;
    }
    const double before = seconds_now();
    folder.add_step(simulation);
    progress.update(progress_of(simulation));
    seconds.output += seconds_now() - before;
  }
  return RunStatus::completed;
}

}  // namespace

int run_command(const RunOptions& options) {
  RunSeconds seconds;
  const double start = seconds_now();
  Diagnostics diagnostics;
  const std::optional<LoadedScene> loaded = load_scene(options.scene, options.overrides, diagnostics);
  std::optional<BuiltSimulation> built;
  if (loaded) built = build_simulation(*loaded, std::max(options.threads, 1), diagnostics);
  if (!built) {
    diagnostics.print(std::cerr);
    return exit_status::bad_input;
  }
  if (!options.quiet) {
    for (const AutomaticChoice& choice : built->choices) {
      std::cerr << fmt::format("chosen: {} = {:.4g} {}\n", choice.key, choice.value, choice.unit);
    }
  }
  seconds.setup = seconds_now() - start;

  const InterruptGuard guard;
  Simulation& simulation = built->simulation;
  ResultFolder folder(result_folder_of(options), loaded->scene, simulation);
  ProgressLine progress(loaded->scene.analysis.end_time, options.quiet);
  std::string message;
  const RunStatus status =
      run_steps(simulation, loaded->scene.analysis.end_time, folder, progress, seconds, message);
  folder.add_frame(simulation);
  progress.finish();
  seconds.total = seconds_now() - start;
  const auto summary = run_summary(loaded->scene, *built, status, message, seconds, folder.frames());
  write_file_atomically(folder.path() / "summary.json", summary.dump(2) + "\n", Durability::process);
  if (status == RunStatus::failed) {
    std::cerr << fmt::format("ashlar: error: {}; the last accepted state is in {}\n", message,
                             folder.path().string());
  }
  return exit_status_of(status);
}

}  // namespace ashlar
