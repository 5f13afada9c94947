// Searches for a factor and thrust that several ranks share, as threads: the answer of one rank.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/results/columns/summary_units.hpp"
#include "apps/run/answers/trial_folder.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_setup.hpp"
#include "solver/ranks/thread_ranks.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::shared_search_test {
namespace {

/// Two courses of bricks in running bond on a plane that dips by 15 degrees towards +x, as gravity says. All slide down it
/// together at  tan(phi) / tan(15).
std::string courses(const std::string& analysis, const std::string& joint, const std::string& more = "") {
  return "[analysis]\ngravity = [2.538, 0, -9.474]\n" + analysis + "\n[contact]\n" + joint + R"(
[[material]]
name = "stone"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "plane"
fixed = true
box = { min = [-2, -2, -1], max = [6, 3, 0] }
[[block]]
name = "low"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 0.4] }
array = { count = [4], step = [[1, 0, 0]] }
[[block]]
name = "high"
material = "stone"
box = { min = [0.5, 0, 0.4], max = [1.5, 1, 0.8] }
array = { count = [3], step = [[1, 0, 0]] }
)" + more;
}

const double sliding = std::tan(30.0 * M_PI / 180.0) / (2.538 / 9.474);

std::shared_ptr<const LoadedScene> scene_of(const std::string& text) {
  Diagnostics diagnostics;
  std::optional<LoadedScene> loaded = load_scene_text(text, "scene.toml", {}, diagnostics);
  EXPECT_TRUE(loaded) << to_string(diagnostics.sorted().front());
  return std::make_shared<const LoadedScene>(std::move(*loaded));
}

/// A run on ranks to its end. @param prepare called for the run of each rank before it begins
/// @param positions null, or gets those of all blocks at the end. @return the summary of the first rank
nlohmann::json answer(const std::shared_ptr<const LoadedScene>& scene, int ranks,
                      const std::function<void(Run&, bool first)>& prepare = {},
                      std::vector<Eigen::MatrixX3d>* positions = nullptr) {
  nlohmann::json summary;
  std::mutex lock;
  std::vector<RunStatus> statuses;
  run_on_threads(ranks, [&](Ranks& own) {
    const RunRanks shared{own};
    RunManner manner;
    manner.keeps_history = false;
    manner.ranks = &shared;
    Diagnostics faults;
    std::optional<BuiltSimulation> built = build_first_stage(scene, 1, faults, nullptr, &shared);
    ASSERT_TRUE(built && faults.good());
    Run run(scene, std::move(*built), manner);
    if (prepare) prepare(run, shared.first());
    while (run.step()) {
    }
    const std::lock_guard guard(lock);
    statuses.push_back(*run.status());
    if (!shared.first()) return;
    summary = nlohmann::json::parse(run.summary());
    if (positions == nullptr) return;
    positions->clear();
    for (const BlockState& block : run.simulation().states()) positions->push_back(block.position);
  });
  EXPECT_EQ(statuses, std::vector<RunStatus>(static_cast<std::size_t>(ranks), statuses.front()));
  return summary;
}

/// The message of a search without its accelerations, which agree to a tolerance only.
std::string message(const nlohmann::json& summary) {
  const auto text = summary.at("message").get<std::string>();
  return text.substr(0, text.find(';'));
}

/// Factors and outcomes of the trials of a search by static analyses.
nlohmann::json trials(const nlohmann::json& found) {
  nlohmann::json result = nlohmann::json::array();
  for (const nlohmann::json& trial : found.at("trials"))
    result.push_back({trial.at("factor"), trial.at("outcome")});
  return result;
}

/// Axial forces of the bolts when a step has been drawn, N.
class BoltRecord final : public RunObserver {
 public:
  explicit BoltRecord(std::vector<std::vector<double>>& axial) : axial_(axial) {}
  void step_taken(const ashlar::Run& run) override {
    axial_.clear();
    for (const BoltState& bolt : run.simulation().bolts()) axial_.push_back(bolt.axial);
  }

 private:
  std::vector<std::vector<double>>& axial_;
};

