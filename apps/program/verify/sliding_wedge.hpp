// A prism that slides on two planes along their line of intersection: planes 40/130 and 60/220 (dip and dip
// direction, degrees).
#pragma once

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {

struct SlidingWedge {
  Vector3 n1;    ///< outward normal of plane 1
  Vector3 n2;    ///< of plane 2
  Vector3 line;  ///< down the line of intersection
  Vector3 d1;    ///< up plane 1, normal to the line
  Vector3 d2;    ///< up plane 2
  double grip;   ///< sum of normal forces over weight
  double slip;   ///< driving force over weight

  SlidingWedge();
  /// Two fixed blocks below the planes, 0 and 1, and the wedge, 2: 2 m along the line, 1 m up each plane.
  void add_to(ContactScene& scene, const Material& material) const;
  /// Contact area of both planes, m^2.
  [[nodiscard]] double contact_area() const { return 4.0; }
  /// Volume of the wedge, m^3.
  [[nodiscard]] double volume() const { return d1.cross(d2).norm(); }
};

}  // namespace ashlar
