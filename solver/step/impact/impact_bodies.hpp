// Bodies and points of an impact (impact.hpp) as one system of equations in z, the changes of velocity.
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <memory>
#include <vector>

#include "solver/step/impact/impact.hpp"

namespace ashlar {

/// Impulse that a point can transmit, nearest to another one, and the derivative by that.
struct LawfulImpulse {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
};

/// Projection on the cone |j_t| <= tan(phi) j_n; a bond transmits all.
[[nodiscard]] LawfulImpulse lawful_impulse(const ImpactPoint& point, const Eigen::Vector3d& impulse);

/// Factor of M + G' A G with symmetric A: dense for few bodies.
class ImpactFactor {
 public:
  explicit ImpactFactor(const Eigen::MatrixXd& matrix);
  explicit ImpactFactor(const Eigen::SparseMatrix<double>& matrix);
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> dense_;
  std::shared_ptr<const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>> sparse_;  ///< null: dense
};

/// Uses its arguments as long as it lives.
class ImpactBodies {
 public:
  ImpactBodies(const std::vector<double>& inertia, const std::vector<int>& sizes,
               const std::vector<ImpactPoint>& points);

  [[nodiscard]] std::size_t points() const { return points_.size(); }
  [[nodiscard]] const ImpactPoint& point(std::size_t k) const { return points_[k]; }
  [[nodiscard]] Eigen::Index unknowns() const { return inertia_.size(); }
  /// M, by unknown.
  [[nodiscard]] const Eigen::VectorXd& inertia() const { return inertia_; }
  /// Mean velocity by impulse of a point alone, 1/kg. 0: both motions are given
  [[nodiscard]] double mobility(std::size_t k) const { return mobilities_[k]; }
  /// Largest velocity of a point before, in the energy norm of its own mass, sqrt(kg) m/s.
  [[nodiscard]] double speed() const { return speed_; }

  /// Change of the velocity of a point, m/s.
  [[nodiscard]] Eigen::Vector3d motion(std::size_t k, const Eigen::VectorXd& z) const;
  /// Velocity of a point without impulses, less its target; 0 for a bond. m/s
  [[nodiscard]] Eigen::Vector3d given(std::size_t k) const;
  /// Velocity of a point after the impact, less its target; its change for a bond. m/s
  [[nodiscard]] Eigen::Vector3d after(std::size_t k, const Eigen::VectorXd& z) const {
    return given(k) + motion(k, z);
  }
  /// G' j.
  [[nodiscard]] Eigen::VectorXd on_bodies(const std::vector<Eigen::Vector3d>& impulses) const;
  /// z = M^-1 G' j.
  [[nodiscard]] Eigen::VectorXd changes(const std::vector<Eigen::Vector3d>& impulses) const {
    return on_bodies(impulses).cwiseQuotient(inertia_);
  }
  /// z of one body.
  [[nodiscard]] Eigen::VectorXd of_body(std::size_t body, const Eigen::VectorXd& z) const {
    return z.segment(begin_[body], begin_[body + 1] - begin_[body]);
  }

  /// Solves (M + G' A G) x = b. @param stiffness A by point
  [[nodiscard]] Eigen::VectorXd solve(const std::vector<Eigen::Matrix3d>& stiffness,
                                      const Eigen::VectorXd& b) const;
  /// @param stiffness A by point, symmetric without negative eigenvalues
  [[nodiscard]] ImpactFactor factor(const std::vector<Eigen::Matrix3d>& stiffness) const;

  /// Residual of Coulomb's law, of the largest velocity of a point before: change of the velocity of a point, by itself,
  /// that makes its impulse obey the law. 0 without velocities
  [[nodiscard]] double residual(const std::vector<Eigen::Vector3d>& impulses) const;
  /// Work of impulses, J: half of them acts on the velocity before, half on that after.
  [[nodiscard]] double work(const std::vector<Eigen::Vector3d>& impulses) const;

 private:
  template <class Do>
  static void for_sides(const ImpactPoint& point, const Do& act) {
    if (point.a >= 0) act(point.a, point.of_a);
    if (point.b >= 0) act(point.b, point.of_b);
  }
  /// Calls `add(row, column, block)` with the parts of G' A G.
  template <class Add>
  void each_part(const std::vector<Eigen::Matrix3d>& stiffness, const Add& add) const;
  [[nodiscard]] bool is_small() const;
  [[nodiscard]] Eigen::MatrixXd dense(const std::vector<Eigen::Matrix3d>& stiffness) const;
  [[nodiscard]] Eigen::SparseMatrix<double> sparse(const std::vector<Eigen::Matrix3d>& stiffness) const;

  const std::vector<ImpactPoint>& points_;
  std::vector<Eigen::Index> begin_;  ///< of the unknowns of each body, and their number
  Eigen::VectorXd inertia_;
  std::vector<double> mobilities_;
  double fastest_ = 0.0;  ///< m/s
  double speed_ = 0.0;
};

/// Impulses of a method that goes on until they are accurate.
struct FoundImpulses {
  std::vector<Eigen::Vector3d> impulses;  ///< by point, N s on a along (n, t1, t2), in their cones
  double residual = 0.0;                  ///< of these, ImpactBodies::residual

  /// Keeps others if their residual is smaller.
  void take(const ImpactBodies& bodies, const std::vector<Eigen::Vector3d>& others);
};

}  // namespace ashlar
