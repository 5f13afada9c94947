#include "mechanics/block/incremental_block.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "mechanics/block/block_model.hpp"
#include "support/check_derivatives.hpp"
#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::incremental_block_test {
namespace {

const Material rock{2000.0, 3e9, 0.25};

BlockDefinition incremental(const Polyhedron& solid, int order) {
  BlockDefinition definition = test_support::block_of("A", solid, rock, order);
  definition.formulation = Formulation::incremental;
  return definition;
}

Polyhedron box() {
  return Polyhedron(make_box({0, 0, 0}, {1, 2, 3}));
}

/// Coefficients of the displacement  gradient (x - origin).
Eigen::MatrixX3d linear_motion(const BlockModel& block, const Eigen::Matrix3d& gradient) {
  return block.basis().linear_field(gradient * block.basis().centroid(), gradient);
}

TEST(IncrementalBlock, ForceIsTheDerivativeOfTheEnergy) {
  for (const int order : {1, 3}) {
    const PolynomialBasis basis(test_support::l_shaped_prism(), order);
    const Eigen::Index p = basis.size();
    Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(p, 6);
    stress.topRows(p) =
        1e5 * Eigen::VectorXd::LinSpaced(6 * p, 0.0, 9.0).array().sin().matrix().reshaped(p, 6);
    const Eigen::VectorXd place = 1e-4 * Eigen::VectorXd::LinSpaced(3 * p, 1.0, 7.0).array().cos().matrix();
    const auto respond = [&](const Eigen::VectorXd& d) {
      return incremental_response(basis, rock, stress, Eigen::Map<const Eigen::MatrixX3d>(d.data(), p, 3));
    };
    const Eigen::MatrixX3d force = respond(place).force;
    const Eigen::MatrixXd gradient = Eigen::Map<const Eigen::RowVectorXd>(force.data(), 3 * p);
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& d) { return Eigen::VectorXd::Constant(1, respond(d).energy); }, place,
        gradient, 1e-4, 1e-8);
  }
}

TEST(IncrementalBlock, WithoutStressTheForceIsThatOfTheStiffness) {
  const PolynomialBasis basis(test_support::l_shaped_prism(), 3);
  const Eigen::Index p = basis.size();
  const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(3 * p, 1.0, 7.0).array().cos();
  const Eigen::VectorXd expected = elastic_stiffness(basis, rock) * d;
  const ElasticResponse response = incremental_response(basis, rock, Eigen::MatrixXd::Zero(p, 6),
                                                        Eigen::Map<const Eigen::MatrixX3d>(d.data(), p, 3));
  EXPECT_LT((response.force.reshaped() - expected).norm(), 1e-12 * expected.norm());
  EXPECT_NEAR(response.energy, 0.5 * d.dot(expected), 1e-12 * response.energy);
}

TEST(IncrementalBlock, StressAddsUp) {
  // Two stretches of 1e-3 and 2e-3 along x: sigma_xx = (lambda + 2 mu) e, sigma_yy = sigma_zz = lambda e.
  const BlockModel start(incremental(box(), 2));
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient(0, 0) = 1e-3;
  const BlockModel next =
      start.carried_on(start.basis().identity_map() + linear_motion(start, gradient)).model;
  BlockState state = next.initial_state();
  state.position += linear_motion(next, 2.0 * gradient);
  const double across = rock.lame_lambda() * 3e-3;
  const double along = across + 2.0 * rock.lame_mu() * 3e-3;
  for (const Vector3& point : next.solid().mesh().points) {
    const Eigen::Matrix3d stress = next.stress(state, point);
    EXPECT_LT((stress - Eigen::Matrix3d(Vector3(along, across, across).asDiagonal())).norm(), 1e-9 * along);
  }
  EXPECT_NEAR(next.elastic(next.initial_state().position).energy,
              0.5 * next.basis().volume() * (rock.lame_lambda() + 2.0 * rock.lame_mu()) * 1e-6, 1e-3);
}

TEST(IncrementalBlock, VolumeGrowsByTheSquareOfTheTurn) {
  // I + t [e_z]x has the determinant 1 + t^2: the known fault.
  const double t = 0.01;
  Eigen::Matrix3d spin = Eigen::Matrix3d::Zero();
  spin(0, 1) = -t;
  spin(1, 0) = t;
  for (const int order : {1, 3}) {
    BlockModel block(incremental(box(), order));
    for (int step = 0; step < 3; ++step)
      block = block.carried_on(block.basis().identity_map() + linear_motion(block, spin)).model;
    const double growth = 1.0 + t * t;
    EXPECT_NEAR(block.basis().volume(), 6.0 * growth * growth * growth, 1e-12) << order;
    EXPECT_LT(block.stress(block.initial_state(), block.basis().centroid()).norm(), 1e-3) << order;
  }
}