// Motion is no search: its verdict is put together from the blocks of all ranks. Courses of random friction slide, fall or rest.
TEST(SharedRunOfMotion, ItsVerdictIsThatOfOneRank) {
  for (const double friction : {5.0, 12.0, 20.0}) {
    const auto scene = scene_of(courses("type = \"dynamic\"\nend_time = 0.6\ntime_step = 2e-3",
                                        "friction_angle = " + std::to_string(friction)));
    const nlohmann::json alone = answer(scene, 1).at("verdict");
    EXPECT_EQ(alone.at("state"), friction < 15.0 ? "moving" : "at rest");
    for (const int ranks : {2, 3}) {
      const nlohmann::json shared = answer(scene, ranks).at("verdict");
      for (const char* key : {"state", "moving", "displaced"})
        EXPECT_EQ(shared.at(key), alone.at(key)) << key << ranks;
      EXPECT_NEAR(shared.at("speed"), alone.at("speed"), 1e-6 * alone.at("speed").get<double>());
      ASSERT_EQ(shared.at("fallen").size(), alone.at("fallen").size());
      for (std::size_t k = 0; k < alone.at("fallen").size(); ++k)
        EXPECT_EQ(shared.at("fallen")[k].at("time"), alone.at("fallen")[k].at("time"));
    }
  }
}

TEST(SharedSearch, LimitAnalysisIsThatOfTheFirstRank) {
  const auto scene = scene_of(courses("type = \"factor-of-safety\"", "friction_angle = 30"));
  std::vector<Eigen::MatrixX3d> drawn, positions;
  const nlohmann::json alone = answer(scene, 1, {}, &drawn);
  const nlohmann::json& found = alone.at("factor_of_safety");
  EXPECT_LT(found.at("lower").get<double>(), 1.001 * sliding);
  EXPECT_GT(found.at("upper").get<double>(), 0.999 * sliding);
  for (const int ranks : {2, 3}) {
    const nlohmann::json shared = answer(scene, ranks, {}, &positions);
    EXPECT_EQ(shared.at("factor_of_safety"), found) << ranks;
    EXPECT_EQ(shared.at("status"), alone.at("status"));
    EXPECT_EQ(shared.at("message"), alone.at("message"));
    EXPECT_EQ(positions, drawn) << "the onset of motion is drawn alike";
  }
}

TEST(SharedSearch, StaticAnalysesAreShared) {
  // Joints that lose strength: limit analysis does not begin the search.
  const auto scene =
      scene_of(courses("type = \"factor-of-safety\"\nmethod = \"elastic\"\nsafety = { tolerance = 0.05 }",
                       "friction_angle = 30\nfriction_angle_residual = 29"));
  const nlohmann::json alone = answer(scene, 1);
  const nlohmann::json& found = alone.at("factor_of_safety");
  EXPECT_LT(found.at("lower").get<double>(), 1.001 * sliding);
  // Where joints slip a little before all slide, the residual friction is left.
  EXPECT_GT(found.at("upper").get<double>(),
            0.999 * sliding * std::tan(29 * M_PI / 180.0) / std::tan(30 * M_PI / 180.0));
  for (const int ranks : {2, 4}) {
    const nlohmann::json shared = answer(scene, ranks);
    const nlohmann::json& by_ranks = shared.at("factor_of_safety");
    EXPECT_EQ(trials(by_ranks), trials(found)) << ranks;
    EXPECT_EQ(by_ranks.at("moving"), found.at("moving"));
    EXPECT_EQ(by_ranks.at("joints"), found.at("joints"));
    EXPECT_EQ(shared.at("status"), alone.at("status"));
    EXPECT_EQ(message(shared), message(alone));
    EXPECT_TRUE(undeclared_numbers(nlohmann::ordered_json::parse(shared.dump())).empty());
  }
}

TEST(SharedSearch, StaticAnalysesBeginWithWhatLimitAnalysisFinds) {
  const auto scene =
      scene_of(courses("type = \"factor-of-safety\"\nmethod = \"elastic\"", "friction_angle = 30"));
  const nlohmann::json alone = answer(scene, 1).at("factor_of_safety");
  const nlohmann::json shared = answer(scene, 2).at("factor_of_safety");
  EXPECT_EQ(trials(alone).size(), 2U);
  EXPECT_EQ(trials(shared), trials(alone));
  EXPECT_EQ(shared.at("limit"), alone.at("limit"));
}

