// The contact of two blocks as a step finds it: points that are constant within the step, and how their springs and
// multipliers start.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mechanics/contact/contact_points.hpp"
#include "solver/contact/contact_cache.hpp"
#include "solver/contact/pair_rows.hpp"

namespace ashlar {

/// Contact points of two blocks with what they were made from.
struct ContactPatch {
  std::vector<ContactPoint> points;
  std::vector<PressureCut> cuts = {};  ///< where pressure ends, to be remembered
  std::vector<FacePair> turning = {};  ///< faces over which friction turned in the step before
  std::shared_ptr<const PairRows::Values> rows = nullptr;  ///< of the points; null: to be made
  std::shared_ptr<const ContactCache> cache = nullptr;     ///< reused by later steps; null: none
};

/// Start of the springs and multipliers of a patch in a step, besides the memory of their points.
struct PatchStart {
  /// True if the points are those of the last step: springs continue from its compression, and hold the same energy
  bool continues = false;
  /// m, >= 0: springs without tension that are placed below the surface, by no more than this, are at rest there
  double touch_within = 0.0;
  /// J, >= 0, dissipated by the multipliers of the pair and not given back: they freeze points at the gap where they are
  /// found below the surface, bonds also above it. Empty: the rest of springs is the surface
  std::optional<double> frozen = std::nullopt;
  /// m, of a relative to b at each point since the load level of a static analysis began (static_analysis.hpp): slip is
  /// counted from there. Empty: from the last step
  std::vector<Vector3> moved_in_level = {};
  /// True if bonds neither tear nor slide whatever pulls, and none is lost in the step
  bool freezes_failure = false;
};

/// Actions on a pair in one step beside its contact.
struct StepActions {
  const Eigen::MatrixX3d& prescribed_a;  ///< change of the position of a by supports, (p, 3), m; empty: none
  const Eigen::MatrixX3d& prescribed_b;
  double step = 0.0;             ///< s; 0: an iteration of a static analysis, which has no dashpots
  bool defers_friction = false;  ///< friction of the last step's impulses acts in this one
};

}  // namespace ashlar
