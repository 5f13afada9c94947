#include "mechanics/contact/laws/point_force.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "unit/mechanics/contact/laws/sample_joint.hpp"

namespace ashlar::point_force_test {
namespace {

/// Laws without dilation, dashpots, gradual damage and yielding, each with what the others do not have.
std::vector<PointLaw> frequent_laws() {
  const PointLaw failed = point_law(test_support::law, 0.1, false);
  std::vector<PointLaw> laws(6, failed);
  laws[1] = point_law(test_support::law, 0.1, true);
  laws[2].normal_multiplier = 700.0;
  laws[2].shear_multiplier = {-200.0, 100.0};
  laws[2].impulse_force = 300.0;
  laws[3].held_limit = 500.0;
  laws[4].friction = 0.0;
  laws[5].cohesion = 400.0;
  laws[5].bridged = true;
  for (PointLaw& law : laws) law.rounding = 1e-9;
  return laws;
}

TEST(FrequentLaw, IsThePointLawWithoutWhatItDoesNotHave) {
  std::mt19937_64 random(20261129);
  const auto any = [&] { return 0x1p-52 * static_cast<double>(random() >> 11U) - 1.0; };
  std::set<ContactState> states;
  for (const PointLaw& law : frequent_laws()) {
    ASSERT_TRUE(is_frequent(law));
    for (int k = 0; k < 200; ++k) {
      const double gap = k == 0 ? 0.0 : 1e-5 * any();
      const Eigen::Vector2d slip(1e-5 * any(), 1e-5 * any());
      const PointResponse expected = point_response(law, gap, slip);
      const FrequentLaw frequent(law);
      const PointForce at = point_force(frequent, gap, slip);
      const PointDerivative derivative = point_derivative(frequent, at);
      states.insert(at.state);
      EXPECT_EQ(at.state, expected.state);
      EXPECT_EQ(at.force, expected.force);
      EXPECT_EQ(derivative.tangent, expected.tangent);
      EXPECT_EQ(derivative.coupling.force, expected.coupling.force);
      EXPECT_EQ(limit_at(frequent, at.state, at.force[0], 0.0), end_response(law, expected, gap).limit);
    }
  }
  EXPECT_EQ(states.size(), 3U);
}

TEST(FrequentLaw, OthersAreNotFrequent) {
  std::vector<PointLaw> others(6, point_law(test_support::law, 0.1, true));
  others[0].dilation.tangent = 0.1;
  others[1].dashpots.normal = 1.0;
  others[2].dashpots.shear = 1.0;
  others[3].bond.tension = 1.0;
  others[4].is_static = true;
  others[4].residual[2] = others[4].tension;
  others[5].crushing = 1e4;
  for (const PointLaw& law : others) EXPECT_FALSE(is_frequent(law));
}

}  // namespace
}  // namespace ashlar::point_force_test
