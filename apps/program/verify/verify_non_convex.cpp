// Landings of blocks on nonconvex solids, from places that a search along the edges finds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/verify/verification_contacts.hpp"
#include "geometry/mesh/polygon_triangulation.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar {
namespace {

const Material stone{2500.0, 1e9, 0.2};
constexpr double friction = 0.577;

using Outline = std::vector<std::array<double, 2>>;  ///< (x, z), counter-clockwise seen against y

/// A prism along y from -2 to 2.
Polyhedron prism(const Outline& outline) {
  TriangleMesh mesh;
  const int count = static_cast<int>(outline.size());
  for (const double y : {-2.0, 2.0})
    for (const auto& [x, z] : outline) mesh.points.emplace_back(x, y, z);
  std::vector<int> loop(outline.size());
  std::iota(loop.begin(), loop.end(), 0);
  std::size_t tests_left = loop.size() * loop.size() * loop.size();
  triangulate_polygon(mesh.points, loop, mesh.triangles, tests_left);
  const std::vector<std::array<int, 3>> front = mesh.triangles;
  for (const auto& [a, b, c] : front) mesh.triangles.push_back({count + a, count + c, count + b});
  for (int k = 0; k < count; ++k) {
    const int next = (k + 1) % count;
    mesh.triangles.push_back({k, count + k, next});
    mesh.triangles.push_back({next, count + k, count + next});
  }
  return Polyhedron(std::move(mesh));
}

/// Ground of one mesh and the same of convex parts.
struct Ground {
  std::string name;
  Polyhedron whole;
  std::vector<Polyhedron> pieces;
  double low, high;  ///< range of initial places, x in m
};

/// A trench of rectangular section is a pit seen from inside: floor and walls at right angles.
std::vector<Ground> grounds() {
  std::vector<Ground> all;
  const Outline slope = {{-2, -1}, {0, -1}, {0, 0}, {-2, 1.1547}};
  all.push_back({"slope and flat",
                 prism({{0, -1}, {3, -1}, {3, 0}, {0, 0}, {-2, 1.1547}, {-2, -1}}),
                 {prism(slope), prism({{0, -1}, {3, -1}, {3, 0}, {0, 0}})},
                 -0.5,
                 0.1});
  all.push_back({"groove",
                 prism({{0, -1}, {2, -1}, {2, 1.1547}, {0, 0}, {-2, 1.1547}, {-2, -1}}),
                 {prism(slope), prism({{0, -1}, {2, -1}, {2, 1.1547}, {0, 0}})},
                 -0.3,
                 0.3});
  all.push_back({"pit",
                 prism({{0, -1},
                        {2, -1},
                        {2, 0.5},
                        {0.45, 0.5},
                        {0.45, 0},
                        {-0.45, 0},
                        {-0.45, 0.5},
                        {-2, 0.5},
                        {-2, -1}}),
                 {prism({{-2, -1}, {-0.45, -1}, {-0.45, 0.5}, {-2, 0.5}}),
                  prism({{-0.45, -1}, {0.45, -1}, {0.45, 0}, {-0.45, 0}}),
                  prism({{0.45, -1}, {2, -1}, {2, 0.5}, {0.45, 0.5}})},
                 -0.1,
                 0.1});
  all.push_back({"ridge",
                 prism({{0, -1}, {2, -1}, {2, 0}, {0.5, 0}, {0, 0.4}, {-0.5, 0}, {-2, 0}, {-2, -1}}),
                 {prism({{-2, -1}, {-0.5, -1}, {-0.5, 0}, {-2, 0}}),
                  prism({{-0.5, -1}, {0.5, -1}, {0.5, 0}, {0, 0.4}, {-0.5, 0}}),
                  prism({{0.5, -1}, {2, -1}, {2, 0}, {0.5, 0}})},
                 0.3,
                 0.6});
  return all;
}

/// Height of the ground's outline at x: the maximum over all parts.
double height_at(const Ground& ground, const Vector3& point) {
  double highest = -1.0;
  for (const Polyhedron& piece : ground.pieces) {
    for (const PolyhedronFace& face : piece.faces()) {
      if (!(face.normal.z() > 1e-9)) continue;
      double low = 1e9, high = -1e9;
      for (const int corner : face.loops.front()) {
        low = std::min(low, piece.mesh().points[static_cast<std::size_t>(corner)].x());
        high = std::max(high, piece.mesh().points[static_cast<std::size_t>(corner)].x());
      }
      if (point.x() < low || point.x() > high) continue;
      const Vector3& on_plane = piece.mesh().points[static_cast<std::size_t>(face.loops.front().front())];
      highest =
          std::max(highest, on_plane.z() - face.normal.x() / face.normal.z() * (point.x() - on_plane.x()));
    }
  }
  return highest;
}

Polyhedron ell() {
  const double s = 0.15;
  const Outline outline = {{0, 0}, {2 * s, 0}, {2 * s, s}, {s, s}, {s, 2 * s}, {0, 2 * s}};
  TriangleMesh mesh = prism(outline).mesh();
  for (Vector3& point : mesh.points) point = Vector3(point.x() - s, 0.075 * point.y(), point.z() - s);
  return Polyhedron(std::move(mesh));
}

/// A random double in [0, 1) that is the same on every machine.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

std::vector<std::pair<std::string, Polyhedron>> falling_blocks() {
  std::mt19937_64 random(7);
  std::vector<Vector3> ball;
  for (int k = 0; k < 12; ++k) {
    const double z = 2.0 * uniform(random) - 1.0, turn = 2.0 * std::numbers::pi * uniform(random);
    const double r = std::sqrt(1.0 - z * z);
    ball.emplace_back(0.25 * r * std::cos(turn), 0.25 * r * std::sin(turn), 0.25 * z);
  }
  return {{"cube", Polyhedron(make_box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}))},
          {"tetrahedron", hull_of({{0.3, 0, 0.2}, {-0.15, 0.26, 0.2}, {-0.15, -0.26, 0.2}, {0, 0, -0.3}})},
          {"hull", hull_of(ball)},
          {"L block", ell()}};
}

