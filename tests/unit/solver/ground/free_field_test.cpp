#include "solver/ground/free_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ashlar::free_field_test {
namespace {

/// lambda = mu = 8e7 Pa, c_s = 200 m/s.
const Material soil{2000.0, 2e8, 0.25};
constexpr double pulse_time = 0.1;  // s

FreeFieldColumn column(int layers) {
  std::vector<GroundLayer> all;
  for (int k = 0; k < layers; ++k) all.push_back({4.0 * k, 4.0 * k + 4.0, soil, 3});
  return FreeFieldColumn(std::move(all));
}

double pulse(double time) {
  const double sine = std::sin(std::numbers::pi * std::clamp(time / pulse_time, 0.0, 1.0));
  return sine * sine;
}

History pulse_history() {
  History history;
  for (int k = 0; k <= 200; ++k) {
    history.times.push_back(k * pulse_time / 200);
    history.values.push_back(pulse(history.times.back()));
  }
  return history;
}

TEST(FreeField, FunctionsOfALayerAreOneAtTheirNodes) {
  const FreeFieldColumn three = column(3);
  ASSERT_EQ(three.nodes().size(), 10U);
  EXPECT_EQ(three.first_node(2), 6);
  EXPECT_EQ(three.layer_at(4.0), 1U);
  EXPECT_EQ(three.layer_at(12.0), 2U);
  EXPECT_NEAR((three.values(1, three.nodes()[4]) - Eigen::VectorXd::Unit(4, 1)).norm(), 0.0, 1e-14);
  // z^3 has the slope 3 z^2.
  double value = 0.0, slope = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double z = three.nodes()[static_cast<std::size_t>(3 + k)];
    value += z * z * z * three.values(1, 5.0)[k];
    slope += z * z * z * three.slopes(1, 5.0)[k];
  }
  EXPECT_NEAR(value, 125.0, 1e-11);
  EXPECT_NEAR(slope, 75.0, 1e-11);
}

// An upward wave w(t) moves the top by 2 w(t - H/c), passes the base again at 2 H/c and is gone.
TEST(FreeField, AWaveDoublesAtTheTopAndLeaves) {
  for (const Integrator integrator : {Integrator::average_acceleration, Integrator::generalized_alpha}) {
    for (const auto& [wave, speed] :
         {std::pair(ColumnWave::across, 200.0), std::pair(ColumnWave::along, 200.0 * std::sqrt(3.0))}) {
      SimulationSettings settings;
      settings.integrator = integrator;
      settings.time_step = 5e-4;
      const FreeFieldColumn ten = column(10);
      const ColumnMotion motion = ten.motion(wave, pulse_history(), settings, 1.0);
      const double up = 40.0 / speed;
      double error = 0.0, after = 0.0;
      for (std::size_t n = 0; n < motion.times.size(); ++n) {
        const auto column = static_cast<Eigen::Index>(n);
        const double top = motion.velocity(motion.velocity.rows() - 1, column),
                     base = motion.velocity(0, column);
        const double time = motion.times[n];
        error = std::max({error, std::abs(top - 2.0 * pulse(time - up)),
                          std::abs(base - pulse(time) - pulse(time - 2.0 * up))});
        if (time > 2.0 * up + pulse_time + 0.05)
          after = std::max(after, motion.velocity.col(column).cwiseAbs().maxCoeff());
      }
      EXPECT_LT(error, 0.02);
      EXPECT_LT(after, 0.005);
      // All has moved by twice the integral of the pulse.
      EXPECT_NEAR(motion.displacement.col(motion.displacement.cols() - 1).minCoeff(), pulse_time,
                  1e-4 * pulse_time);
      EXPECT_NEAR(motion.displacement.col(motion.displacement.cols() - 1).maxCoeff(), pulse_time,
                  1e-4 * pulse_time);
    }
  }
}

TEST(FreeField, AColumnNeedsALayer) {
  EXPECT_THROW(FreeFieldColumn({}), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::free_field_test
