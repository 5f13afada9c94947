#include "solver/step/solve/contact_line.hpp"

#include <gtest/gtest.h>

#include <random>

#include "unit/solver/step/sample_problem.hpp"

namespace ashlar::contact_line_test {
namespace {

using test_support::level_point;
using test_support::SampleProblem;

/// Corners of the base, three of them closed.
SampleProblem sample_of(const JointLaw& law) {
  return {law,
          {level_point({0, 0, 0}, -2e-6), level_point({1, 0, 0}, -1e-6), level_point({1, 1, 0}, -1e-6),
           level_point({0, 1, 0}, 1e-6)}};
}

// Opening, closing, sticking and sliding: work per share is the force on the unknowns times the change, found by rows.
TEST(ContactLine, WorkIsThatOfAllForcesAtEachShare) {
  JointLaw dilating{1e9, 5e8, 0.5, 1e3, 0.0, true};
  dilating.dilation = 0.2;
  JointLaw multipliers{1e9, 5e8, 0.5, 0.0, 0.0, true};
  multipliers.transmission = Transmission::multipliers;
  for (const JointLaw& law : {JointLaw{1e9, 5e8, 0.5, 0.0, 0.0, true}, dilating, multipliers}) {
    SampleProblem sample = sample_of(law);
    IslandProblem& problem = sample.problem;
    std::mt19937_64 random(20261127);
    const auto any = [&] { return 0x1p-52 * static_cast<double>(random() >> 11U) - 1.0; };
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::VectorXd change =
          4e-6 * Eigen::VectorXd::NullaryExpr(sample.cube.unknowns(), [&](auto) { return any(); });
      problem.respond();
      const ContactLine line(problem, change, 0.0);
      double at = 0.0;
      for (const double share : {0.0, 0.3, 1.0, 2.0}) {
        problem.apply(change, share - at);
        at = share;
        problem.respond();
        const Eigen::VectorXd forces = problem.contact_forces();
        EXPECT_NEAR(line.work(share), forces.dot(change), 1e-9 * forces.norm() * change.norm())
            << trial << ' ' << share;
      }
      // The same line from its other end.
      EXPECT_NEAR(ContactLine(problem, change, at).work(0.3), line.work(0.3),
                  1e-9 * (std::abs(line.work(0.3)) + std::abs(line.work(2.0))));
      problem.apply(change, -at);
    }
  }
}

}  // namespace
}  // namespace ashlar::contact_line_test
