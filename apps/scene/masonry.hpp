// [[masonry]]: walls, arches, columns and domes as blocks, without coordinates. Pieces that touch are given
// the same corners, to the last bit, so that they have common faces and neither overlap nor gap.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"
#include "apps/scene/toml_table_reader.hpp"

namespace ashlar {

/// One piece: its name behind that of the masonry, "1" or "lintel.1", and its shape.
struct MasonryPiece {
  std::string name;
  SceneShape shape;
  std::optional<SceneRotation> rotate;
  std::vector<SceneLoad> load;
};

/// The blocks of one [[masonry]], NAME.1, NAME.2, ...: see the reader of each kind for their order. None if
/// anything is missing or faulty.
[[nodiscard]] std::vector<SceneBlock> read_masonry(TomlTableReader& table);

/// A wall of bricks, courses from below, each along `direction`, leaves from the face that `origin` is on;
/// then lintels. Along odd courses (the second, fourth, ...) of bonds "running" and "header" joints are half a
/// brick farther, so that they begin and end with a half brick. Bricks end where the wall ends and at
/// openings; one that is left above or below an opening's edge within a course is a piece of its own. Edges
/// that differ by less than 1e-9 of a brick are the same. Warned of: pieces thinner than a hundredth of a
/// brick. Refused: an opening that meets no brick or does not go through the wall.
[[nodiscard]] std::vector<MasonryPiece> read_wall(TomlTableReader& table);

/// An arch in an upright plane, voussoirs from the angle `from` to the angle `to`, measured at the centre from
/// `direction` upwards. Faces are plane: the curves are polygons with a corner at each joint, on which the
/// radii are taken. With `fill` each voussoir bears the weight of the soil or rubble that stands upright on
/// its outer face, up to a level, as a force on that face. Refused: a fill over faces that do not look up, or
/// with a level below the outer crown.
[[nodiscard]] std::vector<MasonryPiece> read_arch(TomlTableReader& table);

/// An upright column, drums from below: prisms or, with another top_radius, frusta.
[[nodiscard]] std::vector<MasonryPiece> read_column(TomlTableReader& table);

/// A dome, courses from below, each counter-clockwise from x; its keystone, if it has one, last. Joints of
/// courses are continuous: with plane faces, stones that are set over joints would not fit.
[[nodiscard]] std::vector<MasonryPiece> read_dome(TomlTableReader& table);

}  // namespace ashlar
