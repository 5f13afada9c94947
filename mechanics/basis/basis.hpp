// The polynomial basis of a block (theory.md section 2): complete of order n, orthonormal on the block's own
// volume and graded, so that the first 4, 10, 20, ... functions span the orders 1, 2, 3, ...
//
//   xi = (A' (X - c) - m) / h                  A: principal axes, c: first point; -1 to 1 in the box along A,
//   seed_k(X) = L_a(xi_1) L_b(xi_2) L_c(xi_3)  Legendre polynomials,
//   G = integral of seed seed' dV = L L'       moments and Cholesky factor in 32 digits if their rounding is proven
//                                               to change phi by less than 2^-56, else in 50
//   phi = inverse(L) seed                      so that  integral of phi phi' dV = I.
//
// phi is not evaluated in this form: if the block fills little of its box, inverse(L) and its rounding errors are
// large. A function of degree d - 1 multiplied by xi_i is a combination of functions of degrees d, d - 1 and d - 2
// only. So each function follows from earlier ones by a recurrence that is as stable as orthogonalization.
//
// Derivatives of phi are polynomials of the same space, so they are matrices: d phi / dX_i = D_i phi, and
// every integral of products of phi and its derivatives is a product of those matrices.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <memory>
#include <stdexcept>
#include <vector>

#include "geometry/solid/polyhedron.hpp"
#include "mechanics/basis/multi_index.hpp"

namespace ashlar {

/// An order too high for the shape in double precision.
struct OrderTooHigh : std::domain_error {
  OrderTooHigh(int order, int highest);
  int highest_safe_order;  ///< 0: not even order 1
};

/// Constant after construction.
class PolynomialBasis {
 public:
  static constexpr int max_order = 12;
  /// Allowed rounding error of a function relative to its root mean square over the block: six digits remain. The
  /// error is measured at points of the solid against 50 digits and covers orthonormality (||G - I||). Boxes and
  /// hulls lose 1e-15 to 1e-11 up to order 12. Thin rotated ones lose as much as their coordinates across the
  /// thickness lose to cancellation (1e-11 n^2 for a thickness of 1e-5). More is lost by shapes that fill little of
  /// the box along their principal axes, such as an L of thin arms: functions of size 1 on the arms are huge between
  /// them.
  static constexpr double allowed_loss = 1e-6;

  /// @param solid reference shape, m
  /// @param order 0 to max_order
  /// @throws std::invalid_argument if the order is out of range
  /// @throws OrderTooHigh if the functions lose more than allowed_loss, or cannot be computed in 50 digits
  PolynomialBasis(const Polyhedron& solid, int order);

  /// The basis of the same solid translated so that its first point is at a place. Shares all data independent of the
  /// place.
  /// @param anchor m
  [[nodiscard]] PolynomialBasis moved_to(const Vector3& anchor) const { return {parts_, anchor}; }

  [[nodiscard]] int order() const { return parts_->order; }
  /// p, the number of functions.
  [[nodiscard]] int size() const { return polynomial_count(order()); }
  [[nodiscard]] double volume() const { return parts_->volume; }
  /// Largest measured loss of any function, see allowed_loss.
  [[nodiscard]] double loss() const { return parts_->loss; }
  /// Centroid of the block, m.
  [[nodiscard]] const Vector3& centroid() const { return centroid_; }
  /// Integral of (X - centroid)(X - centroid)' dV, m^5.
  [[nodiscard]] const Eigen::Matrix3d& second_moment() const { return parts_->second_moment; }

  /// phi at a material point. @param point reference coordinates, m (any point, not only inside). @return
  /// (p), m^-3/2
  [[nodiscard]] Eigen::VectorXd values(const Vector3& point) const;

  /// phi at many points. @return (#points, p), m^-3/2
  [[nodiscard]] Eigen::MatrixXd values(const std::vector<Vector3>& points) const;

  /// Points that determine a polynomial of this order well: Gauss points of the box along the principal axes.
  /// @return ((order + 1)^3), m
  [[nodiscard]] std::vector<Vector3> sample_points() const;

  /// Gradients of phi at a material point. @return (p, 3), m^-5/2
  [[nodiscard]] Eigen::MatrixX3d gradients(const Vector3& point) const;

