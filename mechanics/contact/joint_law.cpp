#include "mechanics/contact/joint_law.hpp"

#include <algorithm>

namespace ashlar {

PointLaw point_law(const JointLaw& law, double area, bool intact) {
  const double scale = law.area_springs ? area : 1.0;
  const ResidualStrength residual = law.residual.value_or(ResidualStrength{law.friction, 0.0, 0.0});
  PointLaw point{law.normal_stiffness * scale, law.shear_stiffness * scale, law.friction,
                 law.cohesion * area,          law.tensile_strength * area, law.rounding};
  point.residual = {residual.friction, residual.cohesion * area, residual.tensile_strength * area};
  if (!intact) point.fail();
  return point;
}

namespace {

/// The normal force that friction goes by and its derivative by the normal force. Impulses count for no more
/// than the force beside them, so that nothing rubs that hardly touches.
struct RubbingForce {
  double value;  ///< N
  double slope;
};

RubbingForce rubbing_force(const PointLaw& law, double normal) {
  const double pushing = std::max(normal, 0.0);
  if (law.impulse_force > pushing) return {2.0 * pushing, 2.0};
  if (law.impulse_force < -pushing) return {0.0, 0.0};
  return {pushing + law.impulse_force, 1.0};
}

/// What the shear force is at most, N. @param normal force, N
double shear_limit(const PointLaw& law, double normal) {
  return law.held_limit >= 0.0 ? law.held_limit
                               : rubbing_force(law, normal).value * law.friction + law.cohesion;
}

/// Whether a trial shear force is within the limit but for rounding. Nothing locks what has no friction.
bool is_locked(const PointLaw& law, double trial, double limit) {
  const bool smooth =
      law.held_limit >= 0.0 ? law.held_limit == 0.0 : law.friction == 0.0 && law.cohesion == 0.0;
  return trial <= (smooth ? limit : limit + law.shear_stiffness * law.rounding);
}

/// A trial shear force, cut to the limit. @param length of the trial
Eigen::Vector2d within(double limit, const Eigen::Vector2d& trial, double length) {
  return length > limit ? Eigen::Vector2d(limit / length * trial) : trial;
}

}  // namespace

PointResponse point_response(const PointLaw& law, double gap, const Eigen::Vector2d& slip) {
  PointResponse response{ContactState::open, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), 0.0, 0.0};
  const double normal = law.normal_multiplier - law.normal_stiffness * gap;
  const bool open = normal < -(law.tension + law.normal_stiffness * law.rounding);
  if (open && law.held_limit <= 0.0 && !law.bridged) return response;
  if (!open) {
    response.force[0] = std::max(normal, -law.tension);
    response.tangent(0, 0) = law.normal_stiffness;
    if (!law.augmented && response.force[0] != 0.0)
      response.normal_energy = 0.5 * law.normal_stiffness * gap * gap;
  }
  const double limit = shear_limit(law, normal);
  const Eigen::Vector2d trial = law.shear_multiplier - law.shear_stiffness * slip;
  const double length = trial.norm();
  if (is_locked(law, length, limit)) {
    response.state = ContactState::locked;
    response.force.tail<2>() = within(limit, trial, length);
    response.tangent.bottomRightCorner<2, 2>().diagonal().setConstant(law.shear_stiffness);
    if (!law.augmented) response.shear_energy = 0.5 * law.shear_stiffness * slip.squaredNorm();
    return response;
  }
  response.state = ContactState::sliding;
  const Eigen::Vector2d direction = trial / length;
  response.direction = direction;
  response.force.tail<2>() = limit * direction;
  response.tangent.bottomRightCorner<2, 2>() =
      law.shear_stiffness * limit / length *
      (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  if (law.shear_stiffness > 0.0 && !law.augmented)
    response.shear_energy = 0.5 * limit * limit / law.shear_stiffness;
  return response;
}

Eigen::Vector2d sliding_coupling(const PointLaw& law, const PointResponse& response) {
  // Also of a point in touch that has no force yet.
  const bool pushes = response.force[0] >= 0.0 && response.tangent(0, 0) > 0.0;
  if (response.state != ContactState::sliding || !pushes || law.held_limit >= 0.0)
    return Eigen::Vector2d::Zero();
  return rubbing_force(law, response.force[0]).slope * law.friction * law.normal_stiffness *
         response.direction;
}

MeanResponse end_response(const PointLaw& law, const PointResponse& end) {
  const double limit = end.state == ContactState::open ? 0.0 : shear_limit(law, end.force[0]);
  return {end.force, end.tangent, sliding_coupling(law, end), limit};
}

namespace {

/// A gap as a spring without tension sees it: one of rounding is none.
double seen_gap(const PointLaw& law, const PointResponse& response, double gap) {
  return law.tension > 0.0 || response.state == ContactState::open ? gap : std::min(0.0, gap);
}

/// Mean normal force and its tangent. @param start,end responses whose normal forces count
void set_mean_normal(const PointLaw& law, const PointResponse& start, double start_gap,
                     const PointResponse& end, double end_gap, MeanResponse& mean) {
  mean.force[0] = 0.5 * (start.force[0] + end.force[0]);
  mean.tangent(0, 0) = 0.5 * end.tangent(0, 0);
  const bool start_open = start.state == ContactState::open;
  const bool end_open = end.state == ContactState::open;
  if (start_open == end_open || law.tension > 0.0) return;
  // E(g) = kn <-g>^2 / 2; the force is -(E1 - E0)/(g1 - g0). The gaps differ since their signs do.
  const double difference = end_gap - start_gap;
  if (start_open) {
    mean.force[0] = -0.5 * law.normal_stiffness * end_gap * end_gap / difference;
    mean.tangent(0, 0) =
        law.normal_stiffness * end_gap * (0.5 * end_gap - start_gap) / (difference * difference);
  } else {
    mean.force[0] = 0.5 * law.normal_stiffness * start_gap * start_gap / difference;
    mean.tangent(0, 0) = mean.force[0] / difference;
  }
}

/// Share of a step in which a point is closed, its gap linear in time, and the derivative by the end gap.
struct ClosedShare {
  double value;
  double by_end_gap;
};

/// Bonds are closed until they are torn, bridged points until they have opened.
ClosedShare closed_share(const PointLaw& law, bool start_open, double start_gap, bool end_open,
                         double end_gap) {
  if (law.bridged) return {1.0, 0.0};
  if (start_open && end_open) return {0.0, 0.0};
  if (start_open == end_open || law.tension > 0.0) return {1.0, 0.0};
  const double difference = end_gap - start_gap;
  return end_open ? ClosedShare{-start_gap / difference, start_gap / (difference * difference)}
                  : ClosedShare{end_gap / difference, -start_gap / (difference * difference)};
}

}  // namespace

AveragedStep averaged_step(const PointLaw& law, const PointResponse& start,
                           const Eigen::Vector3d& start_place, const Eigen::Vector3d& end_place) {
  if (law.augmented) {
    const PointResponse end = point_response(law, end_place[0], end_place.tail<2>());
    return {end, end_response(law, end)};
  }
  PointLaw normal_only = law;
  normal_only.held_limit = -1.0;
  normal_only.bridged = false;
  AveragedStep step{point_response(normal_only, end_place[0], Eigen::Vector2d::Zero()),
                    {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Vector2d::Zero(), 0.0}};
  PointResponse& end = step.end;
  MeanResponse& mean = step.mean;
  const double start_gap = seen_gap(law, start, start_place[0]);
  const double end_gap = seen_gap(law, end, end_place[0]);
  set_mean_normal(law, start, start_gap, end, end_gap, mean);
  const bool end_open = end.state == ContactState::open;
  const bool start_open = start.state == ContactState::open;
  const ClosedShare closed = closed_share(law, start_open, start_gap, end_open, end_gap);
  mean.limit = std::max(mean.force[0], 0.0) * law.friction + closed.value * law.cohesion;
  const double limit = law.held_limit >= 0.0 ? law.held_limit : mean.limit;
  if (limit <= 0.0 && end_open) return step;
  Eigen::Vector2d start_slip = start_place.tail<2>();
  if (start.state == ContactState::sliding) start_slip = elastic_slip(law, start, start_slip);
  const Eigen::Vector2d way = end_place.tail<2>() - start_place.tail<2>();
  const Eigen::Vector2d trial = -law.shear_stiffness * (start_slip + 0.5 * way);
  const double length = trial.norm();
  Eigen::Vector2d end_slip = start_slip + way;
  auto tangent = mean.tangent.bottomRightCorner<2, 2>();
  if (is_locked(law, length, limit)) {
    mean.force.tail<2>() = within(limit, trial, length);
    tangent.diagonal().setConstant(0.5 * law.shear_stiffness);
  } else {
    const Eigen::Vector2d direction = trial / length;
    mean.force.tail<2>() = limit * direction;
    tangent = 0.5 * law.shear_stiffness * limit / length *
              (Eigen::Matrix2d::Identity() - direction * direction.transpose());
    if (law.held_limit < 0.0) {
      mean.coupling = -law.cohesion * closed.by_end_gap * direction;
      if (mean.force[0] >= 0.0) mean.coupling += law.friction * mean.tangent(0, 0) * direction;
    }
    end_slip = -2.0 / law.shear_stiffness * mean.force.tail<2>() - start_slip;
    if (!end_open) end.state = ContactState::sliding;
  }
  if (end_open) return step;
  end.force.tail<2>() = -law.shear_stiffness * end_slip;
  end.shear_energy = 0.5 * law.shear_stiffness * end_slip.squaredNorm();
  return step;
}

Eigen::Vector2d borne_slip(const PointLaw& law, double normal, const Eigen::Vector2d& slip) {
  const double force = law.shear_stiffness * slip.norm();
  const double limit = shear_limit(law, normal);
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
      return -response.force.tail<2>() / law.shear_stiffness;
  }
  return slip;
}

}  // namespace ashlar
