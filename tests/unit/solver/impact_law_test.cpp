// Newton's law of impact for blocks that rock and tumble: the same at any step, order, and with springs and multipliers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::impact_law_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::same_law;
using test_support::turned;

const Material stone{2500.0, 1e10, 0.2};

SimulationSettings settings_of(double step, bool multipliers) {
  SimulationSettings settings;
  settings.gravity = Vector3(0, 0, -9.81);
  settings.time_step = step;
  settings.contact_distance = 6e-4;
  settings.augmented = multipliers;
  settings.rest.sleeps = false;
  return settings;
}

JointLaw law_of(double restitution, double friction) {
  JointLaw law{1e11, 5e10, friction, 0.0, 0.0, true};
  law.rigid = true;
  law.restitution = restitution;
  return law;
}

double mechanical_energy(const Simulation& simulation) {
  const Ledger& ledger = simulation.ledger();
  return ledger.kinetic + ledger.elastic + ledger.gravity + ledger.contact;
}

/// Energies of the rigid motion of block 1, of width b and height h, in the plane y = const, J.
struct RigidEnergy {
  double kinetic = 0.0;
  double total = 0.0;
};
RigidEnergy rigid_energy(const Simulation& simulation, double b, double h) {
  const BlockModel& block = simulation.blocks()[1];
  const Vector3 centre = place_of(simulation, 1, block.basis().centroid()), momentum = simulation.momentum();
  const double spin = (simulation.angular_momentum() - centre.cross(momentum)).y();
  const double inertia = block.mass() * (b * b + h * h) / 12.0;
  RigidEnergy energy;
  energy.kinetic = 0.5 * momentum.squaredNorm() / block.mass() + 0.5 * spin * spin / inertia;
  energy.total = energy.kinetic + 9.81 * block.mass() * centre.z();
  return energy;
}

/// Kinetic energy after over before an impact of the far edge of a block that rocks about the near one: an impulse at the
/// far edge that stops it along the floor and reverses e of its fall; the near edge is free to leave. Of a plane body of
/// unit mass and width b, height h: for e = 0 Housner's (1 - 3/2 sin^2 a)^2, tan a = b/h.
double kept_by_rocking(double b, double h, double e) {
  const double inertia = (b * b + h * h) / 12.0, x = -0.5 * b, z = -0.5 * h;  // the far edge from the centre
  std::array<double, 3> motion = {-0.5 * h, -0.5 * b, 1.0};  // along x, z, and turning about the near edge
  const double fall = motion[1] + motion[2] * x;
  const double xx = 1.0 + z * z / inertia, xz = -x * z / inertia, zz = 1.0 + x * x / inertia;
  const double along = -(motion[0] - motion[2] * z), up = -(1.0 + e) * fall;
  const double determinant = xx * zz - xz * xz;
  const double j_along = (along * zz - up * xz) / determinant, j_up = (up * xx - along * xz) / determinant;
  const auto energy = [&] {
    return motion[0] * motion[0] + motion[1] * motion[1] + inertia * motion[2] * motion[2];
  };
  const double before = energy();
  motion = {motion[0] + j_along, motion[1] + j_up, motion[2] + (x * j_up - z * j_along) / inertia};
  return energy() / before;
}

TEST(ImpactLaw, RockingByHandIsHousners) {
  for (const double b : {0.2, 0.3, 0.5}) {
    const double sine = std::sin(std::atan2(b, 1.2));
    EXPECT_NEAR(kept_by_rocking(b, 1.2, 0.0), std::pow(1.0 - 1.5 * sine * sine, 2), 1e-12);
  }
}

struct Rocking {
  double width, height;
  int order;
  bool multipliers;
  double step, restitution;
};
std::ostream& operator<<(std::ostream& out, const Rocking& of) {
  return out << of.width << " x " << of.height << " order " << of.order << " multipliers " << of.multipliers
             << " step " << of.step << " e " << of.restitution;
}

class OfRocking : public testing::TestWithParam<Rocking> {};

