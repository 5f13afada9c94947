#include "apps/run/run_findings.hpp"

#include <gtest/gtest.h>

#include <string>

#include "apps/run/run_history.hpp"
#include "unit/apps/results/ended_run.hpp"

namespace ashlar::run_findings_test {
namespace {

/// A pier of 2 m on a floor, order 1, under its weight.
std::string pier(const std::string& analysis) {
  return "analysis = { gravity = [0, 0, -10], " + analysis + R"( }
contact = { friction_angle = 30 }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [2, 2, 0] }
[[block]]
name = "pier"
material = "stone"
order = 1
box = { min = [0, 0, 0], max = [1, 1, 2] }
[[measure]]
name = "middle"
block = "pier"
point = [0.5, 0.5, 1]
)";
}

TEST(RunFindings, TheVerdictIsTheMessageOfAStageWithoutOne) {
  const test::EndedRun ended(pier("initial_state = \"static\", end_time = 0.01, time_step = 1e-3"));
  RunFindings findings({});
  findings.note_step(ended.run().simulation());
  EXPECT_TRUE(findings.falls().falls.empty());
  EXPECT_FALSE(findings.verdict());
  RunEnd end;
  findings.judge(ended.run().simulation(), end);
  ASSERT_TRUE(findings.verdict());
  EXPECT_TRUE(findings.verdict()->at_rest());
  EXPECT_EQ(end.message, describe(*findings.verdict(), ended.run().simulation()));
  end.message = "interrupted";
  findings.judge(ended.run().simulation(), end);
  EXPECT_EQ(end.message, "interrupted");
}

TEST(RunFindings, MeasuresOfAnEquilibriumHaveErrors) {
  const test::EndedRun ended(pier("type = \"static\""));
  const ashlar::Run& run = ended.run();
  const RunHistory history(measures_of(run.whole(), run.simulation().blocks()), false);
  const GoalValues goals = history.goals();
  RunFindings findings({});
  RunEnd end;
  end.end(RunStatus::moving);
  findings.conclude(run.whole(), run.scene(), run.simulation(), goals, end);
  EXPECT_TRUE(findings.measure_errors().empty()) << "it is no equilibrium";
  end.end(RunStatus::equilibrium);
  findings.conclude(run.whole(), run.scene(), run.simulation(), goals, end);
  EXPECT_EQ(findings.measure_errors().size(), 1U);
  EXPECT_TRUE(findings.work().empty()) << "no other process shares the run";
}

TEST(RunFindings, OrdersAreEstimatedAtTheEndUnlessItIsNoEquilibrium) {
  const test::EndedRun ended(pier("type = \"static\""));
  const ashlar::Run& run = ended.run();
  const GoalValues goals = [](const Simulation&) { return std::vector<Goal>(); };
  RunFindings findings({});
  RunEnd end;
  end.end(RunStatus::moving);
  EXPECT_FALSE(findings.has_order_errors(run.scene().analysis, end.status));
  findings.conclude(run.whole(), run.scene(), run.simulation(), goals, end);
  EXPECT_FALSE(findings.order_errors());
  end.end(RunStatus::equilibrium);
  EXPECT_TRUE(findings.has_order_errors(run.scene().analysis, end.status));
  findings.conclude(run.whole(), run.scene(), run.simulation(), goals, end);
  ASSERT_TRUE(findings.order_errors());
  EXPECT_EQ(findings.order_errors()->blocks, 1);
  ASSERT_EQ(findings.order_errors()->errors.size(), 1U);
  // Order 1 has the mean stress, 3/4 of the energy.
  EXPECT_NEAR(findings.order_errors()->errors[0].relative(), 0.5, 0.01);
  findings.reopen();
  EXPECT_FALSE(findings.order_errors());
}

TEST(RunFindings, FallsOfACheckpointAreRemembered) {
  RunFindings findings({});
  findings.resume({}, FallRecord{.falls = {{3, 0.5}}});
  ASSERT_EQ(findings.falls().falls.size(), 1U);
  EXPECT_EQ(findings.falls().falls.front().block, 3);
}

}  // namespace
}  // namespace ashlar::run_findings_test
