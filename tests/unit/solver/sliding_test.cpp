// A block that slides over a face cut into many triangles must not feel their sides.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "support/simulations.hpp"

namespace ashlar {
namespace {

using test_support::block_of;
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
  settings.chord_tolerance = 1e-3;
  settings.subdivisions = 0;
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

}  // namespace
}  // namespace ashlar
