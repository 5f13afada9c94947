#include "apps/scene/masonry/masonry_reading.hpp"

#include <fmt/format.h>

#include "apps/scene/read/block_arrays.hpp"
#include "apps/scene/read/exact_turn.hpp"

namespace ashlar {

bool read_length(TomlTableReader& table, std::string_view key, double& length) {
  table.require(key);
  return table.read_number(key, length, range::positive_length);
}

bool read_optional_length(TomlTableReader& table, std::string_view key, double& length) {
  return table.read_number(key, length, range::positive_length) || !table.given(key);
}

bool read_masonry_position(TomlTableReader& table, std::string_view key, Vector3& position) {
  const bool good = table.read_place(key, position) || !table.given(key);
  position -= table.reading().origin();
  return good;
}

bool read_count(TomlTableReader& table, std::string_view key, int& count, int low) {
  table.require(key);
  return table.read_integer(key, count, low, most_laid_blocks);
}

bool check_pieces(TomlTableReader& table, double pieces) {
  const double all = table.reading().add_pieces(pieces);
  if (all <= most_laid_blocks) return true;
  table.error_at_table(
      fmt::format("masonry is too large (about {:.3g} pieces up to this one), at most {} are allowed", all,
                  most_laid_blocks));
  return false;
}

bool read_direction(TomlTableReader& table, const Vector3& about, std::optional<SceneRotation>& turn) {
  Vector3 direction = Vector3::UnitX();
  if (!table.read_vector("direction", direction)) return !table.given("direction");
  if (direction.z() != 0.0 || direction.head<2>().isZero(0.0)) {
    table.error_at_value(
        "direction", fmt::format("direction is not level ([{}, {}, {}]), [x, y, 0] is needed", direction.x(),
                                 direction.y(), direction.z()));
    return false;
  }
  const double angle = degrees_of(direction.x(), direction.y());
  if (angle != 0.0) turn = SceneRotation{Vector3::UnitZ(), angle, about};
  return true;
}

}  // namespace ashlar
