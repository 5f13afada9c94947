// One problem of a cone programme during its solution: iterates and directions of the interior point method
// (cone_program.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/limit/cone_algebra.hpp"
#include "solver/limit/cone_program.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace cone {

/// Iterate of a point: force, slacks of its bounds and their duals. Members without a bound stay 1 and are not used.
struct PointIterate {
  Vector3d p = Vector3d::Zero();
  Vector3d x = Vector3d::UnitX();  ///< (c + mu N, t)
  Vector3d z = Vector3d::UnitX();
  double xc = 1.0;  ///< T + N
  double zc = 1.0;
  double xm = 1.0;  ///< M - N
  double zm = 1.0;
};

/// Residuals of the equations of a point at an iterate, and the direction.
struct PointStep {
  Scaling w;
  Vector3d lambda = Vector3d::UnitX();
  Vector3d lack_x;  ///< E p + e - x
  double lack_xc = 0.0;
  double lack_xm = 0.0;  ///< M - N - xm
  Vector3d lack_y;       ///< G v + s - E'z
  Matrix3d inverse;      ///< H^-1
  Vector3d right;        ///< b of dp = H^-1 (b - G dv)
  Vector3d q;            ///< W^-1 times the residual of complementarity
  double qc = 0.0, qm = 0.0;
  Vector3d dp, dx, dz;
  double dxc = 0.0, dzc = 0.0, dxm = 0.0, dzm = 0.0;
};

}  // namespace cone

class ConeIteration {
 public:
  ConeIteration(ConeProgram& program, const ConeQuestion& question);

  ConeAnswer run();

 private:
  using Matrix3d = Eigen::Matrix3d;
  using Vector3d = Eigen::Vector3d;

  /// Stores the best iterate so far.
  void keep();
  void take_back();

  [[nodiscard]] const ConeStrength& strength(std::size_t k) const { return program_.points_[k].strength; }

  template <class Work>
  void each_pair(const Work& work) const {
    parallel_for(program_.threads_, program_.pairs_.size(), [&](std::size_t n) {
      const ConePair& pair = program_.pairs_[n];
      for (std::size_t k = pair.begin; k < pair.end; ++k) work(pair, k);
    });
  }
  template <class Work>
  void each_body(const Work& work) const {
    parallel_for(program_.threads_, program_.freedom_.size(), work);
  }

  static Vector3d times(const ConePoint& point, const ConePair& pair, const std::vector<BodyVelocity>& v);

  /// Sum of G' f at a body. @param f of a point
  template <class Force>
  [[nodiscard]] BodyVelocity gathered(std::size_t body, const Force& f) const {
    BodyVelocity sum = BodyVelocity::Zero();
    for (const auto& [pair, side] : program_.pairs_of_body_[body]) {
      const ConePair& of = program_.pairs_[pair];
      for (std::size_t k = of.begin; k < of.end; ++k) {
        const ConePoint& point = program_.points_[k];
        if (side == 0) {
          sum.noalias() += point.first.transpose() * f(k);
        } else {
          sum.noalias() -= point.second.transpose() * f(k);
        }
      }
    }
    return sum;
  }

  void start();
  /// First iterate of a bar or of a joint that crushes: within its bounds.
  void start_bounded(const ConeStrength& strength, cone::PointIterate& iterate) const;

  void note_equations();

  [[nodiscard]] double gap_allowed() const;
  [[nodiscard]] double equations_allowed() const;
  /// Unit of residuals of velocity.
  [[nodiscard]] double velocity_scale() const;
  [[nodiscard]] bool done(double looser) const;

  bool factorize();

  [[nodiscard]] std::vector<BodyVelocity> solved(const std::vector<BodyVelocity>& right);

  /// Direction that reduces complementarity to the share `centring`. @param corrected by the last direction
  void direction(double centring, bool corrected = false);
  /// Right-hand side of a point of a direction. @param target of the products
  void note_right_side(std::size_t k, double target, bool corrected);
  /// Growth of the factor in a direction, and the velocities with it.
  void note_growth(double target, bool corrected);
  /// Changes of a point, from the velocities of a direction.
  void note_step(const ConePair& pair, std::size_t k);

  [[nodiscard]] double length(double share) const;

  /// Complementarity after a step of length `step` along the direction.
  [[nodiscard]] double gap_after(double step) const;

  void advance(double step);

  void finish(ConeAnswer& answer) const;

  ConeProgram& program_;
  const ConeQuestion& question_;
  bool grows_;     ///< `factor`
  bool slow_;      ///< `slow`
  double weight_;  ///< of v in the balance of bodies
  double load_square_ = 0.0;
  double load_scale_ = 0.0;
  double bounds_ = 0.0;
  std::vector<BodyVelocity> velocity_, step_v_, lack_v_, along_;
  std::vector<cone::PointIterate> points_;
  std::vector<cone::PointStep> steps_;
  struct Kept {
    std::vector<BodyVelocity> velocity;
    std::vector<cone::PointIterate> points;
    double factor, slack, slack_dual;
  };
  Kept best_;
  double factor_ = 0.0, step_factor_ = 0.0;
  double slack_ = 0.0, slack_dual_ = 0.0, step_slack_ = 0.0, step_dual_ = 0.0;
  double lack_growth_ = 0.0, lack_slack_ = 0.0;
  double gap_ = 0.0, gap_scale_ = 1.0, equations_ = 0.0;
};

}  // namespace ashlar
