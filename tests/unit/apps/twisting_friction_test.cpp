// Slabs that twist on a floor: the direction of friction turns over the face around its middle.
//
// The mean distance of a unit square from its middle is d = (sqrt(2) + asinh(1)) / 6 = 0.3826, so that a slab of side a
// and weight W under uniform pressure resists a couple of mu W d a.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::twisting_friction_test {
namespace {

const double mean_distance = (std::sqrt(2.0) + std::asinh(1.0)) / 6.0;
const double friction = std::tan(30.0 * 3.141592653589793 / 180.0);
constexpr double gravity = 9.81;

/// A slab of 1 x 1 x 0.2 m, 500 kg, on a floor. No lateral strain: it would bend the slab under its own weight and move
/// pressure from the rim to the middle.
std::string slab_on_a_floor(const std::string& head, int order, const std::string& more) {
  return head + R"([contact]
friction_angle = 30
[[material]]
name = "stone"
density = 2500
young_modulus = 1e10
poisson_ratio = 0
[[block]]
name = "ground"
fixed = true
box = { min = [-3, -3, -1], max = [3, 3, 0] }
[[measure]]
name = "slab"
block = "slab"
[output]
every = 1000000
[[block]]
name = "slab"
material = "stone"
box = { min = [-0.5, -0.5, 0], max = [0.5, 0.5, 0.2] }
order = )" +
         std::to_string(order) + "\n" + more;
}

class TwistingFriction : public RunCommand {};

/// Two forces on opposite faces, N, which make a couple of 1 m times one of them.
std::string couple_of(double force) {
  const std::string size = std::to_string(force);
  return "[[block.load]]\nplane = { point = [-0.5, 0, 0], normal = [1, 0, 0] }\nforce = [0, -" + size +
         ", 0]\n[[block.load]]\nplane = { point = [0.5, 0, 0], normal = [1, 0, 0] }\nforce = [0, " + size +
         ", 0]\n";
}

TEST_F(TwistingFriction, ASlabResistsTheCoupleOfUniformPressure) {
  // Beyond it the slab turns: until it moves for certain, or until the forces' arms are as much shorter.
  const double expected = friction * 500.0 * gravity * mean_distance;
  for (const int order : {0, 1, 2, 3}) {
    for (const double share : {0.995, 1.005}) {
      write_text(scene_,
                 slab_on_a_floor("[analysis]\ntype = \"static\"\n", order, couple_of(share * expected)));
      const std::string out = (folder_ / (std::to_string(order) + std::to_string(share))).string();
      const int status = command({"run", scene_.string(), "--out", out, "--quiet"});
      const double turned = column(out + "/history.csv", "slab.rz").back();  // degrees
      if (share < 1.0) {
        EXPECT_EQ(status, 0) << faults_;
        EXPECT_LT(turned, 1e-3) << "order " << order;
      } else {
        EXPECT_GT(turned, 1e-2) << "order " << order;
      }
    }
  }
}

TEST_F(TwistingFriction, ASpinningSlabTurnsUntilFrictionHasStoppedIt) {
  // I = m a^2 / 6, 1 rad/s: the angle is I / (2 mu W d).
  const double expected = 1.0 / 6.0 / (2.0 * friction * gravity * mean_distance);
  for (const char* augmented : {"true", "false"}) {
    for (const int order : {0, 1, 2, 3}) {
      write_text(scene_, slab_on_a_floor("[analysis]\nend_time = 0.1\ntime_step = 1e-3\ninitial_state = "
                                         "\"as-placed\"\n",
                                         order, "angular_velocity = [0, 0, 1]\n"));
      const std::string out = (folder_ / (augmented + std::to_string(order))).string();
      ASSERT_EQ(command({"run", scene_.string(), "--out", out, "--quiet", "--set",
                         std::string("contact.augmented=") + augmented}),
                0)
          << faults_;
      EXPECT_NEAR(column(out + "/history.csv", "slab.rz").back() * 3.141592653589793 / 180.0, expected,
                  0.005 * expected)
          << "order " << order << ", multipliers " << augmented;
    }
  }
}

}  // namespace
}  // namespace ashlar::twisting_friction_test
