#include "benchmarks/studies/cost_targets.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "apps/program/verify/falling_block.hpp"
#include "apps/results/system/this_process.hpp"
#include "benchmarks/studies/cost_run.hpp"
#include "benchmarks/studies/cost_scenes.hpp"

namespace ashlar {
namespace {

/// On the machine of reference, s: the amount of machine_factor(), and 240 steps of Bullet's hulls, least of several runs.
constexpr double reference_seconds = 0.208;
constexpr double bullet_wall_20 = 1.24;
constexpr double bullet_pyramid_14 = 6.7;
constexpr double bullet_pile_10 = 2.6;

/// Measures one scene after the other.
class Figures {
 public:
  Figures(double share, const std::function<void(const CostFigure&)>& measured)
      : share_(share), measured_(measured), machine_(machine_factor()) {}

  void measure() {
    add_wall();
    add_pyramid_and_pile();
    add_large_wall();
    add_growth("at rest", at_least_one(200), 1.1);
    add_growth("in the bounce", 0, 1.3);
    add_loose_wall();
    add_many();
    add_few();
    add_threads();
  }
  [[nodiscard]] std::vector<CostFigure> result() && { return std::move(figures_); }

 private:
  [[nodiscard]] int at_least_one(int whole) const {
    return std::max(1, static_cast<int>(std::lround(share_ * whole)));
  }
  /// Not a number where the scene does not run to its end.
  static RunCost cost_of(const MakeSimulation& make, int skipped, int steps) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return cost_of_run(make, skipped, steps).value_or(RunCost{nan, nan, nan, nan, nan, nan, nan});
  }
  static RunCost cost_of(const SceneText& scene, int skipped, int steps, int threads = 1) {
    return cost_of(scene_of_text(scene.text(), threads), skipped, steps);
  }
  void add(const std::string& what, double measured, double target, const std::string& unit,
           bool speedup = false) {
    figures_.push_back({what, measured, target, unit, speedup});
    measured_(figures_.back());
  }
  [[nodiscard]] double here(double seconds_of_reference) const { return machine_ * seconds_of_reference; }

