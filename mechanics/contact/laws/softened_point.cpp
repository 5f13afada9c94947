#include "mechanics/contact/laws/softened_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ashlar {

BondDamage bond_of(const JointLaw& law, double area) {
  BondDamage bond;
  if (law.fracture.tension > 0.0 && law.tensile_strength > 0.0) {
    bond.tension = law.tensile_strength * area;
    bond.peak = law.tensile_strength / law.normal_stiffness;
    bond.end_opening = 2.0 * law.fracture.tension / law.tensile_strength;
  }
  if (law.fracture.shear > 0.0 && law.cohesion > 0.0) {
    bond.cohesion = law.cohesion * area;
    bond.end_slip = 2.0 * law.fracture.shear / law.cohesion;
  }
  return bond;
}

namespace {

/// Cause of damage of a point in a step.
enum class DamageCause { nothing, opening, slip };

struct DamageState {
  double value;
  DamageCause cause;
};

/// True if a trial shear force is above the limit by more than rounding.
bool slides(const PointLaw& law, double trial, double limit) {
  return trial > limit + law.shear_stiffness * law.rounding;
}

bool is_bonded_in_tension(const PointLaw& law, double damage) {
  return law.bond.tension > 0.0 && damage < 1.0;
}

/// @param normal force under compression, N, >= 0. @param trial shear force, N
DamageState damage_at(const PointLaw& law, double gap, double normal, double trial) {
  const BondDamage& bond = law.bond;
  DamageState damage{bond.at_opening(gap, bond.start), DamageCause::nothing};
  if (damage.value > bond.start) damage.cause = DamageCause::opening;
  if (bond.cohesion == 0.0 || law.held_limit >= 0.0 || bond.start >= 1.0) return damage;
  const double limit = law.friction * normal + bond.cohesion * (1.0 - bond.start);
  if (!slides(law, trial, limit)) return damage;
  const double growth = (trial - limit) / (law.shear_stiffness * bond.end_slip - bond.cohesion);
  const double by_slip = std::min(1.0, bond.start + growth);
  return by_slip > damage.value ? DamageState{by_slip, DamageCause::slip} : damage;
}

/// The normal spring at the end of a step.
struct BondSpring {
  double force;      ///< N, N
  double stiffness;  ///< secant, N/m
  double energy;     ///< J
  bool open;
};

BondSpring bond_spring(const PointLaw& law, double gap, double damage) {
  const bool bonded = is_bonded_in_tension(law, damage);
  if (gap <= 0.0 || bonded) {
    const double stiffness = gap > 0.0 ? law.bond.stiffness(damage) : law.normal_stiffness;
    return {-stiffness * gap, stiffness, 0.5 * stiffness * gap * gap, false};
  }
  const bool open = gap > law.rounding;
  return {0.0, open ? 0.0 : law.normal_stiffness, 0.0, open};
}

double limit_of(const PointLaw& law, double normal, double damage) {
  return law.held_limit >= 0.0 ? law.held_limit
                               : law.friction * std::max(normal, 0.0) + law.bond.cohesion * (1.0 - damage);
}

/// Unsymmetric part of the Jacobian of a point that slides. @param direction of the shear force
Coupling coupling_of_slip(const PointLaw& law, double gap, const DamageState& damage,
                          const Eigen::Vector2d& direction) {
  const BondDamage& bond = law.bond;
  const double by_gap = gap < 0.0 ? law.friction * law.normal_stiffness : 0.0;  // -d f / d g
  Coupling coupling;
  if (damage.cause != DamageCause::slip || damage.value >= 1.0) {
    coupling.force.tail<2>() = by_gap * direction;
    return coupling;
  }
  // d D = (ks d|s| + kn tan(phi) d g)/(ks pf - C); the slip is against the shear force.
  const double rest = law.shear_stiffness * bond.end_slip - bond.cohesion;
  const Eigen::Vector2d by_slip = -law.shear_stiffness / rest * direction;
  if (gap < 0.0) {
    coupling.force.tail<2>() = direction;
    coupling.by << by_gap * law.shear_stiffness * bond.end_slip / rest, bond.cohesion * by_slip;
    return coupling;
  }
  const double width = bond.opening(damage.value);
  coupling.force << -std::max(gap, 0.0) * bond.tension * bond.end_opening / (width * width),
      bond.cohesion * direction;
  coupling.by << 0.0, by_slip;
  return coupling;
}

/// The same of a point that opens. @param direction of the shear force of a sliding point; zero: locked
Coupling coupling_of_opening(const BondDamage& bond, double damage, const Eigen::Vector2d& direction) {
  const double width = bond.end_opening - bond.peak;
  Coupling coupling;
  coupling.force << -bond.tension / width - bond.stiffness(damage), bond.cohesion / width * direction;
  return coupling;
}

/// Energy dissipated by damage over a step beside the work of the limit at its end on the slip, J.
double fractured_at_end(const BondDamage& bond, double gap, const DamageState& damage) {
  const double growth = damage.value - bond.start;
  if (damage.cause == DamageCause::opening) return bond.energy_of_tension(growth);
  if (damage.cause != DamageCause::slip) return 0.0;
  const double in_shear = 0.5 * bond.cohesion * bond.end_slip * growth * growth;
  const double opened = std::max(gap, 0.0);
  return in_shear + 0.5 * (bond.stiffness(bond.start) - bond.stiffness(damage.value)) * opened * opened;
}

}  // namespace

