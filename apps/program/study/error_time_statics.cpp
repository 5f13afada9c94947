// Plate and sphere of error_time_problems.hpp.
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "apps/program/study/error_time_problems.hpp"
#include "apps/program/verify/hertz_sphere.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_values.hpp"
#include "solver/accuracy/static_accuracy.hpp"

namespace ashlar {
namespace {

constexpr double no_equilibrium = std::numeric_limits<double>::infinity();

}  // namespace

double error_in_equilibrium(Simulation simulation, const GoalValues& goal, double exact,
                            const ErrorTimeSetting& setting) {
  if (setting.accuracy == 0.0) {
    if (find_equilibrium(simulation) != StaticStatus::equilibrium) return no_equilibrium;
  } else {
    AccuracyRounds rounds;
    const AccuracyRequest request{setting.accuracy, std::vector<bool>(simulation.blocks().size(), true)};
    if (find_equilibrium(simulation, 1.0, request, goal, rounds, [] { return true; }) !=
        StaticStatus::equilibrium)
      return no_equilibrium;
    if (setting.estimate != nullptr)
      *setting.estimate = accuracy_estimate(goal(simulation), rounds).largest();
  }
  return std::abs(goal(simulation)[0].values[0] / exact - 1.0);
}

double plate_error(const ErrorTimeSetting& setting) {
  const GoalValues middle = [](const Simulation& now) {
    const Vector3 moved = displacement(now.blocks()[0], now.states()[0].position, middle_of_plate);
    return std::vector<Goal>{{"middle", {moved.z()}, 1e-12}};
  };
  return error_in_equilibrium(lone_block(clamped_plate(setting.order), {}, {}), middle, deflection_of_plate(),
                              setting);
}

double sphere_error(const ErrorTimeSetting& setting) {
  HertzSphere sphere;
  const bool chosen = setting.accuracy > 0.0;
  sphere.far_order = chosen ? 1 : setting.order;
  sphere.near_order = chosen ? 1 : setting.order + 1;
  sphere.inner_order = chosen ? 1 : setting.order + 2;
  const GoalValues approach = [&](const Simulation& now) {
    return std::vector<Goal>{{"approach", {approach_of(now, sphere)}}};
  };
  return error_in_equilibrium(sphere_on_plane(sphere), approach, sphere.approach(), setting);
}

}  // namespace ashlar
