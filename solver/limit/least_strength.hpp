// Compressive strength that a structure of rigid blocks needs.
//
// Strengths of all joints are tried, as factors are (limit_analysis.hpp): with pressure at centroids of parts of joints
// (crushing_joints.hpp) they stand, with pressure at corners of parts they move, and parts are divided between. The
// motion of a strength that is too small has a power of the loads, which bounds the strength from below. The result
// stands by forces at centroids.
#pragma once

#include <optional>
#include <vector>

#include "solver/block_pair.hpp"
#include "solver/limit/limit_trial.hpp"
#include "solver/limit/rigid_model.hpp"

namespace ashlar {

struct LeastStrength {
  double value = 0.0;          ///< Pa, as a key of joints whose strength is divided has it
  BlockPair joint = {-1, -1};  ///< two blocks, where it is needed
};

/// @param model with or without compressive strength, which is not used. @param reduced by point: true for joints whose
/// strength is divided. @return empty: no strength is enough, or the programme does not converge
[[nodiscard]] std::optional<LeastStrength> least_strength(const RigidModel& model,
                                                          const std::vector<bool>& reduced,
                                                          const LimitFactors& factors, int threads);

}  // namespace ashlar
