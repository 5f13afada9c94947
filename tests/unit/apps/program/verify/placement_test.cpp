#include "apps/program/verify/placement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/verify/cases/scene_case_run.hpp"
#include "apps/program/verify/falling_block.hpp"
#include "apps/program/verify/verification.hpp"
#include "apps/program/verify/verification_blocks.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "geometry/solid/hull_solid.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::placement_test {
namespace {

/// A quarter turn about z and (1, 2, 3): (x, y, z) -> (1 - y, 2 + x, 3 + z).
Placement quarter_turn() {
  Placement placement;
  placement.turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  placement.shift = {1, 2, 3};
  return placement;
}

TEST(Placement, PlacesAndReadsBack) {
  const Placement placement = quarter_turn();
  EXPECT_EQ(placement.point({4, 5, 6}), Vector3(-4, 6, 9));
  EXPECT_EQ(placement.direction({4, 5, 6}), Vector3(-5, 4, 6));
  EXPECT_EQ(placement.point_back({-4, 6, 9}), Vector3(4, 5, 6));
  EXPECT_EQ(placement.direction_back({-5, 4, 6}), Vector3(4, 5, 6));
  EXPECT_NEAR(
      (some_placement().turn.transpose() * some_placement().turn - Eigen::Matrix3d::Identity()).norm(), 0.0,
      1e-15);
}

TEST(Placement, ABlockTakesSupportsLoadsAndPointsAlong) {
  BlockDefinition block = define_block(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2000, 1e9, 0.2}, 1);
  block.supports.push_back(
      {Plane{{0, 0, 0}, Vector3::UnitX()}, {true, true, true}, {{0, 1}, {{0, 0, 0}, {1, 0, 0}}}});
  block.loads.push_back({Vector3(1, 0, 0), false, {0, 7, 0}, {}});
  block.followed.emplace_back(0, 1, 0);
  const BlockDefinition turned = placed(block, quarter_turn());
  EXPECT_EQ(turned.solid->mesh().points[0], quarter_turn().point(block.solid->mesh().points[0]));
  EXPECT_EQ(turned.solid->faces().size(), 6U);
  EXPECT_EQ(std::get<Plane>(turned.supports[0].where).point, Vector3(1, 2, 3));
  EXPECT_EQ(std::get<Plane>(turned.supports[0].where).normal, Vector3::UnitY());
  EXPECT_EQ(turned.supports[0].history.values[1], Vector3::UnitY());
  EXPECT_EQ(std::get<Vector3>(turned.loads[0].where), Vector3(1, 3, 3));
  EXPECT_EQ(turned.loads[0].vector, Vector3(-7, 0, 0));
  EXPECT_EQ(turned.followed[0], Vector3(0, 2, 3));
}

TEST(Placement, SupportsOfSingleComponentsCanBeMovedButNotTurned) {
  BlockDefinition block = define_block(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2000, 1e9, 0.2}, 1);
  block.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}, {true, false, false}});
  EXPECT_THROW((void)placed(block, quarter_turn()), std::invalid_argument);
  Placement moved;
  moved.shift = {0, 0, 2};
  EXPECT_EQ(std::get<Plane>(placed(block, moved).supports[0].where).point, Vector3(0, 0, 2));
}

/// Cases that are run rotated and shifted. Reasons of the others are below.
constexpr const char* placed_cases =
    "accuracy-incline accuracy-swelling accuracy-tumbling accuracy-beam effectivity-bar "
    "effectivity-beam effectivity-plate effectivity-swelling bolt-hung-block bolt-slope bolt-dowel "
    "bolt-limit-slope bolt-limit-wedge prop-limit prop-yield fracture-work fracture-branch tie-breaks "
    "bonded-bridge "
    "quiet-static water-tension-crack water-dam water-wedge bounce rocking-block dilation-stiffness "
    "dilation-load joint-damping free-fall spin-volume spin-volume-incremental torque-free "
    "spinning-bar dda-damping collision-momentum limit-plane limit-wedge limit-arch-sliding "
    "limit-arch-thickness limit-portal limit-twist limit-support-movement hanging-ring "
    "cantilever-end-load cantilever-self-weight cantilever-frequencies sliding-cube forces-alone "
    "forces-alone-factor restitution-heights restitution-none restitution-exchange restitution-cradle "
    "restitution-oblique plane-slide-safety wedge-safety incline-stick incline-slide "
    "block-slide-or-topple wedge shear-patch goodman-bray overturning-limit book-stack base-record "
    "roof-wedge kinematic-block pushover-sliding pushover-corner crushed-pier joint-closure closure-uneven "
    "closing-impact";

