#include "mechanics/contact/laws/sliding_point.hpp"

#include <algorithm>

namespace ashlar {

Coupling tangent_of(const Sliding& sliding, Eigen::Matrix3d& tangent) {
  const auto& [normal, limit, stiffness, dilation, share, direction] = sliding;
  const double given = stiffness > 0.0 ? stiffness / (stiffness + limit * dilation) : 1.0;
  const double whole = given * normal;
  const double ratio = normal > 0.0 ? std::min(limit / normal, dilation) : dilation;
  tangent(0, 0) = whole;
  tangent.bottomRightCorner<2, 2>() =
      stiffness * share * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  Coupling coupling;
  if (dilation > 0.0) {
    tangent.block<1, 2>(0, 1) = whole * ratio * direction.transpose();
    tangent.block<2, 1>(1, 0) = whole * ratio * direction;
    tangent.bottomRightCorner<2, 2>() += whole * ratio * ratio * direction * direction.transpose();
  }
  if (ratio == dilation) {
    coupling.force.tail<2>() = (given * limit - whole * ratio) * direction;
    coupling.by.tail<2>() = dilation * direction;
  } else {
    coupling.force << whole, whole * ratio * direction;
    coupling.by << 0.0, (dilation - ratio) * direction;
  }
  return coupling;
}

}  // namespace ashlar
