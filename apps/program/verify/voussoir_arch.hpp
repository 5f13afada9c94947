// Semicircular arches of equal voussoirs with straight sides.
#pragma once

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {

/// Inner and outer corners are on circles of radius R -+ t/2, joints are radial, the springings horizontal.
struct VoussoirArch {
  static constexpr double mean_radius = 10.0;  ///< R, m
  static constexpr double depth = 2.0;         ///< m
  int count;
  double ratio;  ///< t / R

  [[nodiscard]] double inner_radius() const { return (1.0 - 0.5 * ratio) * mean_radius; }
  [[nodiscard]] double outer_radius() const { return (1.0 + 0.5 * ratio) * mean_radius; }
  /// The voussoirs, 0 first at the springing of positive x, then two fixed blocks below the springings.
  /// @param orders of the voussoirs; empty: 1. @return size of a voussoir, m (block_size)
  double add_to(ContactScene& scene, const Material& material, const std::vector<int>& orders = {}) const;
  /// The smallest tan(phi) at which rigid voussoirs stand, by the required thrust.
  ///
  /// Half of the arch above the joint at the angle a from the springing has the area A(a) and its moment about the
  /// centre M(a). The crown acts on it with a thrust H per weight and depth. The joint cannot open at its inner side
  /// if
  ///   H >= (r_i A cos a - M) / (r_o - r_i sin a)       hinges at the crown's outer and the joint's inner side
  /// and the part above does not slide down on it if
  ///   H >= A tan(a - phi).
  /// At the springing H <= A(0) tan(phi). The arch spreads until H is the smallest value allowed by both.
  /// @pre count is even: the crown is a joint
  [[nodiscard]] double least_friction() const;
};

}  // namespace ashlar
