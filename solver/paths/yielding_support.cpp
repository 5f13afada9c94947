#include "solver/paths/yielding_support.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/block/rigid_body.hpp"

namespace ashlar {
namespace {

/// Mean of the directions from the centre to the points of a support, over the mean of their lengths: with less the support
/// lies around the structure. Larger values need more one-sided supports, smaller ones take asymmetry for a side.
constexpr double one_side = 0.1;
/// Residual of forces in balance, over the loads: larger values accept forces that programmes could not determine.
constexpr double balanced_residual = 1e-4;

bool is_of(const RigidPoint& point, int block) {
  return point.blocks[0] == block || point.blocks[1] == block;
}

/// True for a contact of the block.
bool touches(const RigidPoint& point, int block) {
  return !point.bar && is_of(point, block);
}

/// Centre of gravity of all bodies that may move, m. @pre there is a body
Vector3 middle_of_bodies(const RigidModel& model) {
  Vector3 middle = Vector3::Zero();
  double mass = 0.0;
  for (const RigidBody& body : model.bodies) {
    if (body.blocks.empty()) continue;
    middle += body.mass * body.middle;
    mass += body.mass;
  }
  return middle / mass;
}

/// The part of a vector at right angles to gravity. @param down any length; zero: the whole vector
Vector3 level_part(const Vector3& vector, const Vector3& down) {
  const double square = down.squaredNorm();
  return square > 0.0 ? Vector3(vector - vector.dot(down) / square * down) : vector;
}

/// The horizontal unit vector in which a support on one side of the structure moves away from it.
/// @return empty: the support lies around the structure, or below its centre
std::optional<Vector3> direction_away(const RigidModel& model, int support, const Vector3& down) {
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

}  // namespace

std::vector<int> supports_of(const RigidModel& model) {
  std::set<int> supports;
  for (const RigidPoint& point : model.points)
    for (const int block : point.blocks)
      if (!point.bar && model.body_of[at(block)] < 0) supports.insert(block);
  return {supports.begin(), supports.end()};
}

Eigen::MatrixX3d mapped(const BlockModel& block, const Eigen::MatrixX3d& position, const Eigen::Matrix3d& a,
                        const Vector3& c) {
  const Eigen::VectorXd one = constant_function(position.rows(), block.basis().volume());
  return position * a.transpose() + one * c.transpose();
}

MovementLaw::MovementLaw(const RigidModel& model, int support, const Vector3& down,
                         const std::optional<Vector3>& direction)
    : support_(support), middle_(middle_of_bodies(model)), down_(down) {
  std::map<int, int> count;
  for (const RigidPoint& point : model.points) {
    if (!touches(point, support)) continue;
    const int block = point.blocks[point.blocks[0] == support ? 1 : 0];
    arms_.try_emplace(block, Vector3::Zero()).first->second += level_part(point.place - middle_, down_);
    ++count[block];
  }
  if (arms_.empty()) throw std::invalid_argument("nothing bears on the support");
  double sum = 0.0;
  for (auto& [block, arm] : arms_) {
    arm /= count[block];
    sum += arm.norm();
  }
  direction_ = direction ? direction->normalized() : direction_away(model, support, down);
  // A block at the very centre of its support stays at rest.
  if (!direction_ && sum > 0.0) radius_ = sum / static_cast<double>(arms_.size());
}

Vector3 MovementLaw::velocity(const RigidPoint& point, double q) const {
  if (direction_) return *direction_;
  const auto arm = arms_.find(point.blocks[point.blocks[0] == support_ ? 1 : 0]);
  if (arm != arms_.end()) return arm->second / radius_;
  return level_part(point.place - middle_, down_) / (radius_ + q);
}

Eigen::MatrixX3d MovementLaw::placed(const BlockModel& support, const Eigen::MatrixX3d& position,
                                     double q) const {
  if (direction_) return mapped(support, position, Eigen::Matrix3d::Identity(), q * *direction_);
  Eigen::Matrix3d level;
  for (int k = 0; k < 3; ++k) level.col(k) = level_part(Vector3::Unit(k), down_);
  const Eigen::Matrix3d stretch = q / radius_ * level;
  return mapped(support, position, Eigen::Matrix3d::Identity() + stretch, -stretch * middle_);
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
                                        [&](const RigidPoint& point) { return is_of(point, support); });
    for (int& body : pair.bodies)
      if (body < 0 && of_support) body = coordinate;
  }
  return ConeProgram(std::move(freedom), std::move(pairs), std::move(points), threads);
}

ConeQuestion question_of_support(const RigidModel& model, double sign) {
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
  question.most = unbounded_over_loads * std::max(load, 1.0);
  return question;
}

bool boundless(const ConeQuestion& question, const ConeAnswer& answer) {
  return answer.factor > 0.5 * question.most;
}

bool is_balanced(const ConeAnswer& answer) {
  return answer.status == ConeStatus::solved && answer.residual <= balanced_residual;
}

std::vector<Vector3> forces_of(const RigidModel& model, const std::vector<Eigen::Vector3d>& in_frames) {
  std::vector<Vector3> forces;
  for (std::size_t k = 0; k < model.points.size(); ++k)
    forces.emplace_back(model.units.force() * (model.points[k].frame.transpose() * in_frames[k]));
  return forces;
}

}  // namespace ashlar
