// [[masonry]]: walls, arches, columns and domes as blocks, without coordinates. Adjacent pieces have the same corners
// to the last bit, so that they have common faces and neither overlaps nor gaps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// One piece: the suffix of its name, "1" or "lintel.1", and its shape.
struct MasonryPiece {
  std::string name;
  SceneShape shape;
  std::optional<SceneRotation> rotate;
  std::vector<SceneLoad> load;
};

/// The blocks of one [[masonry]], NAME.1, NAME.2, ..., in the order of the reader of each kind. Empty if anything is
/// missing or faulty.
[[nodiscard]] std::vector<SceneBlock> read_masonry(TomlTableReader& table);

/// A wall of bricks: courses in ascending order, each along `direction`, leaves from the face of `origin`; then
/// lintels. In odd courses (the second, fourth, ...) of bonds "running" and "header" joints are shifted by half a
/// brick, so that they begin and end with a half brick. Bricks end at the end of the wall and at openings. The rest
/// of a brick above or below an opening's edge within a course is a piece of its own. Edges that differ by less than
/// 1e-9 of a brick are equal. Warns of pieces thinner than a hundredth of a brick. Refuses an opening that meets no
/// brick or does not go through the wall.
[[nodiscard]] std::vector<MasonryPiece> read_wall(TomlTableReader& table);

/// An arch in a vertical plane, voussoirs from the angle `from` to the angle `to`, measured at the centre from
/// `direction` upwards. Faces are plane: the curves are polygons with a corner at each joint, which has the given
/// radii. With `fill` each voussoir carries the weight of the soil or rubble above its outer face, up to a level, as
/// a force on that face. Refuses a fill over faces that do not point upwards, or with a level below the outer crown.
[[nodiscard]] std::vector<MasonryPiece> read_arch(TomlTableReader& table);

/// A vertical column, drums in ascending order: prisms or, with another top_radius, frusta.
[[nodiscard]] std::vector<MasonryPiece> read_column(TomlTableReader& table);

/// A dome: courses in ascending order, each counter-clockwise from x; its keystone, if any, last. Vertical joints are
/// continuous over courses: with plane faces, staggered blocks would not fit.
[[nodiscard]] std::vector<MasonryPiece> read_dome(TomlTableReader& table);

}  // namespace ashlar
