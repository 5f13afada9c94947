#include "mechanics/contact/laws/joint_law.hpp"

#include <algorithm>
#include <utility>

#include "mechanics/contact/laws/crushed_point.hpp"
#include "mechanics/contact/laws/point_force.hpp"
#include "mechanics/contact/laws/sliding_point.hpp"
#include "mechanics/contact/laws/softened_point.hpp"

namespace ashlar {

void PointLaw::set_damage(double damage) {
  if (!bond.softens()) return;
  bond.start = damage;
  tension = bond.tension * (1.0 - damage);
  cohesion = bond.cohesion * (1.0 - damage);
}

double PointLaw::shear_strength(double normal) const {
  return friction_under(*this, std::max(normal, 0.0)).value + cohesion;
}

double PointLaw::friction_at(double normal) const {
  return roughness.given() && normal > 0.0 ? friction_under(*this, normal).value / normal : friction;
}

PointLaw point_law(const JointLaw& law, double area, bool intact, double damage) {
  const double scale = law.area_springs ? area : 1.0;
  const ResidualStrength residual = law.residual.value_or(ResidualStrength{law.friction, 0.0, 0.0});
  PointLaw point{law.normal_stiffness * scale, law.shear_stiffness * scale, law.friction,
                 law.cohesion * area,          law.tensile_strength * area, law.rounding};
  point.residual = {residual.friction, residual.cohesion * area, residual.tensile_strength * area};
  point.dilation.tangent = law.dilation;
  if (law.crushes() && area > 0.0) point.crushing = law.compressive_strength * area;
  point.roughness = point_roughness(law.roughness, area, damage);
  point.largest_closure = law.largest_closure;
  if (law.fracture.given()) point.bond = bond_of(law, area);
  if (point.bond.softens()) point.set_damage(damage);
  if (!intact) point.fail();
  return point;
}

JointLaw failed_law(JointLaw law) {
  const PointLaw failed = point_law(law, 1.0, false);
  law.friction = failed.friction;
  law.cohesion = failed.cohesion;
  law.tensile_strength = failed.tension;
  law.residual = ResidualStrength{law.friction, law.cohesion, law.tensile_strength};
  law.fracture = {};
  if (law.roughness.wears()) law.roughness = {};
  return law;
}

void set_mean_friction(JointLaw& law, double friction) {
  law.friction = friction;
  if (law.residual && !law.roughness.wears()) law.residual->friction = friction;
}

double friction_of_part(const JointLaw& law, double area, double normal) {
  return friction_under(point_law(law, area, true), normal).value;
}

double least_friction(const JointLaw& law, double normal) {
  return law.roughness.share * (law.roughness.worn * normal);
}

namespace {

/// Energy dissipated by the normal dashpot over a step, J, for a spring with force `spring` at its end. The spring
/// may replace the compressive force of the dashpot up to its own: all of it if blocks separate below the surface.
double taken_by_normal(const PointLaw& law, double spring, double force, double gap) {
  return law.dashpots.normal > 0.0 ? (spring - force) * (gap - law.dashpots.start_gap) : 0.0;
}

}  // namespace

double trial_normal(const PointLaw& law, double gap) {
  return normal_at(law, gap);
}

namespace {

/// Sets energies of the normal spring and its dashpot at the end of a step. @param gap over the rest gap
void set_normal_energy(const PointLaw& law, double gap, const PointForce& at, PointResponse& response) {
  const bool damps = law.dashpots.normal > 0.0;
  const bool strained = damps ? gap < 0.0 || (law.tension > 0.0 && !at.parted) : response.force[0] != 0.0;
  if (law.augmented || !strained) return;
  // The potential of a force that yields goes on linearly.
  const bool yields = law.yields() && at.normal < -law.tension;
  const double elastic = yields ? law.tension / law.normal_stiffness : gap;
  const NormalSpring spring = law.normal_spring();
  response.normal_energy = spring.energy(-elastic) + (yields ? law.tension * (gap - elastic) : 0.0);
  if (damps) response.damped += taken_by_normal(law, spring.force(-gap), response.force[0], gap);
}

/// Sets energies of the shear spring and its dashpot at the end of a step. @param slip elastic, m
void set_shear_energy(const PointLaw& law, const Eigen::Vector2d& slip, PointResponse& response) {
  if (law.augmented) return;
  response.shear_energy = 0.5 * law.shear_stiffness * slip.squaredNorm();
  if (law.dashpots.shear == 0.0) return;
  response.shear_damped = -law.dashpots.shear * (slip - law.dashpots.start_slip);
  response.damped += law.dashpots.shear * (slip - law.dashpots.start_slip).squaredNorm();
}

}  // namespace

PointResponse point_response(const PointLaw& law, double gap, const Eigen::Vector2d& slip) {
  if (law.bond.softens()) return softened_response(law, gap, slip);
  const PointForce at = point_force(law, gap, slip);
  const PointDerivative derivative = point_derivative(law, at);
  PointResponse response{at.state, at.force, derivative.tangent, 0.0, 0.0};
  response.coupling = derivative.coupling;
  if (!at.parted) response.dilation = at.dilation.tangent * at.slid - at.closure;
  if (at.closure > 0.0) response.fractured = law.crushing * at.closure;
  set_normal_energy(law, gap - response.dilation, at, response);
  if (at.state == ContactState::locked) set_shear_energy(law, slip, response);
  if (at.state != ContactState::sliding) return response;
  response.direction = at.trial / at.length;
  if (law.roughness.given() && law.shear_stiffness > 0.0)
    response.slid = (at.length - at.bound) / shear_resistance(law);
  if (law.shear_stiffness > 0.0)
    set_shear_energy(
        law,
        (law.dashpots.shear * law.dashpots.start_slip - response.force.tail<2>()) / shear_resistance(law),
        response);
  return response;
}

double damage_after(const PointLaw& start, const PointLaw& end, const PointResponse& response,
                    double before) {
  if (start.bond.softens()) return end.bond.softens() ? response.damage : 1.0;
  return start.roughness.wears() ? wear_after(start.roughness, before, response.slid) : 0.0;
}

MeanResponse end_response(const PointLaw& law, const PointResponse& end, double gap) {
  const double limit = law.bond.softens()
                           ? softened_limit(law, end)
                           : limit_at(law, end.state, end.force[0], step_dilation(law, gap).tangent);
  return {end.force, end.tangent, end.coupling, limit};
}

namespace {

/// Gap for a spring without tension: zero within rounding error.
double seen_gap(const PointLaw& law, const PointResponse& response, double gap) {
  return law.tension > 0.0 || response.state == ContactState::open ? gap : std::min(0.0, gap);
}

/// Sets the mean normal force and its tangent. @param start,end responses with the normal forces
void set_mean_normal(const PointLaw& law, const PointResponse& start, double start_gap,
                     const PointResponse& end, double end_gap, MeanResponse& mean) {
  mean.force[0] = 0.5 * (start.force[0] + end.force[0]);
  mean.tangent(0, 0) = 0.5 * end.tangent(0, 0);
  const bool start_open = start.state == ContactState::open;
  const bool end_open = end.state == ContactState::open;
  if (start_open == end_open || (law.tension > 0.0 && start_open)) return;
  // E(g) = kn <-g>^2 / 2; the force is -(E1 - E0)/(g1 - g0). The gaps differ since their signs do.
  const double difference = end_gap - start_gap;
  if (law.tension > 0.0) {
    // A bond parts at the gap T A/kn, and what its spring holds there is lost.
    const double parting = law.tension / law.normal_stiffness;
    mean.force[0] = 0.5 * law.normal_stiffness * (start_gap * start_gap - parting * parting) / difference;
    mean.tangent(0, 0) = mean.force[0] / difference;
  } else if (start_open) {
    mean.force[0] = -0.5 * law.normal_stiffness * end_gap * end_gap / difference;
    mean.tangent(0, 0) =
        law.normal_stiffness * end_gap * (0.5 * end_gap - start_gap) / (difference * difference);
  } else {
    mean.force[0] = 0.5 * law.normal_stiffness * start_gap * start_gap / difference;
    mean.tangent(0, 0) = mean.force[0] / difference;
  }
}

void set_mean_compression(const PointLaw& law, double start_gap, double end_gap, MeanResponse& mean) {
  const MeanCompression compression = law.normal_spring().mean_compression(-start_gap, -end_gap);
  mean.force[0] = compression.force;
  mean.tangent(0, 0) = compression.slope;
}

/// Share of a step in which a point is closed, its gap linear in time, and the derivative by the end gap.
struct ClosedShare {
  double value;
  double by_end_gap;
};

/// Bonds are closed until they fail, bridged points until they have opened.
ClosedShare closed_share(const PointLaw& law, bool start_open, double start_gap, bool end_open,
                         double end_gap) {
  if (law.bridged) return {1.0, 0.0};
  if (start_open && end_open) return {0.0, 0.0};
  if (start_open == end_open || law.tension > 0.0) return {1.0, 0.0};
  const double difference = end_gap - start_gap;
  return end_open ? ClosedShare{-start_gap / difference, start_gap / (difference * difference)}
                  : ClosedShare{end_gap / difference, -start_gap / (difference * difference)};
}

/// Normal force over a step with a given gap at its end, and the bound of the shear force.
struct MeanNormal {
  PointResponse end;           ///< of the spring
  double undamped = 0.0;       ///< N, without the dashpot
  double force = 0.0;          ///< N
  double slope = 0.0;          ///< -d force / d gap, N/m
  ShearBound bound{0.0, 0.0};  ///< slope: -d limit / d gap, N/m
  double limit = 0.0;          ///< of Coulomb's law, N
};

/// @param start_gap,end_gap over the rest gap at each time, m
/// @param dilation tan(psi) over the step
MeanNormal mean_normal(const PointLaw& law, const PointResponse& start, double start_gap, double end_gap,
                       double dilation) {
  PointLaw spring = law;
  spring.held_limit = -1.0;
  spring.bridged = false;
  spring.dilation = {};
  spring.dashpots = {};
  const double closure = std::min(start.dilation, 0.0);
  MeanNormal result{point_response(spring, end_gap - closure, Eigen::Vector2d::Zero())};
  const double seen_start = seen_gap(law, start, start_gap - closure);
  const double seen_end = seen_gap(law, result.end, end_gap - closure - result.end.dilation);
  const bool parts = law.tension > 0.0 && result.end.state == ContactState::open;
  const bool crushes = !parts && (closure < 0.0 || result.end.dilation < 0.0);
  MeanResponse mean{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), {}, 0.0};
  if (crushes)
    set_mean_crushing(law, start_gap - closure, end_gap - closure, mean);
  else if (law.normal_spring().stiffens())
    set_mean_compression(law, start_gap, end_gap, mean);
  else
    set_mean_normal(law, start, seen_start, result.end, seen_end, mean);
  result.end.dilation += closure;
  if (closure < 0.0) result.end.fractured += start.fractured;
  result.force = result.undamped = mean.force[0];
  result.slope = mean.tangent(0, 0);
  const bool end_open = result.end.state == ContactState::open;
  if (law.dashpots.normal > 0.0 && !(law.tension > 0.0 && end_open)) {
    result.force -= law.dashpots.normal * (damped_gap(law, end_gap) - damped_gap(law, start_gap));
    if (!end_open) result.slope += law.dashpots.normal;
    if (law.tension == 0.0 && result.force < 0.0) result.force = result.slope = 0.0;
  }
  const bool start_open = start.state == ContactState::open;
  const ClosedShare closed = closed_share(law, start_open, seen_start, end_open, seen_end);
  const double pushing = std::max(result.force, 0.0);
  const double by_force = result.force >= 0.0 ? result.slope : 0.0;
  const ShearBound friction = friction_under(law, pushing);
  result.limit = friction.value + closed.value * law.cohesion;
  result.bound = law.held_limit >= 0.0
                     ? ShearBound{law.held_limit + dilation * pushing, dilation * by_force}
                     : ShearBound{result.limit, friction.slope * by_force - law.cohesion * closed.by_end_gap};
  if (law.held_limit < 0.0) result.limit = std::max(0.0, result.limit - dilation * pushing);
  return result;
}

/// Computes slip and normal force of a point that dilates. @param trial shear force, N
/// @param stiffness in shear, N/m. @param normal_at of slip, m. @return slip, m
template <class NormalAt>
double lift(double trial, double stiffness, double dilation, NormalAt normal_at, MeanNormal& normal) {
  const double slip = plastic_slip(trial, stiffness, [&](double shift) {
    const ShearBound bound = normal_at(shift).bound;
    return ShearBound{bound.value, bound.slope * dilation};
  });
  MeanNormal risen = normal_at(slip);
  // Without compression there is no dilation.
  if (!(risen.force > 0.0) && risen.end.state == ContactState::open) return 0.0;
  normal = std::move(risen);
  return slip;
}

}  // namespace

