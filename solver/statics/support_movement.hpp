// Range of support movements: how far one support of an arch, a vault or a dome can move before what it bears comes
// down.
//
// The support is placed by small steps along its coordinate (yielding_support.hpp), all other supports stay. Rigid
// blocks follow, with exact rotations. A step is one cone programme, the dual of the least thrust with gaps: over the
// forces p in balance and within friction, with H the thrust, g the gaps and d the step,
//     min  d H + g . p_N                                                                                 (step)
// (for a support that is pressed in, with -d). The multipliers of balance are the motion of the bodies: points come no
// nearer than their gap, and bear only where they close. Points are then detected again where blocks lie, and
//     min  g . p_N                                                                                       (close)
// with the support held is repeated until nothing moves: gaps of second order of the step are closed or pushed out, and
// forces in balance act at closed points only. Such a place is an equilibrium, whatever led to it.
//
// Friction slides with dilation within a programme, mu times the slip. That opening is a gap of the next one, which
// closes it, so that joints do not rise as they slide: the scheme of Anitescu, Math. Program. 105 (2006) 113, whose
// motion obeys Coulomb's law as the step goes to zero. Redundant structures have several such motions; this is one.
// notes/limit_analysis.md says how large a step is.
//
// The movement ends where no step within the tolerance leads to an equilibrium in reach: no forces in balance exist any
// more, or an arbitrarily small movement sets off a finite motion. `lower` is the last equilibrium that was found.
//
// Joints have friction only: cohesion and tensile strength, which a moved joint has lost, count as nothing.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "solver/contact/pair_history.hpp"
#include "solver/state/block_system.hpp"
#include "solver/statics/rigid_model.hpp"

namespace ashlar {

/// Blocks as they are placed. What it refers to must outlive what uses it.
struct PlacedScene {
  const BlockSystem& system;
  const std::vector<BlockState>& states;
  const PairHistories& histories;  ///< of which overlaps of placement count
  double end_time = 0.0;           ///< of the loads, s
  int threads = 1;
};

struct MovementSearch {
  /// Any length > 0: the support moves along it and against it. Empty: away from the structure and towards it
  std::optional<Vector3> direction;
  double limit = 0.0;      ///< m, > 0: movements beyond it are not looked for
  double tolerance = 0.0;  ///< m, > 0: width of the bracket, where rounding lets the programmes tell so much
  std::function<bool()> goes_on = [] { return true; };  ///< asked before each step
};

/// Where a movement ends.
enum class MovementEnd {
  collapses,       ///< no equilibrium in reach: blocks move on while the support stands
  jams,            ///< what stands at the support does not let it in, whatever presses
  reaches_limit,   ///< not limited as far as it was looked for: raise `limit` to look farther
  not_balanced,    ///< no equilibrium where it begins
  not_determined,  ///< programmes did not reach their tolerances: nothing is known beyond `lower`
  interrupted,     ///< by goes_on
};

/// An equilibrium on the way.
struct MovedPlace {
  double moved = 0.0;   ///< m
  double thrust = 0.0;  ///< N, against which the support moves on, as ThrustState::thrust
};

/// A joint that is not as it was.
struct MovedJoint {
  std::array<int, 2> blocks;
  Vector3 place;            ///< m, centre of its normal forces at the end
  double rotation = 0.0;    ///< rad, of its blocks against each other
  double slip = 0.0;        ///< m, way that it has slid under pressure
  bool pressed_on = false;  ///< it bears at the end
};

/// In one of the two directions.
struct SupportPath {
  MovementEnd end = MovementEnd::not_determined;
  double lower = 0.0;              ///< m, >= 0, the last movement that has an equilibrium
  std::optional<double> upper;     ///< m, the least that was found to have none in reach; empty: none was
  std::vector<MovedPlace> places;  ///< `moved` ascends, from 0
  std::vector<MovedJoint> joints;  ///< at `lower`, that have turned or slid
  std::vector<int> moving;         ///< blocks that move at `lower` if the support moves on, by block number
  /// Reference coefficients of blocks at `lower`, by block, (p, 3)
  std::vector<Eigen::MatrixX3d> positions;
  int programmes = 0;
};

struct SupportMovement {
  int support;                       ///< block
  std::optional<Vector3> direction;  ///< of `out`, of length 1; empty: it spreads around the structure
  SupportPath out;                   ///< away from the structure, or along the direction
  SupportPath in;                    ///< the other way
  bool away = false;                 ///< the direction is away from the structure, not one that was asked for
  bool left_out_strength = false;    ///< joints have cohesion or tensile strength
};

/// Size of what may move, m: the diagonal of the box around its contacts. 0: it has none
[[nodiscard]] double extent_of(const RigidModel& model);

/// A block that its supports hold in part: it cannot be followed where it turns. Empty: there is none
[[nodiscard]] std::optional<int> block_held_in_part(const RigidModel& model);
/// True if a load acts on any body.
[[nodiscard]] bool is_loaded(const RigidModel& model);

/// @param support block that does not move and touches one that does, of supports_of
/// @throws std::invalid_argument if a block is incremental or held in part, if nothing bears on the support, or if no
/// load acts
[[nodiscard]] SupportMovement support_movement(const PlacedScene& scene, int support,
                                               const MovementSearch& search);

/// "collapses", "jams", "reaches-limit", "not-balanced", "not-determined", "interrupted"
[[nodiscard]] const char* to_string(MovementEnd end);

}  // namespace ashlar
