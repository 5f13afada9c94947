// Arches, columns and domes. Corners are computed individually from the numbers of their joint, so that the pieces on
// both sides of a joint have the same ones.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/keys/masonry_keys.hpp"
#include "apps/scene/masonry/masonry.hpp"
#include "apps/scene/masonry/masonry_reading.hpp"
#include "geometry/exact/degree_turn.hpp"

namespace ashlar {
namespace {

constexpr int fewest_sides = 3;

MasonryPiece hull_piece(std::vector<Vector3> points, std::size_t number) {
  return {std::to_string(number), SceneHull{std::move(points)}, {}, {}};
}

/// Number k of a row of `count` numbers from `first` to `last`, exact at both ends.
double between(double first, double last, int k, int count) {
  return k == count ? last : first + (last - first) * k / count;
}

struct Ring {
  double inner = 0.0;
  double outer = 0.0;
};

/// @tparam Struct with a mean radius and a thickness
template <class Struct>
Ring ring_of(const Struct& given) {
  return {given.radius - 0.5 * given.thickness, given.radius + 0.5 * given.thickness};
}

/// Corners on the circle about the vertical, k of `count`, at a height above the centre.
struct Circle {
  Vector3 center;
  int count;

  [[nodiscard]] Vector3 corner(int k, double radius, double height) const {
    const DegreeTurn turn = degree_turn((k % count) * 360.0 / count);
    return {center.x() + radius * turn.cosine, center.y() + radius * turn.sine, center.z() + height};
  }
};

struct Arch {
  Vector3 center = Vector3::Zero();
  std::optional<SceneRotation> turn;
  Ring ring;
  double width = 0.0;
  double from = 0.0;
  double to = 180.0;
  int voussoirs = 0;
  std::optional<SceneFill> fill;

