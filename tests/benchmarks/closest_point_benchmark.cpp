// Speed of exact closest points, one core: a bumpy ball of 5,120 triangles, random points around and in it.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "geometry/any_solid/closest_point.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar {
namespace {

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

Polyhedron bumpy_ball() {
  TriangleMesh mesh = make_sphere(Vector3::Zero(), 1.0, 4);
  std::mt19937_64 random(3);
  for (Vector3& p : mesh.points) p *= 1.0 + 0.05 * uniform(random);
  return Polyhedron(mesh);
}

// In a cube around the ball of the given half side.
void closest_point_on_ball(benchmark::State& state) {
  const ClosestPointFinder finder(bumpy_ball());
  const double reach = static_cast<double>(state.range(0)) / 10.0;
  std::mt19937_64 random(4);
  std::vector<Vector3> queries(4096);
  for (Vector3& q : queries)
    for (double& x : q) x = reach * (2.0 * uniform(random) - 1.0);
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(finder.find(queries[k]));
    k = (k + 1) % queries.size();
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["triangles"] = static_cast<double>(finder.solid().mesh().triangles.size());
}
BENCHMARK(closest_point_on_ball)->Arg(12)->Arg(20)->Arg(50);

}  // namespace
}  // namespace ashlar
