#include "solver/statics/yielding_support.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

bool touches(const RigidPoint& point, int block) {
  return point.blocks[0] == block || point.blocks[1] == block;
}

}  // namespace

std::vector<int> supports_of(const RigidModel& model) {
  std::set<int> supports;
  for (const RigidPoint& point : model.points)
    for (const int block : point.blocks)
      if (model.body_of[at(block)] < 0) supports.insert(block);
  return {supports.begin(), supports.end()};
}

Vector3 middle_of_bodies(const RigidModel& model) {
  Vector3 middle = Vector3::Zero();
  double mass = 0.0;
  for (const RigidBody& body : model.bodies) {
    middle += body.mass * body.middle;
    mass += body.mass;
  }
  return middle / mass;
}

Vector3 level_part(const Vector3& vector, const Vector3& down) {
  const double square = down.squaredNorm();
  return square > 0.0 ? Vector3(vector - vector.dot(down) / square * down) : vector;
}

std::optional<Vector3> direction_away(const RigidModel& model, int support, const Vector3& down) {
  constexpr double one_side = 0.1;
  const Vector3 middle = middle_of_bodies(model);
  Vector3 sum = Vector3::Zero();
  double size = 0.0;
  for (const RigidPoint& point : model.points) {
    if (!touches(point, support)) continue;
    const Vector3 arm = level_part(point.place - middle, down);
    sum += arm;
    size += arm.norm();
  }
  if (!(sum.norm() > one_side * size)) return std::nullopt;
  return sum.normalized();
}

ConeProgram program_with_support(const RigidModel& model, int support, const SupportVelocity& velocity,
                                 int threads) {
  const int coordinate = static_cast<int>(model.bodies.size());
  std::vector<int> freedom;
  for (const RigidBody& body : model.bodies) freedom.push_back(body.freedom);
  freedom.push_back(1);
  std::vector<ConePoint> points = cone_points(model);
  std::vector<ConePair> pairs = model.pairs;
  for (ConePair& pair : pairs) {
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      const RigidPoint& point = model.points[k];
      for (const std::size_t side : {0U, 1U}) {
        if (point.blocks[side] != support || pair.bodies[side] >= 0) continue;
        ConeRows& rows = side == 0 ? points[k].first : points[k].second;
        rows.col(0) = point.frame * velocity(point);
      }
    }
    const bool of_support = std::any_of(model.points.begin() + static_cast<std::ptrdiff_t>(pair.begin),
                                        model.points.begin() + static_cast<std::ptrdiff_t>(pair.end),
                                        [&](const RigidPoint& point) { return touches(point, support); });
    for (int& body : pair.bodies)
      if (body < 0 && of_support) body = coordinate;
  }
  return ConeProgram(std::move(freedom), std::move(pairs), std::move(points), threads);
}

ConeQuestion question_of_support(const RigidModel& model, double sign) {
  constexpr double multiple_of_loads = 1e3;
  double load = 0.0;
  ConeQuestion question;
  question.load = model.steady;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    question.load[b] += model.multiplied[b];
    load += question.load[b].norm();
  }
  question.load.push_back(BodyVelocity::Zero());
  question.grows.assign(question.load.size(), BodyVelocity::Zero());
  question.grows.back()[0] = sign;
  question.most = multiple_of_loads * std::max(load, 1.0);
  return question;
}

bool boundless(const ConeQuestion& question, const ConeAnswer& answer) {
  return answer.factor > 0.5 * question.most;
}

bool is_balanced(const ConeAnswer& answer) {
  constexpr double residual = 1e-4;  // over the loads
  return answer.status == ConeStatus::solved && answer.lacking <= residual;
}

std::vector<Vector3> forces_of(const RigidModel& model, const ConeAnswer& answer) {
  std::vector<Vector3> forces;
  for (std::size_t k = 0; k < model.points.size(); ++k)
    forces.emplace_back(model.units.force() * (model.points[k].frame.transpose() * answer.force[k]));
  return forces;
}

}  // namespace ashlar
