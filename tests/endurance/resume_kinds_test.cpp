// A run of each kind in kinds.json resumed from some of its steps takes all later ones to the bit.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/answers/factor_analysis.hpp"
#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/initial_state.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "solver/run/checkpoint.hpp"

namespace ashlar {
namespace {

const std::filesystem::path tests_folder = std::filesystem::path(ASHLAR_DATA_DIR) / "../tests/endurance";

/// A scene with what differs from it.
struct Kind {
  std::string name;
  std::filesystem::path scene;
  std::vector<std::string> overrides;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

std::vector<Kind> kinds() {
  std::vector<Kind> result;
  std::ifstream file(tests_folder / "kinds.json");
  const auto json = nlohmann::ordered_json::parse(file);
  for (const auto& [name, kind] : json.items())
    result.push_back({name, tests_folder / kind.at("scene"), kind.at("set")});
  return result;
}

/// State of a run, without clock times and costs.
std::string reached(SimulationSnapshot snapshot) {
  snapshot.run.log = {};
  snapshot.finder.counts = {};
  return to_bytes(snapshot);
}

/// A run through all stages of a scene, step by step.
class StagedRun {
 public:
  explicit StagedRun(const LoadedScene& loaded) : loaded_(loaded) { begin(0); }
  /// Resumes from the state of a run at one of its steps.
  StagedRun(const LoadedScene& loaded, std::size_t stage, const std::string& checkpoint) : loaded_(loaded) {
    begin(stage);
    simulation_->restore(snapshot_from_bytes(checkpoint));
  }
  void start_statically() {
    if (present_->scene.analysis.initial_state != SceneAnalysis::InitialState::statics) return;
    EXPECT_EQ(start_in_statics(*simulation_, [] { return true; }).end, StaticStart::End::answered);
  }
  /// @return whether there is more to do
  bool step() {
    const SceneAnalysis& analysis = present_->scene.analysis;
    if (is_static(analysis)) {
      if (simulation_->static_step(analysis.end_time) == StaticStatus::balancing) return true;
    } else {
      EXPECT_EQ(simulation_->step(analysis.end_time), StepStatus::accepted);
      if (::testing::Test::HasFailure()) return false;
      if (!simulation_->reached(analysis.end_time)) return true;
    }
    if (stage_ + 1 >= stage_count(loaded_.scene)) return false;
    const SimulationSnapshot end = simulation_->snapshot();
    const std::vector<bool> was_absent = simulation_->system().absent();
    begin(stage_ + 1);
    simulation_->start_stage(end, was_absent);
    return true;
  }
  [[nodiscard]] SimulationSnapshot snapshot() const { return simulation_->snapshot(); }
  [[nodiscard]] std::size_t stage() const { return stage_; }

 private:
  void begin(std::size_t stage) {
    stage_ = stage;
    present_ = std::make_unique<LoadedScene>(stage_of(loaded_, stage));
    Diagnostics diagnostics;
    auto built = build_simulation(*present_, 1, diagnostics);
    ASSERT_TRUE(built.has_value());
    simulation_.emplace(std::move(built->simulation));
  }

  const LoadedScene& loaded_;
  std::unique_ptr<LoadedScene> present_;  ///< its present stage
  std::optional<Simulation> simulation_;
  std::size_t stage_ = 0;
};

/// A step of a run that did not stop.
struct Step {
  std::size_t stage;
  std::string checkpoint;
};

class ResumeKinds : public ::testing::TestWithParam<Kind> {};

TEST_P(ResumeKinds, GoOnToTheBit) {
  constexpr std::size_t parts = 3;  // a run goes on from between them
  Diagnostics diagnostics;
  const auto loaded = load_scene(GetParam().scene, GetParam().overrides, diagnostics);
  ASSERT_TRUE(loaded.has_value()) << to_string(diagnostics.sorted().front());
  if (seeks_factor(loaded->scene.analysis)) GTEST_SKIP() << "many analyses: kills.py has them";
  StagedRun straight(*loaded);
  straight.start_statically();
  std::vector<Step> steps;
  const auto note = [&] { steps.push_back({straight.stage(), to_bytes(straight.snapshot())}); };
  note();
  while (straight.step()) note();
  note();
  ASSERT_FALSE(HasFailure());
  ASSERT_GT(steps.size(), parts) << "too few steps to stop between them";
  for (std::size_t part = 1; part < parts; ++part) {
    std::size_t n = part * steps.size() / parts;
    StagedRun resumed(*loaded, steps[n].stage, steps[n].checkpoint);
    const std::size_t start = n;
    for (bool more = true; more;) {
      more = resumed.step();
      ASSERT_LT(++n, steps.size());
      ASSERT_TRUE(reached(resumed.snapshot()) == reached(snapshot_from_bytes(steps[n].checkpoint)))
          << "from step " << start << ": step " << n << " of " << steps.size() - 1;
    }
    ASSERT_EQ(n + 1, steps.size());
  }
}

INSTANTIATE_TEST_SUITE_P(All, ResumeKinds, ::testing::ValuesIn(kinds()),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace ashlar
