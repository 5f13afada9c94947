// Quiet faces of blocks, from the [[boundary]] of a scene.
//
// Beside a free-field boundary a column of the ground moves alone, with the velocity v and the strain e of plane waves
// along it (free_field.hpp). It acts on the faces there by
//   t = s n - Z (u' - v),   s n = lambda (e . a) n + mu (e (a . n) + a (e . n)),
// a its axis, e = dv/dz of the displacement, n the outward normal and Z the impedance of the block's material
// (quiet_faces.hpp). The column does not depend on the model: its motion is computed before the run, in steps of the
// run.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "mechanics/supports/quiet_faces.hpp"
#include "solver/run/free_field.hpp"

namespace ashlar {

/// Components that a boundary holds until motion begins: all of a base, the normal one of a side along an axis of space.
/// @param gravity m/s^2; zero: every boundary is a base
[[nodiscard]] std::array<bool, 3> held_components(const Vector3& normal, const Vector3& gravity);

/// The column beside a free-field boundary, and its motion along x, y and z of space.
struct SideColumn {
  std::shared_ptr<const FreeFieldColumn> column;  ///< null: nothing moves it
  Vector3 axis = Vector3::UnitZ();                ///< unit, upward
  Vector3 origin = Vector3::Zero();               ///< m, at height 0
  std::vector<double> times;                      ///< s
  /// m and m/s, (nodes, 3) at each time
  std::vector<Eigen::MatrixX3d> displacement, velocity;
};

/// Quiet faces of all blocks of a scene of one stage.
class QuietBoundaries {
 public:
  /// @param scene that check_boundaries() has accepted. @param solids by block
  /// @param settings integrator, time_step and damping of the run
  QuietBoundaries(const Scene& scene, const std::vector<Polyhedron>& solids,
                  const SimulationSettings& settings, Diagnostics& diagnostics);

  /// Faces of a block in the planes of boundaries, with what drives them. Empty for a fixed block.
  /// @param scene that of the constructor. @param solid of the block
  [[nodiscard]] std::vector<QuietFaces> of_block(const Scene& scene, const Polyhedron& solid,
                                                 std::size_t block) const;

 private:
  std::vector<SideColumn> sides_;  ///< by boundary
};

}  // namespace ashlar
