// Compressive strength that a structure of rigid blocks needs.
//
// With pressure at centroids of parts of joints (crushing_joints.hpp) of areas A_k, the least f is sought for which
// forces p within N_k <= f A_k and the other strengths balance the loads F. With q = p / f that is a limit load:
//     max a:   a F + G'q = 0,   N_k <= A_k,   |t| <= c / f + mu N,   -T / f <= N                             (least)
// and f = 1 / a. Without cohesion, tensile strength and bars, f is in the answer only. With them (least) maps f to a
// smaller f' as long as f is more than needed, and never below what is needed.
#pragma once

#include <optional>
#include <vector>

#include "solver/block_pair.hpp"
#include "solver/statics/limit_trial.hpp"
#include "solver/statics/rigid_model.hpp"

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