PointResponse softened_response(const PointLaw& law, double gap, const Eigen::Vector2d& slip) {
  PointResponse response{ContactState::open, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), 0.0, 0.0};
  const Eigen::Vector2d trial = -law.shear_stiffness * slip;
  const double length = trial.norm();
  const DamageState damage = damage_at(law, gap, law.normal_stiffness * std::max(-gap, 0.0), length);
  response.damage = damage.value;
  response.fractured = fractured_at_end(law.bond, gap, damage);
  const BondSpring normal = bond_spring(law, gap, damage.value);
  response.force[0] = normal.force;
  response.tangent(0, 0) = normal.stiffness;
  response.normal_energy = normal.energy;
  if (normal.open && law.held_limit <= 0.0 && !law.bridged) return response;
  const bool opens = damage.cause == DamageCause::opening && damage.value < 1.0 && law.held_limit < 0.0;
  const double limit = limit_of(law, normal.force, damage.value);
  const bool smooth =
      law.held_limit >= 0.0 ? law.held_limit == 0.0 : law.friction == 0.0 && law.bond.cohesion == 0.0;
  if (smooth ? length <= limit : !slides(law, length, limit)) {
    response.state = ContactState::locked;
    response.force.tail<2>() = length > limit ? Eigen::Vector2d(limit / length * trial) : trial;
    response.tangent.bottomRightCorner<2, 2>().diagonal().setConstant(law.shear_stiffness);
    response.shear_energy = 0.5 * law.shear_stiffness * slip.squaredNorm();
    if (opens) response.coupling = coupling_of_opening(law.bond, damage.value, Eigen::Vector2d::Zero());
    return response;
  }
  response.state = ContactState::sliding;
  response.direction = trial / length;
  response.force.tail<2>() = limit * response.direction;
  response.tangent.bottomRightCorner<2, 2>() =
      law.shear_stiffness * limit / length *
      (Eigen::Matrix2d::Identity() - response.direction * response.direction.transpose());
  if (law.shear_stiffness > 0.0) response.shear_energy = 0.5 * limit * limit / law.shear_stiffness;
  if (opens)
    response.coupling = coupling_of_opening(law.bond, damage.value, response.direction);
  else if (law.held_limit < 0.0)
    response.coupling = coupling_of_slip(law, gap, damage, response.direction);
  return response;
}

double softened_limit(const PointLaw& law, const PointResponse& end) {
  return end.state == ContactState::open ? 0.0 : limit_of(law, end.force[0], end.damage);
}

