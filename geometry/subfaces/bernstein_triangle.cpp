// Rounding: u = 2^-53. The error of a sum of m products, in any order and any rounding mode, is at most (m + 1) 2u
// sum |a_i b_i|; that of the mean of two numbers u times the larger one.
#include "geometry/subfaces/bernstein_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

#include "geometry/exact/fifty_digits.hpp"

namespace ashlar {
namespace {

using Real = FiftyDigits;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double two_u = std::numeric_limits<double>::epsilon();

Real power(int base, int exponent) {
  Real result = 1;
  for (int k = 0; k < exponent; ++k) result *= base;
  return result;
}

Real factorial(int k) {
  Real result = 1;
  for (int i = 2; i <= k; ++i) result *= i;
  return result;
}

/// Bernstein polynomials at the domain points, times n^n. @return (points, polynomials)
RealMatrix collocation(const std::vector<std::array<int, 3>>& indices, int order) {
  const auto size = static_cast<Eigen::Index>(indices.size());
  RealMatrix result(size, size);
  for (Eigen::Index row = 0; row < size; ++row) {
    for (Eigen::Index column = 0; column < size; ++column) {
      const auto& point = indices[static_cast<std::size_t>(row)];
      const auto& exponent = indices[static_cast<std::size_t>(column)];
      Real value = factorial(order);
      for (std::size_t c = 0; c < 3; ++c) value *= power(point[c], exponent[c]) / factorial(exponent[c]);
      result(row, column) = value;
    }
  }
  return result;
}

double distance_to_segment(const Vector3& point, const Vector3& start, const Vector3& end) {
  const Vector3 along = end - start;
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? std::clamp(along.dot(point - start) / squared, 0.0, 1.0) : 0.0;
  return (point - start - share * along).norm();
}

/// Distance of a point from the plane of a flat triangle, or from its first corner where there is no plane.
class PlaneDistance {
 public:
  PlaneDistance(const Vector3& a, const Vector3& b, const Vector3& c)
      : origin_(a), normal_((b - a).cross(c - a)) {
    const double length = normal_.norm();
    flat_ = length > 0.0;
    if (flat_) normal_ /= length;
  }
  double operator()(const Vector3& point) const {
    const Vector3 r = point - origin_;
    return flat_ ? std::abs(normal_.dot(r)) : r.norm();
  }