TEST_P(OfRocking, LosesTheEnergyOfItsImpulse) {
  const Rocking& of = GetParam();
  const Polyhedron solid(make_box({-of.width, 0.0, 0.0}, {0.0, 0.5, of.height}));
  const double tilt = 0.35 * std::atan2(of.width, of.height);
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -1, -1}, {2, 2, 0}));
  blocks.emplace_back(block_of(
      "block", turned(solid, Eigen::AngleAxisd(tilt, Vector3::UnitY()), Vector3::Zero()), stone, of.order));
  Simulation simulation(std::move(blocks), {{}, {}}, same_law(law_of(of.restitution, 1.5)),
                        settings_of(of.step, of.multipliers));
  const double start = mechanical_energy(simulation);
  const Vector3 far_edge(-of.width * std::cos(tilt), 0.25, of.width * std::sin(tilt));
  const auto is_down = [&] { return place_of(simulation, 1, far_edge).z() < 1e-4; };
  // The near edge strikes too, by little, as it takes the weight and where a block of order 2 vibrates on it.
  RigidEnergy before, after = rigid_energy(simulation, of.width, of.height);
  for (bool strikes = false; !strikes;) {
    const bool was_down = is_down();
    const std::uint64_t count = simulation.impacts().count;
    before = after;
    ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
    ASSERT_LT(simulation.time(), 1.0);
    after = rigid_energy(simulation, of.width, of.height);
    strikes =
        was_down && simulation.impacts().count > count && before.total - after.total > 0.05 * before.kinetic;
  }
  // Missed: on springs the edge on which a block of order 2 turns vibrates, and so does its rigid motion (restitution.md).
  const double allowed = of.order == 2 && !of.multipliers ? 0.07 : 0.02;
  EXPECT_NEAR(1.0 - (before.total - after.total) / before.kinetic,
              kept_by_rocking(of.width, of.height, of.restitution), allowed);
  EXPECT_LE(mechanical_energy(simulation), start * (1.0 + 1e-9));
}

std::vector<Rocking> rockings() {
  std::vector<Rocking> all;
  for (const auto& [b, h] : {std::pair{0.3, 1.2}, {0.2, 0.8}, {0.5, 1.0}})
    for (const int order : {0, 1, 2})
      for (const bool multipliers : {false, true})
        for (const double step : {4e-3, 1e-3, 1e-4})
          for (const double e : {0.0, 0.3})
            // Order 2 takes long at 0.1 ms. Missed: on springs at 4 ms.
            if (order < 2 || step == 1e-3 || (multipliers && step > 1e-3))
              all.push_back({b, h, order, multipliers, step, e});
  return all;
}
INSTANTIATE_TEST_SUITE_P(, OfRocking, testing::ValuesIn(rockings()));

/// An L-shaped prism in a box.
Polyhedron l_shaped(const Vector3& low, const Vector3& size) {
  const Polyhedron prism = test_support::l_shaped_prism();
  std::vector<Vector3> points;
  for (const Vector3& point : prism.mesh().points)
    points.emplace_back(low + size.cwiseProduct(point.cwiseProduct(Vector3(0.5, 0.5, 1.0))));
  return prism.with_points(std::move(points));
}

/// Blocks that fall on each other, turning. @param reversed their order in the list
Simulation tumbling(unsigned seed, bool reversed, double restitution, std::size_t count) {
  std::mt19937 random(seed);
  const auto number = [&](double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  };
  const Vector3 spin(number(-1.5, 1.5), number(-1.5, 1.5), number(-1.5, 1.5));
  const double friction = std::array{0.0, 0.3, 0.6, 1.0}[random() % 4];
  std::vector<BlockDefinition> definitions;
  double bottom = 0.1;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3 size(number(0.8, 1.2), number(0.8, 1.2), number(0.6, 1.1));
    const Vector3 low(number(-0.15, 0.15) - 0.5 * size.x(), number(-0.15, 0.15) - 0.5 * size.y(), bottom);
    const Polyhedron solid = random() % 3 == 0 ? l_shaped(low, size) : Polyhedron(make_box(low, low + size));
    definitions.push_back(block_of(std::string("b").append(std::to_string(k)), solid,
                                   Material{2500, 1e9, 0.2}, static_cast<int>(random() % 2)));
    bottom += size.z() + number(0.05, 0.3);
  }
  if (reversed) std::reverse(definitions.begin(), definitions.end());
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions(1);
  blocks.emplace_back(fixed_box({-15, -15, -2}, {15, 15, 0}));
  for (BlockDefinition& definition : definitions) {
    blocks.emplace_back(std::move(definition));
    motions.push_back({Vector3::Zero(), spin});
  }
  SimulationSettings settings = settings_of(2e-3, false);
  settings.contact_distance = 2e-3;
  return {std::move(blocks), motions, same_law(law_of(restitution, friction)), settings};
}

class OfStacks : public testing::TestWithParam<unsigned> {};

// The impact and the springs between impacts end, whatever strikes at once; no energy is gained.
TEST_P(OfStacks, TumbleWithoutAnEndOfTheRunAndWithoutGain) {
  const unsigned seed = GetParam();
  const double restitution = std::array{0.0, 0.2, 0.5, 0.8, 1.0}[seed % 5];
  Simulation simulation = tumbling(seed, false, restitution, 2 + seed % 5);
  const double start = mechanical_energy(simulation);
  double highest = start;
  while (!simulation.reached(0.6)) {
    ASSERT_EQ(simulation.step(0.6), StepStatus::accepted) << simulation.time();
    highest = std::max(highest, mechanical_energy(simulation));
  }
  EXPECT_LT(highest - start, 1e-5 * simulation.largest_energy());
  EXPECT_GT(simulation.impacts().count, 0U);
  EXPECT_LT(simulation.impacts().residual, 1e-4) << "beyond this a run warns";
}

