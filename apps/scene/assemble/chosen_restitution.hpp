// Restitution of joints for which the scene gives none: what an engineer expects of the bodies and the step that are
// given (apps/notes/chosen_restitution.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/assemble/block_summary.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// 0 for a contact that a step does not resolve: what it would give back is an error of the step. As springs rebound
/// where they are given and resolved, where a block's own vibrations are, and where dashpots have the loss.
class ChosenRestitution {
 public:
  /// @param blocks of the scene, used as long as this
  ChosenRestitution(const Scene& scene, const std::vector<BlockSummary>& blocks);

  /// Empty: as springs. @param law of the joint of two blocks
  [[nodiscard]] std::optional<double> of(std::size_t a, std::size_t b, const SceneJointLaw& law) const;
  /// True if the scene has motion for which the program chooses.
  [[nodiscard]] bool chooses() const { return chooses_; }

 private:
  [[nodiscard]] bool resolves_springs(std::size_t block, double stiffness) const;

  const std::vector<BlockSummary>& blocks_;
  bool chooses_;
  bool area_;
  double step_;  ///< s
};

}  // namespace ashlar
