// Answers of analyses that search before they show a motion: factor of safety, load factor, thrust and movements of
// supports.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/run/factor_search.hpp"
#include "solver/run/simulation.hpp"
#include "solver/statics/least_strength.hpp"
#include "solver/statics/limit_analysis.hpp"
#include "solver/statics/path_search.hpp"
#include "solver/statics/rigid_bolts.hpp"
#include "solver/statics/support_movement.hpp"
#include "solver/statics/thrust.hpp"

namespace ashlar {

/// Result along the load path of a scene.
struct PathFindings {
  PathAnswer answer;
  LimitMotion motion;    ///< at answer.upper; empty: unknown, or nothing moves
  double allowed = 0.0;  ///< m, the least allowed displacement of any block
};

/// Compressive strength of joints in an answer.
struct CrushingFindings {
  /// With which the lower end stands, if the scene gives no strength; value 0: not found.
  LeastStrength least;
  /// With which all loads without a factor are in balance, if that is more than `given`; value 0: not so.
  LeastStrength needed;
  double given = 0.0;  ///< Pa, the least one of the scene; infinite: none
};

/// Result of limit analysis for a scene.
struct LimitFindings {
  LimitAnswer answer;
  PathFindings path;                   ///< of the factor to be signed: its lower and upper end
  LimitMotion released;                ///< at the smallest factor that moves; empty: none does
  LimitMotion associated;              ///< at the smallest factor above which nothing stands; empty: unknown
  bool has_residual_strength = false;  ///< of joints that lose strength, instead of their strength
  CrushingFindings crushing;
};

/// An extreme of the thrust on one support, and its line of thrust.
struct ThrustLine {
  double thrust = 0.0;  ///< N
  double gap = 0.0;
  std::vector<JointResultant> joints;
  std::vector<BarForce> bars;  ///< of bolts and props
};
struct SupportThrust {
  int support = -1;  ///< block
  ThrustLine least;
  std::optional<ThrustLine> most;  ///< empty: no bound
};

struct ThrustFindings {
  std::vector<SupportThrust> supports;
  std::vector<SupportMovement> movements;  ///< of supports moved by the scene, in the order of blocks
  std::string collapse;  ///< moving blocks, if no forces within the strengths balance the loads
};

/// Empty of a static or dynamic analysis.
struct Answer {
  std::optional<FactorBracket> bracket;  ///< of a search by static analyses
  std::optional<LimitFindings> limits;   ///< of a search by limit analysis; beside bracket: where that began
  std::optional<ThrustFindings> thrust;
  /// Onset of the motion found by limit analysis, to be drawn.
  std::vector<RigidDisplacement> drawn;

  /// True if only the onset of motion is drawn, without an analysis of it.
  [[nodiscard]] bool drawn_only() const { return (limits && !bracket) || thrust; }
};

/// Lists all members, for messages: inlined, gcc takes an empty bracket for one that is not initialised.
template <class Archive>
[[gnu::noinline]] void visit_members(Archive& archive, Answer& answer) {
  auto& [bracket, limits, thrust, drawn] = answer;
  archive(bracket, limits, thrust, drawn);
}

}  // namespace ashlar
