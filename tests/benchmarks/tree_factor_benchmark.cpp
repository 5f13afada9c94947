// Factor and solution of the matrices of walls and pyramids of blocks with 12 unknowns (order 1), each face in contact by
// six random springs: by CHOLMOD, and by the tree factor in double and single precision on a number of threads.
// Arguments: scene (0: wall of n courses, 1: pyramid of n layers), n, method (0: CHOLMOD, 1: double, 2: single), threads.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "solver/linear/block_matrix.hpp"
#include "solver/linear/sparse_cholesky.hpp"
#include "solver/linear/tree_factor.hpp"

namespace ashlar {
namespace {

constexpr int unknowns = 12;
using Box = std::array<double, 6>;  ///< lower and upper ends along x, y, z
using Pairs = std::vector<std::array<int, 2>>;

/// Running bond: odd courses end in half bricks.
std::vector<Box> wall(int courses) {
  std::vector<Box> boxes;
  for (int k = 0; k < courses; ++k) {
    for (int i = 0; i < courses + k % 2; ++i) {
      const double left = std::max(i - 0.5 * (k % 2), 0.0),
                   right = std::min<double>(i + 1 - 0.5 * (k % 2), courses);
      boxes.push_back({left, right, 0.0, 0.5, 0.5 * k, 0.5 * (k + 1)});
    }
  }
  return boxes;
}

/// Each cube on four.
std::vector<Box> pyramid(int layers) {
  std::vector<Box> boxes;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < layers - k; ++j)
      for (int i = 0; i < layers - k; ++i) {
        const double x = i + 0.5 * k, y = j + 0.5 * k, z = k;
        boxes.push_back({x, x + 1.0, y, y + 1.0, z, z + 1.0});
      }
  return boxes;
}

/// True if two boxes share a part of a face.
bool touch(const Box& a, const Box& b) {
  int zeros = 0;
  for (std::size_t k = 0; k < 6; k += 2) {
    const double overlap = std::min(a[k + 1], b[k + 1]) - std::max(a[k], b[k]);
    if (overlap < 0.0) return false;
    if (overlap == 0.0) ++zeros;
  }
  return zeros == 1;
}

Pairs contacts_of(const std::vector<Box>& boxes) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (touch(boxes[i], boxes[j])) pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
  return pairs;
}

BlockMatrix matrix_of(int blocks, const Pairs& pairs) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  BlockMatrix matrix(std::vector<int>(static_cast<std::size_t>(blocks), unknowns), pairs);
  for (int k = 0; k < blocks; ++k) matrix.add_to_diagonal(k, 1e-3);
  for (const auto& [a, b] : pairs) {
    Eigen::MatrixXd rows(6, 2 * unknowns);
    for (double& value : rows.reshaped()) value = normal(random);
    const Eigen::MatrixXd square = rows.transpose() * rows;
    matrix.add_diagonal(a, square.topLeftCorner(unknowns, unknowns));
    matrix.add_diagonal(b, square.bottomRightCorner(unknowns, unknowns));
    matrix.add_pair(a, b, square.topRightCorner(unknowns, unknowns));
  }
  return matrix;
}

struct Case {
  BlockMatrix matrix;
  std::unique_ptr<LinearSolver> solver;
};

Case case_of(const benchmark::State& state) {
  const int n = static_cast<int>(state.range(1));
  const std::vector<Box> boxes = state.range(0) == 0 ? wall(n) : pyramid(n);
  Case one{matrix_of(static_cast<int>(boxes.size()), contacts_of(boxes)), nullptr};
  const auto precision = state.range(2) == 2 ? FactorPrecision::in_single : FactorPrecision::in_double;
  if (state.range(2) == 0)
    one.solver = std::make_unique<SparseCholesky>();
  else
    one.solver = std::make_unique<TreeFactor>(std::vector<int>(boxes.size(), unknowns),
                                              FactorUse{precision, static_cast<int>(state.range(3))});
  // The analysis is not measured.
  if (one.solver->factorize(one.matrix.matrix()) != FactorStatus::success)
    throw std::runtime_error("indefinite");
  return one;
}

void factorize(benchmark::State& state) {
  Case one = case_of(state);
  for (auto step : state) {
    state.PauseTiming();
    one.matrix.add_to_diagonal(0, 1e-3);  // new values
    state.ResumeTiming();
    if (one.solver->factorize(one.matrix.matrix()) != FactorStatus::success)
      state.SkipWithError("indefinite");
  }
}

void solve(benchmark::State& state) {
  const Case one = case_of(state);
  const Eigen::VectorXd right_side = Eigen::VectorXd::LinSpaced(one.matrix.matrix().size, -1.0, 1.0);
  for (auto step : state) benchmark::DoNotOptimize(one.solver->solve(right_side, false));
}

void cases(benchmark::internal::Benchmark* of) {
  for (const auto& [scene, n] : {std::pair(0, 20), std::pair(0, 40), std::pair(1, 14)}) {
    of->Args({scene, n, 0, 1});
    for (const int method : {1, 2})
      for (const int threads : {1, 2, 8}) of->Args({scene, n, method, threads});
  }
  of->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}
BENCHMARK(factorize)->Apply(cases);
BENCHMARK(solve)->Apply(cases);

}  // namespace
}  // namespace ashlar
