// Blocks made from the pieces of a cut block.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

struct PieceBlock {
  SceneBlock block;
  std::vector<std::size_t> fix, load;  ///< indices in the uncut block of supports and loads inherited by the
                                       ///< piece
};

/// Pieces inherit the material, order, velocities and all other properties of the block. A support or load on a plane
/// applies to the pieces with a face in it, a force in proportion to area; one at a point to the piece that contains
/// it. A plane without any is reported. @param index of the block in the scene, whose places are used
/// @param pieces solids, at least one. @param names one for each
[[nodiscard]] std::vector<PieceBlock> make_piece_blocks(
    const Scene& scene, std::size_t index, const std::vector<std::shared_ptr<const Polyhedron>>& pieces,
    const std::vector<std::string>& names, Diagnostics& diagnostics);

/// Distributes the supports and loads of the whole block to pieces, as above.
/// @param path of the whole block as in ScenePlaces
/// @param pieces placed. @param blocks one for each, whose supports and loads are replaced
void share_supports(const Scene& scene, const SceneBlock& whole, const std::string& path,
                    const std::vector<std::shared_ptr<const Polyhedron>>& pieces,
                    std::vector<PieceBlock>& blocks, Diagnostics& diagnostics);

/// Moves measures of points of a block to the pieces that contain the points.
void move_measures(Scene& scene, const std::string& block,
                   const std::vector<std::shared_ptr<const Polyhedron>>& pieces,
                   const std::vector<std::string>& names);

/// m, of the volume of a placed solid, and of one bounded by a mesh.
[[nodiscard]] Vector3 centroid_of(const Polyhedron& solid);
[[nodiscard]] Vector3 centroid_of(const TriangleMesh& mesh);

/// The piece that contains a point, or is closest to it.
[[nodiscard]] std::size_t piece_at(const std::vector<std::shared_ptr<const Polyhedron>>& pieces,
                                   const Vector3& point);

}  // namespace ashlar
