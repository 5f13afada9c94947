// The blocks that pieces of a cut block become.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

struct PieceBlock {
  SceneBlock block;
  std::vector<std::size_t> fix, load;  ///< indices in the uncut block of what the piece got of them
};

/// Pieces have the material, order, velocities and everything else of the block. A support or load on a plane
/// goes to the pieces that have a face in it, a force in parts by area; one at a point to the piece that has
/// it. A plane without any is reported. @param index of the block in the scene, whose places are used
/// @param pieces solids, at least one @param names one for each
[[nodiscard]] std::vector<PieceBlock> make_piece_blocks(
    const Scene& scene, std::size_t index, const std::vector<std::shared_ptr<const Polyhedron>>& pieces,
    const std::vector<std::string>& names, Diagnostics& diagnostics);

/// Gives pieces what they get of the supports and loads of the whole block, as above.
/// @param path of the whole block as in ScenePlaces
/// @param pieces placed. @param blocks one for each, in place of whose supports and loads this comes
void share_supports(const Scene& scene, const SceneBlock& whole, const std::string& path,
                    const std::vector<std::shared_ptr<const Polyhedron>>& pieces,
                    std::vector<PieceBlock>& blocks, Diagnostics& diagnostics);

/// Points of a block that are measured become those of the pieces that have them.
void move_measures(Scene& scene, const std::string& block,
                   const std::vector<std::shared_ptr<const Polyhedron>>& pieces,
                   const std::vector<std::string>& names);

/// The piece that a point is in, or is nearest to.
[[nodiscard]] std::size_t piece_at(const std::vector<std::shared_ptr<const Polyhedron>>& pieces,
                                   const Vector3& point);

}  // namespace ashlar
