// Friction that varies with pressure (JointLaw::friction_varies()) in limit analysis, whose cones have one coefficient.
//
// A joint gets the friction  integral tau(sigma) dA / N  of a pressure that is linear where it is not zero, as between rigid faces
// on springs, with the resultant of its forces: tau is concave, and eccentric forces have less friction. Forces of the programme
// `rest` (cone_program.hpp) under the loads give the resultant, and depend on friction in turn. From the least friction on
// (least_friction()), a few passes agree. Resultants at an edge have that, too. Where the pressure at a limit is another one,
// as loads are multiplied, the search is repeated with that (apps/run/answers/limit_run).
#pragma once

#include <map>

#include "solver/limit/limit_trial.hpp"
#include "solver/limit/rigid_model.hpp"

namespace ashlar {

[[nodiscard]] bool has_pressure_friction(const RigidModel& model);

/// Coefficient of friction by pair of blocks.
using PairFriction = std::map<PairKey, double>;

/// Sets the friction of these joints under loads and strengths of these factors. Joints that wear keep that of the worn
/// joint as their residual strength.
/// @param model of kind `limit`, with its loads. @param reduced by point: its strength is divided by the factor; empty: none
/// @return the largest relative change of a coefficient
double set_pressure_friction(RigidModel& model, const LimitFactors& factors,
                             const std::vector<bool>& reduced = {});

/// The friction that set_pressure_friction() has set.
[[nodiscard]] PairFriction pressure_friction(const RigidModel& model);

/// Sets friction that another model of the same blocks has.
void set_pressure_friction(RigidModel& model, const PairFriction& friction);

}  // namespace ashlar