namespace {

/// Normal force of loading from a damage, N: along its secant, then on the envelope.
double loading_force(const PointLaw& law, double gap, double damage) {
  const BondDamage& bond = law.bond;
  if (gap <= 0.0) return -law.normal_stiffness * gap;
  return -bond.stiffness(bond.at_opening(gap, damage)) * gap;
}

/// Mean normal force over a step and its slope.
struct SoftenedNormal {
  double force = 0.0;  ///< N
  double slope = 0.0;  ///< -d force / d end gap, N/m; negative on the envelope
};

/// The force is linear between the gaps where it has kinks, so that its mean is that of trapezoids.
SoftenedNormal softened_normal(const PointLaw& law, double start, double end, double damage) {
  const auto [low, high] = std::minmax(start, end);
  const std::array<double, 3> kinks = {0.0, law.bond.opening(damage), law.bond.end_opening};
  double sum = 0.0;
  double last = low;
  for (const double kink : kinks) {
    if (!(kink > last && kink < high)) continue;
    sum += 0.5 * (loading_force(law, last, damage) + loading_force(law, kink, damage)) * (kink - last);
    last = kink;
  }
  const double at_end = loading_force(law, end, damage);
  const bool one_line = last == low;
  if (one_line) {
    const double at_start = loading_force(law, start, damage);
    const double stiffness = end > 0.0 ? law.bond.stiffness(damage) : law.normal_stiffness;
    const bool falls = end > law.bond.opening(damage) && end < law.bond.end_opening;
    const double slope = falls ? -law.bond.tension / (law.bond.end_opening - law.bond.peak) : stiffness;
    return {0.5 * (at_start + at_end), 0.5 * (end < law.bond.end_opening ? slope : 0.0)};
  }
  sum += 0.5 * (loading_force(law, last, damage) + loading_force(law, high, damage)) * (high - last);
  const double mean = sum / (high - low);
  return {mean, (mean - at_end) / (end - start)};
}

/// Derivative of the mean tension of an open bond by its damage, N, with the sign of the force on a.
double tension_by_damage(const BondDamage& bond, double start, double end, double damage) {
  if (bond.tension == 0.0 || !(std::min(start, end) >= 0.0)) return 0.0;
  const double width = bond.opening(damage);
  return -0.5 * (start + end) * bond.tension * bond.end_opening / (width * width);
}

/// Share of a step in which cohesion acts: while a point without tensile strength is closed, its gap linear in time.
double cohesive_share(const PointLaw& law, double start, double end) {
  if (law.bond.tension > 0.0 || law.bridged) return 1.0;
  const double below = std::max(-start, 0.0), below_after = std::max(-end, 0.0);
  if (start <= law.rounding && end <= law.rounding) return 1.0;
  return below + below_after > 0.0 ? (below + below_after) / std::abs(end - start) : 0.0;
}

/// Bound of the mean shear force and its derivatives.
struct MeanLimit {
  double value;          ///< N
  double growth;         ///< of damage
  double by_trial;       ///< d value / d trial force
  double by_resistance;  ///< d value / d resistance by friction
  double by_damage;      ///< -d growth / d value, along a change of the trial force
};

/// @param trial shear force, N. @param friction resistance by it, N. @param cohesion C times its share of the step, N
MeanLimit mean_limit(const PointLaw& law, double trial, double friction, double cohesion) {
  const double left = 1.0 - law.bond.start;
  const double intact = friction + cohesion * left;
  if (cohesion == 0.0 || !slides(law, trial, intact)) return {intact, 0.0, 0.0, 1.0, 0.0};
  const double width = law.shear_stiffness * law.bond.end_slip;  // ks pf
  const double growth = 2.0 * (trial - intact) / (width - cohesion);
  if (growth < left)
    return {intact - 0.5 * cohesion * growth, growth, -cohesion / (width - cohesion),
            width / (width - cohesion), 2.0 / cohesion};
  // All cohesion is lost on the way: its work W acts over the whole slip p,  trial - ks p/2 = friction + W/p.
  const double work = 0.5 * cohesion * left * left * law.bond.end_slip;
  const double beyond = trial - friction;
  const double slip =
      (beyond + std::sqrt(std::max(0.0, beyond * beyond - 2.0 * law.shear_stiffness * work))) /
      law.shear_stiffness;
  const double fall = 2.0 * work / (slip * slip * law.shear_stiffness);
  return {friction + work / slip, left, -fall / (1.0 - fall), 1.0 / (1.0 - fall), 0.0};
}

/// Mean normal force over a step, and the bound of the mean shear force that follows from it.
struct MeanBounds {
  SoftenedNormal normal;
  MeanLimit limit;
  double damage;  ///< with that by the slip of the step, without that by its opening
};

/// @param start gap, m. @param end gap, m. @param trial shear force, N
MeanBounds mean_bounds(const PointLaw& law, double start, double end, double trial) {
  MeanBounds mean{
      softened_normal(law, start, end, law.bond.start), {law.held_limit, 0.0, 0.0, 0.0, 0.0}, 0.0};
  const double resistance = law.friction * std::max(mean.normal.force, 0.0);
  const double cohesion = law.bond.cohesion * cohesive_share(law, start, end);
  if (law.held_limit < 0.0) mean.limit = mean_limit(law, trial, resistance, cohesion);
  mean.damage = law.bond.start + mean.limit.growth;
  if (mean.limit.growth > 0.0) mean.normal = softened_normal(law, start, end, mean.damage);
  return mean;
}

/// Sets damage and normal spring at the end of a step. @param start gap, m. @param gap at the end, m
/// @param damage that of MeanBounds
BondSpring set_end_normal(const PointLaw& law, double start, double gap, double damage, PointResponse& end) {
  const BondDamage& bond = law.bond;
  end.damage = bond.at_opening(gap, damage);
  const double opened = std::max(start, 0.0);
  end.fractured = 0.5 * (bond.stiffness(bond.start) - bond.stiffness(damage)) * opened * opened +
                  bond.energy_of_tension(end.damage - damage);
  const BondSpring spring = bond_spring(law, gap, end.damage);
  end.force[0] = spring.force;
  end.tangent(0, 0) = spring.stiffness;
  end.normal_energy = spring.energy;
  return spring;
}

/// Sets the mean normal force. A fall of tension is in the coupling: the tangent is positive semi-definite.
/// @param stiffness of the spring at the end, N/m
void set_mean_normal(const PointLaw& law, const SoftenedNormal& normal, double stiffness,
                     MeanResponse& mean) {
  mean.force[0] = normal.force;
  mean.tangent(0, 0) = normal.slope < 0.0 ? 0.5 * stiffness : normal.slope;
  if (law.held_limit < 0.0) mean.coupling.force[0] = normal.slope - mean.tangent(0, 0);
}

/// Sets the mean shear force of a point that slides, its normal force being set. @param trial shear force, N
/// @param start gap, m. @param end gap, m
void set_mean_sliding(const PointLaw& law, const MeanBounds& bounds, const Eigen::Vector2d& trial,
                      double start, double end, MeanResponse& mean) {
  const auto& [normal, limit, damage] = bounds;
  const double stiffness = 0.5 * law.shear_stiffness;
  const double length = trial.norm();
  const Eigen::Vector2d direction = trial / length;
  mean.force.tail<2>() = limit.value * direction;
  mean.tangent.bottomRightCorner<2, 2>() =
      stiffness * limit.value / length * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  // Of a point that opens and slides, the fall of tension alone: a Jacobian that is not exact costs iterations only.
  if (law.held_limit < 0.0 && normal.slope - mean.tangent(0, 0) == 0.0) {
    mean.coupling.force << limit.by_damage * tension_by_damage(law.bond, start, end, damage), direction;
    mean.coupling.by << (normal.force > 0.0 ? limit.by_resistance * law.friction * normal.slope : 0.0),
        limit.by_trial * stiffness * direction;
  }
}

/// Sets the shear spring at the end of a closed point. A spring that ends beyond its limit there is released to it at
/// once, not at the start of the next step. @param slip elastic, at the end, m
void set_end_shear(const PointLaw& law, Eigen::Vector2d slip, const MeanResponse& mean, PointResponse& end) {
  const double limit = limit_of(law, end.force[0], end.damage) / law.shear_stiffness;
  if (const double length = slip.norm(); law.held_limit < 0.0 && length > limit) {
    const Eigen::Vector2d released = (1.0 - limit / length) * slip;
    slip -= released;
    if (end.state == ContactState::sliding) end.fractured += mean.force.tail<2>().dot(released);
  }
  end.force.tail<2>() = -law.shear_stiffness * slip;
  end.shear_energy = 0.5 * law.shear_stiffness * slip.squaredNorm();
}

}  // namespace

