// Statics of rigid blocks as a convex programme over the cones of their joints, solved by an interior point method.
//
// Bodies have velocities v in coordinates in which their mass matrix is the unit matrix, points have forces
// p = (N, t1, t2) on the first of their two bodies, compression positive. With G v the velocities of the first body
// relative to the second one at the points, F the loads and p within the strengths of the joints,
//     |t| <= c + mu N,   -T <= N <= M                                                                 (cone)
// three programmes are solved:
//     rest     min over p   1/2 |F + G'p|^2 + s . N      accelerations v = F + G'p: Gauss's principle
//     factor   max over p, a   a,   F + G'p + a F1 = 0,   a <= most
//     slow     min over p   s . N,   F + G'p = 0         forces in balance
// The dual variables are velocities v: under `rest` the onset of motion from zero velocity, under `factor` the
// mechanism that limits the factor, with F1 . v = 1, under `slow` a motion without inertia. Sliding joints open by mu
// times their slip (associated flow), less the shift s of a point. Under `rest` without shifts v is zero if and only
// if forces within the strengths balance the loads.
//
// Method: primal-dual, scaled by Nesterov and Todd (Andersen, Roos and Terlaky, Math. Program. 95 (2003) 249), with
// Mehrotra's predictor and corrector. An iteration factorises G' H^-1 G + 1, H (3, 3) of each point: one block for
// each pair of bodies in contact. All quantities are dimensionless: the caller divides by a mass, a length and an
// acceleration.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "solver/linear/block_matrix.hpp"
#include "solver/linear/sparse_cholesky.hpp"

namespace ashlar {

using BodyVelocity = Eigen::Matrix<double, 6, 1>;
using ConeRows = Eigen::Matrix<double, 3, 6>;

/// Strength of a point. Contacts resist any compression, or crush; bars may have bounds on both sides, or none.
struct ConeStrength {
  double friction = 0.0;  ///< mu, >= 0
  double cohesion = 0.0;  ///< c, >= 0
  double tension = 0.0;   ///< T, >= 0; infinite, without friction only: no bound
  double compression = std::numeric_limits<double>::infinity();  ///< M, >= 0 and > -T; infinite: no bound
  /// True: c + mu max(N, 0) resists shear, which is not convex: for elastic joints and motion from rest only.
  bool keeps_cohesion = false;

  /// Bound of |t|, >= 0, and its derivative by N.
  [[nodiscard]] double shear_bound(double normal) const {
    return std::max(0.0, cohesion + friction * (keeps_cohesion ? std::max(normal, 0.0) : normal));
  }
  [[nodiscard]] double shear_slope(double normal) const {
    return shear_bound(normal) > 0.0 && !(keeps_cohesion && normal < 0.0) ? friction : 0.0;
  }
  /// True if it resists shear.
  [[nodiscard]] bool shear() const { return friction > 0.0 || cohesion > 0.0; }
  /// True if tension has a bound of its own, below c/mu, where the cone of shear ends.
  [[nodiscard]] bool cut_off() const {
    return std::isfinite(tension) && (!shear() || friction == 0.0 || tension < cohesion / friction);
  }
  /// True if compression has a bound.
  [[nodiscard]] bool crushes() const { return std::isfinite(compression); }
};

/// A point between two bodies: rows of its relative velocity, normal first.
struct ConePoint {
  ConeRows first = ConeRows::Zero();
  ConeRows second = ConeRows::Zero();  ///< to be subtracted
  ConeStrength strength;
};

/// The points of two bodies, stored consecutively.
struct ConePair {
  std::array<int, 2> bodies;  ///< -1: fixed
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Loads and kind of a programme.
struct ConeQuestion {
  std::vector<BodyVelocity> load;   ///< F, by body
  std::vector<BodyVelocity> grows;  ///< F1; empty: `rest`
  double most = 0.0;                ///< of the factor, > 0
  std::vector<double> shift;        ///< s by point, >= 0; empty: none
  bool balanced = false;            ///< `slow`: needs shifts of which the largest is 1
  /// Gap at which `rest` may end, relative to the square of the loads; 0: as small as rounding allows.
  double gap = 0.0;
};

/// Gap of programmes whose motion is needed to 1e-4 of that by the loads, as the error of v is the square root of the gap:
/// smaller values need more iterations.
inline constexpr double gap_of_motion = 1e-8;

enum class ConeStatus {
  solved,      ///< to the tolerances, or as accurately as rounding allows
  inaccurate,  ///< neither the gap nor the equations are within their tolerances
};

struct ConeAnswer {
  ConeStatus status = ConeStatus::inaccurate;
  std::vector<BodyVelocity> velocity;  ///< v
  std::vector<Eigen::Vector3d> force;  ///< p
  /// Duals: of the cone's axis, of the bound of tension and of that of compression; >= 0
  std::vector<Eigen::Vector3d> opening;
  double factor = 0.0;  ///< a, of `factor`
  double gap = 0.0;     ///< between primal and dual value, >= 0
  double residual =
      0.0;  ///< largest |F + G'p + a F1| of a body that v does not balance, over the largest load
  int iterations = 0;
};

/// Keeps the symbolic analysis of its matrix between problems. The answer to a problem is independent of earlier
/// problems and of the number of threads.
class ConeProgram {
 public:
  /// @param freedom of each body, 1 to 6: the number of its first coordinates that are free. @param pairs each pair
  /// of bodies once, none of two fixed ones. @param threads >= 1
  ConeProgram(std::vector<int> freedom, std::vector<ConePair> pairs, std::vector<ConePoint> points,
              int threads);

  [[nodiscard]] const std::vector<ConePoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<ConePair>& pairs() const { return pairs_; }
  [[nodiscard]] std::size_t bodies() const { return freedom_.size(); }
  [[nodiscard]] int freedom(std::size_t body) const { return freedom_[body]; }
  /// The first bodies, whose motion is compared with their loads. The others are bars (rigid_bolts.hpp), which have no
  /// loads and move with the first ones.
  [[nodiscard]] std::size_t loaded_bodies() const { return loaded_; }
  /// @param count up to bodies(), which it is at first
  void set_loaded_bodies(std::size_t count) { loaded_ = count; }
  void set_strength(std::size_t point, const ConeStrength& strength) { points_[point].strength = strength; }

  /// @throws std::bad_alloc
  [[nodiscard]] ConeAnswer solve(const ConeQuestion& question);

  /// G v at a point.
  [[nodiscard]] Eigen::Vector3d relative(std::size_t pair, std::size_t point,
                                         const std::vector<BodyVelocity>& velocity) const;

 private:
  friend class ConeIteration;
  [[nodiscard]] std::vector<std::array<int, 2>> moving_pairs() const;

  std::vector<int> freedom_;
  std::size_t loaded_;
  std::vector<ConePair> pairs_;
  std::vector<ConePoint> points_;
  std::vector<std::vector<std::array<std::size_t, 2>>>
      pairs_of_body_;  ///< pair, and which of its bodies this is
  int threads_;
  BlockMatrix matrix_;
  SparseCholesky factor_;
};

}  // namespace ashlar
