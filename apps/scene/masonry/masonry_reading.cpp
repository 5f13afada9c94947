#include "apps/scene/masonry/masonry_reading.hpp"

#include <fmt/format.h>

#include "apps/scene/read/block_arrays.hpp"
#include "geometry/exact/degree_turn.hpp"

namespace ashlar {

bool check_pieces(TomlTableReader& table, double pieces) {
  const double all = table.reading().add_pieces(pieces);
  if (all <= most_laid_blocks) return true;
  table.error_at_table(
      fmt::format("masonry is too large (about {:.3g} pieces up to this one), at most {} are allowed", all,
                  most_laid_blocks));
  return false;
}

std::optional<SceneRotation> turn_to(const Vector3& direction, const Vector3& about) {
  const double angle = degrees_of(direction.x(), direction.y());
  return angle == 0.0 ? std::nullopt : std::optional(SceneRotation{Vector3::UnitZ(), angle, about});
}

}  // namespace ashlar
