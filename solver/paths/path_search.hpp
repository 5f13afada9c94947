// The factor on strengths or loads up to which blocks stay at rest along the path of load_path.hpp.
//
// Each factor is tried from the state at rest under the largest factor below it, so that a factor that stands has been
// reached at rest all the way. Beyond the associated limit (limit_analysis.hpp) nothing stands, whatever the path.
//
// A trial without a result in bounded work counts as one that moves: a factor is on the safe side. `proven` tells.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/paths/load_path.hpp"

namespace ashlar {

struct PathAnswer {
  std::optional<double>
      lower;  ///< the largest factor at rest; empty: blocks move on the way to the least one
  std::optional<double> upper;  ///< the least factor not seen to stand; empty: even the largest is at rest
  bool proven = false;          ///< blocks move at `upper`
  bool resolved = false;        ///< upper / lower - 1 is within the tolerance, or one of them is empty
  bool interrupted = false;
  double displacement = 0.0;           ///< m, at `lower`, from the start of the path
  std::vector<Eigen::Vector3d> force;  ///< at `lower`, by point of the path's model, in its units
  /// Factor at which a joint first slides or opens over its whole face, within 1 % or the tolerance; empty: none up to
  /// `lower`
  std::optional<double> onset;
  double onset_displacement = 0.0;    ///< m
  std::vector<PairKey> onset_joints;  ///< blocks of the joints that yield there
  /// Pa, compressive strength with which all joints still bear `lower`, within 5 %: it falls from where no point reaches
  /// it, pressure at the points of springs. 0: nothing is pressed, there is no `lower`, or there are more than 40 bodies
  double least_strength = 0.0;
  PairKey strength_joint = {-1, -1};  ///< blocks of the joint that needs it
  std::optional<LimitTrial> motion;   ///< of `upper`, in the model of the path
  std::vector<LimitTrial> trials;     ///< in order, without motions and forces
};

/// @param associated bracket of the limit above which nothing stands. @param may_continue called before each trial; false ends
/// the search
[[nodiscard]] PathAnswer search_path(LoadPath& path, Sought sought, const LimitSearch& search,
                                     const LimitBracket& associated,
                                     const std::function<bool()>& may_continue);

}  // namespace ashlar
