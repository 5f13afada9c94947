#include "solver/statics/thrust.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "solver/statics/yielding_support.hpp"

namespace ashlar {
namespace {

/// Thrust of a support along the coordinate in which it moves away from the structure.
class ThrustProgram {
 public:
  ThrustProgram(const RigidModel& model, int support, const Vector3& down, int threads)
      : model_(model), program_(made(model, support, down, threads)) {}

  /// @param sign 1: the most thrust, -1: the least
  [[nodiscard]] std::optional<ThrustState> extreme(double sign) {
    const ConeQuestion question = question_of_support(model_, -sign);
    const ConeAnswer answer = program_.solve(question);
    if (!is_balanced(answer) || boundless(question, answer)) return std::nullopt;
    ThrustState state;
    state.thrust = sign * answer.factor * model_.units.force();
    state.gap = answer.gap / std::max(std::abs(answer.factor), 1.0);
    state.force = forces_of(model_, answer.force);
    state.motion = answer.velocity;
    state.motion.pop_back();
    return state;
  }

 private:
  static ConeProgram made(const RigidModel& model, int support, const Vector3& down, int threads) {
    const SupportWay way(model, support, down, std::nullopt);
    return program_with_support(
        model, support, [&way](const RigidPoint& point) { return way.velocity(point, 0.0); }, threads);
  }

  const RigidModel& model_;
  ConeProgram program_;
};

}  // namespace

std::vector<ThrustRange> thrust_ranges(const RigidModel& model, const Vector3& down, int threads) {
  std::vector<ThrustRange> ranges;
  for (const int support : supports_of(model)) {
    ThrustProgram thrust(model, support, down, threads);
    ThrustRange range{support, thrust.extreme(-1.0), thrust.extreme(1.0)};
    if (range.least) ranges.push_back(std::move(range));
  }
  return ranges;
}

std::vector<JointResultant> joint_resultants(const RigidModel& model, const std::vector<Vector3>& force) {
  struct Sum {
    double normal = 0.0;
    Vector3 place = Vector3::Zero();
    Vector3 force = Vector3::Zero();
  };
  std::map<BlockPair, Sum> sums;
  double largest = 0.0;
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    const RigidPoint& point = model.points[k];
    if (point.bar) continue;
    Sum& sum = sums[point.blocks];
    const double normal = std::max(point.frame.row(0).dot(force[k]), 0.0);
    sum.normal += normal;
    sum.place += normal * point.place;
    sum.force += force[k];
    largest = std::max(largest, sum.normal);
  }
  std::vector<JointResultant> resultants;
  for (const auto& [blocks, sum] : sums)
    if (sum.normal > 1e-6 * largest) resultants.push_back({blocks, sum.place / sum.normal, sum.force});
  return resultants;
}

}  // namespace ashlar
