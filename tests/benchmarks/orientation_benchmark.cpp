// The predicate ladder against CGAL's filtered predicates: the orientation of the same four points, one core.
// Items per second are orientations per second.
#include <benchmark/benchmark.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Filtered_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <random>
#include <vector>

#include "geometry/exact/direction_predicates.hpp"

namespace ashlar {
namespace {

/// Static error bounds, then interval arithmetic, then exact numbers.
using StaticFilters = CGAL::Exact_predicates_inexact_constructions_kernel;
/// Interval arithmetic, then exact numbers.
using IntervalFilter = CGAL::Filtered_kernel<CGAL::Simple_cartesian<double>, false>;

constexpr int count = 1000;
using Points = std::array<Vector3, 4>;

/// Points in a unit box, or, where the argument is 1, their corners in one plane but for the rounding of 53
/// bits, or, where it is 2, in one plane exactly (whole numbers).
std::vector<Points> inputs(long kind) {
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto whole = [&] { return static_cast<double>(random() % 1024); };
  std::vector<Points> result(count);
  for (Points& p : result) {
    for (Vector3& x : p)
      for (int i = 0; i < 3; ++i) x[i] = kind == 2 ? whole() : uniform();
    const double s = kind == 2 ? 3.0 : uniform(), t = kind == 2 ? -2.0 : uniform();
    if (kind != 0) p[3] = p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]);
  }
  return result;
}

template <class Kernel>
std::array<typename Kernel::Point_3, 4> points_of(const Points& p) {
  const auto point = [](const Vector3& x) { return typename Kernel::Point_3(x[0], x[1], x[2]); };
  return {point(p[0]), point(p[1]), point(p[2]), point(p[3])};
}

PredicateLadder ladder_for(const std::vector<Points>& inputs) {
  NumericRange range;
  for (const Points& p : inputs)
    for (const Vector3& x : p)
      for (int i = 0; i < 3; ++i) range.include(x[i]);
  PredicateLadder ladder;
  ladder.open(range);
  return ladder;
}

/// Asks for all signs in turn.
template <class Sign>
void run(benchmark::State& state, Sign sign) {
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(sign(k));
    k = k + 1 == count ? 0 : k + 1;
  }
  state.SetItemsProcessed(state.iterations());
}

void ladder(benchmark::State& state) {
  const std::vector<Points> points = inputs(state.range(0));
  PredicateLadder ladder = ladder_for(points);
  run(state, [&](std::size_t k) {
    const Points& p = points[k];
    return sign_volume(p[0], p[1], p[2], p[3], ladder);
  });
  const auto all = static_cast<double>(ladder.counts.filter + ladder.counts.exact);
  state.counters["exact"] = static_cast<double>(ladder.counts.exact) / all;
}

template <class Kernel>
void cgal(benchmark::State& state) {
  const std::vector<Points> points = inputs(state.range(0));
  PredicateLadder ladder = ladder_for(points);
  std::vector<std::array<typename Kernel::Point_3, 4>> given;
  const typename Kernel::Orientation_3 orientation = Kernel().orientation_3_object();
  for (const Points& p : points) {
    const auto& [a, b, c, d] = given.emplace_back(points_of<Kernel>(p));
    if (static_cast<int>(orientation(a, b, c, d)) != sign_volume(p[0], p[1], p[2], p[3], ladder))
      state.SkipWithError("the ladder and CGAL disagree");
  }
  run(state, [&](std::size_t k) {
    const auto& [a, b, c, d] = given[k];
    return static_cast<int>(orientation(a, b, c, d));
  });
}

BENCHMARK(ladder)->DenseRange(0, 2);
BENCHMARK(cgal<StaticFilters>)->DenseRange(0, 2);
BENCHMARK(cgal<IntervalFilter>)->DenseRange(0, 2);

}  // namespace
}  // namespace ashlar
