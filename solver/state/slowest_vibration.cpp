#include "solver/state/slowest_vibration.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace ashlar {
namespace {

/// Of the largest eigenvalue of the stiffness: smaller ones are rigid motions with rounding errors. A larger value would
/// leave out slow vibrations of slender blocks.
constexpr double rigid_motion_share = 1e-9;

}  // namespace

double slowest_vibration(const BlockModel& block) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (block.rigid() || block.fixed() || block.unknowns() == 0) return never;
  // Functions of a block are orthonormal in its volume: the mass is the density times the unit matrix.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      block.tangent(Eigen::Matrix3d(Eigen::Matrix3d::Identity())), Eigen::EigenvaluesOnly);
  const double rounding = rigid_motion_share * modes.eigenvalues().maxCoeff();
  for (const double value : modes.eigenvalues())
    if (value > rounding) return std::sqrt(value / block.material().density);
  return never;
}

}  // namespace ashlar
