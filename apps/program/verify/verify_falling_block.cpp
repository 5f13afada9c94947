// Convergence of the paper's example: finer steps, orders and sub-faces; momentum, energy; the incremental
// formulation.
#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/program/verify/falling_block.hpp"
#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {
namespace {

struct Impact {
  double deepest = 0.0;         ///< m, smallest height of the cantilever's tip relative to its undeformed
                                ///< place
  double momentum_error = 0.0;  ///< of the cube, largest, over its momentum at impact
  double energy_error = 0.0;    ///< residual of a step, or gain of contacts, relative to the largest energy
};

/// Up to 1.1 s, after the first impact and before the cube comes back to the cantilever.
Impact run(const FallingBlock& example, const Placement& placement) {
  constexpr double end = 1.1;
  Simulation simulation = falling_block(example, placement);
  const Vector3 tip = placement.point(falling_block_tip());
  const double mass = simulation.blocks()[0].mass();
  Impact impact;
  double expected = 0.0;
  while (!simulation.reached(end)) {
    take_step(simulation, end);
    Vector3 force = Vector3::Zero();
    for (const PairRecord& record : simulation.contacts()) force += force_on_a(record);
    expected += simulation.report().step * (placement.direction_back(force).z() - 9.81 * mass);
    const Vector3 momentum =
        placement.direction_back(simulation.blocks()[0].momentum(simulation.states()[0]));
    impact.momentum_error =
        std::max(impact.momentum_error, std::abs(momentum.z() - expected) / (mass * std::sqrt(2.0 * 9.81)));
    const Vector3 motion = simulation.blocks()[1].motion_of(simulation.states()[1], tip).displacement;
    impact.deepest = std::min(impact.deepest, placement.direction_back(motion).z());
  }
  impact.energy_error = std::max(simulation.largest_step_residual(), simulation.ledger().redetection_gained) /
                        simulation.largest_energy();
  return impact;
}

std::vector<VerificationCheck> falling_block_case(const Placement& placement) {
  const auto variant = [&](auto change) {
    FallingBlock example;
    change(example);
    return run(example, placement);
  };
  const Impact coarse = variant([](FallingBlock&) {});
  const Impact fine = variant([](FallingBlock& example) { example.time_step = 5e-4; });
  const Impact finer = variant([](FallingBlock& example) { example.time_step = 2.5e-4; });
  const Impact high = variant([](FallingBlock& example) { example.order = 5; });
  const Impact higher = variant([](FallingBlock& example) { example.order = 6; });
  const Impact divided = variant([](FallingBlock& example) { example.chord_tolerance = 3e-3; });
  const Impact incremental = variant([](FallingBlock& example) {
    example.formulation = Formulation::incremental;
    example.subdivisions = 1;
  });
  constexpr double reported = std::numeric_limits<double>::infinity();
  double momentum_error = 0.0, energy_error = 0.0;
  for (const Impact& impact : {coarse, fine, finer, high, higher, divided}) {
    momentum_error = std::max(momentum_error, impact.momentum_error);
    energy_error = std::max(energy_error, impact.energy_error);
  }
  return {
      check_relative("deepest tip at 1 ms and 0.5 ms, m", coarse.deepest, fine.deepest, 0.02),
      check_relative("deepest tip at 0.5 ms and 0.25 ms, m", fine.deepest, finer.deepest, 0.02),
      check_relative("deepest tip of orders 5 and 6, m", high.deepest, higher.deepest, 0.02),
      check_relative("deepest tip at chord tolerances 7.5 mm and 3 mm, m", coarse.deepest, divided.deepest,
                     0.02),
      check_absolute("momentum of the cube less impulses, over that at impact", momentum_error, 0.0, 1e-9),
      check_absolute("residual of a step or gain of contacts over largest energy", energy_error, 0.0, 1e-8),
      check_relative("deepest tip, incremental formulation and this one, m", incremental.deepest,
                     coarse.deepest, reported)};
}

constexpr VerificationCase falling_block_case_list[] = {
    {"falling-block", "a cube that falls on a cantilever: convergence", falling_block_case},
};

}  // namespace

std::span<const VerificationCase> falling_block_cases() {
  return falling_block_case_list;
}

}  // namespace ashlar