/// Cases that only a shift leaves as they are: they have supports of some components.
constexpr const char* moved_cases =
    "effectivity-hertz quiet-pulse wave-free-surface initial-stress bar-impact shear-degradation "
    "pure-bending pinched-body cyclic-shear contact-patch-point";
/// The same, but they are not run shifted either.
constexpr std::pair<const char*, const char*> refused_cases[] = {
    {"free-field-sides", "takes 2 s"},
    {"joint-shear-wave", "takes 2 s"},
    {"stress-patch", "takes 5 s"},
    {"torsion-bar", "takes 1.5 s"},
    {"contact-patch", "takes 5 s"},
    {"joint-wave", "the rounding error of its energy is near its tolerance"},
    {"resting-six-types", "a vertex exactly on an edge has normals that rounding decides"}};

/// Cases that can be placed and are not run.
constexpr std::pair<const char*, const char*> left_out_cases[] = {
    {"bolt-pull-out",
     "moves across the bolt have no stiffness, and rounding errors of a placed one excite them"},
    {"bonded-bar", "rounding errors of a placed bond are near its opening at the strength, 1e-10 m"},
    {"bonded-beam", "points of Voronoi cells are drawn in the axes of the scene"},
    {"bonded-stages", "its scene has Voronoi cells too"},
    {"crack-bar", "takes 3 s"},
    {"crack-beam", "takes 11 s"},
    {"crack-disc", "takes 7 s"},
    {"crack-fall", "rounding decides which of two like places cracks"},
    {"crushed-fall", "takes 2 s"},
    {"rough-shear", "takes 3 s"},
    {"rough-slope", "takes 5 s"},
    {"rocking-frame", "takes 3 s"},
    {"shaken-stack", "takes 2 s"},
    {"bonded-strength", "planes of its cut lie in the ends of the bar, beside which rounding leaves slivers"},
    {"self-weight-column", "takes 2 s"},
    {"limit-toppling", "takes 4 s"},
    {"pushover-strip", "gaps are closed to 5e-6 of a block: rounding moves its zero by more than 1e-6"},
    {"limit-wall-pushed", "takes 7 s"},
    {"limit-wall-capacity", "takes 8 s"},
    {"large-rotation-cantilever", "takes 4 s"},
    {"arch-safety", "takes 5 s"},
    {"toppling-safety", "takes 40 s"},
    {"arch", "takes 5 s"}};

