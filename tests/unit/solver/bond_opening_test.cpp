// A bond in tension holds at any opening, however small the distance within which contacts are searched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/simulations.hpp"

namespace ashlar::bond_opening_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::same_law;

/// A box of 48 kg bonded to a plate by kn = 5e7 Pa/m over 0.12 m^2, which leaves it at a speed: it swings, u = v/w sin(w t)
/// with w = sqrt(kn A / m). @return largest error of its height, of the amplitude, over two periods
double error_of_swing(double amplitude, double contact_distance, int order) {
  constexpr double density = 2000.0, kn = 5e7, area = 0.12, mass = density * area * 0.2;
  const double w = std::sqrt(kn * area / mass);
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -1}, {1, 1, 0}));
  blocks.emplace_back(block_of("box", Polyhedron(make_box({-0.2, -0.15, 0}, {0.2, 0.15, 0.2})),
                               Material{density, 1e14, 0.0}, order));
  JointLaw law{kn, kn, 0.5, 0.0, 0.0, true};
  law.cohesion = law.tensile_strength = 1e12;
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.integrator = Integrator::average_acceleration;
  settings.time_step = 0.01 / w;
  settings.contact_distance = contact_distance;
  settings.rest.sleeps = false;
  Simulation simulation(std::move(blocks), {{}, {{0, 0, amplitude * w}, Vector3::Zero()}}, same_law(law),
                        settings);
  double worst = 0.0;
  while (!simulation.reached(4.0 * std::numbers::pi / w)) {
    EXPECT_EQ(simulation.step(4.0 * std::numbers::pi / w), StepStatus::accepted);
    const double height = test_support::place_of(simulation, 1, {0, 0, 0.1}).z() - 0.1;
    worst = std::max(worst, std::abs(height - amplitude * std::sin(w * simulation.time())));
  }
  return worst / amplitude;
}

TEST(BondOpening, ABondSwingsFarBeyondTheContactDistance) {
  // The step lengthens the period by (w dt)^2 / 12: 1e-4 in two periods.
  for (const int order : {0, 1})
    for (const double distance : {2e-3, 1e-4, 1e-6})
      EXPECT_LT(error_of_swing(4e-3, distance, order), 5e-4) << order << ' ' << distance;
}

}  // namespace
}  // namespace ashlar::bond_opening_test
