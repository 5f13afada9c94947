// Impacts of one moment at joints of different restitution.
#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::unlike_restitution_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;

/// A beam that falls flat by 5 cm on two piers with coefficients of restitution of their own. @return its tally
ImpactTally fallen_beam(double left, double right, double& most, double& least) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -0.2, -1}, {-0.6, 0.2, 0}));
  blocks.emplace_back(fixed_box({0.6, -0.2, -1}, {1, 0.2, 0}));
  blocks.emplace_back(
      block_of("beam", Polyhedron(make_box({-1, -0.2, 0.05}, {1, 0.2, 0.25})), Material{2500, 1e10, 0.2}, 0));
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.rest.sleeps = false;
  const auto law = [=](int a, int) {
    JointLaw of_pier{1e11, 5e10, 0.5, 0.0, 0.0, true};
    of_pier.restitution = a == 0 ? left : right;
    return of_pier;
  };
  Simulation simulation(std::move(blocks), {{}, {}, {}}, law, settings);
  most = 0.0;
  const auto energy = [&] { return simulation.ledger().kinetic + simulation.ledger().gravity; };
  const double start = energy();
  while (!simulation.reached(0.15)) {
    EXPECT_EQ(simulation.step(0.15), StepStatus::accepted);
    most = std::max(most, energy() - start);
  }
  least = energy() - start;
  return simulation.impacts();
}

TEST(UnlikeRestitution, IsCountedAndGainsNoEnergy) {
  double most = 0.0, least = 0.0;
  const ImpactTally unlike = fallen_beam(0.0, 0.8, most, least);
  EXPECT_GE(unlike.count, 1U);
  EXPECT_GE(unlike.unlike, 1U);
  // m g h is 80 J.
  EXPECT_LT(most, 1e-6);
  EXPECT_LT(least, -1.0);
}

TEST(UnlikeRestitution, EqualCoefficientsAreNotCounted) {
  double most = 0.0, least = 0.0;
  const ImpactTally same = fallen_beam(0.5, 0.5, most, least);
  EXPECT_GE(same.count, 1U);
  EXPECT_EQ(same.unlike, 0U);
}

}  // namespace
}  // namespace ashlar::unlike_restitution_test
