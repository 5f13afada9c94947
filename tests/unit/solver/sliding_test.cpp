// Blocks that slide: over a face cut into many triangles, whose sides must have no effect, and over edges and
// on ridges that their faces are tilted to.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "support/simulations.hpp"

namespace ashlar::sliding_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

/// The box with its top face cut into `count` (even) triangles by points put into triangles at random:
/// slivers included.
TriangleMesh box_with_cut_top(const Vector3& low, const Vector3& high, int count, std::uint64_t seed) {
  TriangleMesh mesh = make_box(low, high);
  std::vector<std::size_t> top;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bool on_top = true;
    for (const int corner : mesh.triangles[t])
      on_top = on_top && mesh.points[static_cast<std::size_t>(corner)].z() == high.z();
    if (on_top) top.push_back(t);
  }
  std::mt19937_64 random(seed);
  const auto share = [&] { return static_cast<double>(random() % 1000 + 1) / 1002.0; };
  while (static_cast<int>(top.size()) < count) {
    const std::size_t t = top[random() % top.size()];
    const auto [a, b, c] = mesh.triangles[t];
    const auto point = [&](int k) { return mesh.points[static_cast<std::size_t>(k)]; };
    const double along = share();
    const double across = share();
    Vector3 place = point(a) + along * (point(b) - point(a) + across * (point(c) - point(b)));
    place.z() = high.z();
    const int middle = static_cast<int>(mesh.points.size());
    mesh.points.push_back(place);
    mesh.triangles[t] = {a, b, middle};
    mesh.triangles.push_back({b, c, middle});
    mesh.triangles.push_back({c, a, middle});
    top.push_back(mesh.triangles.size() - 2);
    top.push_back(mesh.triangles.size() - 1);
  }
  return mesh;
}

struct Slide {
  int order = 1;
  bool area = true;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  double block_turn = 0.0;  ///< of the sliding block about the floor's normal
};

/// Largest share of the normal force that acts along the floor while a cube slides half a metre without
/// friction.
double sideways_share(const Slide& slide) {
  TriangleMesh floor = box_with_cut_top({-1, -1, -1}, {3, 2, 0}, 200, 42);
  for (Vector3& point : floor.points) point = slide.turn * point;
  const Eigen::Quaterniond own(slide.turn * Eigen::AngleAxisd(slide.block_turn, Vector3::UnitZ()));
  const Polyhedron cube(make_box({-0.4, -0.3, 0}, {0.4, 0.3, 0.5}));
  std::vector<Vector3> points;
  for (const Vector3& point : cube.mesh().points) points.emplace_back(own * point);

  SimulationSettings settings;
  settings.time_step = 5e-3;
  settings.gravity = slide.turn * Vector3(0, 0, -9.81);
  settings.area_springs = slide.area;
  settings.search.chord_tolerance = 1e-3;
  settings.search.subdivisions = 0;
  std::vector<BlockModel> blocks;
  BlockDefinition base = block_of("floor", Polyhedron(std::move(floor)), {2500, 1e9, 0.2}, 1);
  base.fixed = true;
  blocks.emplace_back(std::move(base));
  blocks.emplace_back(block_of("cube", cube.with_points(std::move(points)), {2500, 1e9, 0.2}, slide.order));
  Simulation simulation(std::move(blocks), {{}, {slide.turn * Vector3(1, 0.3, 0), Vector3::Zero()}},
                        same_law({1e9, 5e8, 0.0, 0.0, 0.0, slide.area}), settings);
  const Vector3 up = slide.turn * Vector3::UnitZ();
  double most = 0.0;
  bool touched = false;
  while (!simulation.reached(0.5)) {
    EXPECT_EQ(simulation.step(0.5), StepStatus::accepted);
    Vector3 force = Vector3::Zero();
    for (const PairRecord& pair : simulation.contacts()) {
      for (std::size_t k = 0; k < pair.points.size(); ++k)
        force += pair.responses[k].force[0] * pair.points[k].normal;
    }
    const double normal = std::abs(force.dot(up));
    if (normal < 1.0) continue;
    touched = true;
    most = std::max(most, (force - force.dot(up) * up).norm() / normal);
  }
  EXPECT_TRUE(touched);
  EXPECT_TRUE(simulation.rejections().empty());
  return most;
}

TEST(Sliding, AFaceInTwoHundredTrianglesFeelsFlat) {
  for (const bool area : {true, false}) {
    for (const int order : {1, 2}) {
      EXPECT_LT(sideways_share({order, area, Eigen::Quaterniond::Identity(), 0.0}), 1e-9) << area << order;
      EXPECT_LT(sideways_share({order, area, Eigen::Quaterniond::Identity(), 0.4}), 1e-9) << area << order;
    }
  }
}

TEST(Sliding, SoDoesATiltedOneWhoseTrianglesRoundingHasTilted) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.9, Vector3(1, -2, 0.7).normalized()));
  for (const bool area : {true, false}) {
    for (const int order : {1, 2}) EXPECT_LT(sideways_share({order, area, turn, 0.4}), 1e-9) << area << order;
  }
}

