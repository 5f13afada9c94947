// The equations of a cube of 1 m on the corners of its base, on fixed ground.
#pragma once

#include <vector>

#include "solver/step/island/island_equations.hpp"
#include "support/simulations.hpp"
#include "unit/solver/contact/sample_pair.hpp"

namespace ashlar::test_support {

/// Steps of 1 ms; the cube has a mass of 2500 kg.
struct SampleProblem {
  /// @param points between the cube, from (0, 0, 0) to (1, 1, 1), and the ground below
  SampleProblem(const JointLaw& law, std::vector<ContactPoint> points)
      : pairs{{{0, 1, {&cube, &at_rest, nullptr}, {&ground, &of_ground, nullptr}},
               law,
               {points},
               std::vector<PointMemory>(points.size())}},
        problem(island, bodies, pairs, scheme, settings,
                solver_of(island, bodies, pairs, SystemRole::step, solvers)) {}

  BlockModel cube{block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 1)};
  BlockModel ground{fixed_box({-2, -2, -1}, {3, 3, 0})};
  BlockState at_rest = cube.initial_state();
  BlockState of_ground = ground.initial_state();
  std::vector<ContactPair> pairs;
  std::vector<BodyStep> bodies = bodies_at_rest();
  Island island{{0}, {0}};
  IslandSolvers solvers{LinearMethod::cholesky};
  SimulationSettings settings;
  TimeScheme scheme = time_scheme(settings, 1e-3);
  IslandProblem problem;

 private:
  [[nodiscard]] std::vector<BodyStep> bodies_at_rest() const {
    std::vector<BodyStep> result(2);
    for (BodyStep& body : result) {
      body.model = &body == result.data() ? &cube : &ground;
      body.state = &body == result.data() ? &at_rest : &of_ground;
      body.free_change = body.external_force = body.change = Eigen::VectorXd::Zero(body.model->unknowns());
    }
    return result;
  }
};

}  // namespace ashlar::test_support
