#include "solver/step/island/lone_body.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::lone_body_test {
namespace {

const Material rock{2000.0, 1e7, 0.25};

/// A step of a deformed block that turns, by the shared factor and by the sparse one.
void expect_same(const BlockModel& block, LoneBodyFactors& factors, const Vector3& spin) {
  BlockState state = block.initial_state();
  state.position += 1e-3 * block.space().expand(
                               Eigen::VectorXd::LinSpaced(block.unknowns(), 0.0, 9.0).array().sin().matrix());
  state.velocity = block.rigid_velocity({1, 2, 3}, spin);
  SimulationSettings settings;
  const TimeScheme scheme = time_scheme(settings, 1e-3);
  BodyStep body;
  body.model = &block;
  body.state = &state;
  body.roundoff_force = block.force_rounding();
  body.free_change = block.space().restrict(Eigen::MatrixX3d(scheme.step * state.velocity));
  body.external_force = block.space().restrict(block.external_force({0, 0, -9.81}, 0.0));
  std::vector<BodyStep> bodies = {body};
  IslandSolvers solvers{LinearMethod::cholesky};
  ASSERT_EQ(solve_island({{0}, {}}, bodies, {}, scheme, settings, solvers).status, IslandStatus::converged);
  const auto result = solve_lone_body(body, scheme, settings, factors);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->status, IslandStatus::converged);
  EXPECT_GT(result->iterations, 1);
  EXPECT_LT((body.change - bodies[0].change).norm(), 1e-9 * body.change.norm());
  EXPECT_NEAR(body.elastic.energy, bodies[0].elastic.energy, 1e-7 * body.elastic.energy);
}

TEST(LoneBody, MovesAsTheIslandDoesWithOneFactorForEqualBlocks) {
  BlockPartsLibrary library;
  LoneBodyFactors factors;
  const auto box = [](double x) { return Polyhedron(make_box({x, 0, 0}, {x + 1, 2, 3})); };
  for (const double x : {0.0, 4.0, 8.0}) {
    const BlockModel block(test_support::block_of("A", box(x), rock, 3), library);
    expect_same(block, factors, {0.5, x, 2.0});
  }
  EXPECT_EQ(factors.counts().factorizations, 1U);
  BlockDefinition clamped = test_support::block_of("B", box(0.0), rock, 3);
  clamped.supports.push_back({Plane{{0, 0, 0}, {0, 0, 1}}});
  const BlockModel block(std::move(clamped), library);
  expect_same(block, factors, Vector3::Zero());
  EXPECT_EQ(factors.counts().factorizations, 2U);
}

TEST(LoneBody, KindsWithoutASharedFactorAreLeftToTheIsland) {
  LoneBodyFactors factors;
  const auto refused = [&](BlockDefinition definition) {
    const BlockModel block(std::move(definition));
    const BlockState state = block.initial_state();
    BodyStep body;
    body.model = &block;
    body.state = &state;
    SimulationSettings settings;
    return !solve_lone_body(body, time_scheme(settings, 1e-3), settings, factors).has_value();
  };
  BlockDefinition definition =
      test_support::block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 2, 3})), rock, 2);
  BlockDefinition hinged = definition;
  hinged.supports.push_back({Vector3(0, 0, 0)});
  EXPECT_TRUE(refused(hinged));
  BlockDefinition large = definition;
  large.material.elasticity = Elasticity::st_venant_kirchhoff;
  EXPECT_TRUE(refused(large));
  definition.formulation = Formulation::incremental;
  EXPECT_TRUE(refused(definition));
}

}  // namespace
}  // namespace ashlar::lone_body_test
