#include "apps/run/kept_trial.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "apps/results/folder/contact_changes.hpp"
#include "apps/scene/build/build_simulation.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar {
namespace {

using ::testing::HasSubstr;

/// Three cubes on each other, pushed at their tops; `more` is added to [analysis].
LoadedScene pushed_stack(const TemporaryFolder& folder, const std::string& order,
                         const std::string& more = "") {
  write_text(folder / "s.toml", "analysis = { type = \"factor-of-safety\"" + more + " }\n" + R"(
contact = { friction_angle = 30 }
material = [{ name = "m", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
[[block]]
name = "floor"
fixed = true
box = { min = [-3, -3, -1], max = [3, 3, 0] }
[[block]]
name = "cube"
material = "m"
order = )" + order + R"(
box = { min = [0, 0, 0], max = [1, 1, 1] }
array = { count = [3], step = [[0, 0, 1]] }
load = [{ point = [0, 0.5, 0.75], force = [500, 0, 0] }]
)");
  Diagnostics diagnostics;
  std::optional<LoadedScene> loaded = load_scene(folder / "s.toml", {}, diagnostics);
  EXPECT_TRUE(loaded) << to_string(diagnostics.sorted().front());
  return std::move(*loaded);
}

TEST(KeptTrial, OneThatIsStoppedGoesOnWhereItWas) {
  const TemporaryFolder folder;
  const LoadedScene scene = pushed_stack(folder, "1");
  std::ostringstream told;
  std::filesystem::create_directories(folder / "whole");
  std::filesystem::create_directories(folder / "stopped");
  const auto always = [] { return true; };
  KeptTrial whole(scene, 7, folder / "whole", {1, std::nullopt, true});
  const std::optional<FactorTrial> answer = whole.run(1.25, always, told);
  ASSERT_TRUE(answer);
  ASSERT_GT(answer->iterations, 4);

  KeptTrial first(scene, 7, folder / "stopped", {1, std::nullopt, true});
  int asked = 0;
  EXPECT_FALSE(first.run(
      1.25, [&] { return ++asked <= 3; }, told));
  EXPECT_EQ(first.iterations(), 3);
  const auto state = folder / "stopped" / trial_state_name;
  ASSERT_TRUE(std::filesystem::exists(state));
  int iterations = 0;
  KeptTrial second(scene, 7, folder / "stopped", {1, std::nullopt, true});
  const auto counted = [&] {
    ++iterations;
    return true;
  };
  const std::optional<FactorTrial> resumed = second.run(1.25, counted, told);
  ASSERT_TRUE(resumed);
  EXPECT_EQ(resumed->outcome, answer->outcome);
  EXPECT_EQ(resumed->iterations, answer->iterations);
  EXPECT_EQ(iterations, answer->iterations - 3) << "those before it was stopped are not run again";
  second.forget();
  EXPECT_FALSE(std::filesystem::exists(state));
}

TEST(KeptTrial, StateOfAnotherFactorOrSceneIsOfNoUse) {
  const TemporaryFolder folder;
  const LoadedScene scene = pushed_stack(folder, "1");
  std::ostringstream told;
  const auto run = [&](std::uint64_t hash, double factor, int most) {
    int asked = 0;
    KeptTrial trial(scene, hash, folder.path(), {1, std::nullopt, true});
    (void)trial.run(
        factor, [&] { return ++asked <= most; }, told);
    return trial.iterations();
  };
  EXPECT_EQ(run(7, 1.0, 2), 2);
  EXPECT_EQ(run(7, 1.5, 1), 1);
  EXPECT_EQ(run(7, 1.5, 1), 2) << "its own";
  EXPECT_EQ(run(8, 1.5, 1), 1);
}

TEST(KeptTrial, StateThatIsDueIsKeptOnTheWay) {
  const TemporaryFolder folder;
  const LoadedScene scene = pushed_stack(folder, "1");
  std::ostringstream told;
  KeptTrial trial(scene, 7, folder.path(), {1, 0.0, true});  // after each iteration
  bool kept = false;
  (void)trial.run(
      1.0,
      [&] {
        kept = kept || std::filesystem::exists(folder / trial_state_name);
        return true;
      },
      told);
  EXPECT_TRUE(kept);
}

TEST(ContactChanges, ThePairThatChangesMostIsNamed) {
  const TemporaryFolder folder;
  const LoadedScene scene = pushed_stack(folder, "1");
  Diagnostics diagnostics;
  std::optional<BuiltSimulation> built = build_simulation(scene, 1, diagnostics);
  ASSERT_TRUE(built);
  ContactChanges changes;
  EXPECT_FALSE(changes.most());
  ASSERT_EQ(built->simulation.static_step(1.0), StaticStatus::balancing);
  changes.note(built->simulation);
  changes.note(built->simulation);
  EXPECT_FALSE(changes.most()) << "nothing has changed";
  const std::string text = describe_unconverged(built->simulation, changes);
  EXPECT_THAT(
      text,
      HasSubstr("no equilibrium was found in 1 iterations under the loads at t = 1 s: contacts no longer "
                "changed, and blocks went on moving, block cube."));
  EXPECT_THAT(text, HasSubstr(" m in all; springs (contact.augmented = false) may converge"));
}

}  // namespace
}  // namespace ashlar
