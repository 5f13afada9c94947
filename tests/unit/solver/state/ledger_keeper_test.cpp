#include "solver/state/ledger_keeper.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::ledger_keeper_test {
namespace {

/// A cube of 2 kg with its centroid 0.5 m up, under 10 m/s^2, and a base that is never measured.
BlockSystem cube_on_base() {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(
      test_support::block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2, 1e6, 0}, 1));
  blocks.emplace_back(test_support::fixed_box({-9, -9, -1}, {9, 9, 0}));
  SimulationSettings settings;
  settings.gravity = {0, 0, -10};
  return {std::move(blocks), test_support::same_law({}), settings, {}};
}

std::vector<BlockState> states_of(const BlockSystem& system, const Vector3& velocity) {
  std::vector<BlockState> states;
  for (const BlockModel& block : system.blocks()) states.push_back(block.initial_state());
  states[0].velocity = system.blocks()[0].rigid_velocity(velocity, Vector3::Zero());
  return states;
}

TEST(LedgerKeeper, BooksEachEnergyOnceInItsPlace) {
  const BlockSystem system = cube_on_base();
  const std::vector<BlockState> states = states_of(system, {3, 0, 0});
  LedgerKeeper keeper;
  keeper.start(system, states);
  EXPECT_NEAR(keeper.ledger().kinetic, 9.0, 1e-13);   // 1/2 2 kg (3 m/s)^2
  EXPECT_NEAR(keeper.ledger().gravity, 10.0, 1e-13);  // 2 kg 10 m/s^2 0.5 m
  EXPECT_NEAR(keeper.mechanical(), 19.0, 1e-13);
  keeper.loads_did(5.0);
  keeper.damping_took(1.0);
  keeper.integrator_took(2.0);
  keeper.sliding_took(0.5);
  keeper.springs_hold(0.25);
  keeper.found_anew(0.125);
  keeper.found_anew(-0.0625);
  keeper.multipliers_gave(0.03125);
  const Ledger& ledger = keeper.ledger();
  EXPECT_EQ(ledger.applied, 5.0);
  EXPECT_EQ(ledger.damping, 1.0);
  EXPECT_EQ(ledger.numerical, 2.03125);
  EXPECT_EQ(ledger.friction, 0.5);
  EXPECT_EQ(ledger.contact, 0.25);
  EXPECT_EQ(ledger.redetection_gained, 0.15625);
  EXPECT_EQ(ledger.redetection_lost, 0.0625);
}

TEST(LedgerKeeper, WhatTheBalanceLacksIsTheResidual) {
  const BlockSystem system = cube_on_base();
  std::vector<BlockState> states = states_of(system, {3, 0, 0});
  LedgerKeeper keeper;
  keeper.start(system, states);
  // 9 J of motion end up as 4 J: 3 J were dissipated, 2 J are missing.
  states[0].velocity *= 2.0 / 3.0;
  keeper.integrator_took(3.0);
  keeper.close_step(system, states);
  EXPECT_NEAR(keeper.ledger().residual, -2.0, 1e-13);
  EXPECT_NEAR(keeper.largest_step_residual(), 2.0, 1e-13);
  EXPECT_NEAR(keeper.largest_energy(), 4.0, 1e-13);
  // A step without a residual changes neither.
  keeper.close_step(system, states);
  EXPECT_NEAR(keeper.ledger().residual, -2.0, 1e-13);
  EXPECT_NEAR(keeper.largest_step_residual(), 2.0, 1e-13);
  keeper.clear(0.75);
  keeper.start(system, states);
  EXPECT_EQ(keeper.ledger().residual, 0.0);
  EXPECT_EQ(keeper.ledger().contact, 0.75);
  EXPECT_EQ(keeper.largest_step_residual(), 0.0);
  keeper.close_step(system, states);
  EXPECT_EQ(keeper.ledger().residual, 0.0);
}

TEST(LedgerKeeper, MeasuresTheElasticEnergyOfMovingBlocks) {
  const BlockSystem system = cube_on_base();
  std::vector<BlockState> states = states_of(system, Vector3::Zero());
  // Stretched by 1 % along x, with nu = 0: 1/2 E eps^2 V = 50 J.
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient(0, 0) = 0.01;
  for (std::size_t k = 0; k < 2; ++k) {
    const PolynomialBasis& basis = system.blocks()[k].basis();
    states[k].position += basis.linear_field(gradient * basis.centroid(), gradient);
  }
  LedgerKeeper keeper;
  keeper.start(system, states);
  EXPECT_NEAR(keeper.elastic_energy(0), 50.0, 1e-9);
  EXPECT_EQ(keeper.elastic_energy(1), 0.0);
  EXPECT_NEAR(keeper.ledger().elastic, 50.0, 1e-9);
}

}  // namespace
}  // namespace ashlar::ledger_keeper_test
