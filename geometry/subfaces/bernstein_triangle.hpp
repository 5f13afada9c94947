// Polynomial patches over triangles in Bernstein form, with certified bounds (theory.md sections 6.1
// and 6.2).
//
//   x(l) = sum_{i+j+k=n} b_ijk n!/(i! j! k!) l0^i l1^j l2^k,   l0 + l1 + l2 = 1, all >= 0
// The patch lies in the convex hull of its control points b, so a convex function of position (distance to a
// plane or a segment, a coordinate, a norm) is nowhere on the patch larger than at one of them. Every bound
// includes the rounding errors of the control points.
#pragma once

#include <array>
#include <vector>

#include "geometry/boxes/box.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Data shared by all patches of one order. Constant after construction.
class BernsteinForm {
 public:
  static constexpr int max_order = 12;

  /// The form of an order, made once. @param order 1 to max_order. @throws std::invalid_argument otherwise
  [[nodiscard]] static const BernsteinForm& of_order(int order);

  [[nodiscard]] int order() const { return order_; }
  /// m = (n+1)(n+2)/2 control points, and as many domain points.
  [[nodiscard]] int size() const { return static_cast<int>(indices_.size()); }
  /// (i, j, k) of every control point, i falling, then j: the corners are the first, and those of index
  /// corner(1) and corner(2).
  [[nodiscard]] const std::vector<std::array<int, 3>>& indices() const { return indices_; }
  [[nodiscard]] int index(int j, int k) const { return (j + k) * (j + k + 1) / 2 + k; }
  [[nodiscard]] int corner(int which) const {
    return which == 0 ? 0 : which == 1 ? index(order_, 0) : index(0, order_);
  }
  /// Barycentric coordinates (i, j, k) / n at which the values of a patch are to be given.
  [[nodiscard]] std::vector<Vector3> domain_points() const;
  /// Control points from values at the domain points, each entry correctly rounded. @return (m, m)
  [[nodiscard]] const Eigen::MatrixXd& interpolation() const { return interpolation_; }
  /// Largest sum of magnitudes of a row of interpolation().
  [[nodiscard]] double interpolation_norm() const { return interpolation_norm_; }

 private:
  explicit BernsteinForm(int order);

  int order_;
  std::vector<std::array<int, 3>> indices_;
  Eigen::MatrixXd interpolation_;
  double interpolation_norm_ = 0.0;
};

/// One patch. Corners are numbered 0 to 2; side s joins corners s and s + 1.
class BernsteinTriangle {
 public:
  /// @param values (3, m), the polynomial at the domain points
  BernsteinTriangle(const BernsteinForm& form, const Eigen::Ref<const Eigen::Matrix3Xd>& values);

  /// The two halves when a side is cut at its middle M in the parameter: corners (M, s+1, s+2) and
  /// (s, M, s+2) with s the side.
  [[nodiscard]] std::array<BernsteinTriangle, 2> halves(int side) const;

  [[nodiscard]] Vector3 corner(int which) const { return control_.col(form_->corner(which)); }
  /// The patch at barycentric coordinates (de Casteljau).
  [[nodiscard]] Vector3 at(const Vector3& barycentric) const;
  /// (3, m)
  [[nodiscard]] const Eigen::Matrix3Xd& control() const { return control_; }
  /// No coordinate of a control point is farther than this from that of the exact one, m.
  [[nodiscard]] double rounding() const { return rounding_; }

  /// Contains the patch.
  [[nodiscard]] Box box() const;
  /// The same with sides along other axes, in their coordinates. @param axes (3, 3), orthonormal columns
  [[nodiscard]] Box box(const Eigen::Matrix3d& axes) const;
  /// Upper bound of the chord error of the flat triangle through the corners, m: distance of the patch from its
  /// plane, and of the sides marked as rim from the straight segments between their ends. (Sides inside a face may
  /// differ within its plane: the flat triangles still cover the same surface.) A triangle without area counts as the
  /// point of its first corner.
  /// @param rim (3) by side
  [[nodiscard]] double chord_bound(const std::array<bool, 3>& rim) const;
  /// Upper bound of the distance of points of the patch from those of another one of the same form at the same
  /// parameters, m.
  [[nodiscard]] double distance_bound(const BernsteinTriangle& other) const;

 private:
  BernsteinTriangle(const BernsteinForm& form, Eigen::Matrix3Xd control, double rounding)
      : form_(&form), control_(std::move(control)), rounding_(rounding) {}

  const BernsteinForm* form_;
  Eigen::Matrix3Xd control_;
  double rounding_;
};

/// The chord error itself, from below: as BernsteinTriangle::chord_bound, but measured at `samples` + 1
/// points along every side and as many rows inside.
[[nodiscard]] double sampled_chord_error(const BernsteinTriangle& patch, const std::array<bool, 3>& rim,
                                         int samples);

}  // namespace ashlar
