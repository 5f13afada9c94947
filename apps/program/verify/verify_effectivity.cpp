#include "apps/program/verify/verify_effectivity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "apps/program/study/error_time_study.hpp"
#include "apps/program/verify/hertz_sphere.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_values.hpp"
#include "solver/accuracy/goal_error.hpp"

namespace ashlar {
namespace {

/// @param estimated,error relative
VerificationCheck check_ratio(std::string what, double estimated, double error) {
  const double ratio = estimated / error;
  constexpr double least = 0.5, most = 3.0;
  return {fmt::format("{}, estimated over true error ({:.2g})", std::move(what), error), ratio, 1.0,
          std::abs(ratio - 1.0), ratio < 1.0 ? 1.0 - least : most - 1.0};
}

/// Deflection of a point of one block under its weight. @param exact m, upwards
VerificationCheck check_deflection(const std::string& what, BlockDefinition block, const Vector3& point,
                                   double exact) {
  Simulation simulation = lone_block(std::move(block), {}, {});
  if (find_equilibrium(simulation) != StaticStatus::equilibrium) return check_ratio(what, std::nan(""), 1.0);
  const GoalValues goal = [&](const Simulation& now) {
    return std::vector<Goal>{
        {"deflection", {displacement(now.blocks()[0], now.states()[0].position, point).z()}}};
  };
  const std::vector<GoalError> errors = goal_errors(simulation, goal);
  const double found = goal(simulation)[0].values[0];
  return check_ratio(what, errors.empty() ? 0.0 : errors[0].relative, std::abs(found / exact - 1.0));
}

/// Hangs from its upper face; u = rho g (h s - s^2 / 2) / E at the distance s below it.
VerificationCheck hanging_bar() {
  constexpr double height = 2.0;
  const Material soft{2500.0, 1e8, 0.0};
  BlockDefinition bar = define_block(Polyhedron(make_box({0, 0, 0}, {0.5, 1, height})), soft, 1);
  bar.supports.push_back({Plane{{0, 0, height}, Vector3::UnitZ()}});
  return check_deflection("hanging bar, order 1, its middle", std::move(bar), {0.25, 0.5, 0.5 * height},
                          -0.375 * soft.density * earth_gravity * height * height / soft.young_modulus);
}

/// 8 by 1 by 3, clamped at one end. The tip's deflection was computed by another program (orders_study.hpp).
VerificationCheck clamped_beam(int order) {
  BlockDefinition beam =
      define_block(Polyhedron(make_box({0, -0.5, -1.5}, {8, 0.5, 1.5})), {3600, 1e10, 0.2}, order);
  beam.supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
  return check_deflection(fmt::format("clamped beam, order {}, its tip", order), std::move(beam), {8, 0, 0},
                          -2.7131353e-3);
}

VerificationCheck deflected_plate(int order) {
  return check_deflection(fmt::format("clamped plate, order {}, its middle", order), clamped_plate(order),
                          middle_of_plate, deflection_of_plate());
}

/// Of low orders, so that the springs and facets do not matter beside them.
VerificationCheck hertz(int inner, int near, int far) {
  HertzSphere sphere;
  sphere.inner_order = inner;
  sphere.near_order = near;
  sphere.far_order = far;
  sphere.estimates = true;
  const HertzContact contact = press(sphere);
  return check_ratio(fmt::format("Hertz's sphere, orders {}, {}, {}, its approach", inner, near, far),
                     contact.equilibrium ? contact.approach_error : std::nan(""),
                     std::abs(contact.approach / sphere.approach() - 1.0));
}

}  // namespace

std::vector<VerificationCheck> check_effectivity() {
  std::vector<VerificationCheck> checks{hanging_bar()};
  for (const int order : {1, 2, 3, 4}) checks.push_back(clamped_beam(order));
  for (const int order : {1, 2, 4, 6}) checks.push_back(deflected_plate(order));
  checks.push_back(hertz(3, 2, 1));
  for (const ChosenRun& run : chosen_runs(2))
    if (run.name.starts_with("swelling"))
      checks.push_back(
          check_ratio(fmt::format("{}, asked {:.0e}", run.name, run.accuracy), run.estimate, run.error));
  return checks;
}

}  // namespace ashlar
