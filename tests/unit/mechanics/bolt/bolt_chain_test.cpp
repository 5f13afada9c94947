#include "mechanics/bolt/bolt_chain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/bolt/bolt_kinematics.hpp"
#include "support/check_derivatives.hpp"

namespace ashlar::bolt_chain_test {
namespace {

constexpr double k = 4e8;   // N/m per m
constexpr double ea = 1e8;  // N: the transfer length is 0.5 m

BoltLaw grouted() {
  BoltLaw law;
  law.axial_stiffness = ea;
  law.bond_stiffness = k;
  law.shear_stiffness = 3e7;
  return law;
}

/// Two pieces of 3 m on both sides of a joint, along x; blocks of order 1.
BoltChain across_a_joint(const BoltLaw& law) {
  return {law,
          BoltShape(law, {-3.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {{0, 1, 0.0, 3.0}, {1, 1, 3.0, 6.0}}, 0.025),
          {true, true}};
}

/// The deformation of a joint that opens by `opening` and is sheared by `shear` without strain of the rock.
Eigen::VectorXd opened(const BoltChain& bolt, double opening, double shear = 0.0) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(deformation_count(bolt.shape()));
  v[2] = v[3] = opening;
  if (v.size() > 4) v[4] = shear;
  return v;
}

/// Largest force of the bar, that at the joint.
double force_at_joint(const BoltResponse& response) {
  double largest = 0.0;
  for (const SpringPoint& spring : response.bar) largest = std::max(largest, spring.force);
  return largest;
}

// EA w'' = k w on each side, w' = 0 at the far end: the bar leaves the rock by u = T coth(lambda L)/(EA lambda).
TEST(BoltChain, PullsOutAsTheShearLagSolution) {
  const BoltChain bolt = across_a_joint(grouted());
  const double lambda = std::sqrt(k / ea);
  const double u = 1e-4;
  const BoltResponse response = bolt.respond(opened(bolt, 2.0 * u), bolt.installed_at(opened(bolt, 0.0)));
  const double expected = u * ea * lambda * std::tanh(lambda * 3.0);
  EXPECT_NEAR(force_at_joint(response), expected, 0.005 * expected);
  EXPECT_NEAR(response.force[2] + response.force[3], force_at_joint(response), 1e-6 * expected);
  EXPECT_NEAR(response.stored, 0.5 * expected * 2.0 * u, 0.005 * expected * u);
  EXPECT_EQ(response.dissipated, 0.0);
}

TEST(BoltChain, SlipsOutOfItsGroutAtStrengthTimesLength) {
  BoltLaw law = grouted();
  law.bond_strength = 2e4;
  const BoltChain bolt = across_a_joint(law);
  const BoltResponse response = bolt.respond(opened(bolt, 0.05), bolt.installed_at(opened(bolt, 0.0)));
  EXPECT_NEAR(force_at_joint(response), 2e4 * 3.0, 1e-3 * 2e4 * 3.0);
}

TEST(BoltChain, YieldsWhereItCrossesTheJoint) {
  BoltLaw law = grouted();
  law.yield_force = 1e5;
  law.rupture_strain = 0.5;
  const BoltChain bolt = across_a_joint(law);
  BoltMemory memory = bolt.installed_at(opened(bolt, 0.0));
  BoltResponse response = bolt.respond(opened(bolt, 0.01), memory);
  EXPECT_NEAR(force_at_joint(response), 1e5, 2e-4 * 1e5);
  memory = bolt.memory_after(response, memory);
  EXPECT_FALSE(bolt.rupture(opened(bolt, 0.01), response, memory));
  // Elastic unloading: stiffness EA lambda tanh(lambda L)/2 of both sides together.
  const BoltResponse unloaded = bolt.respond(opened(bolt, 0.01 - 1e-4), memory);
  EXPECT_NEAR(force_at_joint(unloaded), 1e5 - 0.5 * 1e-4 * ea * 2.0, 0.01 * 1e5);
  // A cell is an eighth of 0.5 m long: strain 0.5 at about 0.031 m.
  response = bolt.respond(opened(bolt, 0.07), memory);
  EXPECT_TRUE(bolt.rupture(opened(bolt, 0.07), response, memory));
  EXPECT_EQ(force_at_joint(bolt.respond(opened(bolt, 0.07), bolt.memory_after(response, memory))) < 5e4,
            true);
}

TEST(BoltChain, PretensionIsLostWithinTheTransferLengthOnly) {
  BoltLaw law = grouted();
  law.pretension = 5e4;
  const BoltChain bolt = across_a_joint(law);
  const Eigen::VectorXd v = opened(bolt, 0.0);
  const BoltResponse response = bolt.respond(v, bolt.installed_at(v));
  // T (1 - 1/cosh(lambda L)) in the middle of a bar of half length L.
  EXPECT_NEAR(force_at_joint(response), 5e4 * (1.0 - 1.0 / std::cosh(6.0)), 0.005 * 5e4);
}

TEST(BoltChain, DowelYieldsInAllDirections) {
  BoltLaw law = grouted();
  law.shear_strength = 6e4;
  const BoltChain bolt = across_a_joint(law);
  const BoltMemory memory = bolt.installed_at(opened(bolt, 0.0));
  EXPECT_NEAR(bolt.respond(opened(bolt, 0.0, 1e-3), memory).dowels[0].norm(), 3e4, 1e-6);
  Eigen::VectorXd v = opened(bolt, 0.0, 3e-2);
  v[5] = 4e-2;
  const BoltResponse sheared = bolt.respond(v, memory);
  EXPECT_NEAR(sheared.dowels[0].norm(), 6e4, 6.0);
  EXPECT_NEAR(sheared.dowels[0][0], 0.6 * 6e4, 6.0);
  EXPECT_NEAR(sheared.dissipated, 6e4 * (0.05 - 0.002), 10.0);
}

TEST(BoltChain, ForcesAreTheGradientOfTheEnergyAndTheTangentTheirs) {
  BoltLaw law = grouted();
  law.yield_force = 1.5e5;
  law.bond_strength = 1.2e5;
  law.shear_strength = 6e4;
  const BoltChain bolt = across_a_joint(law);
  const BoltMemory memory = bolt.installed_at(opened(bolt, 0.0));
  for (const double opening : {1e-4, 1.5e-3, 0.02, -0.003}) {
    Eigen::VectorXd v = opened(bolt, opening, 0.7 * opening);
    v[1] += 1e-5;
    v[5] -= 1e-4;
    const BoltResponse response = bolt.respond(v, memory);
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) {
          const BoltResponse at = bolt.respond(x, memory);
          return Eigen::VectorXd::Constant(1, at.stored + at.dissipated);
        },
        v, response.force.transpose(), 1e-8, 1e-5);
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return bolt.respond(x, memory).force; }, v,
        response.tangent, 1e-9, 1e-5);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(response.tangent).eigenvalues();
    EXPECT_GE(values[0], -1e-9 * values.tail<1>()[0]);
  }
}

