// Force of a contact point at the end of a step as a function of its place: the part of the law of joint_law.hpp that
// every guess of a step needs. point_response() adds derivatives, energies and dissipation.
//
// The functions take any law with the members of PointLaw. One without `dilation`, `dashpots`, `yields`, `crushing`,
// `roughness` or `normal_spring` has none of these, and takes no time for them.
#pragma once

#include <Eigen/Dense>
#include <algorithm>

#include "mechanics/contact/laws/joint_law.hpp"
#include "mechanics/contact/laws/sliding_point.hpp"

namespace ashlar {

/// The frequent law: a PointLaw with springs, friction, strength that is lost at once, and multipliers. Members as
/// there.
struct FrequentLaw {
  explicit FrequentLaw(const PointLaw& law)
      : normal_stiffness(law.normal_stiffness),
        shear_stiffness(law.shear_stiffness),
        friction(law.friction),
        cohesion(law.cohesion),
        tension(law.tension),
        rounding(law.rounding),
        held_limit(law.held_limit),
        normal_multiplier(law.normal_multiplier),
        shear_multiplier(law.shear_multiplier),
        impulse_force(law.impulse_force),
        bridged(law.bridged) {}

  double normal_stiffness;
  double shear_stiffness;
  double friction;
  double cohesion;
  double tension;
  double rounding;
  double held_limit;
  double normal_multiplier;
  Eigen::Vector2d shear_multiplier;
  double impulse_force;
  bool bridged;
};

/// True if FrequentLaw has all that acts at the point.
[[nodiscard]] inline bool is_frequent(const PointLaw& law) {
  return law.dilation.tangent == 0.0 && law.dashpots.normal == 0.0 && law.dashpots.shear == 0.0 &&
         !law.bond.softens() && !law.yields() && !law.crushes() && !law.roughness.given() &&
         !law.normal_spring().stiffens();
}

/// tan(psi) over a step and its decrease with the gap at its end.
struct StepDilation {
  double tangent = 0.0;
  double fall = 0.0;  ///< 1/m

