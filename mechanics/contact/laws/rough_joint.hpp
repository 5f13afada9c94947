// Friction of a rough joint without infilling (Barton and Choubey, Rock Mechanics 10 (1977) 1; Barton, Bandis and Bakhtar,
// Int. J. Rock Mech. 22 (1985) 121):
//     tau = sigma tan(alpha),   alpha = phi_r + JRC log10(JCS / sigma)                                   (peak)
// with the pressure sigma, the angle phi_r of a worn joint, the coefficient of roughness JRC (degrees a decade) and the
// compressive strength JCS of the walls. alpha is at most 70 degrees, so that the strength begins linearly at zero pressure. From
// JCS on, where (peak) has no roughness left, tau goes on along its tangent. The strength is concave in sigma.
//
// A wall of length L has its peak at the slip  d = (L/500) (JRC/L)^0.33  (m), and JRC falls with the slip after it:
//     slip / d          1     2     4     10    25    100
//     JRC left, of all  1     0.85  0.7   0.5   0.4   0
// linear in the logarithm between these (Barton 1982). Before the peak the joint is elastic. Slip is that of the steps before:
// within a step the roughness does not change.
#pragma once

#include <limits>

#include "mechanics/contact/laws/shear_bound.hpp"

namespace ashlar {

/// Roughness of the joints of a pair of blocks.
struct Roughness {
  double jrc = 0.0;    ///< degrees, 0 to 20; 0: smooth, friction is Coulomb's
  double jcs = 0.0;    ///< Pa, > 0
  double worn = 0.0;   ///< tan(phi_r)
  double share = 1.0;  ///< of the strength, 1/F with a factor of safety F
  double peak_slip = std::numeric_limits<double>::infinity();  ///< m, > 0; infinite: it does not wear

  [[nodiscard]] bool given() const { return jrc > 0.0; }
  [[nodiscard]] bool wears() const { return given() && peak_slip < std::numeric_limits<double>::infinity(); }
  friend bool operator==(const Roughness&, const Roughness&) = default;
};

/// d of a wall. @param length m, > 0. @return m
[[nodiscard]] double peak_slip_of(double jrc, double length);

/// Share of JRC that is left. @param wear slip over 100 d, 0 to 1
[[nodiscard]] double roughness_left(double wear);

/// Roughness of a point of an area.
struct PointRoughness {
  double jrc = 0.0;       ///< degrees, what is left of it; 0: smooth
  double strength = 0.0;  ///< JCS A, N
  double worn = 0.0;
  double share = 1.0;
  /// m: nothing is left of JRC after it; infinite: it does not wear
  double last_slip = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool given() const { return jrc > 0.0; }
  [[nodiscard]] bool wears() const { return last_slip < std::numeric_limits<double>::infinity(); }
};
/// @param area m^2; 0: a corner or an edge, whose pressure has no bound and whose friction is that of a worn joint
[[nodiscard]] PointRoughness point_roughness(const Roughness& roughness, double area, double wear);

/// Wear, 0 to 1, after more slip. @param rough of a joint that wears. @param slip m, >= 0
[[nodiscard]] double wear_after(const PointRoughness& rough, double wear, double slip);

/// Bound of the shear force, and its derivative by the normal force. @param normal N, >= 0. @param rough given
[[nodiscard]] ShearBound rough_bound(const PointRoughness& rough, double normal);

}  // namespace ashlar
