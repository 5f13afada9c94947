#include "apps/run/answers/trial_run.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <memory>
#include <string>

#include "apps/run/answers/trial_folder.hpp"
#include "apps/scene/assemble/build_simulation.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::trial_run_test {
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

/// Iterates at most some times. @return number of iterations taken
int iterated(TrialRun& trial, int most) {
  int steps = 0;
  while (steps < most && !trial.result()) {
    (void)trial.iterate();
    ++steps;
  }
  return steps;
}

TEST(TrialFolder, OneThatIsStoppedGoesOnWhereItWas) {
  const TemporaryFolder folder;
  const LoadedScene scene = pushed_stack(folder, "1");
  TrialRun whole(scene, 1.25, 1);
  (void)iterated(whole, 1000);
  ASSERT_TRUE(whole.result());
  ASSERT_GT(whole.iterations(), 4);

  const auto claim = std::make_shared<const FolderClaim>(folder / "out", ClaimPurpose::new_run);
  TrialFolder stored(claim, 7, false, std::nullopt);
  TrialRun first(scene, 1.25, 1);
  EXPECT_FALSE(stored.begin(1.25));
  EXPECT_EQ(iterated(first, 3), 3);
  stored.save(1.25, first.state());
  ASSERT_TRUE(std::filesystem::exists(folder / "out" / trial_state_name));

  TrialFolder again(claim, 7, true, std::nullopt);
  TrialRun second(scene, 1.25, 1);
  second.restore(again.begin(1.25).value());
  EXPECT_EQ(second.iterations(), 3);
  EXPECT_EQ(iterated(second, 1000), whole.iterations() - 3)
      << "those before it was stopped are not run again";
  EXPECT_EQ(second.result()->outcome, whole.result()->outcome);
  EXPECT_EQ(second.result()->iterations, whole.result()->iterations);
  again.add(*second.result());
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / trial_state_name));
  EXPECT_TRUE(TrialFolder(claim, 7, true, std::nullopt).find(1.25));
  EXPECT_FALSE(TrialFolder(claim, 7, false, std::nullopt).find(1.25)) << "a new search forgets";
}

TEST(TrialFolder, StateOfAnotherFactorOrSceneIsOfNoUse) {
  const TemporaryFolder folder;
  const LoadedScene scene = pushed_stack(folder, "1");
  const auto claim = std::make_shared<const FolderClaim>(folder / "out", ClaimPurpose::new_run);
  const auto run = [&](std::uint64_t hash, double factor, int more) {
    TrialFolder stored(claim, hash, true, std::nullopt);
    TrialRun trial(scene, factor, 1);
    if (const auto state = stored.begin(factor)) trial.restore(*state);
    (void)iterated(trial, more);
    stored.save(factor, trial.state());
    return trial.iterations();
  };
  EXPECT_EQ(run(7, 1.0, 2), 2);
  EXPECT_EQ(run(7, 1.5, 1), 1);
  EXPECT_EQ(run(7, 1.5, 1), 2) << "its own";
  EXPECT_EQ(run(8, 1.5, 1), 1);
}

TEST(TrialFolder, StateIsDueAfterItsInterval) {
  const TemporaryFolder folder;
  const auto claim = std::make_shared<const FolderClaim>(folder / "out", ClaimPurpose::new_run);
  TrialFolder always(claim, 7, false, 0.0), seldom(claim, 7, false, 1e6);
  EXPECT_FALSE(always.begin(1.0));
  EXPECT_FALSE(seldom.begin(1.0));
  EXPECT_TRUE(always.due());
  EXPECT_FALSE(seldom.due());
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
}  // namespace ashlar::trial_run_test
