// Time of the broad phase against the number of boxes, at about three neighbours each.
#include "geometry/boxes/box_pairs.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace ashlar {
namespace {

void meeting_boxes_of_a_heap(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  std::mt19937_64 random(5);
  const double side = std::cbrt(static_cast<double>(count));
  const auto number = [&] { return side * static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3 low(number(), number(), number());
    boxes.push_back({low, low + Vector3::Constant(0.9)});
  }
  std::size_t found = 0;
  for ([[maybe_unused]] auto unused : state) {
    found = meeting_boxes(boxes).size();
    benchmark::DoNotOptimize(found);
  }
  state.counters["pairs"] = static_cast<double>(found);
  state.SetComplexityN(state.range(0));
}

BENCHMARK(meeting_boxes_of_a_heap)
    ->RangeMultiplier(4)
    ->Range(1 << 10, 1 << 18)
    ->Complexity(benchmark::oNLogN);

}  // namespace
}  // namespace ashlar