  /// D_i with d phi / dX_i = D_i phi. @param axis 0 to 2. @return (p, p), strictly block lower triangular,
  /// 1/m
  [[nodiscard]] const Eigen::MatrixXd& derivative(int axis) const {
    return parts_->derivatives[static_cast<std::size_t>(axis)];
  }

  /// Coefficients of the map X -> X (the undeformed block). @return (p, 3), m^5/2; zero beyond order 1
  [[nodiscard]] const Eigen::MatrixX3d& identity_map() const { return identity_map_; }

  /// Coefficients c of the field  X -> value + gradient (X - centroid).
  /// @param value (3), @param gradient (3, 3). @return (p, 3). An order 0 basis keeps the mean only.
  [[nodiscard]] Eigen::MatrixX3d linear_field(const Vector3& value, const Eigen::Matrix3d& gradient) const;

  /// Coefficients of the six rigid motions: translations by 1 along the axes, then turns by 1/length about
  /// axes through the centroid. @param length m. @return (3p, 6), stacked as in elasticity.hpp; order >= 1
  [[nodiscard]] Eigen::MatrixXd rigid_motions(double length) const;

 private:
  /// phi_k = (xi_axis phi_parent - sum_j weights_j phi_(first + j)) / divisor
  struct Recurrence {
    int axis;
    int parent;
    int first;
    Eigen::VectorXd weights;
    double divisor;
  };

  template <class Real>
  struct ExactParts;

  /// Data that are invariant under translation of the block. Places are relative to its first point.
  struct Parts {
    explicit Parts(const Polyhedron& solid, int the_order);

    int order;
    double volume = 0.0;
    Vector3 centroid;  ///< m
    Eigen::Matrix3d second_moment;
    Eigen::Matrix3d axes;                 ///< A, by columns
    Vector3 middle;                       ///< m, of the block's box along the principal axes, m
    Vector3 half_size;                    ///< h, of that box, m
    double constant = 0.0;                ///< phi_0
    std::vector<Recurrence> recurrences;  ///< (p - 1), of phi_1 on
    std::array<Eigen::MatrixXd, 3> derivatives;
    Eigen::MatrixX3d identity_map;
    double loss = 0.0;

    /// phi at a point from the first one, in the coordinates of the principal axes. @return (p)
    [[nodiscard]] Eigen::VectorXd values(const Vector3& xi) const;

   private:
    /// Computes all data, with number types for moments and for derived data. @return false if the digits do not
    /// suffice
    /// @throws OrderTooHigh
    template <class MomentReal, class Real>
    [[nodiscard]] bool make(const Polyhedron& solid);
    /// Volume, centroid and second moment.
    template <class Real>
    [[nodiscard]] bool measure(const TriangleMesh& mesh, ExactParts<Real>& exact);
    /// Sets the box along the principal axes in which xi is from -1 to 1.
    void choose_box(const TriangleMesh& mesh);
    /// Coordinates xi of the points.
    template <class Real>
    void scale(ExactParts<Real>& exact) const;
    /// Integrals of the seeds. @param error upper bound of their rounding error
    template <class Real>
    [[nodiscard]] std::vector<Real> seed_moments(const TriangleMesh& mesh, const ExactParts<Real>& exact,
                                                 double& error) const;
    /// @param moments of the seeds. @param error upper bound of theirs. @throws OrderTooHigh
    template <class Real>
    [[nodiscard]] bool orthonormalise(const Polyhedron& solid, const std::vector<Real>& moments, double error,
                                      ExactParts<Real>& exact) const;
    template <class Real>
    void make_recurrences(const ExactParts<Real>& exact);
    template <class Real>
    void make_derivatives(const ExactParts<Real>& exact);
    template <class Real>
    void make_identity_map(const ExactParts<Real>& exact);
    /// @throws OrderTooHigh
    template <class Real>
    void measure_loss(const TriangleMesh& mesh, const ExactParts<Real>& exact);
  };

  PolynomialBasis(std::shared_ptr<const Parts> parts, const Vector3& anchor);

  [[nodiscard]] Vector3 local(const Vector3& point) const {
    return (parts_->axes.transpose() * (point - anchor_) - parts_->middle).cwiseQuotient(parts_->half_size);
  }

  std::shared_ptr<const Parts> parts_;
  Vector3 anchor_;  ///< c, the first point of the solid, m
  Vector3 centroid_;
  Eigen::MatrixX3d identity_map_;
};

}  // namespace ashlar
