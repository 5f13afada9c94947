// The loads and supports of a state: loads.pvd.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// A support of a block that moves otherwise.
struct DrawnSupport {
  int block;
  int stage;                                      ///< 1-based, from which on it is there; 0: from the start
  std::array<bool, 3> components;                 ///< held components x, y, z
  std::vector<std::array<Vector3, 3>> triangles;  ///< m, reference coordinates: its faces; empty: a point
  Vector3 point;                                  ///< m, reference coordinates
};

/// Loads and supports of a scene that its frames draw.
struct DrawnActions {
  std::vector<DrawnSupport> supports;
  std::vector<std::vector<bool>> moving;  ///< by block and load: true for a point of the path of a [[load]]
};
/// Without supports of blocks of the incremental formulation.
/// @param scene the whole one. @param blocks of the simulation
[[nodiscard]] DrawnActions drawn_actions(const Scene& scene, const std::vector<BlockModel>& blocks);

/// True if a scene, or a stage of it, has loads or supports.
[[nodiscard]] bool has_loads_or_supports(const Scene& scene);

/// Cells: a vertex for each load that is not zero, at the centre of its faces, a moving one where it stands between two
/// points of its path, then triangles or a vertex for each
/// support, at their present places. Blocks of the incremental formulation and water have none.
/// Cell data:
///   force      N, resultant of the load; zero of supports
///   held       of supports: 1 for x, 2 for y, 4 for z, summed; 0 of loads
///   block      number of the block
/// @param stage 1-based number of the present stage; 0: none
[[nodiscard]] UnstructuredGrid load_frame(const Simulation& simulation, const DrawnActions& actions,
                                          int stage);

}  // namespace ashlar
