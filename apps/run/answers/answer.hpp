// Answers of analyses that search before they show a motion: factor of safety, load factor, thrust, movements of supports
// and pushovers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/run/answers/factor_search.hpp"
#include "apps/run/answers/kinematic_check.hpp"
#include "apps/run/answers/shown_state.hpp"
#include "solver/limit/least_strength.hpp"
#include "solver/limit/limit_analysis.hpp"
#include "solver/limit/rigid_bolts.hpp"
#include "solver/paths/path_search.hpp"
#include "solver/paths/pushover.hpp"
#include "solver/paths/support_movement.hpp"
#include "solver/paths/thrust.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Result along the load path of a scene.
struct PathFindings {
  PathAnswer answer;
  BalancedForces rest;   ///< at answer.lower; empty: there is none
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
  BalancedForces forces;
};
struct SupportThrust {
  int support = -1;  ///< block
  ThrustLine least;
  std::optional<ThrustLine> most;  ///< empty: no bound
};

struct ThrustFindings {
  std::vector<SupportThrust> supports;
  std::vector<SupportMovement> movements;  ///< of supports moved by the scene, in the order of blocks
  LimitMotion motion;                      ///< if no forces within the strengths balance the loads
  std::string collapse;  ///< moving blocks, if no forces within the strengths balance the loads
};

/// A pushover along one direction.
struct PushedDirection {
  Vector3 direction = Vector3::UnitX();  ///< unit
  Pushover path;
  std::optional<KinematicCheck> check;  ///< of forces in proportion to mass that move something
};

struct PushoverFindings {
  std::vector<PushedDirection> directions;  ///< at least one
  int weakest = 0;                          ///< index of the one with the least multiplier
  [[nodiscard]] const PushedDirection& weakest_direction() const {
    return directions[static_cast<std::size_t>(weakest)];
  }
};

/// Empty of a static or dynamic analysis.
struct Answer {
  std::optional<FactorBracket> bracket;  ///< of a search by static analyses
  std::optional<LimitFindings> limits;   ///< of a search by limit analysis; beside bracket: where that began
  std::optional<ThrustFindings> thrust;
  std::optional<PushoverFindings> pushover;
  std::string method_reason;  ///< why a factor is sought by its method; empty: the scene names it
  /// Of limit analysis, thrust and pushovers: the states that the answer speaks of, each a step of the run.
  std::vector<ShownState> states;

  /// True if the run shows these states only, without an analysis of its own.
  [[nodiscard]] bool shows_states() const { return (limits && !bracket) || thrust || pushover; }
};

/// Lists all members, for messages: inlined, gcc takes an empty bracket for one that is not initialised.
template <class Archive>
[[gnu::noinline]] void visit_members(Archive& archive, Answer& answer) {
  auto& [bracket, limits, thrust, pushover, method_reason, states] = answer;
  archive(bracket, limits, thrust, pushover, method_reason, states);
}

}  // namespace ashlar