TEST(BoltChain, PropsPushAndYieldButDoNotPull) {
  BoltLaw law;
  law.anchorage = BoltAnchorage::ends;
  law.axial_stiffness = 2e7 * 2.0;  // 2e7 N/m
  law.yield_force = 1e5;
  law.tension = false;
  const BoltChain prop(law, BoltShape(law, {0, 0, 0}, {0, 0, 2}, {{0, 1, 0, 0}, {1, 1, 2, 2}}, 0.1),
                       {true, true});
  const auto force = [&](double elongation, const BoltMemory& memory) {
    return prop.respond(Eigen::VectorXd::Constant(1, elongation), memory).force[0];
  };
  BoltMemory memory = prop.installed_at(Eigen::VectorXd::Zero(1));
  EXPECT_EQ(force(1e-3, memory), 0.0);
  EXPECT_DOUBLE_EQ(force(-1e-3, memory), -2e4);
  const BoltResponse yielded = prop.respond(Eigen::VectorXd::Constant(1, -0.015), memory);
  EXPECT_NEAR(yielded.force[0], -1e5, 1.0);
  EXPECT_NEAR(yielded.stored, 0.5 * 1e5 * 0.005, 1e-9);
  EXPECT_NEAR(yielded.dissipated, 1e5 * 0.01, 1e-2);
  memory = prop.memory_after(yielded, memory);
  EXPECT_NEAR(force(-0.014, memory), -8e4, 1.0);
}

TEST(BoltChain, BlocksThatAreAbsentDoNotHoldIt) {
  const BoltLaw law = grouted();
  BoltShape shape = across_a_joint(law).shape();
  const BoltChain bolt(law, shape, {true, false});
  const BoltResponse response = bolt.respond(opened(bolt, 1e-3, 1e-3), bolt.installed_at(opened(bolt, 0.0)));
  EXPECT_LE(response.force.norm(), 1e-3);
}

}  // namespace
}  // namespace ashlar::bolt_chain_test
