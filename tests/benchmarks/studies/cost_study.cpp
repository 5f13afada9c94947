#include "benchmarks/studies/cost_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "benchmarks/studies/cost_run.hpp"
#include "benchmarks/studies/cost_scenes.hpp"
#include "benchmarks/studies/cost_targets.hpp"

namespace ashlar {
namespace {

/// Sizes of a scene and its construction.
struct Family {
  const char* name;
  std::vector<int> sizes;
  SceneText (*make)(int);
};

std::vector<Family> families(int most_order) {
  std::vector<int> orders(static_cast<std::size_t>(most_order));
  for (int k = 0; k < most_order; ++k) orders[static_cast<std::size_t>(k)] = k + 1;
  return {{"floor", {8, 16, 32, 64, 90}, floor_of},
          {"wall", {8, 11, 20, 28, 40, 57, 90}, wall_of},
          {"pile", {4, 5, 7, 10, 14, 20}, [](int n) { return pile_of(n, 1e-3); }},
          {"pyramid", {6, 8, 11, 14, 20, 28}, pyramid_of},
          {"cube by order", std::move(orders), cube_of_order}};
}

}  // namespace

StudyResult study_cost(const StudyProgress& progress) {
  const std::vector<CostFigure> figures =
      cost_figures({}, [&](const CostFigure& figure) { progress(target_line(figure)); });
  StudyResult result = study_cost(CostStudySize{}, progress);
  std::vector<std::string> lines;
  std::transform(figures.begin(), figures.end(), std::back_inserter(lines), target_line);
  result.findings.insert(result.findings.end(), lines.begin(), lines.end());
  return result;
}

StudyResult study_cost(const CostStudySize& size, const StudyProgress& progress) {
  constexpr double kibibytes_in_mebibyte = 1024.0;
  StudyResult result;
  result.columns = {"scene",  "size",          "blocks",           "unknowns",
                    "points", "build_seconds", "seconds_per_step", "MiB"};
  result.plot = {"Processor time of a step, one thread", "unknowns", "seconds", {}};
  int number = 0;
  for (const Family& family : families(size.most_order)) {
    ++number;
    PlotSeries time{family.name, {}, {}};
    PlotSeries memory{family.name, {}, {}};
    double per_block = std::numeric_limits<double>::quiet_NaN();
    for (const int n : family.sizes) {
      const SceneText scene = family.make(n);
      if (scene.blocks() > size.most_blocks) break;
      const std::optional<RunCost> cost = cost_of_run(scene_of_text(scene.text()), 0, size.steps);
      if (!cost) {
        result.findings.push_back(fmt::format("{} of size {} did not run to its end.", family.name, n));
        result.holds = false;
        break;
      }
      result.rows.push_back({static_cast<double>(number), static_cast<double>(n),
                             static_cast<double>(scene.blocks()), cost->unknowns, cost->points,
                             cost->building, cost->seconds / size.steps, cost->mebibytes});
      progress(fmt::format("{} of {} blocks: {:.3g} s a step", family.name, scene.blocks(),
                           cost->seconds / size.steps));
      time.x.push_back(cost->unknowns);
      time.y.push_back(cost->seconds / size.steps);
      memory.x.push_back(cost->unknowns);
      memory.y.push_back(cost->mebibytes);
      per_block = kibibytes_in_mebibyte * cost->mebibytes / scene.blocks();
    }
    if (!time.x.empty()) {
      result.findings.push_back(fmt::format(
          "Scene {}, {}: time of a step ~ unknowns^{:.2f}, memory ~ unknowns^{:.2f} over the last three; "
          "{:.0f} KiB a block at the largest.",
          number, family.name, last_slope(time), last_slope(memory), per_block));
    }
    result.plot.series.push_back(std::move(time));
  }
  return result;
}

}  // namespace ashlar
