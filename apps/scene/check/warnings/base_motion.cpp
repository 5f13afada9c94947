#include "apps/scene/check/warnings/base_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/model/support_history.hpp"

namespace ashlar {
namespace {

/// Largest component of the second derivative of the natural spline; 0 for one or two rows.
double smooth_acceleration(const SupportHistory& history) {
  const auto& [times, values, record] = history;
  if (times.size() < 3) return 0.0;
  const std::vector<Vector3> slopes = spline_slopes(times, values, SplineEnds::natural);
  double most = 0.0;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double length = times[k + 1] - times[k];
    const Vector3 mean = (values[k + 1] - values[k]) / length;
    const Vector3 start = (6.0 * mean - 4.0 * slopes[k] - 2.0 * slopes[k + 1]) / length;
    most = std::max(most, start.cwiseAbs().maxCoeff());
  }
  return most;
}

struct Jump {
  double velocity = 0.0;  ///< m/s, largest component
  double time = 0.0;      ///< s
  double length = 0.0;    ///< s, of the shorter one of the adjacent lines
};

/// The largest jump of velocity at a row whose distance from its neighbours exceeds a step.
Jump largest_jump(const SupportHistory& history, double step, double end_time) {
  const auto& [times, values, record] = history;
  Jump largest;
  for (std::size_t k = 0; k < times.size() && times[k] < end_time; ++k) {
    if (times[k] < 0.0) continue;
    Vector3 before = Vector3::Zero(), after = Vector3::Zero();
    double length = std::numeric_limits<double>::infinity();
    if (k > 0) {
      length = times[k] - times[k - 1];
      before = (values[k] - values[k - 1]) / length;
    }
    if (k + 1 < times.size()) {
      length = std::min(length, times[k + 1] - times[k]);
      after = (values[k + 1] - values[k]) / (times[k + 1] - times[k]);
    }
    const double jump = (after - before).cwiseAbs().maxCoeff();
    if (step < length && jump > largest.velocity) largest = {jump, times[k], length};
  }
  return largest;
}

/// Supports of one block over all stages.
struct BlockSupports {
  bool at_rest = false;                   ///< fixed, or held by a support without a history
  std::vector<SupportHistory> histories;  ///< each once, of moving supports
};

bool moves(const SupportHistory& history) {
  return std::any_of(history.values.begin(), history.values.end(),
                     [](const Vector3& value) { return value != Vector3::Zero(); });
}

void add(BlockSupports& supports, const SceneFix& fix) {
  const SupportHistory history = support_history(fix);
  if (!moves(history))
    supports.at_rest = true;
  else if (std::find(supports.histories.begin(), supports.histories.end(), history) ==
           supports.histories.end())
    supports.histories.push_back(history);
}

BlockSupports supports_of(const Scene& scene, std::size_t block) {
  BlockSupports supports;
  supports.at_rest = scene.block[block].fixed;
  for (const SceneFix& fix : scene.block[block].fix) add(supports, fix);
  for (const SceneStage& stage : scene.stage)
    for (const SceneStage::Fix& entry : stage.fix)
      if (means_block(scene, entry.blocks, block)) add(supports, entry.fix);
  return supports;
}

}  // namespace

std::optional<std::size_t> moved_base(const Scene& scene) {
  std::optional<std::size_t> base;
  std::vector<SupportHistory> histories;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const BlockSupports supports = supports_of(scene, k);
    if (supports.histories.empty()) {
      if (supports.at_rest) return std::nullopt;
      continue;
    }
    if (!base) {
      base = k;
      histories = supports.histories;
    } else if (!std::is_permutation(histories.begin(), histories.end(), supports.histories.begin(),
                                    supports.histories.end())) {
      return std::nullopt;
    }
  }
  return base;
}

void warn_of_jumping_supports(const ExpandedScene& scene, Diagnostics& diagnostics) {
  if (is_static(scene.analysis)) return;
  const double step = scene.analysis.time_step;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    for (std::size_t n = 0; n < scene.block[k].fix.size(); ++n) {
      const SceneFix& fix = scene.block[k].fix[n];
      if (fix.history.empty() || fix.record != MotionRecord::displacement) continue;
      const SupportHistory history = support_history(fix);
      const Jump jump = largest_jump(history, step, scene.analysis.end_time);
      const double smooth = smooth_acceleration(history);
      if (!(jump.velocity / step > largest_ordinary_jump * smooth)) continue;
      diagnostics.warning(
          scene.places.value(fmt::format("block.{}.fix.{}.displacement_history", k, n)),
          fmt::format(
              "displacement_history is linear between rows {:.3g} s apart: the velocity jumps by {:.3g} m/s "
              "at "
              "t = {:.6g} s, {:.3g} m/s^2 in a time_step of {:.3g} s and more in a shorter one, where a "
              "smooth "
              "curve through the rows has up to {:.3g} m/s^2; interpolation = \"cubic\", velocity_history or "
              "acceleration_history have no jumps",
              jump.length, jump.velocity, jump.time, jump.velocity / step, step, smooth));
    }
  }
}

std::vector<std::string> motion_left(const Scene& scene) {
  std::vector<std::string> lines;
  const auto in_words = [](const Vector3& v) {
    return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x(), v.y(), v.z());
  };
  for (const SceneBlock& block : scene.block) {
    std::vector<std::string> of_block;
    for (const SceneFix& fix : block.fix) {
      if (fix.history.empty() ||
          (fix.record != MotionRecord::velocity && fix.record != MotionRecord::acceleration))
        continue;
      const RecordedMotion motion(support_history(fix));
      const double end = std::min(fix.history.back().time, scene.analysis.end_time);
      const std::string line = fmt::format(
          "left at the end of {} of block \"{}\" (t = {:.6g} s): displacement {} m, velocity {} m/s",
          history_key(fix), block.name, end, in_words(motion.displacement(end)),
          in_words(motion.velocity(end)));
      if (std::find(of_block.begin(), of_block.end(), line) == of_block.end()) of_block.push_back(line);
    }
    lines.insert(lines.end(), of_block.begin(), of_block.end());
  }
  return lines;
}

}  // namespace ashlar
