// Pushover along the mechanism: the multiplier of loads that grow together against the displacement that they cause, from
// the limit state until it is zero.
//
// With F the steady loads, F1 the pushed ones, p the forces of points within friction and g their gaps, a step of length d
// is one cone programme,
//     max a - (g / d) . p_N   over p and a,   F + G'p + a F1 = 0                                         (push)
// Its dual is the motion u of the bodies: of all motions with F1 . u = c d, and that let points come no nearer than their
// gaps, the one on which the steady loads do most work. c belongs to the last mechanism, so that d is about the way of the
// block that moves farthest. The multiplier a is the limit of the loads at the present placement: a test that controls the
// displacement would show it. Rigid blocks move by exact screws, with the directions at the middle of the step; points are
// detected again, and (push) with a very small d closes what the step has opened by dilation, or pressed in to second
// order, so that friction does not dilate as steps become short (notes/limit_analysis.md). So each place is an equilibrium
// of the blocks where they are.
//
// Where joints wedge, blocks move earlier: `activation` tells when.
//
// For a block of width b and height h the curve is a = tan(t0 - t), t0 = atan(b / h), at the rotation t.
//
// Joints have friction only, and any compression: cohesion and tensile strength, which a hinge has lost, are ignored.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/paths/support_movement.hpp"

namespace ashlar {

/// A material point whose displacement is shown.
struct PushoverControl {
  int block = -1;
  Vector3 point = Vector3::Zero();  ///< m, of the undeformed block
};

struct PushoverSearch {
  Vector3 direction = Vector3::UnitX();  ///< any length > 0: of the forces, and of the displacement
  double limit = 0.0;                    ///< m, > 0: largest displacement of the control
  /// By block, true: its loads are multiplied. Empty: forces in proportion to mass are, along the direction, a multiplier
  /// of 1 being the weight
  std::vector<bool> multiplied;
  /// Empty: mean displacement of the blocks that move first, weighted by mass
  std::optional<PushoverControl> control;
  /// Ascending, 0 to 1: shares of the displacement at which the multiplier is zero, which get places of their own
  std::vector<double> shares;
  std::function<bool()> may_continue = [] {
    return true;
  };  ///< called before each step; false ends the search
};

/// Where a pushover ends.
enum class PushoverEnd {
  zero,             ///< the multiplier is zero: the blocks go on by themselves
  reaches_limit,    ///< of the search, with a multiplier above zero
  collapses,        ///< no multiplier balances the blocks any more, or they jump: one has lost its support
  jams,             ///< no multiplier moves the blocks on
  immovable,        ///< no multiplier moves any block
  not_balanced,     ///< the blocks do not stand without the push
  control_at_rest,  ///< the control does not move along the direction, or no more while others do
  not_determined,   ///< programmes did not reach their tolerances: nothing is known beyond the last place
  interrupted,      ///< by may_continue
};

/// An equilibrium on the way.
struct PushoverPlace {
  double displacement = 0.0;  ///< m, of the control along the direction
  double multiplier = 0.0;
  std::vector<int> moving;  ///< blocks that move on from here, ascending
};

/// A block of the first mechanism.
struct PushedWeight {
  int block = -1;
  double weight = 0.0;        ///< N
  double displacement = 0.0;  ///< of its centroid along the direction, per displacement of the control
};

/// The blocks at a place.
struct PushoverState {
  int place = 0;                            ///< index into Pushover::places
  std::vector<Eigen::MatrixX3d> positions;  ///< reference coefficients by block, (p, 3)
  std::vector<PairRecord> contacts;         ///< forces in balance under the multiplier of the place
};

struct Pushover {
  PushoverEnd end = PushoverEnd::not_determined;
  std::vector<PushoverPlace> places;  ///< in the order of the motion, from the limit state
  /// Multiplier at which blocks begin to move, the one to be signed (pushover_activation.hpp): that of the first place, or
  /// less. 0: there is no place, or the search was interrupted
  double activation = 0.0;
  bool at_limit = false;       ///< it is that of the first place
  std::optional<double> zero;  ///< m, displacement at which the multiplier is zero; empty: it was not reached
  std::vector<PushedWeight> mechanism;  ///< at the limit state, by block number
  std::vector<PushoverState> states;    ///< some places, the first and the last one among them
  bool left_out_strength = false;       ///< true: joints have cohesion or tensile strength, which are ignored
  int programmes = 0;
};

/// @throws std::invalid_argument if a block is incremental or partly supported, if no load acts or there is no gravity, if
/// the pushed loads move no block, or if a bolt is installed
[[nodiscard]] Pushover pushover(const PlacedScene& scene, const PushoverSearch& search);

/// Multiplier at a displacement, linear between places. Empty: beyond them
[[nodiscard]] std::optional<double> multiplier_at(const Pushover& path, double displacement);

/// "zero", "reaches-limit", "collapses", "jams", "immovable", "not-balanced", "control-at-rest", "not-determined",
/// "interrupted"
[[nodiscard]] const char* to_string(PushoverEnd end);

}  // namespace ashlar
