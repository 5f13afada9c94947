#include "apps/results/tables/contact_state.hpp"

#include <algorithm>

#include "unit/apps/results/ended_run.hpp"

namespace ashlar::test::contact_state_test {
namespace {

/// A plate on a slope whose tangent is 0.5 (26.6 degrees), with a friction angle.
std::string plate(const std::string& analysis, int friction_angle) {
  return "analysis = { " + analysis + " }\ncontact = { friction_angle = " + std::to_string(friction_angle) +
         R"( }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
[[block]]
name = "slope"
fixed = true
box = { min = [-9, -4, -1], max = [9, 4, 0] }
rotate = { axis = [0, -1, 0], angle = "= atan(0.5) / deg" }
[[block]]
name = "stone"
material = "stone"
box = { min = [-1, -1, 0], max = [1, 1, 0.5] }
rotate = { axis = [0, -1, 0], angle = "= atan(0.5) / deg" }
)";
}

/// Points that the solver has at their limit.
int points_at_limit(const Simulation& simulation) {
  int count = 0;
  for (const PairRecord& record : simulation.contacts())
    count += static_cast<int>(
        std::count_if(record.responses.begin(), record.responses.end(),
                      [](const PointResponse& point) { return point.state == ContactState::sliding; }));
  return count;
}

// A semicircular arch of 15 voussoirs, 0.15 m thick, stands: its line of thrust meets every joint nearly at a right angle,
// so that joints use a small part of a friction of 60 degrees. Points at their limit balance each other within a joint.
TEST(ContactState, NothingSlidesInAStandingArch) {
  const EndedRun run(R"(
analysis = { type = "static" }
contact = { friction_angle = 60 }
material = [{ name = "stone", density = 2500, young_modulus = 1e10, poisson_ratio = 0.2 }]
masonry = [{ name = "arch", kind = "arch", material = "stone", radius = 1, thickness = 0.15, width = 0.2, voussoirs = 15 }]
[[block]]
name = "support"
fixed = true
box = { min = [-1.3, -0.3, -0.3], max = [-0.7, 0.3, 0] }
array = { count = [2], step = [[2, 0, 0]] }
)");
  ASSERT_EQ(run.run().status(), RunStatus::equilibrium);
  EXPECT_GT(points_at_limit(run.run().simulation()), 0)
      << "forces in joints are unique: the test shows nothing";
  EXPECT_EQ(contact_counts(run.run().simulation()).sliding, 0);
  EXPECT_EQ(run.last("contacts.sliding"), 0.0);
  EXPECT_GT(run.last("contacts.locked"), 0.0);
}

TEST(ContactState, APlateThatSlidesDownASlopeSlides) {
  // tan 20 degrees = 0.364 < 0.5
  const EndedRun run(plate("end_time = 0.1, time_step = 1e-3", 20));
  EXPECT_GT(run.last("contacts.sliding"), 0.0);
  EXPECT_EQ(run.last("contacts.locked"), 0.0);
}

TEST(ContactState, APlateThatRestsOnASlopeDoesNotSlide) {
  // tan 30 degrees = 0.577 > 0.5
  const EndedRun run(plate("type = \"static\"", 30));
  ASSERT_EQ(run.run().status(), RunStatus::equilibrium);
  EXPECT_EQ(run.last("contacts.sliding"), 0.0);
  EXPECT_GT(run.last("contacts.locked"), 0.0);
}

// A static analysis that finds motion ends in a state that has moved: its joint is at its limit.
TEST(ContactState, AJointAtItsLimitSlides) {
  const EndedRun run(plate("type = \"static\"", 20));
  ASSERT_EQ(run.run().status(), RunStatus::moving);
  EXPECT_GT(run.last("contacts.sliding"), 0.0);
}

}  // namespace
}  // namespace ashlar::test::contact_state_test