TEST(SharedSearch, LoadsOfBlocksThatComeNearAreMultiplied) {
  // The last of the upper bricks is pushed: models that ranks make for a trial have its loads. The plane is level; the
  // brick of 800 kg slides at  mu W = 0.57735 * 800 * 9.81 = 4531 N.
  std::string text = courses(
      "type = \"capacity\"\nmethod = \"elastic\"\ncapacity = { blocks = [\"high.3\"], tolerance = 0.1 }",
      "friction_angle = 30\nfriction_angle_residual = 29.99");
  text.replace(text.find("[2.538, 0, -9.474]"), 18, "[0, 0, -9.81]");
  const auto scene = scene_of(text + "load = [{ point = [1, 0.5, 0.5], force = [1000, 0, 0] }]\n");
  const double most = std::tan(M_PI / 6.0) * 800 * 9.81 / 1000;
  const nlohmann::json found = answer(scene, 1).at("load_factor");
  EXPECT_LT(found.at("lower").get<double>(), 1.001 * most);
  EXPECT_GT(found.at("upper").get<double>(), 0.999 * most);
  EXPECT_EQ(trials(answer(scene, 2).at("load_factor")), trials(found));
}

TEST(SharedSearch, BlocksThatMoveBeforeJointsFailHaveTheirAccelerations) {
  // At a factor F all slide with  g sin(15) - g cos(15) tan(30) / F, by the strength that they have not lost.
  const auto scene =
      scene_of(courses("type = \"factor-of-safety\"\nmethod = \"elastic\"\nsafety = { tolerance = 0.2 }",
                       "friction_angle = 30\nfriction_angle_residual = 29"));
  for (const int ranks : {1, 2}) {
    const nlohmann::json found = answer(scene, ranks).at("factor_of_safety");
    const double expected = 2.538 - 9.474 * std::tan(M_PI / 6.0) / found.at("upper").get<double>();
    ASSERT_EQ(found.at("accelerations").size(), 7U);
    // Forces that bricks have on each other at rest change their own accelerations, not those of all.
    double sum = 0.0;
    for (const nlohmann::json& acceleration : found.at("accelerations")) {
      EXPECT_NEAR(acceleration.at(0).get<double>(), expected, 1e-2 * expected) << ranks;
      sum += acceleration.at(0).get<double>();
    }
    EXPECT_NEAR(sum / 7.0, expected, 1e-3 * expected) << ranks;
  }
}

TEST(SharedSearch, ThrustIsThatOfTheFirstRank) {
  const auto scene = scene_of(keystone("type = \"thrust\"", "friction_angle = 10"));
  const nlohmann::json alone = answer(scene, 1);
  ASSERT_EQ(alone.at("thrust").size(), 2U);
  const nlohmann::json shared = answer(scene, 2);
  EXPECT_EQ(shared.at("thrust"), alone.at("thrust"));
  EXPECT_EQ(shared.at("status"), "completed");
  EXPECT_EQ(shared.at("message"), alone.at("message"));
}

