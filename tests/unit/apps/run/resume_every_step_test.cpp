// A run resumed from any of its steps takes the next ones to the bit.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "apps/scene/assemble/build_simulation.hpp"
#include "solver/run/checkpoint.hpp"

namespace ashlar::resume_every_step_test {
namespace {

/// State of a run, without clock times and costs.
std::string reached(const Simulation& simulation) {
  SimulationSnapshot snapshot = simulation.snapshot();
  snapshot.run.log = {};
  snapshot.finder.counts = {};
  return to_bytes(snapshot);
}

TEST(ResumeEveryStep, OfStonesThatBounce) {
  constexpr int followed = 2;
  const std::filesystem::path file =
      std::filesystem::path(ASHLAR_DATA_DIR) / "../tests/endurance/bounce.toml";
  Diagnostics diagnostics;
  const auto loaded = load_scene(file, {"output.every=100000"}, diagnostics);
  ASSERT_TRUE(loaded.has_value());
  const auto build = [&] { return std::move(build_simulation(*loaded, 1, diagnostics)->simulation); };
  const double end = loaded->scene.analysis.end_time;
  Simulation straight = build();
  std::map<int, Simulation> resumed;
  while (!straight.reached(end)) {
    Simulation& next = resumed.emplace(straight.steps(), build()).first->second;
    next.restore(snapshot_from_bytes(to_bytes(straight.snapshot())));
    // One that is saved again before it goes on.
    ASSERT_TRUE(reached(next) == reached(straight)) << straight.steps();
    ASSERT_EQ(straight.step(end), StepStatus::accepted);
    const std::string expected = reached(straight);
    for (auto& [start, simulation] : resumed) {
      ASSERT_EQ(simulation.step(end), StepStatus::accepted);
      ASSERT_TRUE(reached(simulation) == expected) << start << " " << straight.steps();
    }
    resumed.erase(static_cast<int>(straight.steps()) - followed);
  }
}

}  // namespace
}  // namespace ashlar::resume_every_step_test
