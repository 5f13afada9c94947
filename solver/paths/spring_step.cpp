#include "solver/paths/spring_step.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int most_corrections = 40;
/// Relative to the largest load on a body.
constexpr double balanced = 1e-9;
/// Share of the reduction of the residual that a linear one would have; the shortest step.
constexpr double descent = 0.1, shortest = 0.02;
/// A step may raise the residual up to the largest of this many steps before: the tangent jumps where states change.
constexpr std::size_t remembered = 6;

}  // namespace

/// The unsymmetric tangent: a block for each body and two for each pair of moving ones.
struct SpringStep::Matrix {
  Eigen::SparseMatrix<double> values;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factor;
  bool analyzed = false;
};

SpringStep::SpringStep(const ConeProgram& program, std::vector<JointSpring> points)
    : program_(program), points_(std::move(points)), matrix_(std::make_unique<Matrix>()) {
  offsets_.push_back(0);
  for (std::size_t b = 0; b < program.bodies(); ++b) offsets_.push_back(offsets_.back() + program.freedom(b));
  std::vector<double> stiff(program.bodies(), 0.0);
  for (const ConePair& pair : program.pairs()) {
    for (const std::size_t side : {0U, 1U}) {
      if (pair.bodies[side] < 0) continue;
      BodyVelocity sum = BodyVelocity::Zero();
      for (std::size_t k = pair.begin; k < pair.end; ++k) {
        const ConeRows& rows = side == 0 ? program.points()[k].first : program.points()[k].second;
        const Vector3d springs(points_[k].normal, points_[k].shear, points_[k].shear);
        sum += (rows.array().square().colwise() * springs.array()).colwise().sum().transpose().matrix();
      }
      stiff[at(pair.bodies[side])] += sum.maxCoeff();
    }
  }
  for (const double one : stiff) stiffness_ += one / static_cast<double>(stiff.size());
  matrix_->values.resize(offsets_.back(), offsets_.back());
}

SpringStep::~SpringStep() = default;

SpringStep::Response SpringStep::response(std::size_t k, const Vector3d& start, const Vector3d& d) const {
  const JointSpring& spring = points_[k];
  const ConeStrength& strength = program_.points()[k].strength;
  Response r{Vector3d::Zero(), Matrix3d::Zero(), SpringState::sticks};
  const auto bounded = [&](double normal) {
    return std::clamp(normal, -strength.tension, std::max(strength.compression, -strength.tension));
  };
  const double elastic = start[0] - spring.normal * d[0];
  double normal = bounded(elastic);
  double slope = normal == elastic && spring.normal > 0.0 ? spring.normal : 0.0;
  const Eigen::Vector2d shear = start.tail<2>() - spring.shear * d.tail<2>();
  const double length = shear.norm();
  double limit = strength.shear_bound(normal);
  // Derivatives of the limit by N, and of N by the length of t'.
  double by_normal = strength.shear_slope(normal), by_length = 0.0;
  r.force[0] = normal;
  r.tangent(0, 0) = slope;
  if (length <= limit) {
    r.force.tail<2>() = shear;
    r.tangent(1, 1) = r.tangent(2, 2) = spring.shear;
    if (elastic <= -strength.tension && strength.tension == 0.0 && length == 0.0) r.state = SpringState::open;
    return r;
  }
  r.state = limit > 0.0 || normal > 0.0 ? SpringState::slides : SpringState::open;
  if (spring.dilation > 0.0 && spring.normal > 0.0 && spring.shear > 0.0) {
    const double wedge = spring.normal * spring.dilation / spring.shear;
    const double share = 1.0 / (1.0 + strength.friction * wedge);
    // N' is below zero where a joint has risen by its slip.
    const double raised =
        elastic + wedge * share * (length - strength.cohesion - strength.friction * elastic);
    if (raised > normal && raised < strength.compression) {
      by_length = wedge * share;
      slope = share * spring.normal;  // d N / d N' = 1 - friction wedge share
      normal = raised;
      limit = strength.shear_bound(normal);
      by_normal = strength.shear_slope(normal);
      r.state = SpringState::slides;
      r.force[0] = normal;
      r.tangent(0, 0) = slope;
    }
  }
  const Eigen::Vector2d along = shear / length;
  r.force.tail<2>() = limit * along;
  r.tangent.block<1, 2>(0, 1) = by_length * spring.shear * along.transpose();
  r.tangent.block<2, 1>(1, 0) = by_normal * slope * along;
  r.tangent.bottomRightCorner<2, 2>() =
      spring.shear * (limit / length * (Eigen::Matrix2d::Identity() - along * along.transpose()) +
                      by_normal * by_length * along * along.transpose());
  return r;
}