  /// Derivative of the dilated gap by the gap, for a point with this slip.
  [[nodiscard]] double lever(double slip) const { return 1.0 + slip * fall; }
};

/// @param gap at the end of the step, without dilation
template <class Law>
[[nodiscard]] StepDilation step_dilation(const Law& law, double gap) {
  if constexpr (requires { law.dilation; }) {
    const auto& [tangent, landing_from] = law.dilation;
    if (!(landing_from > 0.0)) return {tangent, 0.0};
    if (!(gap < 0.0)) return {};
    const double travel = landing_from - gap;
    return {tangent * -gap / travel, tangent * landing_from / (travel * travel)};
  }
  return {};
}

/// Stiffness of a point's springs with their dashpots, N/m.
template <class Law>
[[nodiscard]] double normal_resistance(const Law& law) {
  if constexpr (requires { law.dashpots; }) return law.normal_stiffness + law.dashpots.normal;
  return law.normal_stiffness;
}
template <class Law>
[[nodiscard]] double shear_resistance(const Law& law) {
  if constexpr (requires { law.dashpots; }) return law.shear_stiffness + law.dashpots.shear;
  return law.shear_stiffness;
}

/// Gap for a dashpot: without a bond it acts below the surface only.
template <class Law>
[[nodiscard]] double damped_gap(const Law& law, double gap) {
  return law.tension > 0.0 ? gap : std::min(gap, 0.0);
}

/// The normal force at a gap without slip, N; may be negative beyond the tensile strength.
template <class Law>
[[nodiscard]] double normal_at(const Law& law, double gap) {
  double normal = law.normal_multiplier - normal_resistance(law) * gap;
  if constexpr (requires { law.normal_spring(); }) {
    if (const NormalSpring spring = law.normal_spring(); spring.stiffens())
      normal = spring.force(-gap) - law.dashpots.normal * gap;
  }
  if constexpr (requires { law.dashpots; }) {
    if (law.dashpots.normal > 0.0)
      return normal + law.dashpots.normal * damped_gap(law, law.dashpots.start_gap);
  }
  return normal;
}

/// -d normal_at / d gap, N/m.
template <class Law>
[[nodiscard]] double normal_slope(const Law& law, double gap) {
  if constexpr (requires { law.normal_spring(); }) {
    if (const NormalSpring spring = law.normal_spring(); spring.stiffens())
      return spring.slope(-gap) + law.dashpots.normal;
  }
  return normal_resistance(law);
}

/// The largest that it is at any gap, N/m.
[[nodiscard]] inline double steepest_normal_slope(const PointLaw& law) {
  return normal_slope(law, -law.largest_closure);
}

/// The normal force of a point that has dilated. @param normal normal_at(law, gap). @param tangent tan(psi)
/// @param slip m
template <class Law>
[[nodiscard]] double dilated_normal(const Law& law, double normal, double gap, double tangent, double slip) {
  if (law.normal_spring().stiffens()) return normal_at(law, gap - tangent * slip);
  return normal + normal_resistance(law) * tangent * slip;
}

/// The shear force of a point that does not slide, N. @param slip m
template <class Law>
[[nodiscard]] Eigen::Vector2d shear_at(const Law& law, const Eigen::Vector2d& slip) {
  Eigen::Vector2d trial = law.shear_multiplier - shear_resistance(law) * slip;
  if constexpr (requires { law.dashpots; }) {
    if (law.dashpots.shear > 0.0) trial += law.dashpots.shear * law.dashpots.start_slip;
  }
  return trial;
}

/// Normal force in the friction law and its derivative by the normal force. Impulses count at most as much as the
/// normal force, so that points with very small forces have no friction.
struct RubbingForce {
  double value;  ///< N
  double slope;
};
template <class Law>
[[nodiscard]] RubbingForce rubbing_force(const Law& law, double normal) {
  const double pushing = std::max(normal, 0.0);
  if (law.impulse_force > pushing) return {2.0 * pushing, 2.0};
  if (law.impulse_force < -pushing) return {0.0, 0.0};
  return {pushing + law.impulse_force, 1.0};
}

/// Friction under a normal force. @param normal N, >= 0
template <class Law>
[[nodiscard]] ShearBound friction_under(const Law& law, double normal) {
  if constexpr (requires { law.roughness; }) {
    if (law.roughness.given()) return rough_bound(law.roughness, normal);
  }
  return {law.friction * normal, law.friction};
}

/// @param normal force, N. @param dilation tan(psi) in the step
template <class Law>
[[nodiscard]] ShearBound shear_bound(const Law& law, double normal, double dilation) {
  const bool pushes = normal >= 0.0;
  if (law.held_limit >= 0.0)
    return {law.held_limit + dilation * std::max(normal, 0.0), pushes ? dilation : 0.0};
  const RubbingForce rubbing = rubbing_force(law, normal);
  const ShearBound friction = friction_under(law, rubbing.value);
  return {friction.value + law.cohesion, pushes ? rubbing.slope * friction.slope : 0.0};
}

/// Shear force of a state that PointLaw::held_limit replaces, N: MeanResponse::limit at the end of a step.
/// @param normal force, N. @param dilation tan(psi) in the step
template <class Law>
[[nodiscard]] double limit_at(const Law& law, ContactState state, double normal, double dilation) {
  if (state == ContactState::open) return 0.0;
  if (law.held_limit >= 0.0) return law.held_limit;
  const double limit = shear_bound(law, normal, dilation).value;
  return dilation > 0.0 ? std::max(0.0, limit - dilation * std::max(normal, 0.0)) : limit;
}

/// True if a trial shear force is within the limit but for rounding. Without friction no point is locked.
template <class Law>
[[nodiscard]] bool is_locked(const Law& law, double trial, double limit) {
  bool smooth = law.friction == 0.0 && law.cohesion == 0.0;
  if constexpr (requires { law.roughness; }) smooth = smooth && !law.roughness.given();
  if (law.held_limit >= 0.0) {
    smooth = law.held_limit == 0.0;
    if constexpr (requires { law.dilation; }) smooth = smooth && law.dilation.tangent == 0.0;
  }
  return trial <= (smooth ? limit : limit + shear_resistance(law) * law.rounding);
}

/// Reduces a trial shear force to the limit. @param length of the trial
[[nodiscard]] inline Eigen::Vector2d within(double limit, const Eigen::Vector2d& trial, double length) {
  return length > limit ? Eigen::Vector2d(limit / length * trial) : trial;
}

/// A point at a place: its force, and the values that its derivatives and energies follow from.
struct PointForce {
  ContactState state = ContactState::open;
  bool parted = true;      ///< normal spring open; a bridged point transmits shear then
  double normal = 0.0;     ///< without the bound of tension, N
  double closure = 0.0;    ///< of a point that crushes, m
  double stiffness = 0.0;  ///< -d normal / d gap without slip, N/m
  Eigen::Vector2d trial;   ///< shear force as if locked, N
  double length = 0.0;     ///< of `trial`
  double bound = 0.0;      ///< of the shear force, N
  StepDilation dilation = {};
  double slid = 0.0;                                ///< slip of a point that dilates, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N, in the frame (n, t1, t2)
};

/// @param law without gradual damage. @param gap m. @param slip trial slip, m, as if locked
template <class Law>
[[nodiscard]] PointForce point_force(const Law& law, double gap, const Eigen::Vector2d& slip) {
  PointForce at;
  at.normal = normal_at(law, gap);
  if constexpr (requires { law.crushing; }) {
    if (at.normal > law.crushing) {
      at.closure = (at.normal - law.crushing) / law.normal_stiffness;
      at.normal = law.crushing;
    }
  }
  at.trial = shear_at(law, slip);
  at.length = at.trial.norm();
  at.dilation = step_dilation(law, gap);
  const bool locked = is_locked(law, at.length, shear_bound(law, at.normal, at.dilation.tangent).value);
  bool yields = false;
  if constexpr (requires { law.yields(); }) yields = law.yields();
  if constexpr (requires { law.dilation; }) {
    const double resistance = shear_resistance(law);
    if (!locked && at.dilation.tangent > 0.0 && resistance > 0.0) {
      const double tangent = at.dilation.tangent, undilated = at.normal;
      at.slid = plastic_slip(at.length, resistance, [&](double travel) {
        const ShearBound bound =
            shear_bound(law, dilated_normal(law, undilated, gap, tangent, travel), tangent);
        return ShearBound{bound.value, bound.slope * (normal_slope(law, gap - tangent * travel) * tangent)};
      });
      at.normal = dilated_normal(law, undilated, gap, tangent, at.slid);
    }
  }
  at.stiffness = normal_slope(law, gap - at.dilation.tangent * at.slid);
  at.parted = !yields && at.normal < -(law.tension + normal_resistance(law) * law.rounding);
  if (!at.parted) at.force[0] = std::max(at.normal, -law.tension);
  if (at.parted && law.held_limit <= 0.0 && !law.bridged) return at;
  at.bound = shear_bound(law, at.normal, at.dilation.tangent).value;
  at.state = locked ? ContactState::locked : ContactState::sliding;
  at.force.tail<2>() = locked ? within(at.bound, at.trial, at.length)
                              : Eigen::Vector2d(at.bound * Eigen::Vector2d(at.trial / at.length));
  return at;
}

/// Derivatives of the force by the place.
struct PointDerivative {
  Eigen::Matrix3d tangent = Eigen::Matrix3d::Zero();  ///< as PointResponse::tangent
  Coupling coupling = {};                             ///< part of the Jacobian missing from the tangent
};

/// @param at point_force() of the law
template <class Law>
[[nodiscard]] PointDerivative point_derivative(const Law& law, const PointForce& at) {
  PointDerivative result;
  bool yields = false;
  if constexpr (requires { law.yields(); }) yields = law.yields() && at.normal < -law.tension;
  if (!at.parted) result.tangent(0, 0) = yields || at.closure > 0.0 ? 0.0 : at.stiffness;
  if (at.state == ContactState::open) return result;
  const double resistance = shear_resistance(law);
  if (at.state == ContactState::locked) {
    result.tangent.template bottomRightCorner<2, 2>().diagonal().setConstant(resistance);
    return result;
  }
  // A closed point without force has friction once it is compressed.
  const double bound_slope = at.parted ? 0.0 : shear_bound(law, at.force[0], at.dilation.tangent).slope;
  const double lever = at.dilation.lever(at.slid);
  const double slope = result.tangent(0, 0) * lever;
  const Coupling coupling = tangent_of({slope, bound_slope * slope, resistance, at.dilation.tangent / lever,
                                        at.bound / at.length, at.trial / at.length},
                                       result.tangent);
  if (law.held_limit < 0.0) result.coupling = coupling;
  return result;
}

}  // namespace ashlar
