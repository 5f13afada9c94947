// A joint whose contact points are tested.
#pragma once

#include "mechanics/contact/laws/joint_law.hpp"

namespace ashlar::test_support {

/// Friction 0.5, cohesion and tensile strength.
inline const JointLaw law{2e9, 1e9, 0.5, 3e4, 2e4, true};

/// The part of a tangent due to a coupling.
inline Eigen::Matrix3d left_out(const Coupling& coupling) {
  return coupling.force * coupling.by.transpose();
}

}  // namespace ashlar::test_support
