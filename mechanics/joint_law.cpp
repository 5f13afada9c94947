#include "mechanics/joint_law.hpp"

#include <algorithm>

namespace ashlar {

PointLaw point_law(const JointLaw& law, double area, bool intact) {
  const double scale = law.area_springs ? area : 1.0;
  return {law.normal_stiffness * scale, law.shear_stiffness * scale, law.friction,
          intact ? law.cohesion * area : 0.0, intact ? law.tensile_strength * area : 0.0};
}

namespace {

/// What the shear force is at most, N. @param normal force, N
double shear_limit(const PointLaw& law, double normal) {
  return law.held_limit >= 0.0 ? law.held_limit : std::max(normal, 0.0) * law.friction + law.cohesion;
}

}  // namespace

PointResponse point_response(const PointLaw& law, double gap, const Eigen::Vector2d& slip) {
  PointResponse response{ContactState::open, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), 0.0, 0.0};
  const double normal = law.normal_multiplier - law.normal_stiffness * gap;
  const bool open =
      normal < -law.tension || (gap > 0.0 && law.tension == 0.0 && law.normal_multiplier == 0.0);
  if (open && law.held_limit <= 0.0) return response;
  if (!open) {
    response.force[0] = normal;
    response.tangent(0, 0) = law.normal_stiffness;
    response.normal_energy = 0.5 * law.normal_stiffness * gap * gap;
  }
  const double limit = shear_limit(law, normal);
  const Eigen::Vector2d trial = law.shear_multiplier - law.shear_stiffness * slip;
  const double length = trial.norm();
  if (length <= limit) {
    response.state = ContactState::locked;
    response.force.tail<2>() = trial;
    response.tangent.bottomRightCorner<2, 2>().diagonal().setConstant(law.shear_stiffness);
    response.shear_energy = 0.5 * law.shear_stiffness * slip.squaredNorm();
    return response;
  }
  response.state = ContactState::sliding;
  const Eigen::Vector2d direction = trial / length;
  response.force.tail<2>() = limit * direction;
  response.tangent.bottomRightCorner<2, 2>() =
      law.shear_stiffness * limit / length *
      (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  if (law.shear_stiffness > 0.0 && !law.augmented)
    response.shear_energy = 0.5 * limit * limit / law.shear_stiffness;
  return response;
}

Eigen::Vector2d sliding_coupling(const PointLaw& law, const PointResponse& response) {
  const Eigen::Vector2d shear = response.force.tail<2>();
  const double length = shear.norm();
  if (response.state != ContactState::sliding || response.force[0] <= 0.0 || law.held_limit >= 0.0 ||
      length == 0.0)
    return Eigen::Vector2d::Zero();
  return law.friction * law.normal_stiffness / length * shear;
}

MeanResponse end_response(const PointLaw& law, const PointResponse& end) {
  return {end.force, end.tangent, sliding_coupling(law, end)};
}

MeanResponse mean_response(const PointLaw& law, const PointResponse& start, double start_gap,
                           const PointResponse& end, double end_gap) {
  if (law.augmented) return end_response(law, end);
  MeanResponse mean{0.5 * (start.force + end.force), 0.5 * end.tangent, 0.5 * sliding_coupling(law, end)};
  const Eigen::Vector2d start_shear = start.force.tail<2>();
  const bool end_open = end.state == ContactState::open;
  const double limit = end_open ? 0.0 : shear_limit(law, end.force[0]);
  if (const double length = start_shear.norm(); length > limit) {
    mean.force.tail<2>() = 0.5 * (limit / length * start_shear + end.force.tail<2>());
    if (law.held_limit < 0.0 && end.force[0] > 0.0)
      mean.coupling += 0.5 * law.friction * law.normal_stiffness / length * start_shear;
  }
  const bool start_open = start.state == ContactState::open;
  if (start_open == end_open || law.tension > 0.0) return mean;
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
  return mean;
}

Eigen::Vector2d elastic_slip(const PointLaw& law, const PointResponse& response,
                             const Eigen::Vector2d& slip) {
  switch (response.state) {
    case ContactState::open:
      return Eigen::Vector2d::Zero();
    case ContactState::locked:
      return slip;
    case ContactState::sliding:
      if (law.augmented) return Eigen::Vector2d::Zero();
      return -response.force.tail<2>() / law.shear_stiffness;
  }
  return slip;
}

}  // namespace ashlar