Eigen::VectorXd SpringStep::residual(const std::vector<Vector3d>& start,
                                     const std::vector<BodyVelocity>& load, double inertia,
                                     SpringSolution& at_end, std::vector<Matrix3d>& tangents) const {
  Eigen::VectorXd sum(offsets_.back());
  const auto segment = [&](int body) { return sum.segment(offsets_[at(body)], program_.freedom(at(body))); };
  for (std::size_t b = 0; b < load.size(); ++b) {
    const int own = static_cast<int>(b);
    segment(own) = (load[b] - inertia * at_end.moved[b]).head(program_.freedom(b));
  }
  for (std::size_t n = 0; n < program_.pairs().size(); ++n) {
    const ConePair& pair = program_.pairs()[n];
    BodyVelocity first = BodyVelocity::Zero(), second = BodyVelocity::Zero();
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      const Response r = response(k, start[k], program_.relative(n, k, at_end.moved));
      at_end.force[k] = r.force;
      at_end.states[k] = r.state;
      tangents[k] = r.tangent;
      first.noalias() += program_.points()[k].first.transpose() * r.force;
      second.noalias() += program_.points()[k].second.transpose() * r.force;
    }
    const auto [a, b] = pair.bodies;
    if (a >= 0) segment(a) += first.head(program_.freedom(at(a)));
    if (b >= 0) segment(b) -= second.head(program_.freedom(at(b)));
  }
  return sum;
}

bool SpringStep::factorize(const std::vector<Matrix3d>& tangents, double inertia) {
  Matrix& m = *matrix_;
  m.entries.clear();
  const auto add = [&](int row, int column, const Matrix6& block) {
    for (int j = 0; j < program_.freedom(at(column)); ++j)
      for (int i = 0; i < program_.freedom(at(row)); ++i)
        m.entries.emplace_back(offsets_[at(row)] + i, offsets_[at(column)] + j, block(i, j));
  };
  for (std::size_t b = 0; b < program_.bodies(); ++b) {
    const int own = static_cast<int>(b);
    add(own, own, inertia * Matrix6::Identity());
  }
  for (const ConePair& pair : program_.pairs()) {
    Matrix6 aa = Matrix6::Zero(), ab = aa, ba = aa, bb = aa;
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      const ConePoint& point = program_.points()[k];
      const ConeRows first = tangents[k] * point.first, second = tangents[k] * point.second;
      aa.noalias() += point.first.transpose() * first;
      ab.noalias() -= point.first.transpose() * second;
      ba.noalias() -= point.second.transpose() * first;
      bb.noalias() += point.second.transpose() * second;
    }
    const auto [a, b] = pair.bodies;
    if (a >= 0) add(a, a, aa);
    if (b >= 0) add(b, b, bb);
    if (a >= 0 && b >= 0) {
      add(a, b, ab);
      add(b, a, ba);
    }
  }
  m.values.setFromTriplets(m.entries.begin(), m.entries.end());
  if (!std::exchange(m.analyzed, true)) m.factor.analyzePattern(m.values);
  m.factor.factorize(m.values);
  return m.factor.info() == Eigen::Success;
}

SpringSolution SpringStep::solve(const std::vector<Vector3d>& start, const std::vector<BodyVelocity>& load,
                                 double inertia) {
  SpringSolution now;
  now.moved.assign(program_.bodies(), BodyVelocity::Zero());
  now.force = start;
  now.states.assign(start.size(), SpringState::sticks);
  double scale = std::numeric_limits<double>::min();
  for (const BodyVelocity& own : load) scale = std::max(scale, own.norm());
  std::vector<Matrix3d> tangents(start.size()), next_tangents(start.size());
  Eigen::VectorXd left = residual(start, load, inertia, now, tangents);
  SpringSolution next = now;
  std::vector<double> sizes;
  for (; now.iterations < most_corrections; ++now.iterations) {
    const double size = left.norm();
    now.converged = size <= balanced * scale;
    if (now.converged || !std::isfinite(size) || !factorize(tangents, inertia)) break;
    const Eigen::VectorXd change = matrix_->factor.solve(left);
    if (!change.allFinite()) break;
    sizes.push_back(size);
    const auto first = sizes.size() > remembered ? sizes.end() - remembered : sizes.begin();
    const double allowed = *std::max_element(first, sizes.end());
    double share = 1.0;
    Eigen::VectorXd next_left;
    for (;; share *= 0.5) {
      for (std::size_t b = 0; b < next.moved.size(); ++b)
        next.moved[b].head(program_.freedom(b)) =
            now.moved[b].head(program_.freedom(b)) + share * change.segment(offsets_[b], program_.freedom(b));
      next_left = residual(start, load, inertia, next, next_tangents);
      if (next_left.norm() < (1.0 - descent * share) * allowed || share < shortest) break;
    }
    now.moved.swap(next.moved);
    now.force.swap(next.force);
    now.states.swap(next.states);
    tangents.swap(next_tangents);
    left = std::move(next_left);
  }
  return now;
}

}  // namespace ashlar
