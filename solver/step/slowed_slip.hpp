// Pays for moving blocks apart where contacts have not taken enough (position_projection.hpp).
//
// A step moves straight what slides along a face that turns, and pushes along the normal at its start. The
// face comes to meet what slides: it is then deeper by d = w v dt^2 (w: angular velocity of the face, v:
// slip), and blocks have gained N d that a normal turning with the face would have taken from the slip, as
// its force leans against it by w dt. So slip pays what moving blocks apart by d takes: impulses against it,
//
//   J_k = -s N_k u_k     of each point that pushes and is too deep, u_k: velocity of its slip
//   s sum N_k u_k^2 - s^2/2 sum |P|^2/rho = energy     P: sums of N_k u_k in the unknowns of each block
//
// equal and opposite on both blocks. They are part of the contact forces of the step that follows.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Impulses against the slip of points that are too deep.
struct SlowedSlip {
  std::map<int, Eigen::MatrixX3d> velocities;  ///< changes, by block
  std::map<PairKey, Vector3> on_a;             ///< by pair, N s
  double work_on_supports = 0.0;               ///< J
};

/// @param step s. @param energy that they take, J. @return none: slip cannot be why points are deep
[[nodiscard]] std::optional<SlowedSlip> slow_slip(const RunContext& run, const Island& island,
                                                  const std::vector<ContactPair>& pairs, double step,
                                                  double energy);

/// Changes velocities and books their energy. @param impulses on a, by pair, N s, are added to
void apply(const RunContext& run, const SlowedSlip& slowed, std::map<PairKey, Vector3>& impulses);

/// Spreads a pair's impulse over its points, as they push. @param forces of the points in their frames, N
void add_impulse(const Vector3& on_a, double step, const std::vector<ContactPoint>& points,
                 std::vector<PointResponse>& forces);

}  // namespace ashlar
