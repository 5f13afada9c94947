// The column beside a free-field boundary: its motion in space, and the tractions by which it acts on the model.
//
// The column of the ground (free_field.hpp) moves alone, with the velocity v and the strain e of plane waves along it. It
// acts on the faces beside it by (Lysmer and Kuhlemeyer 1969; mechanics/notes/quiet_boundaries.md)
//   t = s n - Z (u' - v),   s n = lambda (e . a) n + mu (e (a . n) + a (e . n)),
// a its axis, e = dv/dz of the displacement, n the outward normal and Z the impedance of the block's material
// (quiet_faces.hpp), whose dashpots give -Z u'. A model that moves as the column does feels nothing. The column does not
// depend on the model: its motion is computed before the run, in steps of the run.
#pragma once

#include <memory>
#include <vector>

#include "solver/ground/free_field.hpp"
#include "solver/ground/ground_wave.hpp"

namespace ashlar {

/// The column beside a free-field boundary, and its motion along x, y and z of space.
struct SideColumn {
  std::shared_ptr<const FreeFieldColumn> column;  ///< null: there is none
  Vector3 axis = Vector3::UnitZ();                ///< unit, upward
  Vector3 origin = Vector3::Zero();               ///< m, at height 0
  std::vector<double> times;                      ///< s
  /// m and m/s, (nodes, 3) at each time
  std::vector<Eigen::MatrixX3d> displacement, velocity;
};

/// The column on a base, moved by the wave that enters there: its part along the axis as a P wave, the others as S waves.
/// @param base its normal points out of the model, against the axis. @param layers as FreeFieldColumn
/// @param settings integrator, time_step and damping of the run. @param end_time s, > 0
/// @throws std::invalid_argument without layers
[[nodiscard]] SideColumn side_column(const Plane& base, std::vector<GroundLayer> layers,
                                     const GroundWave& wave, const SimulationSettings& settings,
                                     double end_time);

/// Tractions s n + Z v of a column on faces of a block, one load for each node of the layers beside them, component and
/// kind of traction. Components that never move have none.
/// @param side with a column. @param material of the block. @param faces indices, of one plane and side
[[nodiscard]] std::vector<Load> column_loads(const SideColumn& side, const Polyhedron& solid,
                                             const Material& material, const std::vector<int>& faces);

}  // namespace ashlar