TEST(IncrementalBlock, PolynomialsMoveAlong) {
  const PolynomialBasis from(box(), 3);
  const Vector3 shift(0.3, -0.2, 0.5);
  const PolynomialBasis to(Polyhedron(make_box({0.2, -0.1, 0.6}, {1.4, 1.9, 3.4})), 3);
  const Eigen::VectorXd coefficients = Eigen::VectorXd::LinSpaced(from.size(), -1.0, 4.0).array().sin();
  const Eigen::VectorXd moved = re_expansion(from, to, shift) * coefficients;
  for (const Vector3& point : {Vector3(0.2, 1.0, 2.0), Vector3(1.4, -0.1, 3.4), Vector3(0.7, 0.7, 0.7)})
    EXPECT_NEAR(to.values(point).dot(moved), from.values(Vector3(point - shift)).dot(coefficients), 1e-12);
}

TEST(IncrementalBlock, WhatVanishesOnAClampStillDoes) {
  BlockDefinition definition = incremental(box(), 3);
  definition.supports.push_back({Plane{{0, 0, 0}, {0, 0, 1}}});
  definition.loads.push_back({Vector3(0.5, 1.0, 3.0), false, {1e6, 0, 0}, {}});
  const BlockModel start(std::move(definition));
  const auto position = start.equilibrium({0, 0, -9.81}, 0.0);
  ASSERT_TRUE(position.has_value());
  const CarriedBlock next = start.carried_on(*position);
  ASSERT_GT((next.model.basis().centroid() - start.basis().centroid()).norm(), 1e-4);
  const Eigen::MatrixX3d velocity = next.taken_over(*position - start.basis().identity_map());
  for (const Vector3& point : {Vector3(0, 0, 0), Vector3(1, 2, 0), Vector3(0.4, 1.1, 0)})
    EXPECT_LT((velocity.transpose() * next.model.basis().values(point)).norm(), 1e-12);
  // A field that vanishes on the clamp stays where it is, as the clamp does.
  const Vector3 inside(0.3, 1.4, 2.2);
  const Vector3 before =
      (*position - start.basis().identity_map()).transpose() * start.basis().values(inside);
  const Vector3 after = velocity.transpose() * next.model.basis().values(inside);
  EXPECT_LT((after - before).norm(), 1e-12);
  // The force goes with its point.
  const Vector3 tip = start.motion_of({*position, velocity}, {0.5, 1.0, 3.0}).place;
  EXPECT_LT((next.model.motion_of(next.model.initial_state(), {0.5, 1.0, 3.0}).place - tip).norm(), 1e-12);
  const Eigen::MatrixX3d expected = next.model.basis().values(tip) * Vector3(1e6, 0, 0).transpose();
  EXPECT_LT((next.model.load_force(0.0) - expected).norm(), 1e-9 * expected.norm());
}

TEST(IncrementalBlock, TractionsActOnThePresentArea) {
  BlockDefinition definition = incremental(box(), 2);
  definition.loads.push_back({Plane{{0, 0, 3}, {0, 0, 1}}, true, {0, 0, 5.0}, {}});
  const BlockModel start(std::move(definition));
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Zero();
  stretch(0, 0) = 0.1;
  const BlockModel next =
      start.carried_on(start.basis().identity_map() + linear_motion(start, stretch)).model;
  // The first function is 1/sqrt(V): its row is the resultant over sqrt(V). The face is 1.1 x 2.
  EXPECT_NEAR(next.load_force(0.0)(0, 2) * std::sqrt(next.basis().volume()), 5.0 * 2.2, 1e-11);
}

TEST(IncrementalBlock, OnlyFollowedPointsAreKnown) {
  BlockDefinition definition = incremental(box(), 2);
  definition.followed.push_back({0.3, 0.4, 0.5});
  const BlockModel block(std::move(definition));
  BlockState state = block.initial_state();
  state.position.row(0) += std::sqrt(block.basis().volume()) * Eigen::RowVector3d(1, 2, 3);
  for (const Vector3& point : {Vector3(0.3, 0.4, 0.5), Vector3(1, 2, 3), Vector3(0.5, 0.5, 0)}) {
    const PointMotion motion = block.motion_of(state, point);
    EXPECT_LT((motion.place - point - Vector3(1, 2, 3)).norm(), 1e-13);
    EXPECT_LT((motion.displacement - Vector3(1, 2, 3)).norm(), 1e-13);
  }
  EXPECT_THROW((void)block.motion_of(state, {0.31, 0.4, 0.5}), std::invalid_argument);
}

TEST(IncrementalBlock, LargeStrainElasticityIsRefused) {
  BlockDefinition definition = incremental(box(), 2);
  definition.material.elasticity = Elasticity::st_venant_kirchhoff;
  EXPECT_THROW(BlockModel{definition}, std::invalid_argument);
}

TEST(IncrementalBlock, ABlockTurnedInsideOutIsRefused) {
  const BlockModel block(incremental(box(), 1));
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Zero();
  mirror(0, 0) = -2.0;
  EXPECT_THROW((void)block.carried_on(block.basis().identity_map() + linear_motion(block, mirror)),
               std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::incremental_block_test