std::vector<std::string> words_of(const char* text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::vector<SceneCase> scene_cases() {
  Diagnostics faults;
  std::vector<SceneCase> cases = read_cases(own_cases(), faults);
  EXPECT_TRUE(faults.good());
  return cases;
}

SceneCase scene_case(const std::string& name) {
  for (SceneCase& found : scene_cases())
    if (found.name == name) return std::move(found);
  throw std::invalid_argument("there is no case " + name);
}

/// All checks pass, and measured values are those of the case in its own place. Checks whose reference is zero measure
/// errors, which are rounding: they only have to pass.
void expect_the_same(const std::string& name, const Placement& placement) {
  const SceneCase chosen = scene_case(name);
  // The bracket of an elastic search of 1 % ends where its trials have led.
  const double tolerance = name == "wedge-safety" ? 1e-3 : 1e-6;
  Diagnostics faults;
  const auto here = run_case(chosen, "", faults);
  const auto there = run_case(chosen, "", faults, placement);
  for (const Diagnostic& fault : faults.sorted())
    if (fault.severity == Severity::error) ADD_FAILURE() << fault.message;
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_TRUE(there[k].passed()) << there[k].what << ", error " << there[k].error;
    if (here[k].reference != 0.0) {
      EXPECT_NEAR(there[k].measured, here[k].measured, tolerance * std::abs(here[k].measured))
          << here[k].what;
    }
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class PlacedCase : public testing::TestWithParam<std::string> {};
TEST_P(PlacedCase, MeasuresTheSame) {
  expect_the_same(GetParam(), some_placement());
}
INSTANTIATE_TEST_SUITE_P(Scenes, PlacedCase, testing::ValuesIn(words_of(placed_cases)), test_name);

class MovedCase : public testing::TestWithParam<std::string> {};
TEST_P(MovedCase, MeasuresTheSame) {
  Placement moved;
  moved.shift = some_placement().shift;
  expect_the_same(GetParam(), moved);
}
INSTANTIATE_TEST_SUITE_P(Scenes, MovedCase, testing::ValuesIn(words_of(moved_cases)), test_name);

TEST(SceneCases, SayWhyTheyCannotBePlaced) {
  std::vector<std::string> names = words_of(moved_cases);
  for (const auto& [name, reason] : refused_cases) names.emplace_back(name);
  for (const std::string& name : names) {
    Diagnostics faults;
    try {
      (void)run_case(scene_case(name), "", faults, some_placement());
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& refusal) {
      EXPECT_TRUE(std::string(refusal.what()).starts_with("fix.components cannot be placed")) << name;
    }
  }
}

/// A new case is placed, or left out with a reason.
TEST(SceneCases, EachIsListedOnce) {
  std::vector<std::string> listed = words_of(placed_cases), all;
  for (const std::string& name : words_of(moved_cases)) listed.push_back(name);
  for (const auto& [name, reason] : refused_cases) listed.emplace_back(name);
  for (const auto& [name, reason] : left_out_cases) listed.emplace_back(name);
  for (const SceneCase& found : scene_cases()) all.push_back(found.name);
  EXPECT_THAT(listed, testing::UnorderedElementsAreArray(all));
}

/// Four cubes released a millimetre above the ground and each other: 100 steps of the settling tower.
TEST(Tower, TurnsWithItsScene) {
  const auto places = [](const Placement& placement) {
    ContactScene scene(placement);
    scene.settings.time_step = 1e-3;
    scene.settings.search.subdivisions = 0;
    *scene.law = {1e10, 5e9, tangent_of(35), 0.0, 0.0, true};
    scene.add_fixed(Polyhedron(make_box({-3, -3, -1}, {3, 3, 0})));
    for (int k = 0; k < 4; ++k) {
      const double low = k + 1e-3 * (k + 1), off = 0.05 * k;
      scene.add(
          define_block(Polyhedron(make_box({off, 0, low}, {off + 1, 1, low + 1})), {2500, 1e9, 0.2}, 2));
    }
    Simulation simulation = scene.build();
    for (int step = 0; step < 100; ++step) take_step(simulation, 1.0);
    EXPECT_EQ(simulation.contacts().size(), 4U);
    std::vector<Vector3> result;
    for (int k = 1; k <= 4; ++k) result.push_back(placement.point_back(centroid(simulation, k)));
    return result;
  };
  const std::vector<Vector3> here = places({});
  const std::vector<Vector3> there = places(some_placement());
  // The highest has come down by some 4 mm: a millionth of that.
  EXPECT_LT(here[3].z(), 3.504 - 3e-3);
  for (std::size_t k = 0; k < here.size(); ++k) EXPECT_LE((here[k] - there[k]).norm(), 4e-9) << k;
}

/// Displacements of all corners of the blocks, in the scene's own axes.
std::vector<Vector3> corner_displacements(const Simulation& simulation, const Placement& placement) {
  std::vector<Vector3> result;
  for (std::size_t block = 0; block < simulation.blocks().size(); ++block) {
    for (const Vector3& corner : simulation.blocks()[block].solid().mesh().points)
      result.push_back(placement.direction_back(
          simulation.blocks()[block].motion_of(simulation.states()[block], corner).displacement));
  }
  return result;
}

/// Two boxes of order 3 that spin and collide off-centre, their faces divided where the other is in reach: 60
/// steps. @return places of their corners, in the scene's own axes
std::vector<Vector3> collided(bool area_springs, const Placement& placement) {
  ContactScene scene(placement);
  scene.settings.gravity.setZero();
  scene.settings.time_step = 2e-4;
  scene.settings.area_springs = area_springs;
  scene.settings.search.chord_tolerance = 2.7e-3;
  scene.settings.search.subdivisions = 0;
  const double share = area_springs ? 1.0 : 0.25;
  *scene.law = {share * 5e9, share * 2e9, tangent_of(30), 0.0, 0.0, area_springs};
  const Material soft{2500, 1e8, 0.2};
  scene.add(define_block(Polyhedron(make_box({0, 0, 0}, {1, 0.8, 0.6})), soft, 3), {{5, 0, 0}, {0, 3, 1}});
  scene.add(define_block(Polyhedron(make_box({1.02, 0.35, 0.2}, {1.6, 1.2, 1.3})), soft, 3),
            {{-2, 0, 0.5}, {1, 0, -2}});
  Simulation simulation = scene.build();
  for (int step = 0; step < 60; ++step) take_step(simulation, 1.0);
  EXPECT_GT(simulation.counts().finder.divisions, 2U);
  EXPECT_EQ(simulation.contacts().size(), 1U);
  return corner_displacements(simulation, placement);
}

TEST(Collision, TurnsWithItsScene) {
  for (const bool area_springs : {true, false}) {
    const std::vector<Vector3> here = collided(area_springs, {});
    Placement turned;
    turned.turn = Eigen::AngleAxisd(2.222, Vector3(3, -1, 2).normalized()).toRotationMatrix();
    const std::vector<Vector3> there = collided(area_springs, turned);
    // They have moved by some 5 cm: a millionth of that.
    for (std::size_t k = 0; k < here.size(); ++k)
      EXPECT_LE((here[k] - there[k]).norm(), 5e-8) << area_springs << ' ' << k;
  }
}

/// An arch of nine voussoirs of order 2 that is released: 50 steps. Their faces coincide up to the compression of
/// the springs. @return displacements of all corners, in the scene's own axes
std::vector<Vector3> arch_at_rest(bool area_springs, const Placement& placement) {
  ContactScene scene(placement);
  scene.settings.time_step = 1e-3;
  scene.settings.search.subdivisions = 0;
  scene.settings.area_springs = area_springs;
  const double share = area_springs ? 1.0 : 0.01;
  *scene.law = {share * 1e10, share * 1e10, tangent_of(60), 0.0, 0.0, area_springs};
  scene.add_fixed(Polyhedron(make_box({-2, -1, -0.5}, {2, 1, 0})));
  constexpr int voussoirs = 9;
  for (int k = 0; k < voussoirs; ++k) {
    std::vector<Vector3> corners;
    for (const int side : {k, k + 1}) {
      const double angle = side * std::numbers::pi / voussoirs;
      const double height = side % voussoirs == 0 ? 0.0 : std::sin(angle);
      for (const double radius : {0.85, 1.15})
        for (const double y : {0.0, 0.2}) corners.emplace_back(radius * std::cos(angle), y, radius * height);
    }
    scene.add(define_block(Polyhedron(make_convex_hull(corners)), {2500, 1e11, 0.2}, 2));
  }
  Simulation simulation = scene.build();
  for (int step = 0; step < 50; ++step) take_step(simulation, 1.0);
  EXPECT_EQ(simulation.contacts().size(), voussoirs + 1U);
  return corner_displacements(simulation, placement);
}

TEST(Arch, TurnsWithItsScene) {
  for (const bool area_springs : {true, false}) {
    const std::vector<Vector3> here = arch_at_rest(area_springs, {});
    const std::vector<Vector3> there = arch_at_rest(area_springs, some_placement());
    double farthest = 0.0;
    for (const Vector3& displacement : here) farthest = std::max(farthest, displacement.norm());
    EXPECT_GT(farthest, 1e-6);
    for (std::size_t k = 0; k < here.size(); ++k)
      EXPECT_LE((here[k] - there[k]).norm(), 1e-6 * farthest) << area_springs << ' ' << k;
  }
}

/// Four dominoes on a floor, the first pushed over, 40 steps; corners are turned before blocks are made of
/// them.
/// @return displacements of all corners, in the scene's own axes
std::vector<Vector3> fallen_dominoes(bool augmented, const Placement& placement) {
  const auto turned_box = [&](const Vector3& low, const Vector3& high) {
    std::vector<Vector3> corners = make_box(low, high).points;
    for (Vector3& corner : corners) corner = placement.point(corner);
    return make_hull_solid(corners, 1e-12);
  };
  ContactScene scene;
  scene.settings.gravity = placement.direction({0, 0, -9.81});
  scene.settings.time_step = 5e-3;
  scene.settings.augmented = augmented;
  // Cohesion counts where pressure ends, too.
  *scene.law = {1e10, 1e10, tangent_of(10), 2e5, 0.0, true};
  scene.add_fixed(turned_box({-1.6, -1.6, -0.5}, {5.1, 1.6, 0}));
  for (int k = 0; k < 4; ++k) {
    const double x = 0.9 * k;
    InitialMotion pushed;
    if (k == 0) pushed = {placement.direction({0.9, 0, 0.2}), placement.direction({0, 1.2, 0})};
    scene.add(define_block(turned_box({x, -0.55, 0}, {x + 0.33, 0.55, 1.6}), {2900, 1.4e9, 0.2}, 1), pushed);
  }
  Simulation simulation = scene.build();
  for (int step = 0; step < 40; ++step) take_step(simulation, 1.0);
  EXPECT_LE(simulation.ledger().redetection_gained, 1e-8 * simulation.largest_energy()) << augmented;
  return corner_displacements(simulation, placement);
}

TEST(Dominoes, TurnWithTheirScene) {
  for (const bool augmented : {false, true}) {
    const std::vector<Vector3> here = fallen_dominoes(augmented, {});
    const std::vector<Vector3> there = fallen_dominoes(augmented, some_placement());
    ASSERT_EQ(here.size(), there.size());
    // The first has moved by some 0.2 m.
    for (std::size_t k = 0; k < here.size(); ++k)
      EXPECT_LE((here[k] - there[k]).norm(), 2e-7) << augmented << ' ' << k;
  }
}

/// 100 steps through the impact of the paper's example.
TEST(FallingBlock, TurnsWithItsScene) {
  FallingBlock example;
  example.drop = 0.01;
  example.speed = 4.4;
  const auto places = [&](const Placement& placement) {
    Simulation simulation = falling_block(example, placement);
    int pressed = 0;
    for (int k = 0; k < 100; ++k) {
      take_step(simulation, 1.0);
      if (simulation.report().locked + simulation.report().sliding > 0) ++pressed;
    }
    EXPECT_GT(pressed, 10);
    std::vector<Vector3> result;
    for (std::size_t block = 0; block < 2; ++block) {
      for (const Vector3& corner : simulation.blocks()[block].solid().mesh().points) {
        const PointMotion motion = simulation.blocks()[block].motion_of(simulation.states()[block], corner);
        result.push_back(placement.direction_back(motion.displacement));
        result.push_back(placement.direction_back(motion.velocity));
      }
    }
    return result;
  };
  const std::vector<Vector3> here = places({});
  const std::vector<Vector3> there = places(some_placement());
  // Points have moved by 0.1 to 1 m, at some m/s.
  for (std::size_t k = 0; k < here.size(); ++k) EXPECT_LE((here[k] - there[k]).norm(), 1e-6) << k;
}

}  // namespace
}  // namespace ashlar::placement_test
