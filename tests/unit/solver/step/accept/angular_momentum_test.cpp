// Angular momentum of free blocks, alone, tied and in collisions, with every integrator.
#include "solver/step/accept/angular_momentum.hpp"

#include <gtest/gtest.h>

#include <random>

#include "solver/state/free_bodies.hpp"
#include "support/simulations.hpp"

namespace ashlar::angular_momentum_test {
namespace {

using test_support::block_of;
using test_support::run_until;
using test_support::same_law;

const Material stone{2500, 1e9, 0.2};

BlockDefinition cube_at(double x, int order = 1) {
  return block_of("cube", Polyhedron(make_box({x, 0, 0}, {x + 1, 1, 1})), stone, order);
}

/// Velocity and position that no rigid motion gives.
BlockState any_state(const BlockModel& block, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
  BlockState state = block.initial_state();
  for (double& entry : state.position.reshaped()) entry += 0.1 * number();
  for (double& entry : state.velocity.reshaped()) entry = number();
  return state;
}

TEST(FreeBodies, AreWhatTiesMakeOneAndNothingHolds) {
  std::vector<BlockModel> blocks;
  for (int k = 0; k < 7; ++k) {
    BlockDefinition cube = cube_at(k);
    cube.fixed = k == 1;
    if (k == 4) cube.supports.push_back({Vector3(4, 0, 0), {true, true, true}, {}});
    blocks.emplace_back(std::move(cube));
  }
  // 0 alone, 1 fixed, 2 with 5 and 6, 3 with the supported 4.
  EXPECT_EQ(free_bodies(blocks, {{5, 6}, {3, 4}, {2, 5}}), (std::vector<std::vector<int>>{{0}, {2, 5, 6}}));
  EXPECT_EQ(free_bodies(blocks, {}), (std::vector<std::vector<int>>{{0}, {2}, {3}, {5}, {6}}));
}

TEST(StrayAngularMomentum, IsWhatTheStepGivesBesideKnownForces) {
  // L' - L less dt times the moment of the known forces about the mean place, whatever the step was and
  // whichever the point they are taken about: known forces have the resultant that changes the momentum, as
  // internal forces have none. Of two blocks they need not have it on each, as the force that one is given by
  // the other is known with an error.
  const std::vector<BlockModel> blocks = {BlockModel(cube_at(3, 2)), BlockModel(cube_at(4, 1))};
  const double step = 0.01;
  const Eigen::RowVector3d error(300.0, -200.0, 500.0);
  Vector3 expected = Vector3::Zero();
  Vector3 stray = Vector3::Zero();
  Vector3 stray_about_another = Vector3::Zero();
  double size = 0.0;
  for (const std::size_t k : {0U, 1U}) {
    const BlockModel& block = blocks[k];
    const auto seed = static_cast<unsigned>(3 * k);
    const BlockState before = any_state(block, seed + 1);
    const BlockState after = any_state(block, seed + 2);
    Eigen::MatrixX3d known = any_state(block, seed + 3).velocity;
    known.row(0) = 2500.0 / step * (after.velocity.row(0) - before.velocity.row(0));
    known.row(0) += k == 0 ? error : Eigen::RowVector3d(-error);
    expected += block.angular_momentum(after) - block.angular_momentum(before);
    for (Eigen::Index row = 0; row < known.rows(); ++row) {
      const Vector3 place = 0.5 * (before.position.row(row) + after.position.row(row));
      expected -= step * place.cross(Vector3(known.row(row)));
    }
    stray += stray_angular_momentum(block, before, after, known, step, {3.5, 0.5, 0.5});
    stray_about_another += stray_angular_momentum(block, before, after, known, step, {-1, 2, 7});
    size += block.angular_momentum(after).norm();
  }
  EXPECT_GT(expected.norm(), 100.0);
  EXPECT_LT((stray - expected).norm(), 1e-12 * size);
  EXPECT_LT((stray_about_another - expected).norm(), 1e-12 * size);
}

TEST(AddSpin, GivesWhatIsAskedForToTheBodyAsAWhole) {
  std::vector<BlockModel> blocks;
  std::vector<BlockState> states;
  for (const int k : {0, 1, 2}) {
    blocks.emplace_back(cube_at(10.0 * k, k + 1));
    states.push_back(any_state(blocks.back(), static_cast<unsigned>(k)));
  }
  const std::vector<BlockState> before = states;
  const Vector3 asked(3, -7, 20);
  const double gain = add_spin(blocks, {0, 2}, asked, 1e9, states);
  Vector3 angular_momentum = Vector3::Zero(), momentum = Vector3::Zero();
  double energy = 0.0;
  for (const std::size_t k : {0U, 2U}) {
    angular_momentum += blocks[k].angular_momentum(states[k]) - blocks[k].angular_momentum(before[k]);
    momentum += blocks[k].momentum(states[k]) - blocks[k].momentum(before[k]);
    energy += blocks[k].kinetic_energy(states[k]) - blocks[k].kinetic_energy(before[k]);
  }
  EXPECT_LT((angular_momentum - asked).norm(), 1e-11 * asked.norm());
  EXPECT_LT(momentum.norm(), 1e-12);
  EXPECT_NEAR(gain, energy, 1e-10);
  EXPECT_EQ(states[1].velocity, before[1].velocity);
}

TEST(AddSpin, TakesNoMoreEnergyThanTheLimit) {
  // A unit cube of 2500 kg that turns at w about its centroid, inertia 2500/6: up to 2 w it gains three times
  // the energy it has. Asked to stand still it gives energy away, and no limit is in the way.
  const std::vector<BlockModel> blocks = [] {
    std::vector<BlockModel> result;
    result.emplace_back(cube_at(0));
    return result;
  }();
  const Vector3 spin(0, 0, 3);
  const double inertia = 2500.0 / 6.0, energy = 0.5 * inertia * 9.0;
  const auto after = [&](const Vector3& asked, double limit) {
    std::vector<BlockState> states = {blocks[0].initial_state()};
    states[0].velocity = blocks[0].rigid_velocity(Vector3::Zero(), spin);
    const double gain = add_spin(blocks, {0}, asked, limit, states);
    EXPECT_NEAR(gain, blocks[0].kinetic_energy(states[0]) - energy, 1e-10 * energy);
    return blocks[0].angular_momentum(states[0]).z() / inertia;
  };
  EXPECT_NEAR(after(inertia * spin, 3.1 * energy), 6.0, 1e-12);
  EXPECT_NEAR(after(inertia * spin, 3.0 * energy), 6.0, 1e-12);
  EXPECT_NEAR(after(inertia * spin, 1.25 * energy), 4.5, 1e-12);
  EXPECT_NEAR(after(inertia * spin, 0.0), 3.0, 1e-12);
  EXPECT_NEAR(after(-inertia * spin, 0.0), 0.0, 1e-12);
  // Beyond standing still, as fast the other way: no energy is gained.
  EXPECT_NEAR(after(-3.0 * inertia * spin, 0.0), -3.0, 1e-12);
}

/// A box that tumbles freely. @return the largest energy on the way over that at the start
double tumble(Integrator integrator, const Vector3& spin, double modulus, int order, double step, int steps,
              double& angular_error) {
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.integrator = integrator;
  settings.time_step = step;
  std::vector<BlockModel> blocks;
  blocks.emplace_back(
      block_of("box", Polyhedron(make_box({0, 0, 0}, {1, 0.8, 0.6})), {2500, modulus, 0.2}, order));
  Simulation simulation(std::move(blocks), {{Vector3(1, 0, 0), spin}}, same_law({}), settings);
  const Vector3 angular = simulation.angular_momentum();
  const double energy = simulation.ledger().kinetic;
  double most = 0.0;
  for (int k = 0; k < steps; ++k) {
    EXPECT_EQ(simulation.step(1e9), StepStatus::accepted);
    most = std::max(most, simulation.ledger().kinetic + simulation.ledger().elastic);
    EXPECT_NEAR(simulation.ledger().residual, 0.0, 1e-7 * energy);
  }
  angular_error = (simulation.angular_momentum() - angular).norm() / angular.norm();
  return most / energy;
}

TEST(AngularMomentum, StaysWithABlockThatTumbles) {
  for (const Integrator integrator :
       {Integrator::dda, Integrator::generalized_alpha, Integrator::average_acceleration}) {
    for (const int order : {1, 2, 3}) {
      double error = 0.0;
      // 0.01 rad a step about nearly the middle axis: it turns over.
      const double most = tumble(integrator, {0.03, 10, 0.05}, 1e8, order, 1e-3, 500, error);
      EXPECT_LT(error, 1e-11) << order;
      if (integrator == Integrator::dda) {
        EXPECT_LT(most, 1.0 + 1e-12) << order;
      }
    }
  }
}

TEST(AngularMomentum, IsNotBoughtWithEnergy) {
  // 0.17 rad a step, far beyond what a step can follow, of a block so stiff that dda hardly damps it. A step
  // may create energy, which later ones dissipate before spin takes up any: the hundredth is for that.
  double error = 0.0;
  EXPECT_LT(tumble(Integrator::dda, {10, 10, 10}, 1e10, 1, 1e-2, 1500, error), 1.01);
}

TEST(AngularMomentum, StaysWithTiedBlocksThatSpin) {
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.time_step = 2e-3;
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions;
  const Vector3 spin(0.5, 1, 5);
  for (int k = 0; k < 3; ++k) {
    blocks.emplace_back(cube_at(k, k + 1));
    motions.push_back({spin.cross(Vector3(k - 1.0, 0, 0)), spin});
  }
  Simulation simulation(std::move(blocks), motions, same_law({}), settings, {{0, 1, 1e14}, {1, 2, 1e14}});
  ASSERT_TRUE(simulation.system().are_tied(0, 1) && simulation.system().are_tied(1, 2));
  const Vector3 angular = simulation.angular_momentum();
  const double energy = simulation.ledger().kinetic;
  ASSERT_TRUE(run_until(simulation, 1.0));
  EXPECT_LT((simulation.angular_momentum() - angular).norm(), 1e-9 * angular.norm());
  // Without the spin given back, 500 steps of 0.01 rad take 5 %.
  EXPECT_GT(simulation.ledger().kinetic, 0.999 * energy);
  EXPECT_LT(simulation.largest_step_residual(), 1e-8 * energy);
}

/// Two boxes that spin and slide over each other as they collide off-centre.
class FreeCollision : public testing::TestWithParam<std::tuple<Integrator, bool, bool, std::array<int, 2>>> {
};

TEST_P(FreeCollision, KeepsMomentumAndAngularMomentum) {
  const auto& [integrator, area_springs, curved, orders] = GetParam();
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.integrator = integrator;
  settings.time_step = 2e-4;
  settings.area_springs = area_springs;
  settings.curved_surface = curved;
  settings.search.subdivisions = 1;
  // Here nothing is given back: what a step is solved to is left.
  if (integrator == Integrator::average_acceleration) settings.iteration.residual_tolerance = 1e-13;
  const double share = area_springs ? 1.0 : 0.25;
  const JointLaw law{share * 5e9, share * 2e9, 0.577, 0.0, 0.0, area_springs};
  const Material soft{2500, 1e8, 0.2}, light{2000, 1e8, 0.3};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("a", Polyhedron(make_box({0, 0, 0}, {1, 0.8, 0.6})), soft, orders[0]));
  blocks.emplace_back(
      block_of("b", Polyhedron(make_box({1.02, 0.35, 0.2}, {1.6, 1.2, 1.3})), light, orders[1]));
  Simulation simulation(std::move(blocks), {{{5, 0, 0}, {0, 3, 1}}, {{-2, 0, 0.5}, {1, 0, -2}}},
                        same_law(law), settings);
  const Vector3 momentum = simulation.momentum();
  const Vector3 angular = simulation.angular_momentum();
  const double energy = simulation.ledger().kinetic;
  ASSERT_TRUE(run_until(simulation, 0.04));
  // They did collide, and rubbed.
  EXPECT_LT(simulation.blocks()[0].momentum(simulation.states()[0]).x(), 0.5 * 5.0 * 1200.0);
  EXPECT_GT(simulation.ledger().friction, 1e-3 * energy);
  EXPECT_LT((simulation.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT((simulation.angular_momentum() - angular).norm(), 1e-11 * angular.norm());
  EXPECT_LT(simulation.largest_step_residual(), 1e-10 * energy);
}

INSTANTIATE_TEST_SUITE_P(Every, FreeCollision,
                         testing::Combine(testing::Values(Integrator::dda, Integrator::generalized_alpha,
                                                          Integrator::average_acceleration),
                                          testing::Bool(), testing::Bool(),
                                          testing::Values(std::array{1, 1}, std::array{2, 2},
                                                          std::array{2, 1})));

}  // namespace
}  // namespace ashlar::angular_momentum_test