TEST(Sliding, FrictionTakesTheKineticEnergyWhicheverIntegrator) {
  // A block that rattles on its springs is open at the end of half of its steps, but has rubbed in them.
  const double kinetic = 0.5 * 2500.0 * 0.4 * 4.0;
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    for (const int order : {1, 2}) {
      SimulationSettings settings;
      settings.time_step = 2e-3;
      settings.integrator = integrator;
      std::vector<BlockModel> blocks;
      blocks.emplace_back(test_support::fixed_box({-3, -3, -1}, {6, 3, 0}));
      blocks.emplace_back(block_of("block", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.4})),
                                   {2500, 1e10, 0.2}, order));
      Simulation simulation(std::move(blocks), {{}, {Vector3(2, 0, 0), Vector3::Zero()}},
                            same_law({1e11, 1e11, 0.5, 0.0, 0.0, true}), settings);
      // v / (mu g) = 0.41 s
      ASSERT_TRUE(run_until(simulation, 0.5));
      EXPECT_NEAR(simulation.ledger().friction, kinetic, 1e-3 * kinetic);
      EXPECT_NEAR(simulation.ledger().numerical, 0.0, 1e-3 * kinetic);
    }
  }
}

/// Position of a plate on two fixed supports, each in contact along a line across it.
struct OnEdges {
  int order = 1;
  bool area = true;
  double start = 0.0;    ///< velocity along x, m/s
  double slope = 0.0;    ///< by which gravity is turned, rad
  double degrees = 0.0;  ///< both supports' tops are tilted, so that they rise to an edge
  double flanks = 0.0;   ///< degrees, both supports are roofs
  bool halves = false;   ///< of two blocks each
};

/// The supports and a plate without friction.
Simulation plate_on_edges(const OnEdges& scene) {
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.area_springs = scene.area;
  settings.contact_distance = 2e-3;
  settings.search.chord_tolerance = 1e-3;
  settings.search.subdivisions = 0;
  settings.gravity = 9.81 * Vector3(std::sin(scene.slope), 0.0, -std::cos(scene.slope));
  const double fall = std::tan((scene.degrees + scene.flanks) * std::numbers::pi / 180.0);
  std::vector<BlockModel> blocks;
  // From an edge at z = 0 so far to either side, m.
  const auto add_support = [&](double edge, double before, double behind) {
    std::vector<Vector3> points;
    for (const double y : {-0.6, 0.6}) {
      points.emplace_back(edge, y, 0.0);
      for (const auto& [x, drop] : {std::pair(edge - before, before), {edge + behind, behind}}) {
        points.emplace_back(x, y, -drop * fall);
        points.emplace_back(x, y, -0.5);
      }
    }
    BlockDefinition support = block_of("support", Polyhedron(make_convex_hull(points)), {2500, 1e9, 0.2}, 1);
    support.fixed = true;
    blocks.emplace_back(std::move(support));
  };
  for (const double edge : {-1.0, 1.0}) {
    // A tilted top ends in its edge, a roof goes on behind it.
    const double behind = scene.flanks > 0.0 ? 0.4 : 0.0;
    add_support(edge, 0.4, scene.halves ? 0.0 : behind);
    if (scene.halves) add_support(edge, 0.0, behind);
  }
  blocks.emplace_back(
      block_of("plate", Polyhedron(make_box({-3, -0.5, 0}, {3, 0.5, 0.3})), {2500, 1e10, 0.2}, scene.order));
  std::vector<InitialMotion> motions(blocks.size());
  motions.back().velocity = Vector3(scene.start, 0, 0);
  return {std::move(blocks), std::move(motions), same_law({1e11, 5e10, 0.0, 0.0, 0.0, scene.area}), settings};
}

/// Where the middle of the plate is.
Vector3 plate_in(const Simulation& simulation) {
  return place_of(simulation, static_cast<int>(simulation.blocks().size()) - 1, Vector3(0, 0, 0.15));
}

class OnEdgesWithoutFriction : public testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  [[nodiscard]] OnEdges scene() const {
    OnEdges result;
    std::tie(result.order, result.area) = GetParam();
    return result;
  }
};

TEST_P(OnEdgesWithoutFriction, APlateAtRestStaysWhereItIs) {
  // The edges push along the plate's normal, so nothing acts along it. Along the supports' normals, 4 degrees
  // off, it would slide (g/2) sin(4) cos(4) t^2 = 0.085 m.
  OnEdges scene = this->scene();
  scene.degrees = 4.0;
  Simulation simulation = plate_on_edges(scene);
  ASSERT_TRUE(run_until(simulation, 0.5));
  const Vector3 place = plate_in(simulation);
  EXPECT_LT(std::abs(place.x()), 1e-4);
  EXPECT_LT(std::abs(place.z() - 0.15), 1e-3);
}

TEST_P(OnEdgesWithoutFriction, RidgesDoNotBrake) {
  // g tan(6 degrees) would take 0.62 m/s in 0.6 s, g tan(1 degree) 0.1.
  OnEdges scene = this->scene();
  scene.start = 2.0;
  for (const auto& [flanks, halves] : {std::pair(6.0, false), std::pair(1.0, true)}) {
    scene.flanks = flanks;
    scene.halves = halves;
    Simulation simulation = plate_on_edges(scene);
    ASSERT_TRUE(run_until(simulation, 0.6));
    EXPECT_NEAR(plate_in(simulation).x(), 1.2, 1e-3) << halves;
  }
}

TEST_P(OnEdgesWithoutFriction, RidgesDoNotHoldWhatLiesOnASlope) {
  OnEdges scene = this->scene();
  scene.flanks = 6.0;
  scene.slope = 3.0 * std::numbers::pi / 180.0;
  Simulation simulation = plate_on_edges(scene);
  ASSERT_TRUE(run_until(simulation, 0.5));
  const double travel = 0.5 * 9.81 * std::sin(scene.slope) * 0.25;
  EXPECT_NEAR(plate_in(simulation).x(), travel, 0.01 * travel);
}

INSTANTIATE_TEST_SUITE_P(OrdersAndSprings, OnEdgesWithoutFriction,
                         testing::Combine(testing::Values(1, 2), testing::Bool()));

}  // namespace
}  // namespace ashlar::sliding_test
