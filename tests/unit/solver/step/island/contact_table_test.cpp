#include "solver/step/island/contact_table.hpp"

#include <gtest/gtest.h>

#include "unit/solver/step/sample_problem.hpp"

namespace ashlar::contact_table_test {
namespace {

PointLaw law_of(double stiffness) {
  return point_law(JointLaw{stiffness, 0.5 * stiffness, 0.5, 0.0, 0.0, true}, 1.0, true);
}

TEST(ContactTable, HasTheLawsOfPairsWithoutOthers) {
  std::vector<std::vector<PointLaw>> laws = {{law_of(1e9), law_of(3e9)}, {law_of(2e9)}, {}, {law_of(4e9)}};
  laws[1][0].dashpots.shear = 7e9;
  ContactTable table;
  table.set(laws, false);
  ASSERT_EQ(table.frequent(0).size(), 2U);
  EXPECT_EQ(table.frequent(0)[1].normal_stiffness, 3e9);
  EXPECT_TRUE(table.frequent(1).empty());
  EXPECT_TRUE(table.frequent(2).empty());
  ASSERT_EQ(table.frequent(3).size(), 1U);
  EXPECT_EQ(table.frequent(3)[0].normal_stiffness, 4e9);
  EXPECT_EQ(table.first_point(1), 2U);
  EXPECT_EQ(table.first_point(3), 3U);
  EXPECT_EQ(table.first_point(4), 4U);
  EXPECT_EQ(table.stiffness(0), 3e9);
  EXPECT_EQ(table.stiffness(1), 8e9) << "spring and dashpot";
  table.set(laws, true);
  EXPECT_TRUE(table.frequent(0).empty()) << "means over the step";
  EXPECT_EQ(table.first_point(4), 4U);
}

/// Corners of the base: two pressed, one of them along the ground, one within rounding of the ground, one above it.
std::vector<ContactPoint> corners() {
  using test_support::level_point;
  return {level_point({0, 0, 0}, -1e-6), level_point({1, 0, 0}, -2e-6), level_point({1, 1, 0}, 0.0),
          level_point({0, 1, 0}, 1e-6)};
}

// Dilation so small that the forces are the same makes the law one of the others, with full responses.
TEST(ContactTable, ForcesAndDerivativesAreThoseOfFullResponses) {
  const JointLaw joint{1e9, 5e8, 0.5, 0.0, 0.0, true};
  test_support::SampleProblem frequent(joint, corners());
  test_support::SampleProblem other(joint, corners());
  for (PointLaw& law : other.problem.changing_laws()[0]) law.dilation = {1e-300, 0.0};
  Eigen::VectorXd change = Eigen::VectorXd::Zero(frequent.cube.unknowns());
  change[0] = 1.5e-6;
  for (IslandProblem* problem : {&frequent.problem, &other.problem}) {
    problem->apply(change, 1.0);
    problem->respond();
  }
  ASSERT_FALSE(frequent.problem.frequent_laws(0).empty());
  ASSERT_TRUE(other.problem.frequent_laws(0).empty());
  EXPECT_EQ(frequent.problem.states(), other.problem.states());
  const Residual residual = frequent.problem.residual();
  const Residual expected = other.problem.residual();
  EXPECT_LT((residual.force - expected.force).norm(), 1e-12 * expected.force.norm());
  EXPECT_NEAR(residual.largest, expected.largest, 1e-9 * expected.largest);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LT((frequent.problem.derivatives(0)[k].tangent - other.problem.derivatives(0)[k].tangent).norm(),
              1e-12 * 1e9);
  EXPECT_EQ(frequent.problem.responses()[0].points.size(), 4U);
  EXPECT_EQ(frequent.problem.responses()[0].points[1].force, other.problem.responses()[0].points[1].force);
}

}  // namespace
}  // namespace ashlar::contact_table_test
