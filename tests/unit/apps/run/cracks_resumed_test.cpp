// A run that is resumed from a state whose blocks have reached their strength and are not divided yet.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_observer.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/run/checkpoint.hpp"

namespace ashlar::cracks_resumed_test {
namespace {

/// Keeps the last state before the first crack: that of the step which brings it.
class StateBeforeCrack : public RunObserver {
 public:
  void step_taken(const Run& run) override {
    if (run.cracks().events.empty()) state = run.checkpoint();
  }
  std::optional<RunCheckpoint> state;
};

/// State of a run, without clock times and costs.
std::string reached(const Run& run) {
  SimulationSnapshot snapshot = run.simulation().snapshot();
  snapshot.run.log = {};
  snapshot.finder.counts = {};
  return to_bytes(snapshot);
}

void expect_the_same_end(const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  auto loaded = load_scene(std::filesystem::path(ASHLAR_DATA_DIR) / "verification/cracks/bar.toml", overrides,
                           diagnostics);
  ASSERT_TRUE(loaded.has_value());
  const auto scene = std::make_shared<const LoadedScene>(std::move(*loaded));
  Run straight(scene);
  const auto keeper = std::make_shared<StateBeforeCrack>();
  straight.observe(keeper);
  while (straight.step()) {
  }
  ASSERT_EQ(straight.cracks().events.size(), 1U);
  ASSERT_TRUE(keeper->state.has_value());
  Run resumed(scene);
  resumed.resume(*keeper->state);
  while (resumed.step()) {
  }
  ASSERT_EQ(resumed.cracks().events.size(), 1U);
  EXPECT_EQ(resumed.cracks().events[0].time, straight.cracks().events[0].time);
  EXPECT_TRUE(reached(resumed) == reached(straight));
}

TEST(CracksResumed, InMotion) {
  expect_the_same_end({"analysis.type=\"dynamic\"", "analysis.end_time=1.05"});
}

TEST(CracksResumed, InStatics) {
  expect_the_same_end({"analysis.end_time=1.05"});
}

}  // namespace
}  // namespace ashlar::cracks_resumed_test
