#include "solver/paths/thrust.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "solver/limit/crushing_joints.hpp"
#include "solver/paths/yielding_support.hpp"

namespace ashlar {
namespace {

/// Relative difference of an extreme by both bounds of parts up to which they are divided.
constexpr double close_thrust = 5e-4;
constexpr int most_thrust_divisions = 30;
/// Normal force of a joint that has a resultant, of the largest one: the place of a smaller one is that of rounding.
constexpr double least_resultant = 1e-6;

/// Thrust of a support along the coordinate in which it moves away from the structure.
class ThrustProgram {
 public:
  ThrustProgram(const RigidModel& model, int support, const Vector3& down, int threads)
      : model_(model),
        support_(support),
        down_(down),
        threads_(threads),
        program_(made(model, support, down, threads)) {}

  /// @param sign 1: the most thrust, -1: the least
  [[nodiscard]] std::optional<ThrustState> extreme(double sign) {
    const ConeQuestion question = question_of_support(model_, -sign);
    const ConeAnswer answer = program_.solve(question);
    if (!is_balanced(answer) || boundless(question, answer)) return std::nullopt;
    ThrustState state;
    state.thrust = sign * answer.factor * model_.units.force();
    state.gap = (answer.gap + by_parts(question, answer)) / std::max(std::abs(answer.factor), 1.0);
    state.force = forces_of(model_, answer.force);
    state.motion = answer.velocity;
    state.motion.pop_back();
    return state;
  }

  /// Divides parts for an extreme. @return false: they are fine enough, or cannot be divided
  bool divide(double sign, RigidModel& model) {
    const ConeQuestion question = question_of_support(model_, -sign);
    const ConeAnswer answer = program_.solve(question);
    // Without forces in balance the extreme of the stronger model shows where they are missing.
    const bool fine = is_balanced(answer) &&
                      by_parts(question, answer) <= close_thrust * std::max(std::abs(answer.factor), 1.0);
    if (fine) return false;
    const CornerModel corners = corner_model(model_);
    const ConeProgram stronger = made(corners.model, support_, down_, threads_);
    return !refine_parts(model, strengths_of(program_), corner_velocities(corners, stronger, answer.velocity))
                .empty();
  }

 private:
  /// The difference of the factor to that with pressure at corners of parts.
  [[nodiscard]] double by_parts(const ConeQuestion& question, const ConeAnswer& answer) const {
    if (!has_parts(model_)) return 0.0;
    const CornerModel corners = corner_model(model_);
    const ConeAnswer bound = made(corners.model, support_, down_, threads_).solve(question);
    return is_balanced(bound) ? std::max(0.0, bound.factor - answer.factor) : 0.0;
  }

  static ConeProgram made(const RigidModel& model, int support, const Vector3& down, int threads) {
    const MovementLaw movement_law(model, support, down, std::nullopt);
    return program_with_support(
        model, support,
        [&movement_law](const RigidPoint& point) { return movement_law.velocity(point, 0.0); }, threads);
  }

  const RigidModel& model_;
  int support_;
  Vector3 down_;
  int threads_;
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

void divide_for_thrust(RigidModel& model, const Vector3& down, int threads) {
  if (!has_parts(model)) return;
  for (const int support : supports_of(model))
    for (const double sign : {-1.0, 1.0})
      for (int n = 0; n < most_thrust_divisions; ++n) {
        const RigidModel before = model;
        if (!ThrustProgram(before, support, down, threads).divide(sign, model)) break;
      }
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
    if (sum.normal > least_resultant * largest)
      resultants.push_back({blocks, sum.place / sum.normal, sum.force});
  return resultants;
}

}  // namespace ashlar