AveragedStep averaged_step(const PointLaw& law, const PointResponse& start,
                           const Eigen::Vector3d& start_place, const Eigen::Vector3d& end_place) {
  if (law.bond.softens()) return softened_step(law, start, start_place, end_place);
  if (law.augmented) {
    const PointResponse end = point_response(law, end_place[0], end_place.tail<2>());
    return {end, end_response(law, end, end_place[0])};
  }
  Eigen::Vector2d start_slip = start_place.tail<2>();
  if (start.state == ContactState::sliding) start_slip = elastic_slip(law, start, start_slip);
  const Eigen::Vector2d shift = end_place.tail<2>() - start_place.tail<2>();
  const double stiffness = 0.5 * law.shear_stiffness + law.dashpots.shear;
  Eigen::Vector2d trial = -law.shear_stiffness * (start_slip + 0.5 * shift);
  if (law.dashpots.shear > 0.0) trial -= law.dashpots.shear * shift;
  const double length = trial.norm();
  const StepDilation dilation = step_dilation(law, end_place[0]);
  const auto normal_at = [&](double slip) {
    return mean_normal(law, start, start_place[0], end_place[0] - dilation.tangent * slip, dilation.tangent);
  };
  MeanNormal normal = normal_at(0.0);
  const bool locked = is_locked(law, length, normal.bound.value);
  const bool rises = !locked && dilation.tangent > 0.0 && stiffness > 0.0;
  const double slid = rises ? lift(length, stiffness, dilation.tangent, normal_at, normal) : 0.0;
  AveragedStep step{normal.end, {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), {}, normal.limit}};
  PointResponse& end = step.end;
  MeanResponse& mean = step.mean;
  mean.force[0] = normal.force;
  mean.tangent(0, 0) = normal.slope;
  if (slid > 0.0) end.dilation = dilation.tangent * slid;
  const double end_gap = end_place[0] - end.dilation;
  if (law.dashpots.normal > 0.0) end.damped = (normal.undamped - normal.force) * (end_gap - start_place[0]);
  const bool end_open = end.state == ContactState::open;
  const double limit = normal.bound.value;
  if (limit <= 0.0 && end_open) return step;
  Eigen::Vector2d end_slip = start_slip + shift;
  if (locked) {
    mean.force.tail<2>() = within(limit, trial, length);
    mean.tangent.bottomRightCorner<2, 2>().diagonal().setConstant(stiffness);
  } else {
    const Eigen::Vector2d direction = trial / length;
    mean.force.tail<2>() = limit * direction;
    if (law.roughness.given() && stiffness > 0.0) end.slid = (length - limit) / stiffness;
    const double lever = dilation.lever(slid);
    mean.coupling = tangent_of({normal.slope * lever, normal.bound.slope * lever, stiffness,
                                dilation.tangent / lever, limit / length, direction},
                               mean.tangent);
    if (law.held_limit >= 0.0) mean.coupling = {};
    const double both = law.shear_stiffness + 2.0 * law.dashpots.shear;
    end_slip = -2.0 / both * mean.force.tail<2>() -
               (law.shear_stiffness - 2.0 * law.dashpots.shear) / both * start_slip;
    if (!end_open) end.state = ContactState::sliding;
  }
  if (end_open) return step;
  end.force.tail<2>() = -law.shear_stiffness * end_slip;
  end.shear_energy = 0.5 * law.shear_stiffness * end_slip.squaredNorm();
  if (law.dashpots.shear > 0.0) end.damped += law.dashpots.shear * (end_slip - start_slip).squaredNorm();
  return step;
}

Eigen::Vector2d borne_slip(const PointLaw& law, double normal, const Eigen::Vector2d& slip) {
  const double force = law.shear_stiffness * slip.norm();
  const double limit = shear_bound(law, normal, 0.0).value;
  return force > limit ? Eigen::Vector2d(limit / force * slip) : slip;
}

Eigen::Vector2d elastic_slip(const PointLaw& law, const PointResponse& response,
                             const Eigen::Vector2d& slip) {
  if (law.augmented) return Eigen::Vector2d::Zero();
  switch (response.state) {
    case ContactState::open:
      return Eigen::Vector2d::Zero();
    case ContactState::locked:
      return slip;
    case ContactState::sliding:
      return (response.shear_damped - response.force.tail<2>()) / law.shear_stiffness;
  }
  return slip;
}

}  // namespace ashlar