  void add_wall() {
    const SceneText wall = wall_of(at_least_one(20));
    const int steps = at_least_one(240);
    const RunCost cost = cost_of(wall, 0, steps);
    add("wall of 410 bricks, 240 steps, over Bullet's hulls", cost.seconds / here(bullet_wall_20), 4.0, "");
    const RunCost later = cost_of(wall, steps, steps);
    add("the next 240 steps, in which it sleeps", later.seconds / here(bullet_wall_20), 0.05, "");
    constexpr double kibibytes = 1024.0;
    add("its memory, a brick", kibibytes * cost.mebibytes / wall.blocks(), 60.0, "KiB");
  }
  void add_pyramid_and_pile() {
    const RunCost pyramid = cost_of(pyramid_of(at_least_one(14)), 0, at_least_one(240));
    add("pyramid of 1015 cubes, over Bullet's hulls", pyramid.seconds / here(bullet_pyramid_14), 3.0, "");
    const RunCost pile = cost_of(pile_of(at_least_one(10), 0.02), 0, at_least_one(240));
    add("pile of 1000 cubes, over Bullet's hulls", pile.seconds / here(bullet_pile_10), 2.0, "");
  }
  void add_large_wall() {
    const RunCost cost = cost_of(wall_of(at_least_one(40)), 0, at_least_one(240));
    add("wall of 1620 bricks, 240 steps", cost.seconds / machine_, 50.0, "s");
    add("its worst step", cost.worst / machine_, 2.0, "s");
  }
  /// Exponent of a step's time against blocks from walls of 10 courses to 40.
  void add_growth(const std::string& when, int skipped, double target) {
    std::vector<double> seconds, blocks;
    for (const int n : {at_least_one(10), 2 * at_least_one(10), 4 * at_least_one(10)}) {
      const SceneText wall = waking_wall_of(n);
      seconds.push_back(cost_of(wall, skipped, at_least_one(16)).seconds);
      blocks.push_back(wall.blocks());
    }
    add("exponent of a step's time, walls of 105 to 1620 bricks " + when,
        std::log(seconds.back() / seconds.front()) / std::log(blocks.back() / blocks.front()), target, "");
  }
  void add_loose_wall() {
    const int n = at_least_one(20);
    const int steps = at_least_one(60);
    const double loose = cost_of(loose_wall_of(n), 0, steps).seconds;
    add("wall in which one brick topples, 60 steps, over one at rest",
        loose / cost_of(wall_of(n), 0, steps).seconds, 1.2, "");
  }
  void add_many() {
    const int side = at_least_one(64);
    add("4096 cubes apart on one slab, 10 steps",
        cost_of(floor_of(side), 0, at_least_one(10)).seconds / machine_, 2.0, "s");
    add("1000 hulls of order 3, to the first step",
        cost_of(hulls_of(at_least_one(1000), 3), 0, 1).building / machine_, 0.8, "s");
  }
  void add_few() {
    add("16 stiff dominoes, 0.9 s",
        cost_of(scene_of_text(dominoes_text()), 0, at_least_one(3600)).seconds / machine_, 20.0, "s");
    for (const auto& [order, target] : {std::pair(3, 0.2), std::pair(6, 1.2), std::pair(8, 5.0)})
      add(fmt::format("falling block of order {}, 1350 steps", order),
          cost_of([order = order] { return std::optional(falling_block({.order = order})); }, 0,
                  at_least_one(1350))
                  .seconds /
              machine_,
          target, "s");
  }
  void add_threads() {
    const auto speedup = [&](const SceneText& scene) {
      const int steps = at_least_one(16);
      return cost_of(scene, 0, steps, 1).wall / cost_of(scene, 0, steps, 2).wall;
    };
    add("two threads, wall of 1620 bricks", speedup(wall_of(at_least_one(40))), 1.7, "", true);
    add("two threads, pyramid of 1015 cubes", speedup(pyramid_of(at_least_one(14))), 1.7, "", true);
  }

  double share_;
  const std::function<void(const CostFigure&)>& measured_;
  double machine_;
  std::vector<CostFigure> figures_;
};

/// Processor seconds of a fixed amount of small dense factorisations.
double seconds_of_factorisations() {
  constexpr int size = 12;
  constexpr int repetitions = 400000;
  using Square = Eigen::Matrix<double, size, size>;
  Square matrix = Square::Constant(0.5);
  matrix.diagonal().setConstant(size);
  Eigen::Matrix<double, size, 1> x = Eigen::Matrix<double, size, 1>::Ones();
  const double start = processor_time();
  for (int k = 0; k < repetitions; ++k) {
    // Depends on the result, so that the compiler cannot remove the work.
    matrix(0, 0) = size + 1e-3 * x[0];
    x = matrix.llt().solve(x + Eigen::Matrix<double, size, 1>::Ones());
  }
  const double seconds = processor_time() - start;
  return x.allFinite() ? seconds : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double machine_factor() {
  double least = std::numeric_limits<double>::infinity();
  constexpr int repetitions = 5;
  for (int k = 0; k < repetitions; ++k) least = std::min(least, seconds_of_factorisations());
  return least / reference_seconds;
}

std::vector<CostFigure> cost_figures(const CostFigureSize& size,
                                     const std::function<void(const CostFigure&)>& measured) {
  Figures figures(size.share, measured);
  figures.measure();
  return std::move(figures).result();
}

std::string target_line(const CostFigure& figure) {
  const std::string unit = figure.unit.empty() ? "" : " " + figure.unit;
  return fmt::format("{}: {:.3g}{} (target {:.3g}{}, {})", figure.what, figure.measured, unit, figure.target,
                     unit, figure.met() ? "met" : "missed");
}

}  // namespace ashlar
