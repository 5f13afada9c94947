// Speed of exact contact classification, one core. Every benchmark runs over a fixed set of random pairs, so
// that its time is that of a mixture; items per second are pairs per second.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/convex/convex_contact.hpp"

namespace ashlar {
namespace {

constexpr int pair_count = 1000;
using ShapePairs = std::vector<std::pair<ConvexShape, ConvexShape>>;

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

Eigen::Matrix3d random_rotation(std::mt19937_64& random) {
  Eigen::Quaterniond q;
  do {
    q.coeffs() = Eigen::Vector4d(uniform(random), uniform(random), uniform(random), uniform(random)) * 2.0 -
                 Eigen::Vector4d::Ones();
  } while (q.squaredNorm() > 1.0 || q.squaredNorm() < 0.1);
  return q.normalized().toRotationMatrix();
}

TriangleMesh unit_cube() {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) mesh.points.emplace_back(k & 1, k >> 1 & 1, k >> 2 & 1);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh rotated_cube(std::mt19937_64& random, double spread) {
  TriangleMesh mesh = unit_cube();
  const Eigen::Matrix3d rotation = random_rotation(random);
  const Vector3 center(uniform(random) * spread, uniform(random) * spread, uniform(random) * spread);
  for (Vector3& p : mesh.points) p = rotation * (p - Vector3::Constant(0.5)) + center;
  return mesh;
}

// Rounded rotations: no face is exactly flat, so the shapes have up to 12 facets.
ShapePairs rotated_cubes(double spread) {
  std::mt19937_64 random(1);
  ShapePairs pairs;
  for (int k = 0; k < pair_count; ++k) {
    ConvexShape a = ConvexShape::from_mesh(rotated_cube(random, spread));
    pairs.emplace_back(std::move(a), ConvexShape::from_mesh(rotated_cube(random, spread)));
  }
  return pairs;
}

// Exactly flat cubes that touch exactly, in a corner, an edge or a face (wholly or partly): corners are whole
// multiples of 2^-12 turned by an integer quaternion of norm below 2^6.
ShapePairs touching_cubes() {
  std::mt19937_64 random(2);
  ShapePairs pairs;
  while (static_cast<int>(pairs.size()) < pair_count) {
    const Eigen::Quaterniond q(static_cast<double>(random() % 7) - 3.0,
                               static_cast<double>(random() % 7) - 3.0,
                               static_cast<double>(random() % 7) - 3.0, 1.0);
    const Eigen::Vector4d& c = q.coeffs();
    const double x = c[0], y = c[1], z = c[2], w = c[3];
    Eigen::Matrix3d rotation;  // times the squared norm, hence whole
    rotation << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
        2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),          //
        2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
    Vector3 shift(1.0, 0.0, 0.0);
    for (int i = 1; i < 3; ++i) shift[i] = static_cast<double>(random() % 8193) / 4096.0 - 1.0;
    const int kind = static_cast<int>(random() % 3);  // face, edge, corner
    if (kind >= 1) shift[1] = 1.0;
    if (kind == 2) shift[2] = 1.0;
    TriangleMesh a = unit_cube(), b = a;
    for (Vector3& p : a.points) p = rotation * (p + shift);
    for (Vector3& p : b.points) p = rotation * p;
    ConvexShape shape = ConvexShape::from_mesh(a);
    pairs.emplace_back(std::move(shape), ConvexShape::from_mesh(b));
  }
  return pairs;
}

void run(benchmark::State& state, const ShapePairs& pairs) {
  std::size_t k = 0;
  DecisionCounts counts;
  long crossing = 0, rounds = 0;
  for ([[maybe_unused]] auto unused : state) {
    const ConvexContact contact = classify(pairs[k].first, pairs[k].second);
    benchmark::DoNotOptimize(contact.squared_distance);
    counts.filter += contact.decided_by.filter;
    counts.exact += contact.decided_by.exact;
    crossing += contact.relation == Relation::crossing;
    ++rounds;
    k = k + 1 == pairs.size() ? 0 : k + 1;
  }
  state.SetItemsProcessed(state.iterations());
  const auto per_pair = [&](long n) { return static_cast<double>(n) / static_cast<double>(rounds); };
  state.counters["filter"] = per_pair(counts.filter);
  state.counters["exact"] = per_pair(counts.exact);
  state.counters["crossing"] = per_pair(crossing);
}

void rotated_cubes_report(benchmark::State& state) {
  run(state, rotated_cubes(static_cast<double>(state.range(0))));
}
// Random cubes near each other: the label says how many of them cross, the others are apart.
void random_cubes_mixed(benchmark::State& state) {
  const ShapePairs pairs = rotated_cubes(static_cast<double>(state.range(0)) / 4.0);
  const auto crossing = std::count_if(pairs.begin(), pairs.end(), [](const auto& pair) {
    return classify(pair.first, pair.second).relation == Relation::crossing;
  });
  state.SetLabel(std::to_string(crossing) + " of " + std::to_string(pairs.size()) + " cross");
  run(state, pairs);
}
void touching_cubes_report(benchmark::State& state) {
  run(state, touching_cubes());
}

ShapePairs triangles(double spread) {
  std::mt19937_64 random(3);
  const auto triangle = [&] {
    const Vector3 corner = Vector3(uniform(random), uniform(random), uniform(random)) * spread;
    std::array<Vector3, 3> t;
    for (Vector3& p : t) p = corner + Vector3(uniform(random), uniform(random), uniform(random));
    return ConvexShape::from_triangle(t[0], t[1], t[2]);
  };
  ShapePairs pairs;
  for (int k = 0; k < pair_count; ++k) {
    ConvexShape a = triangle();
    pairs.emplace_back(std::move(a), triangle());
  }
  return pairs;
}

void triangles_report(benchmark::State& state) {
  run(state, triangles(static_cast<double>(state.range(0))));
}

// Side of the box the centers are drawn from: 20 all apart, 4 a ninth cross, 1 nearly all cross.
BENCHMARK(rotated_cubes_report)->Arg(20)->Arg(4)->Arg(1);
// Quarters of that side.
BENCHMARK(random_cubes_mixed)->Arg(8)->Arg(10);
BENCHMARK(touching_cubes_report);
// Corners are drawn from unit boxes; side of the box the corners of those are drawn from: 0 one common box.
BENCHMARK(triangles_report)->Arg(4)->Arg(1)->Arg(0);

}  // namespace
}  // namespace ashlar