// Until the first of two nearly equal ways is taken, the order in which blocks are listed changes nothing.
TEST_P(OfStacks, DoNotDependOnTheOrderOfBlocks) {
  const unsigned seed = GetParam();
  const double restitution = std::array{0.0, 0.2, 0.5, 0.8, 1.0}[seed % 5];
  const std::size_t count = 2 + seed % 5;
  Simulation forward = tumbling(seed, false, restitution, count);
  Simulation backward = tumbling(seed, true, restitution, count);
  while (forward.impacts().count < 3 && !forward.reached(0.6)) {
    ASSERT_EQ(forward.step(0.6), StepStatus::accepted);
    ASSERT_EQ(backward.step(0.6), StepStatus::accepted);
  }
  ASSERT_EQ(forward.impacts().count, backward.impacts().count);
  ASSERT_NEAR(forward.time(), backward.time(), 1e-9);
  for (std::size_t k = 1; k <= count; ++k) {
    const Vector3 centre = forward.blocks()[k].basis().centroid();
    const Vector3 moved = place_of(forward, static_cast<int>(k), centre);
    const Vector3 again = place_of(backward, static_cast<int>(count + 1 - k), centre);
    EXPECT_LT((moved - again).norm(), 1e-6) << "block " << k;
  }
}

// In flight without weight nothing but impacts acts on blocks that meet.
TEST_P(OfStacks, KeepMomentumWhereTheyMeetInFlight) {
  const unsigned seed = GetParam();
  std::mt19937 random(seed);
  const auto number = [&](double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  };
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions;
  for (int k = 0; k < 3; ++k) {
    const Vector3 low(1.5 * k, number(-0.3, 0.3), number(-0.3, 0.3)), size(number(0.6, 1.2), 1.0, 0.8);
    blocks.emplace_back(block_of("b" + std::to_string(k), Polyhedron(make_box(low, low + size)),
                                 Material{2500, 1e9, 0.2}, static_cast<int>(random() % 2)));
    motions.push_back(
        {Vector3(2.0 * (1 - k), 0.1 * k, 0.0), Vector3(number(-1, 1), number(-1, 1), number(-1, 1))});
  }
  SimulationSettings settings = settings_of(2e-3, false);
  settings.gravity.setZero();
  settings.contact_distance = 2e-3;
  Simulation simulation(std::move(blocks), motions, same_law(law_of(0.25 * (seed % 5), 0.5)), settings);
  const Vector3 momentum = simulation.momentum(), spin = simulation.angular_momentum();
  const double start = mechanical_energy(simulation);
  while (!simulation.reached(0.5)) ASSERT_EQ(simulation.step(0.5), StepStatus::accepted);
  EXPECT_GT(simulation.impacts().count, 0U);
  EXPECT_LT((simulation.momentum() - momentum).norm(), 1e-9 * 2500.0 * 2.0);
  // The friction of a point acts on each block at its own place, which are a gap apart: up to 2e-5 m as they touch.
  EXPECT_LT((simulation.angular_momentum() - spin).norm(), 1e-5 * 2500.0 * 2.0 * 3.0);
  EXPECT_LT(mechanical_energy(simulation), start * (1.0 + 1e-9));
}

INSTANTIATE_TEST_SUITE_P(, OfStacks, testing::Range(0U, 40U));

// The impulse of a landing has its friction, whatever holds the joint afterwards: momentum lost along the floor is tan(phi)
// times that gained upwards, weight included.
TEST(ImpactLaw, LandingsHaveCoulombsFriction) {
  const double phi = 0.36, fall = 0.02, end = 0.3;
  for (const bool multipliers : {false, true}) {
    for (const int order : {0, 1, 2}) {
      for (const double step : {4e-3, 1e-3, 2.5e-4}) {
        std::vector<BlockModel> blocks;
        blocks.emplace_back(fixed_box({-2, -2, -1}, {6, 2, 0}));
        blocks.emplace_back(block_of(
            "stone", Polyhedron(make_box({-0.3, -0.3, fall}, {0.3, 0.3, fall + 0.2})), stone, order));
        Simulation simulation(std::move(blocks), {{}, {Vector3(4, 0, -0.5), Vector3::Zero()}},
                              same_law(law_of(0.0, phi)), settings_of(step, multipliers));
        const double mass = simulation.blocks()[1].mass();
        while (!simulation.reached(end)) ASSERT_EQ(simulation.step(end), StepStatus::accepted);
        const double upwards = simulation.momentum().z() + mass * (0.5 + 9.81 * end);
        EXPECT_NEAR((4.0 * mass - simulation.momentum().x()) / (phi * upwards), 1.0, 0.02)
            << "multipliers " << multipliers << " order " << order << " step " << step;
      }
    }
  }
}

}  // namespace
}  // namespace ashlar::impact_law_test
