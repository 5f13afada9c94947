// A circular tunnel in elastic rock under stress: a quarter of the plane around it, of tied blocks.
//
// Kirsch's solution in plane strain (Jaeger, Cook and Zimmerman, Fundamentals of Rock Mechanics, 4th ed., 8.5): radius a,
// pressure p vertical and K p horizontal, angle t from the horizontal x, pressures positive,
//   s_r  = p/2 [(1 + K)(1 - a^2/r^2) - (1 - K)(1 - 4 a^2/r^2 + 3 a^4/r^4) cos 2t]
//   s_t  = p/2 [(1 + K)(1 + a^2/r^2) + (1 - K)(1 + 3 a^4/r^4) cos 2t]
//   s_rt = p/2 (1 - K)(1 + 2 a^2/r^2 - 3 a^4/r^4) sin 2t
// and the displacement by the excavation, with the shear modulus G and Poisson's ratio n,
//   u_r = -p a^2 / (4 G r) [(1 + K) - (1 - K)(4 (1 - n) - a^2/r^2) cos 2t]
//   u_t = -p a^2 / (4 G r) (1 - K)(2 (1 - 2 n) + a^2/r^2) sin 2t
//
// The square of side L around the tunnel has the tractions of this solution on its outer faces, so that it is exact in
// the square: no error from a far boundary. The tunnel's wall is a polygon, the remaining error that of its corners and
// of the blocks' polynomials.
#pragma once

#include <vector>

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {

struct KirschTunnel {
  double radius = 2.0;      ///< a, m
  double pressure = 5e6;    ///< p, Pa
  double ratio = 0.5;       ///< K
  double half_width = 8.0;  ///< L, m
  Material rock{2600.0, 1e10, 0.25};

  /// Stress after excavation at a place outside the tunnel, Pa, tension positive. y is the tunnel's axis.
  [[nodiscard]] Eigen::Matrix3d stress(const Vector3& place) const;
  /// The same without the tunnel.
  [[nodiscard]] Eigen::Matrix3d initial_stress() const;
  /// Displacement by the excavation, m.
  [[nodiscard]] Vector3 displacement(const Vector3& place) const;
};

/// The quarter x, z >= 0 in rings of sectors.
struct TunnelMesh {
  int order = 4;    ///< of the blocks
  int sectors = 4;  ///< even
  int facets = 8;   ///< of a sector's wall
};

/// Errors of a static analysis at the wall.
struct TunnelErrors {
  bool equilibrium = false;
  double hoop_stress = 0.0;   ///< largest, over that of the side wall
  double displacement = 0.0;  ///< largest, over that of the crown
};

[[nodiscard]] TunnelErrors errors_at_the_wall(const KirschTunnel& tunnel, const TunnelMesh& mesh);

}  // namespace ashlar
