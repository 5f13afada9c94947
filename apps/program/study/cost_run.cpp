#include "apps/program/study/cost_run.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <type_traits>
#include <utility>

#include "apps/program/study/processor_time.hpp"
#include "apps/scene/build/build_simulation.hpp"

namespace ashlar {
namespace {

/// Most memory that this process has taken so far, MiB.
double most_memory() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  constexpr double kibibytes = 1024.0;
  return static_cast<double>(used.ru_maxrss) / kibibytes;
}

std::optional<RunCost> cost_here(const MakeSimulation& make, int skipped, int steps) {
  constexpr double without_end = 1000.0;  // s
  const double memory = most_memory();
  const double start = processor_time();
  std::optional<Simulation> simulation = make();
  if (!simulation) return std::nullopt;
  RunCost cost;
  cost.building = processor_time() - start;
  for (int k = 0; k < skipped; ++k)
    if (simulation->step(without_end) != StepStatus::accepted) return std::nullopt;
  const auto wall = std::chrono::steady_clock::now();
  for (int k = 0; k < steps; ++k) {
    const double before = processor_time();
    if (simulation->step(without_end) != StepStatus::accepted) return std::nullopt;
    const double seconds = processor_time() - before;
    cost.seconds += seconds;
    cost.worst = std::max(cost.worst, seconds);
  }
  cost.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  cost.mebibytes = most_memory() - memory;
  cost.points = static_cast<double>(simulation->counts().contact_points) / (skipped + steps);
  for (const BlockModel& block : simulation->blocks())
    if (!block.fixed()) cost.unknowns += block.unknowns();
  return cost;
}

}  // namespace

MakeSimulation scene_of_text(const std::string& text, int threads) {
  return [text, threads]() -> std::optional<Simulation> {
    Diagnostics diagnostics;
    const auto loaded = load_scene_text(text, "study.toml", {}, diagnostics);
    if (!loaded) return std::nullopt;
    auto built = build_simulation(*loaded, threads, diagnostics);
    if (!built) return std::nullopt;
    return std::move(built->simulation);
  };
}

std::optional<RunCost> cost_of_run(const MakeSimulation& make, int skipped, int steps) {
  static_assert(std::is_trivially_copyable_v<RunCost>);
  constexpr auto bytes = static_cast<ssize_t>(sizeof(RunCost));
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    bool told = false;
    try {
      if (const std::optional<RunCost> cost = cost_here(make, skipped, steps))
        told = write(ends[1], &*cost, sizeof(RunCost)) == bytes;
    } catch (const std::exception&) {
      told = false;
    }
    _exit(told ? 0 : 1);
  }
  close(ends[1]);
  RunCost cost;
  const bool read_all = child > 0 && read(ends[0], &cost, sizeof(RunCost)) == bytes;
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  return read_all ? std::optional(cost) : std::nullopt;
}

}  // namespace ashlar
