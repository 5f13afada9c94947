// Kinematic check of a mechanism, from its pushover. The equations are those of the Italian code for local mechanisms of
// masonry (Circolare 21 January 2019 no. 7, C8.7.1.2; as Circolare 2 February 2009 no. 617, C8A.4). With P_i the weights of
// the blocks of the mechanism, d_i the virtual displacements of their centroids along the direction, alpha the multiplier,
// d_k the displacement of the control, FC the confidence factor and q the behaviour factor:
//   M*  = (sum P_i d_i)^2 / (g sum P_i d_i^2)                         participating mass                     (1)
//   e*  = g M* / sum P_i                                              its fraction                           (2)
//   a0* = alpha_0 g / (e* FC)                                         spectral acceleration of activation    (3)
//   d*  = d_k sum P_i d_i^2 / (d_kk sum P_i d_i),  d_kk that of the control   spectral displacement           (4)
//   a*  = alpha(d_k) g / (e* FC)                                      capacity curve a*(d*)                  (5)
//   d_u* = 0.4 d_0*,  a*(d_0*) = 0                                    ultimate displacement                  (6)
//   T_s = 2 pi sqrt(d_s* / a*(d_s*)),  d_s* = 0.4 d_u*                secant period                          (7)
// Safety against collapse (SLV), with Se the elastic spectrum of acceleration and SDe that of displacement at the ground:
//   linear, on the ground         a0* >= Se(0) / q                                                           (8)
//   linear, at a height Z         a0* >= Se(T1) psi gamma / q                                                (9)
//   non-linear, on the ground     d_u* >= SDe(T_s)                                                          (10)
//   non-linear, at a height Z     d_u* >= SDe(T1) psi gamma (T_s / T1)^2 /
//                                         sqrt((1 - T_s / T1)^2 + 0.02 T_s / T1)                             (11)
// with psi = Z / H, gamma = 3 N / (2 N + 1) for N storeys, and T1 the first period of the building, 0.05 H^(3/4) unless it
// is known (NTC 2008, 7.3.3.2). At a height both demands hold.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_pushover.hpp"
#include "solver/paths/pushover.hpp"

namespace ashlar {

/// A capacity and what an earthquake asks for.
struct KinematicVerdict {
  double capacity = 0.0;
  double demand = 0.0;
  [[nodiscard]] bool satisfied() const { return capacity >= demand; }
};

/// Capacity of the mechanism. Displacements are known with a multiplier of zero, and if blocks begin to move at the limit
/// (Pushover::at_limit); otherwise their mechanism is another one, and all of its weight counts as participating.
struct KinematicCapacity {
  double multiplier = 0.0;                         ///< alpha_0
  double weight = 0.0;                             ///< N, sum of P_i
  double mass = 0.0;                               ///< kg, M*
  double mass_fraction = 0.0;                      ///< e*
  double acceleration = 0.0;                       ///< m/s^2, a0*
  double displacement_ratio = 0.0;                 ///< d* / d_k
  std::optional<double> zero = {};                 ///< m, d_k of the multiplier zero
  std::optional<double> ultimate = {};             ///< m, d_u*
  std::optional<double> secant = {};               ///< m, d_s*
  std::optional<double> secant_acceleration = {};  ///< m/s^2, a*(d_s*)
  std::optional<double> secant_period = {};        ///< s, T_s
};

/// Comparison with a spectrum. Verdicts at a height are those of a mechanism in a building.
struct KinematicDemand {
  std::optional<KinematicVerdict> linear = {}, linear_above = {};        ///< m/s^2
  std::optional<KinematicVerdict> nonlinear = {}, nonlinear_above = {};  ///< m
  double ground_acceleration = 0.0;                                      ///< m/s^2, Se(0)
  double building_period = 0.0, mode = 0.0, participation = 0.0;  ///< s, T1; psi; gamma; 0: on the ground
};

struct KinematicCheck {
  double confidence_factor = 1.0;  ///< FC
  double behaviour_factor = 1.0;   ///< q
  KinematicCapacity capacity;
  std::optional<KinematicDemand> demand = {};  ///< empty: the scene has no spectrum
};

/// Shares of the displacement of the multiplier zero at which (6) and (7) need it: 0.4 * 0.4 and 0.4.
[[nodiscard]] std::vector<double> shares_of_check();

/// @param path of forces in proportion to mass. @param gravity m/s^2, > 0. @return empty without a mechanism
[[nodiscard]] std::optional<KinematicCheck> kinematic_check(const Pushover& path, const ScenePushover& asked,
                                                            const SceneSpectrum& spectrum, double gravity);

/// "satisfied", "not satisfied" by the non-linear check, or by the linear one where that is not known; "no demand"
[[nodiscard]] std::string verdict_of(const KinematicCheck& check);

/// All numbers as a table: quantity, symbol, value, unit, equation above.
[[nodiscard]] std::string kinematic_table(const KinematicCheck& check);

}  // namespace ashlar
