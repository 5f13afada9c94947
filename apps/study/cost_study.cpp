#include "apps/study/cost_study.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "apps/scene/build_simulation.hpp"
#include "apps/study/processor_time.hpp"

namespace ashlar {
namespace {

/// Text of a scene, block by block.
class SceneText {
 public:
  explicit SceneText(int order) : order_(order) {
    text_ = R"([analysis]
end_time = 1000.0
time_step = 0.004166666666666667
[contact]
friction_angle = 26.565
[[material]]
name = "stone"
density = 2600
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "ground"
fixed = true
box = { min = [-500, -500, -5], max = [500, 500, 0] }
)";
  }
  void add_box(const Vector3& low, const Vector3& high) {
    fmt::format_to(std::back_inserter(text_),
                   "[[block]]\nname = \"b{}\"\nmaterial = \"stone\"\norder = {}\n"
                   "box = {{ min = [{}, {}, {}], max = [{}, {}, {}] }}\n",
                   blocks_++, order_, low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
  }
  void add_cube(double x, double y, double z) { add_box({x, y, z}, {x + 1, y + 1, z + 1}); }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] int blocks() const { return blocks_; }

 private:
  std::string text_;
  int order_;
  int blocks_ = 0;
};

SceneText floor_of(int n) {
  SceneText scene(1);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) scene.add_cube(1.5 * i, 1.5 * j, 0);
  }
  return scene;
}

/// Odd courses end in half bricks.
SceneText wall_of(int n) {
  SceneText scene(1);
  for (int course = 0; course < n; ++course) {
    const double low = 0.5 * course;
    for (int i = 0; i < n + course % 2; ++i) {
      const double left = std::max(0.0, i - 0.5 * (course % 2));
      const double right = std::min<double>(n, i - 0.5 * (course % 2) + 1.0);
      scene.add_box({left, 0, low}, {right, 0.5, low + 0.5});
    }
  }
  return scene;
}

SceneText pile_of(int n) {
  constexpr double gap = 1e-3;
  SceneText scene(1);
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) scene.add_cube(1.02 * i, 1.02 * j, gap + k * (1.0 + gap));
    }
  }
  return scene;
}

SceneText pyramid_of(int n) {
  SceneText scene(1);
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n - k; ++j) {
      for (int i = 0; i < n - k; ++i) scene.add_cube(i + 0.5 * k, j + 0.5 * k, k);
    }
  }
  return scene;
}

SceneText cube_of_order(int order) {
  SceneText scene(order);
  scene.add_cube(0, 0, 0);
  return scene;
}

/// What a run cost.
struct Cost {
  double unknowns = 0.0;
  double points = 0.0;     ///< contact points a step
  double building = 0.0;   ///< s
  double step = 0.0;       ///< s
  double mebibytes = 0.0;  ///< that the process grew by
};

/// Most that this process has taken so far, KiB.
double most_memory() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss);
}

std::optional<Cost> cost_of(const SceneText& scene, int steps) {
  const double memory = most_memory();
  const double start = processor_time();
  Diagnostics diagnostics;
  const auto loaded = load_scene_text(scene.text(), "study.toml", {}, diagnostics);
  if (!loaded) return std::nullopt;
  auto built = build_simulation(*loaded, 1, diagnostics);
  if (!built) return std::nullopt;
  Simulation& simulation = built->simulation;
  const double built_at = processor_time();
  for (int k = 0; k < steps; ++k)
    if (simulation.step(loaded->scene.analysis.end_time) != StepStatus::accepted) return std::nullopt;
  const double end = processor_time();
  Cost cost;
  for (const BlockModel& block : simulation.blocks())
    if (!block.fixed()) cost.unknowns += block.unknowns();
  cost.points = static_cast<double>(simulation.counts().contact_points) / steps;
  cost.building = built_at - start;
  cost.step = (end - built_at) / steps;
  constexpr double kibibytes = 1024.0;
  cost.mebibytes = (most_memory() - memory) / kibibytes;
  return cost;
}

/// The same in a process of its own: memory that another scene has left would hide what this one takes.
std::optional<Cost> cost_alone(const SceneText& scene, int steps) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    bool told = false;
    try {
      if (const std::optional<Cost> cost = cost_of(scene, steps))
        told = write(ends[1], &*cost, sizeof(Cost)) == static_cast<ssize_t>(sizeof(Cost));
    } catch (const std::exception&) {
      told = false;
    }
    _exit(told ? 0 : 1);
  }
  close(ends[1]);
  Cost cost;
  const bool read_all = child > 0 && read(ends[0], &cost, sizeof(Cost)) == static_cast<ssize_t>(sizeof(Cost));
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  return read_all ? std::optional(cost) : std::nullopt;
}

/// Sizes of a scene and how they are made.
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
          {"pile", {4, 5, 7, 10, 14, 20}, pile_of},
          {"pyramid", {6, 8, 11, 14, 20, 28}, pyramid_of},
          {"cube by order", std::move(orders), cube_of_order}};
}

}  // namespace

StudyResult study_cost() {
  return study_cost({});
}

StudyResult study_cost(const CostStudySize& size) {
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
      const std::optional<Cost> cost = cost_alone(scene, size.steps);
      if (!cost) {
        result.findings.push_back(fmt::format("{} of size {} did not run to its end.", family.name, n));
        result.holds = false;
        break;
      }
      result.rows.push_back({static_cast<double>(number), static_cast<double>(n),
                             static_cast<double>(scene.blocks()), cost->unknowns, cost->points,
                             cost->building, cost->step, cost->mebibytes});
      time.x.push_back(cost->unknowns);
      time.y.push_back(cost->step);
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
