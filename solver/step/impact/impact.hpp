// Impulses of an impact between bodies that move rigidly: a system of a few points and bodies, solved on its own.
//
// With z the changes of the velocities of all bodies, M their inertia, u = G v the relative velocities of the points
// before, u+ = u + G z those after:
//     M z = sum of G' j
//     normal     u+_n >= t,  j_n >= 0,  j_n (u+_n - t) = 0          t: the least velocity apart, -e u_n of an impact
//     tangents   |j_t| <= j_n tan(phi), otherwise against u+_t      Coulomb's law for impulses
//     bonds      u+ = u
// Without friction z is unique, the smallest change in the norm of M (Moreau). With one e for all points it never gains
// energy; with several, or with friction, it may: then the impulses are those between e = 0, which dissipate, and e,
// that keep the energy.
//
// Impulses: proximal_impact.hpp. Redundant points (four corners of a face) share the impulse; the motion is the same.
// There always is an answer: impulses within their cones that gain no energy, with the residual of the law.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace ashlar {

/// A point where two bodies meet.
struct ImpactPoint {
  int a = -1;  ///< index of the body; -1: its motion is given
  int b = -1;
  Eigen::Matrix3Xd
      of_a;  ///< G: motion of a relative to b along (n, t1, t2) by the velocities of a, (3, of a)
  Eigen::Matrix3Xd of_b;                               ///< the same by those of b, (3, of b)
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< u, m/s, positive: apart
  double target = 0.0;                                 ///< t, m/s
  double friction = 0.0;                               ///< tan(phi)
  bool bonded = false;
};

/// Result of an impact.
struct ImpactResult {
  std::vector<Eigen::VectorXd> changes;   ///< z, by body
  std::vector<Eigen::Vector3d> impulses;  ///< j, by point, N s on a along (n, t1, t2)
  double work = 0.0;                      ///< of the impulses, on given motion too, J, <= 0
  /// Error of a point's velocity against its law (ImpactBodies::residual), over the largest velocity before; that of the
  /// solutions between which the energy chooses
  double residual = 0.0;
};

/// Residual of a solution that is as good as exact. Points at nearly the same place limit it to 1e-8.
inline constexpr double impact_accuracy = 1e-6;

struct ImpactEffort {
  int quick = 500;      ///< iterations of splitting, before passes of Newton's method
  int thorough = 5000;  ///< the same where these do not suffice
  int passes = 40;
};

/// @param inertia of each body: a multiple of the unit matrix, kg/m^3 in mass-orthonormal functions
/// @param sizes number of velocities of each body.
[[nodiscard]] ImpactResult solve_impact(const std::vector<double>& inertia, const std::vector<int>& sizes,
                                        const std::vector<ImpactPoint>& points,
                                        const ImpactEffort& effort = {});

}  // namespace ashlar