TEST(SharedSearch, BoltsHaveTheForcesOfTheLimitState) {
  // The lowest brick has no bolt and slides alone, at the factor of all without one.
  const auto scene =
      scene_of(courses("type = \"factor-of-safety\"\nmethod = \"limit\"", "friction_angle = 30", R"(
[[bolt]]
name = "bolt"
from = [3, 0.5, 0.8]
to = [2.2, 0.5, -0.8]
area = 5e-4
young_modulus = 2e11
yield_force = 2e4
bond_stiffness = 1e9
bond_strength = 2e5
)"));
  const auto forces = [&scene](int ranks) {
    std::vector<std::vector<double>> axial;
    const nlohmann::json summary = answer(scene, ranks, [&](ashlar::Run& run, bool first) {
      if (first) run.observe(std::make_shared<BoltRecord>(axial));
    });
    // Along the path the bolt that stretches presses the upper bricks on it.
    EXPECT_NEAR(summary.at("factor_of_safety").at("released").get<double>(), sliding, 0.01 * sliding);
    EXPECT_GT(summary.at("factor_of_safety").at("lower").get<double>(), 2.0 * sliding);
    return std::pair(axial, summary.at("factor_of_safety"));
  };
  const auto [axial, found] = forces(1);
  ASSERT_FALSE(axial.empty());
  const double most = *std::max_element(axial.front().begin(), axial.front().end());
  EXPECT_GT(most, 0.0);
  EXPECT_LT(most, 1.001 * 2e4) << "it does not exceed yield_force";
  EXPECT_EQ(forces(2), std::pair(axial, found));
}

/// Ends a run when it is asked for the n-th time.
class EndsAt final : public RunObserver {
 public:
  explicit EndsAt(int n) : left_(n) {}
  [[nodiscard]] bool may_continue() override { return --left_ > 0; }

 private:
  int left_;
};

TEST(SharedSearch, OneThatWasInterruptedGoesOnOnOtherRanks) {
  const TemporaryFolder folder;
  const auto scene =
      scene_of(courses("type = \"factor-of-safety\"\nmethod = \"elastic\"\nsafety = { tolerance = 0.2 }",
                       "friction_angle = 30\nfriction_angle_residual = 29"));
  const nlohmann::json whole = answer(scene, 1);
  const auto recorded = [&](ClaimPurpose purpose, int asked) {
    return [&folder, purpose, asked](ashlar::Run& run, bool first) {
      auto claim = first ? std::make_shared<const FolderClaim>(folder / "out", purpose) : nullptr;
      run.record(std::move(claim), std::nullopt, purpose == ClaimPurpose::resume);
      if (first && asked > 0) run.observe(std::make_shared<EndsAt>(asked));
    };
  };
  const nlohmann::json stopped = answer(scene, 3, recorded(ClaimPurpose::new_run, 9));
  EXPECT_EQ(stopped.at("status"), "interrupted");
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / trial_state_name));
  const nlohmann::json resumed = answer(scene, 2, recorded(ClaimPurpose::resume, 0));
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / trial_state_name));
  EXPECT_EQ(trials(resumed.at("factor_of_safety")), trials(whole.at("factor_of_safety")));
  EXPECT_EQ(message(resumed), message(whole));
}

/// Notes before each iteration of a trial but the first one whether the state of the last is stored.
class StoredStates final : public RunObserver {
 public:
  StoredStates(std::filesystem::path file, std::vector<bool>& stored)
      : file_(std::move(file)), stored_(stored) {}
  void trial_continues(double /*factor*/, int iterations) override {
    if (iterations > 1) stored_.push_back(std::filesystem::exists(file_));
  }

 private:
  std::filesystem::path file_;
  std::vector<bool>& stored_;
};

TEST(SharedSearch, StatesOfATrialAreStoredOnTheWay) {
  const auto scene =
      scene_of(courses("type = \"factor-of-safety\"\nmethod = \"elastic\"\nsafety = { tolerance = 0.5 }",
                       "friction_angle = 30\nfriction_angle_residual = 29"));
  for (const int ranks : {1, 2}) {
    const TemporaryFolder folder;
    std::vector<bool> stored;
    (void)answer(scene, ranks, [&](ashlar::Run& run, bool first) {
      auto claim =
          first ? std::make_shared<const FolderClaim>(folder / "out", ClaimPurpose::new_run) : nullptr;
      run.record(std::move(claim), 0.0, false);
      if (first) run.observe(std::make_shared<StoredStates>(folder / "out" / trial_state_name, stored));
    });
    EXPECT_GT(stored.size(), 10U);
    EXPECT_EQ(std::count(stored.begin(), stored.end(), false), 0) << ranks;
  }
}

TEST(SharedSearch, SearchesWithNothingToFindAreRefused) {
  const auto scene =
      scene_of(courses("type = \"thrust\"\nmovement = { supports = [\"low.1\"] }", "friction_angle = 30"));
  int told = 0;
  run_on_threads(2, [&](Ranks& own) {
    const RunRanks shared{own};
    Diagnostics faults;
    EXPECT_TRUE(build_first_stage(scene, 1, faults, nullptr, &shared));
    EXPECT_EQ(faults.good(), !shared.first());
    if (!faults.good()) told = static_cast<int>(faults.sorted().size());
  });
  EXPECT_EQ(told, 1);
}

}  // namespace
}  // namespace ashlar::shared_search_test
