// Quiet faces of blocks, from the [[boundary]] of a scene (solver/ground/ground_boundary.hpp).
#pragma once

#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/ground/ground_boundary.hpp"

namespace ashlar {

/// Quiet faces of all blocks of a scene of one stage.
class QuietBoundaries {
 public:
  /// @param scene that check_boundaries() has accepted. @param solids by block
  /// @param settings integrator, time_step and damping of the run
  /// @param diagnostics receives free-field boundaries without a column
  QuietBoundaries(const Scene& scene, const std::vector<Polyhedron>& solids,
                  const SimulationSettings& settings, Diagnostics& diagnostics);

  /// Faces of a block in the planes of boundaries, with what drives them. Empty for a fixed block.
  /// @param scene that of the constructor. @param solid of the block
  [[nodiscard]] std::vector<QuietFaces> of_block(const Scene& scene, const Polyhedron& solid,
                                                 std::size_t block) const;

 private:
  std::vector<GroundBoundary> boundaries_;
  std::vector<SideColumn> columns_;  ///< by boundary
};

}  // namespace ashlar