AveragedStep softened_step(const PointLaw& law, const PointResponse& start,
                           const Eigen::Vector3d& start_place, const Eigen::Vector3d& end_place) {
  const double start_gap = start_place[0], end_gap = end_place[0];
  Eigen::Vector2d start_slip = start_place.tail<2>();
  if (start.state == ContactState::sliding) start_slip = elastic_slip(law, start, start_slip);
  const Eigen::Vector2d shift = end_place.tail<2>() - start_place.tail<2>();
  const Eigen::Vector2d trial = -law.shear_stiffness * (start_slip + 0.5 * shift);
  const double length = trial.norm();
  const MeanBounds bounds = mean_bounds(law, start_gap, end_gap, length);
  const double limit = bounds.limit.value;

  AveragedStep step{{ContactState::open, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), 0.0, 0.0},
                    {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), {}, limit}};
  PointResponse& end = step.end;
  MeanResponse& mean = step.mean;
  const BondSpring spring = set_end_normal(law, start_gap, end_gap, bounds.damage, end);
  set_mean_normal(law, bounds.normal, spring.stiffness, mean);
  if (limit <= 0.0 && spring.open) return step;
  if (!spring.open) end.state = ContactState::locked;
  Eigen::Vector2d end_slip = start_slip + shift;
  if (!slides(law, length, limit)) {
    mean.force.tail<2>() = length > limit ? Eigen::Vector2d(limit / length * trial) : trial;
    mean.tangent.bottomRightCorner<2, 2>().diagonal().setConstant(0.5 * law.shear_stiffness);
  } else {
    set_mean_sliding(law, bounds, trial, start_gap, end_gap, mean);
    end_slip = -2.0 / law.shear_stiffness * mean.force.tail<2>() - start_slip;
    if (!spring.open) end.state = ContactState::sliding;
  }
  if (!spring.open) set_end_shear(law, end_slip, mean, end);
  return step;
}

}  // namespace ashlar
