#include "solver/step/accept/turn_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/simulations.hpp"

namespace ashlar::turn_limit_test {
namespace {

/// A free block of E = 1e10 Pa that turns by 0.3 rad in a step of the setting.
Simulation spinning(Integrator integrator, int order) {
  constexpr double spin = 60.0;  // rad/s
  SimulationSettings settings;
  settings.gravity = Vector3::Zero();
  settings.time_step = 0.3 / spin;
  settings.contact_distance = 1e-3;
  settings.integrator = integrator;
  std::vector<BlockModel> blocks;
  blocks.emplace_back(test_support::block_of("block", Polyhedron(make_box({0, 0, 0}, {1, 1, 1.3})),
                                             Material{2500, 1e10, 0.2}, order));
  const Vector3 about = spin * Vector3(0.0, 0.2, 1.0).normalized();
  return {std::move(blocks),
          {{Vector3::Zero(), about}},
          test_support::same_law(JointLaw{1e11, 5e10, 0.5, 0.0, 0.0, true}),
          settings};
}

TEST(TurnLimit, NoIntegratorChangesTheEnergyOfASpinningBlockByMoreThanAHundredth) {
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    for (const int order : {0, 1, 2}) {
      if (order == 0 && integrator == Integrator::generalized_alpha) continue;  // it moves no rigid blocks
      Simulation simulation = spinning(integrator, order);
      const double start = simulation.ledger().kinetic + simulation.ledger().elastic;
      ASSERT_TRUE(test_support::run_until(simulation, 0.5)) << order;
      const double end = simulation.ledger().kinetic + simulation.ledger().elastic;
      EXPECT_NEAR(end / start, 1.0, 0.01) << order;
      const bool is_limited = integrator != Integrator::dda && order > 0;
      EXPECT_EQ(simulation.largest_turn().limited > 0, is_limited) << order;
      if (is_limited) {
        EXPECT_LT(simulation.largest_turn().angle, 0.0301);
      }
    }
  }
}

TEST(TurnLimit, TurnsAreMeasuredToFirstOrder) {
  const Simulation simulation = spinning(Integrator::dda, 1);
  const Eigen::MatrixX3d& position = simulation.states()[0].position;
  const Eigen::MatrixX3d velocity = simulation.states()[0].velocity;
  EXPECT_NEAR(turn_between(position, position + 1e-3 * velocity), 0.06, 1e-12);
}

}  // namespace
}  // namespace ashlar::turn_limit_test