  /// Corner before rotation. @param side -0.5 to 0.5 of the width
  [[nodiscard]] Vector3 corner(int joint, double radius, double side) const {
    const bool closed = std::abs(to - from) == 360.0 && joint == voussoirs;
    const DegreeTurn angle = degree_turn(between(from, to, closed ? 0 : joint, voussoirs));
    return {center.x() + radius * angle.cosine, center.y() + side * width, center.z() + radius * angle.sine};
  }
};

std::optional<Arch> read_arch_keys(TomlTableReader& table) {
  SceneArch given;
  if (!keys::arch_keys().read(table, given)) return std::nullopt;
  const Vector3& origin = table.reading().origin();
  const Vector3 center = given.center - origin;
  if (given.fill) given.fill->top -= origin.z();
  return Arch{center,          turn_to(given.direction, center),
              ring_of(given),  given.width,
              given.from,      given.to,
              given.voussoirs, given.fill};
}

bool check_fill(TomlTableReader& table, const Arch& arch) {
  if (std::min(arch.from, arch.to) < 0.0 || std::max(arch.from, arch.to) > 180.0) {
    table.error_at_key("fill",
                       fmt::format("fill on faces that do not look up (from {} to {} degrees), 0 to 180 is "
                                   "needed",
                                   arch.from, arch.to));
    return false;
  }
  const double crown = arch.center.z() + arch.ring.outer;
  if (arch.fill->top >= crown) return true;
  const double datum = table.reading().origin().z();
  table.error_at_key("fill", fmt::format("fill is lower than the crown (top = {} m), at least {} m is needed",
                                         arch.fill->top + datum, crown + datum));
  return false;
}

// The fill is above the outer face, a trapezium in elevation.
SceneLoad weight_of_fill(const Arch& arch, int voussoir) {
  const Vector3 a = arch.corner(voussoir, arch.ring.outer, 0.0),
                b = arch.corner(voussoir + 1, arch.ring.outer, 0.0);
  const double volume = std::abs(b.x() - a.x()) * (arch.fill->top - 0.5 * (a.z() + b.z())) * arch.width;
  ScenePlane plane{a, {a.z() - b.z(), 0.0, b.x() - a.x()}};
  if (arch.turn) {
    const DegreeTurn turn = degree_turn(arch.turn->angle);
    const auto turned = [&](const Vector3& v) {
      return Vector3(turn.cosine * v.x() - turn.sine * v.y(), turn.sine * v.x() + turn.cosine * v.y(), v.z());
    };
    plane = {turned(a - arch.center) + arch.center, turned(plane.normal)};
  }
  SceneLoad load;
  load.where = plane;
  load.kind = SceneLoad::Kind::force;
  load.of_fill = true;
  load.vector = {0.0, 0.0, -arch.fill->weight * volume};
  return load;
}

}  // namespace

std::vector<MasonryPiece> read_arch(TomlTableReader& table) {
  const std::optional<Arch> arch = read_arch_keys(table);
  if (!arch) return {};
  const double span = std::abs(arch->to - arch->from), each = span / arch->voussoirs;
  if (span == 0.0 || span > 360.0 || each >= 180.0) {
    table.error_at_table(
        fmt::format("arch spans {} degrees in {} voussoirs, 0 to 360 in all and less than 180 for "
                    "each are needed",
                    span, arch->voussoirs));
    return {};
  }
  if (!check_pieces(table, arch->voussoirs)) return {};
  if (arch->fill && !check_fill(table, *arch)) return {};
  std::vector<MasonryPiece> pieces;
  for (int k = 0; k < arch->voussoirs; ++k) {
    std::vector<Vector3> points;
    for (const int joint : {k, k + 1})
      for (const double radius : {arch->ring.inner, arch->ring.outer})
        for (const double side : {-0.5, 0.5}) points.push_back(arch->corner(joint, radius, side));
    pieces.push_back(hull_piece(std::move(points), pieces.size() + 1));
    pieces.back().rotate = arch->turn;
    if (arch->fill) pieces.back().load.push_back(weight_of_fill(*arch, k));
  }
  return pieces;
}

std::vector<MasonryPiece> read_column(TomlTableReader& table) {
  SceneColumn column;
  if (!keys::column_keys().read(table, column)) return {};
  const auto& [foot, radius, top, height, sides, drums] = column;
  const Vector3 center = foot - table.reading().origin();
  const double top_radius = top.value_or(radius);
  // A drum has as many corners as several pieces of other kinds.
  if (!check_pieces(table, static_cast<double>(drums) * std::max(1.0, sides / 8.0))) return {};
  const Circle circle{center, sides};
  std::vector<MasonryPiece> pieces;
  for (int k = 0; k < drums; ++k) {
    std::vector<Vector3> points;
    for (const int level : {k, k + 1})
      for (int side = 0; side < sides; ++side)
        points.push_back(circle.corner(side, between(radius, top_radius, level, drums),
                                       between(0.0, height, level, drums)));
    pieces.push_back(hull_piece(std::move(points), pieces.size() + 1));
  }
  return pieces;
}

std::vector<MasonryPiece> read_dome(TomlTableReader& table) {
  SceneDome dome;
  if (!keys::dome_keys().read(table, dome)) return {};
  const Vector3 center = dome.center - table.reading().origin();
  const double from = dome.from, to = dome.to;
  const int courses = dome.courses, voussoirs = dome.voussoirs;
  const Ring ring = ring_of(dome);
  if (voussoirs < fewest_sides) {
    table.error_at_value("voussoirs",
                         fmt::format("dome has too few voussoirs in a course ({}), at least {} are "
                                     "needed",
                                     voussoirs, fewest_sides));
    return {};
  }
  if (!(0.0 <= from && from < to && to < 90.0)) {
    table.error_at_table(
        fmt::format("dome goes from {} to {} degrees of elevation, 0 <= from < to < 90 is needed", from, to));
    return {};
  }
  if (!check_pieces(table, static_cast<double>(courses) * voussoirs + 1.0)) return {};
  const Circle circle{center, voussoirs};
  const auto corner = [&](int course, int k, double radius) {
    const DegreeTurn up = degree_turn(between(from, to, course, courses));
    return circle.corner(k, radius * up.cosine, radius * up.sine);
  };
  std::vector<MasonryPiece> pieces;
  for (int course = 0; course < courses; ++course)
    for (int k = 0; k < voussoirs; ++k) {
      std::vector<Vector3> points;
      for (const int level : {course, course + 1})
        for (const int side : {k, k + 1})
          for (const double radius : {ring.inner, ring.outer}) points.push_back(corner(level, side, radius));
      pieces.push_back(hull_piece(std::move(points), pieces.size() + 1));
    }
  if (dome.keystone) {
    std::vector<Vector3> points;
    for (const double radius : {ring.inner, ring.outer})
      for (int k = 0; k < voussoirs; ++k) points.push_back(corner(courses, k, radius));
    pieces.push_back(hull_piece(std::move(points), pieces.size() + 1));
  }
  return pieces;
}

}  // namespace ashlar
