// Boundaries of the ground: planes in which a model ends but the ground does not.
//
// Faces of moving blocks in such a plane are quiet (quiet_faces.hpp): dashpots let waves out, and until motion begins
// they are held as by supports. A wave drives them from behind, or beside a free-field boundary the column of the ground
// that the wave of the base moves (side_column.hpp). Equations: mechanics/notes/quiet_boundaries.md.
//
// For each free-field boundary: base_of_side(), layers_beside() (side_layers.hpp) with the material and order of each
// layer's block, side_column(); then quiet_faces_of() for each boundary and block, into BlockDefinition::quiet.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/ground/side_column.hpp"

namespace ashlar {

struct GroundBoundary {
  enum class Kind {
    quiet,       ///< dashpots of the material of each block
    free_field,  ///< beside it a column of the ground, moved by the wave of the quiet boundary below
  };
  Plane plane;  ///< its normal points out of the model
  Kind kind = Kind::quiet;
  GroundWave wave = {};  ///< that comes from outside
};

/// Components that a boundary holds until motion begins: all of a base, the normal one of a side along an axis of space.
/// @param gravity m/s^2; zero: every boundary is a base
[[nodiscard]] std::array<bool, 3> held_components(const Vector3& normal, const Vector3& gravity);

/// Index of the quiet boundary below a side, at right angles to it: the first with a wave, or the first at all. Empty:
/// there is none. @param side index
[[nodiscard]] std::optional<std::size_t> base_of_side(const std::vector<GroundBoundary>& boundaries,
                                                      std::size_t side);

/// Faces of a moving block in the plane of a boundary, with what drives them; empty if it has none there.
/// @param column beside the boundary; without one its own wave drives the faces
/// @param solid,material of the block, of order 1 or more. @param gravity m/s^2
/// @throws std::invalid_argument as faces_in_plane
[[nodiscard]] std::optional<QuietFaces> quiet_faces_of(const GroundBoundary& boundary,
                                                       const SideColumn& column, const Polyhedron& solid,
                                                       const Material& material, const Vector3& gravity);

}  // namespace ashlar
