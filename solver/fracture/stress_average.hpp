// Mean stress near the places of a block, for cracks (notes/cracks.md).
//
// The mean at X is that over the part of the block within least_size/2 of X. Stress is linear in the gradients of the
// basis functions in the frame of the block, and d phi / dX_i = D_i phi, so that the mean values of phi determine it:
//     mean F = q' (D_i mean phi)_i
// They are constant, and computed once. The mean does not depend on how high the order of the block is, but for how well
// that order has the stress. A peak at a corner or under a point load counts with its mean.
#pragma once

#include <optional>
#include <vector>

#include "mechanics/block/block_model.hpp"
#include "solver/fracture/crack.hpp"

namespace ashlar {

/// Places of a block at which its mean stress is known.
struct StressProbes {
  std::vector<Vector3> points;  ///< m, reference coordinates, in the block or on its surface
  Eigen::MatrixXd means;        ///< (#points, p), m^-3/2: mean of each function near them
};

/// Probes at most least_size/2 apart, inside and on the faces, but not more than some thousands.
/// @param least_size m, > 0
[[nodiscard]] StressProbes stress_probes(const BlockModel& block, double least_size);

/// The probe with the largest mean tension, if that reaches a strength. Of several within a thousandth of it the one nearest
/// the centroid: rounding errors must not decide where a uniform stress divides a block.
/// @param block deformable, of the total formulation, without initial stress. @param strength Pa, > 0
/// @return place with its plane through the probe; WeakPlace::block is not set
[[nodiscard]] std::optional<WeakPlace> weakest_place(const BlockModel& block, const BlockState& state,
                                                     const StressProbes& probes, double strength);

/// Cauchy stress of the block at the mean deformation gradient near a probe, Pa. @param probe index
[[nodiscard]] Eigen::Matrix3d mean_stress(const BlockModel& block, const BlockState& state,
                                          const StressProbes& probes, std::size_t probe);

}  // namespace ashlar
