// A block divided by a crack: solids, definitions and models of its parts (notes/cracks.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/block/block_model.hpp"
#include "solver/fracture/crack.hpp"

namespace ashlar {

/// The solids of the parts, in the order of their names.
struct DividedSolid {
  std::vector<std::shared_ptr<const Polyhedron>> parts;  ///< two at least; those below the plane first
  double area = 0.0;                                     ///< m^2, of the crack
};

/// The plane across a tension, moved so far along its normal that both sides are at least least_size wide.
/// @return empty if the block is narrower than two of them
[[nodiscard]] std::optional<Plane> plane_with_room(const Polyhedron& solid, const Plane& plane,
                                                   double least_size);

/// Cuts a solid exactly (geometry/cutting). Parts that are not connected are several parts.
/// @param plane with a unit normal
/// @return empty if the plane misses the solid, or if a part is no valid solid or narrower than half of least_size
[[nodiscard]] std::optional<DividedSolid> divided_solid(const Polyhedron& solid, const Plane& plane,
                                                        double least_size);

/// A part of a divided block.
struct BlockPart {
  BlockModel model;
  BlockDefinition definition;  ///< of the model
  std::vector<int> loads;      ///< by load of the part: number of that of the whole block
};

/// Name of a part. @param crack number of the crack among those of the block as it was at the start, from 1
/// @param part number of the part, from 0: its letters are a, b, ..., z, aa, ab, ...
[[nodiscard]] std::string name_of_part(const std::string& block, int crack, std::size_t part);

/// Definitions and models of the parts: supports and loads of faces go to the parts that have the faces, forces on
/// several faces in proportion to their areas, those of points to the part at the point.
/// @param whole of the total formulation, neither fixed nor rigid, without initial stress, quiet faces and pressed parts
/// @param names one for each part
/// @throws std::invalid_argument, std::domain_error as BlockModel does
[[nodiscard]] std::vector<BlockPart> parts_of(const BlockDefinition& whole, const DividedSolid& solids,
                                              const std::vector<std::string>& names);

/// The motion of a block as that of a part: the same polynomial in the functions of the part.
[[nodiscard]] BlockState state_of_part(const BlockModel& whole, const BlockState& state,
                                       const BlockModel& part);
/// The same of a field without the undeformed place: velocity, acceleration. @param field (p, 3)
[[nodiscard]] Eigen::MatrixX3d field_of_part(const BlockModel& whole, const Eigen::MatrixX3d& field,
                                             const BlockModel& part);

}  // namespace ashlar