/// The block in random orientation, 1 mm above the ground's outline.
Polyhedron let_go(const Polyhedron& block, const Ground& ground, std::mt19937_64& random) {
  const Vector3 axis(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
  const Eigen::AngleAxisd turn(6.0 * uniform(random), axis.normalized());
  const Vector3 shift(ground.low + (ground.high - ground.low) * uniform(random), 0.5 * uniform(random), 0.0);
  std::vector<Vector3> points;
  for (const Vector3& point : block.mesh().points) points.emplace_back(turn * point + shift);
  double lift = -1e9;
  const auto clear = [&](const Vector3& point) {
    lift = std::max(lift, height_at(ground, point) - point.z());
  };
  for (const PolyhedronEdge& edge : block.edges()) {
    const Vector3& start = points[static_cast<std::size_t>(edge.vertices[0])];
    const Vector3& end = points[static_cast<std::size_t>(edge.vertices[1])];
    constexpr int pieces = 64;
    for (int k = 0; k <= pieces; ++k) clear(start + (end - start) * k / pieces);
  }
  for (Vector3& point : points) point.z() += lift + 1e-3;
  return block.with_points(std::move(points));
}

Simulation landing(const std::vector<Polyhedron>& ground, const Polyhedron& block, bool augmented,
                   const Placement& placement) {
  ContactScene scene(placement);
  for (const Polyhedron& piece : ground) scene.add_fixed(piece);
  const double size = std::cbrt(block.volume());
  choose_as_for_statics(scene, size, stone.young_modulus, friction);
  scene.settings.augmented = augmented;
  scene.add(define_block(block, stone, 1));
  return scene.build();
}

/// A landing for a given time. @return largest excess of the true depth over that of contacts at the end of any step,
/// relative to the block's size
double land(Simulation& simulation, double time) {
  double most = 0.0;
  while (!simulation.reached(time)) {
    take_step(simulation, time);
    most = std::max(most, simulation.report().depth - simulation.report().penetration);
  }
  return most / simulation.blocks().back().size();
}

/// Blocks released over valleys of one mesh do not sink, and move as on convex parts of the same shape. Places are
/// compared with multipliers: the rebound from springs depends on the time of contact within a step, and steps are
/// cut at other times on other ground.
std::vector<VerificationCheck> non_convex_ground_case(const Placement& placement) {
  constexpr int turns = 8;
  constexpr double time = 0.2;
  std::vector<VerificationCheck> checks;
  std::mt19937_64 random(1);
  for (const Ground& ground : grounds()) {
    for (const auto& [name, block] : falling_blocks()) {
      double deepest = 0.0;
      double apart = 0.0;
      for (int k = 0; k < turns; ++k) {
        const Polyhedron placed_block = let_go(block, ground, random);
        Simulation with_springs = landing({ground.whole}, placed_block, false, placement);
        Simulation on_whole = landing({ground.whole}, placed_block, true, placement);
        Simulation on_pieces = landing(ground.pieces, placed_block, true, placement);
        deepest = std::max({deepest, land(with_springs, time), land(on_whole, time), land(on_pieces, time)});
        const int last = static_cast<int>(on_pieces.blocks().size()) - 1;
        apart = std::max(
            apart, (centroid(on_whole, 1) - centroid(on_pieces, last)).norm() / on_whole.blocks()[1].size());
      }
      checks.push_back(
          check_absolute(fmt::format("{} on {}: depth beyond contacts, of its size", name, ground.name),
                         deepest, 0.0, 1e-3));
      checks.push_back(check_absolute(
          fmt::format("{} on {}: off the way on convex pieces, of its size", name, ground.name), apart, 0.0,
          1e-3));
    }
  }
  return checks;
}

constexpr VerificationCase non_convex[] = {
    {"non-convex-ground", "blocks land on slopes, grooves, pits and ridges of one mesh",
     non_convex_ground_case},
};

}  // namespace

std::span<const VerificationCase> non_convex_cases() {
  return non_convex;
}

}  // namespace ashlar
