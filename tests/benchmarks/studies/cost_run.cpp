#include "benchmarks/studies/cost_run.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "apps/results/system/process_copy.hpp"
#include "apps/results/system/this_process.hpp"
#include "apps/scene/assemble/build_simulation.hpp"

namespace ashlar {
namespace {

/// Most memory that this process has taken so far, MiB.
double most_memory() {
  constexpr double mebibyte = 1024.0 * 1024.0;
  return static_cast<double>(peak_memory_bytes()) / mebibyte;
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
  const std::optional<std::string> bytes = told_by_copy([&]() -> std::optional<std::string> {
    const std::optional<RunCost> cost = cost_here(make, skipped, steps);
    if (!cost) return std::nullopt;
    return std::string(reinterpret_cast<const char*>(&*cost), sizeof(RunCost));
  });
  if (!bytes || bytes->size() != sizeof(RunCost)) return std::nullopt;
  RunCost cost;
  std::memcpy(&cost, bytes->data(), sizeof(RunCost));
  return cost;
}

}  // namespace ashlar