 private:
  Vector3 origin_;
  Vector3 normal_;
  bool flat_ = false;
};

}  // namespace

const BernsteinForm& BernsteinForm::of_order(int order) {
  if (order < 1 || order > max_order)
    throw std::invalid_argument("order of a patch (" + std::to_string(order) + "), allowed 1 to " +
                                std::to_string(max_order));
  static std::array<std::unique_ptr<const BernsteinForm>, max_order + 1> forms;
  static std::array<std::once_flag, max_order + 1> made;
  const auto k = static_cast<std::size_t>(order);
  std::call_once(made[k], [&] { forms[k].reset(new BernsteinForm(order)); });
  return *forms[k];
}

BernsteinForm::BernsteinForm(int order) : order_(order) {
  for (int rest = 0; rest <= order; ++rest) {
    for (int k = 0; k <= rest; ++k) indices_.push_back({order - rest, rest - k, k});
  }
  // Fifty digits leave a correctly rounded double: the condition is below 10^6 up to order 12.
  const RealMatrix inverse = collocation(indices_, order).fullPivLu().inverse() * power(order, order);
  interpolation_ = inverse.unaryExpr([](const Real& x) { return x.convert_to<double>(); });
  interpolation_norm_ = interpolation_.cwiseAbs().rowwise().sum().maxCoeff();
}

std::vector<Vector3> BernsteinForm::domain_points() const {
  std::vector<Vector3> points;
  for (const auto& [i, j, k] : indices_) points.push_back(Vector3(i, j, k) / static_cast<double>(order_));
  return points;
}

BernsteinTriangle::BernsteinTriangle(const BernsteinForm& form,
                                     const Eigen::Ref<const Eigen::Matrix3Xd>& values)
    : form_(&form) {
  // Differences relative to one point keep the error proportional to the patch, independent of its place.
  const Vector3 origin = values.col(0);
  const Eigen::Matrix3Xd differences = values.colwise() - origin;
  control_.noalias() = differences * form.interpolation().transpose();
  control_.colwise() += origin;
  const double size = differences.cwiseAbs().maxCoeff();
  const double place = control_.cwiseAbs().maxCoeff();
  rounding_ = two_u * ((form.size() + 3) * form.interpolation_norm() * size + 2.0 * place);
  for (int c = 0; c < 3; ++c) control_.col(form.corner(c)) = values.col(form.corner(c));
}

std::array<BernsteinTriangle, 2> BernsteinTriangle::halves(int side) const {
  const int n = form_->order();
  // Indices of a control point whose parts at the corners side, side + 1, side + 2 are given.
  const auto place = [&](int first, int second, int third) {
    std::array<int, 3> parts{};
    parts[static_cast<std::size_t>(side)] = first;
    parts[static_cast<std::size_t>((side + 1) % 3)] = second;
    parts[static_cast<std::size_t>((side + 2) % 3)] = third;
    return form_->index(parts[1], parts[2]);
  };
  BernsteinTriangle towards_end(*form_, Eigen::Matrix3Xd(3, form_->size()), 0.0);
  BernsteinTriangle towards_start(*form_, Eigen::Matrix3Xd(3, form_->size()), 0.0);
  // Each row of control points parallel to the side is a curve that is halved by itself.
  std::vector<Vector3> row;
  for (int third = 0; third <= n; ++third) {
    const int degree = n - third;
    row.clear();
    for (int second = 0; second <= degree; ++second)
      row.emplace_back(control_.col(place(degree - second, second, third)));
    for (int step = 0; step <= degree; ++step) {
      // row[0] is the point after `step` steps: a control point of both halves.
      towards_start.control_.col(form_->index(step, third)) = row[0];
      towards_end.control_.col(form_->index(degree - step, third)) =
          row[static_cast<std::size_t>(degree - step)];
      for (int k = 0; k + step < degree; ++k) {
        const auto at = static_cast<std::size_t>(k);
        row[at] = 0.5 * (row[at] + row[at + 1]);
      }
    }
  }
  towards_start.rounding_ = towards_end.rounding_ = rounding_ + n * two_u * control_.cwiseAbs().maxCoeff();
  return {std::move(towards_end), std::move(towards_start)};
}

Vector3 BernsteinTriangle::at(const Vector3& barycentric) const {
  Eigen::Matrix3Xd points = control_;
  for (int degree = form_->order(); degree > 0; --degree) {
    for (int rest = 0; rest < degree; ++rest) {
      for (int k = 0; k <= rest; ++k) {
        const int j = rest - k;
        points.col(form_->index(j, k)) = barycentric[0] * points.col(form_->index(j, k)) +
                                         barycentric[1] * points.col(form_->index(j + 1, k)) +
                                         barycentric[2] * points.col(form_->index(j, k + 1));
      }
    }
  }
  return points.col(0);
}

Box BernsteinTriangle::box() const {
  return Box{control_.rowwise().minCoeff(), control_.rowwise().maxCoeff()}.grown(
      rounding_ + two_u * control_.cwiseAbs().maxCoeff());
}

Box BernsteinTriangle::box(const Eigen::Matrix3d& axes) const {
  const Eigen::Matrix3Xd turned = axes.transpose() * control_;
  // Turned, the rounding of three coordinates adds up, and so does that of the three products.
  return Box{turned.rowwise().minCoeff(), turned.rowwise().maxCoeff()}.grown(
      2.0 * rounding_ + 8.0 * two_u * control_.cwiseAbs().maxCoeff());
}

double BernsteinTriangle::chord_bound(const std::array<bool, 3>& rim) const {
  const PlaneDistance distance(corner(0), corner(1), corner(2));
  double bound = 0.0;
  double size = 0.0;
  for (Eigen::Index k = 0; k < control_.cols(); ++k) {
    bound = std::max(bound, distance(control_.col(k)));
    size = std::max(size, (control_.col(k) - control_.col(0)).cwiseAbs().maxCoeff());
  }
  const auto& indices = form_->indices();
  for (int side = 0; side < 3; ++side) {
    if (!rim[static_cast<std::size_t>(side)]) continue;
    const auto opposite = static_cast<std::size_t>((side + 2) % 3);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      if (indices[k][opposite] != 0) continue;
      bound = std::max(bound, distance_to_segment(control_.col(static_cast<Eigen::Index>(k)), corner(side),
                                                  corner((side + 1) % 3)));
    }
  }
  // Three coordinates of rounding, at the control point and at the corners it is compared with, and that of
  // the comparison.
  return bound + 4.0 * rounding_ + 16.0 * two_u * size;
}

double BernsteinTriangle::distance_bound(const BernsteinTriangle& other) const {
  const double moved = std::sqrt((control_ - other.control_).colwise().squaredNorm().maxCoeff());
  return moved * (1.0 + 8.0 * two_u) + 2.0 * (rounding_ + other.rounding_);
}

double sampled_chord_error(const BernsteinTriangle& patch, const std::array<bool, 3>& rim, int samples) {
  const PlaneDistance distance(patch.corner(0), patch.corner(1), patch.corner(2));
  double error = 0.0;
  for (int i = 0; i <= samples; ++i) {
    for (int j = 0; i + j <= samples; ++j) {
      const std::array<int, 3> parts = {samples - i - j, i, j};
      const Vector3 point = patch.at(Vector3(parts[0], parts[1], parts[2]) / static_cast<double>(samples));
      error = std::max(error, distance(point));
      for (int side = 0; side < 3; ++side) {
        if (!rim[static_cast<std::size_t>(side)] || parts[static_cast<std::size_t>((side + 2) % 3)] != 0)
          continue;
        error = std::max(error, distance_to_segment(point, patch.corner(side), patch.corner((side + 1) % 3)));
      }
    }
  }
  return error;
}

}  // namespace ashlar
