// Range of support movements: how far one support of an arch, a vault or a dome can move before the supported
// structure collapses.
//
// The support is placed by small steps along its coordinate (yielding_support.hpp), all other supports stay. Rigid
// blocks follow, with exact rotations. A step is one cone programme, the dual of the least thrust with gaps: over the
// forces p in balance and within friction, with H the thrust, g the gaps and d the step,
//     min  d H + g . p_N                                                                                 (step)
// (for a support that is pressed in, with -d). The multipliers of balance are the motion of the bodies: points come
// no nearer than their gap, and transmit forces only if closed. Points are then detected again at the new placement,
// and
//     min  g . p_N                                                                                       (close)
// with the support held is repeated until nothing moves: gaps of second order of the step are closed or opened, and
// forces in balance act at closed points only. Such a placement is an equilibrium, independent of the path.
//
// Friction slides with dilation within a programme, mu times the slip. That opening is a gap in the next programme,
// which closes it, so that joints do not rise as they slide: the scheme of Anitescu, Math. Program. 105 (2006) 113,
// whose motion obeys Coulomb's law as the step tends to zero. For the length of a step see notes/limit_analysis.md.
//
// Where friction is redundant, balance leaves open which joint slides. After a path whose joints slide, each of these is
// in turn the one that slides first, and the path with the least range counts.
//
// The movement ends where no step within the tolerance leads to an equilibrium in reach: no forces in balance exist,
// or an arbitrarily small movement causes a finite motion. `lower` is the last equilibrium that was found.
//
// Joints have friction only: cohesion and tensile strength, which a moved joint has lost, are ignored.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/block_pair.hpp"
#include "solver/contact/pair_history.hpp"
#include "solver/limit/rigid_model.hpp"
#include "solver/state/block_system.hpp"

namespace ashlar {

/// Blocks at their initial placement. The referenced objects must outlive all users.
struct PlacedScene {
  const BlockSystem& system;
  const std::vector<BlockState>& states;
  const PairHistories& histories;  ///< only initial overlaps are used
  double end_time = 0.0;           ///< of the loads, s
  int threads = 1;
};

struct MovementSearch {
  /// Any length > 0: the support moves along it and against it. Empty: away from the structure and towards it
  std::optional<Vector3> direction;
  double limit = 0.0;      ///< m, > 0: largest movement searched
  double tolerance = 0.0;  ///< m, > 0: width of the bracket, if rounding errors of the programmes allow it
  std::function<bool()> may_continue = [] {
    return true;
  };  ///< called before each step; false ends the search
};

/// Where a movement ends.
enum class MovementEnd {
  collapses,       ///< no equilibrium in reach: blocks continue to move while the support is at rest
  jams,            ///< the structure at the support resists its movement for any force
  reaches_limit,   ///< not limited within the search: increase `limit` to search farther
  not_balanced,    ///< no equilibrium at the start
  not_determined,  ///< programmes did not reach their tolerances: nothing is known beyond `lower`
  interrupted,     ///< by may_continue
};

/// An equilibrium on the path.
struct MovedPlace {
  double moved = 0.0;   ///< m
  double thrust = 0.0;  ///< N, resisting the movement, as ThrustState::thrust
};

/// A joint that has changed.
struct MovedJoint {
  PairKey blocks;
  Vector3 place;            ///< m, centre of its normal forces at the end
  double rotation = 0.0;    ///< rad, of its blocks relative to each other
  double slip = 0.0;        ///< m, accumulated slip under pressure
  bool pressed_on = false;  ///< it transmits force at the end
};

/// Path in one of the two directions.
struct SupportPath {
  MovementEnd end = MovementEnd::not_determined;
  double lower = 0.0;              ///< m, >= 0, last movement with an equilibrium
  std::optional<double> upper;     ///< m, smallest movement found without equilibrium in reach; empty: none
  std::vector<MovedPlace> places;  ///< `moved` ascends, from 0
  std::vector<MovedJoint> joints;  ///< at `lower`, those that have rotated or slid
  std::vector<int> moving;         ///< blocks that move at `lower` if the support continues to move, by block
                                   ///< number
  /// Reference coefficients of blocks at `lower`, by block, (p, 3)
  std::vector<Eigen::MatrixX3d> positions;
  std::vector<PairRecord> contacts;  ///< forces in balance there, with the least thrust against the movement
  int programmes = 0;
  /// m, largest range of other orders of slip, if it is larger by more than the tolerance; not beyond the limit
  std::optional<double> farthest;
};

struct SupportMovement {
  int support;                       ///< block
  std::optional<Vector3> direction;  ///< of `out`, unit; empty: the support spreads around the structure
  SupportPath out;                   ///< away from the structure, or along the direction
  SupportPath in;                    ///< opposite direction
  bool away = false;                 ///< true: the direction is away from the structure, false: it was given
  bool left_out_strength = false;    ///< true: joints have cohesion or tensile strength, which are ignored
};

/// Lists all members, for messages: the compiler cannot count those beside an optional vector (struct_members.hpp).
template <class Archive>
void visit_members(Archive& archive, SupportMovement& movement) {
  auto& [support, direction, out, in, away, left_out_strength] = movement;
  archive(support, direction, out, in, away, left_out_strength);
}

/// Size of the structure that may move, m: diagonal of the box around its contacts. 0: no contacts
[[nodiscard]] double extent_of(const RigidModel& model);

/// A partly supported block, whose rotation cannot be followed. Empty: none
[[nodiscard]] std::optional<int> block_held_in_part(const RigidModel& model);
/// True if a load acts on any body.
[[nodiscard]] bool is_loaded(const RigidModel& model);

/// @param support fixed block in contact with a moving one, see supports_of
/// @throws std::invalid_argument if a block is incremental or partly supported, if the support has no load-bearing
/// contact, if no load acts, or if a bolt is installed
[[nodiscard]] SupportMovement support_movement(const PlacedScene& scene, int support,
                                               const MovementSearch& search);

/// "collapses", "jams", "reaches-limit", "not-balanced", "not-determined", "interrupted"
[[nodiscard]] const char* to_string(MovementEnd end);

}  // namespace ashlar
