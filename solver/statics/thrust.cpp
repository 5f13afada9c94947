#include "solver/statics/thrust.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Thrust beyond this multiple of all loads has no bound.
constexpr double boundless = 1e3;
/// Residual of balance that is allowed, over the loads.
constexpr double balanced = 1e-4;

/// Where the places of a support go when it gives way: level, away from the middle of what it holds.
class Directions {
 public:
  Directions(const RigidModel& model, int support, const Vector3& middle, const Vector3& down)
      : middle_(middle), down_(down) {
    constexpr double one_side = 0.1;
    Vector3 sum = Vector3::Zero();
    double size = 0.0;
    for (const RigidPoint& point : model.points) {
      if (point.blocks[0] != support && point.blocks[1] != support) continue;
      sum += level(point.place);
      size += level(point.place).norm();
    }
    if (sum.norm() > one_side * size) common_ = sum.normalized();
  }

  /// The same of all places of a support on one side; radial of one that lies around what it holds.
  [[nodiscard]] Vector3 at(const Vector3& place) const {
    if (common_) return *common_;
    const Vector3 arm = level(place);
    return arm.norm() > 0.0 ? Vector3(arm.normalized()) : Vector3(Vector3::Zero());
  }

 private:
  [[nodiscard]] Vector3 level(const Vector3& place) const {
    const Vector3 arm = place - middle_;
    const double square = down_.squaredNorm();
    return square > 0.0 ? Vector3(arm - arm.dot(down_) / square * down_) : arm;
  }

  Vector3 middle_, down_;
  std::optional<Vector3> common_;
};

/// A model in which one support may give way.
class Yielding {
 public:
  Yielding(const RigidModel& model, int support, const Vector3& down, int threads)
      : model_(model), support_(support), program_(made(down, threads)) {}

  /// @param sign 1: the most thrust, -1: the least
  [[nodiscard]] std::optional<ThrustState> extreme(double sign) {
    double load = 0.0;
    ConeQuestion question;
    question.load = model_.steady;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      question.load[b] += model_.multiplied[b];
      load += question.load[b].norm();
    }
    question.load.push_back(BodyVelocity::Zero());
    question.grows.assign(question.load.size(), BodyVelocity::Zero());
    question.grows.back()[0] = -sign;
    question.most = boundless * std::max(load, 1.0);
    const ConeAnswer answer = program_.solve(question);
    if (answer.status != ConeStatus::solved || answer.lacking > balanced ||
        answer.factor > 0.5 * question.most)
      return std::nullopt;
    ThrustState state;
    state.thrust = sign * answer.factor * model_.units.force();
    state.gap = answer.gap / std::max(std::abs(answer.factor), 1e-300);
    for (std::size_t k = 0; k < model_.points.size(); ++k)
      state.force.push_back(model_.units.force() * (model_.points[k].frame.transpose() * answer.force[k]));
    state.motion = answer.velocity;
    state.motion.pop_back();
    return state;
  }

 private:
  [[nodiscard]] ConeProgram made(const Vector3& down, int threads) const {
    const int coordinate = static_cast<int>(model_.bodies.size());
    std::vector<int> freedom;
    Vector3 middle = Vector3::Zero();
    double mass = 0.0;
    for (const RigidBody& body : model_.bodies) {
      freedom.push_back(body.freedom);
      middle += body.mass * body.middle;
      mass += body.mass;
    }
    middle /= mass;
    freedom.push_back(1);
    const Directions directions(model_, support_, middle, down);
    std::vector<ConePoint> points = cone_points(model_);
    std::vector<ConePair> pairs = model_.pairs;
    for (ConePair& pair : pairs) {
      for (std::size_t k = pair.begin; k < pair.end; ++k) {
        const RigidPoint& point = model_.points[k];
        for (const std::size_t side : {0U, 1U}) {
          if (point.blocks[side] != support_ || pair.bodies[side] >= 0) continue;
          ConeRows& rows = side == 0 ? points[k].first : points[k].second;
          rows.col(0) = point.frame * directions.at(point.place);
        }
      }
      const bool of_support = std::any_of(model_.points.begin() + static_cast<std::ptrdiff_t>(pair.begin),
                                          model_.points.begin() + static_cast<std::ptrdiff_t>(pair.end),
                                          [&](const RigidPoint& point) {
                                            return point.blocks[0] == support_ || point.blocks[1] == support_;
                                          });
      for (int& body : pair.bodies)
        if (body < 0 && of_support) body = coordinate;
    }
    return ConeProgram(std::move(freedom), std::move(pairs), std::move(points), threads);
  }

  const RigidModel& model_;
  int support_;
  ConeProgram program_;
};

}  // namespace

std::vector<ThrustRange> thrust_ranges(const RigidModel& model, const Vector3& down, int threads) {
  std::set<int> supports;
  for (const RigidPoint& point : model.points)
    for (const int block : point.blocks)
      if (model.body_of[at(block)] < 0) supports.insert(block);
  std::vector<ThrustRange> ranges;
  for (const int support : supports) {
    Yielding yielding(model, support, down, threads);
    ThrustRange range{support, yielding.extreme(-1.0), yielding.extreme(1.0)};
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
  std::map<std::array<int, 2>, Sum> sums;
  double largest = 0.0;
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    const RigidPoint& point = model.points[k];
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
