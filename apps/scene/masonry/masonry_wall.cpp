#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/scene/keys/masonry_keys.hpp"
#include "apps/scene/masonry/masonry.hpp"
#include "apps/scene/masonry/masonry_reading.hpp"
#include "apps/scene/read/block_arrays.hpp"

namespace ashlar {
namespace {

/// Share of a brick: closer edges are equal.
constexpr double same_edge = 1e-9;
/// Share of a brick: thinner pieces cause a warning.
constexpr double thin_piece = 1e-2;

/// In the axes of the wall (along, across, up), m from its origin.
struct WallBox {
  Vector3 low;
  Vector3 high;
};

struct Wall {
  Vector3 origin = Vector3::Zero();
  std::optional<SceneRotation> turn;
  Vector3 size = Vector3::Zero();  ///< length, thickness, height
  Vector3 unit = Vector3::Zero();  ///< size of a brick as laid: along, across, up
  bool staggered = true;
  std::vector<SceneOpening> openings;
};

/// Edges from 0 to the end of the wall, a brick apart.
std::vector<double> edges_of(double total, double unit, bool half) {
  std::vector<double> edges = {0.0};
  const double shift = half ? 0.5 : 0.0, tolerance = same_edge * unit;
  for (double k = half ? 0.0 : 1.0;; k += 1.0) {
    const double edge = (k + shift) * unit;
    if (!(edge < total - tolerance)) break;
    edges.push_back(edge);
  }
  edges.push_back(total);
  return edges;
}

/// Lays bricks and cuts them at openings.
class Bricklayer {
 public:
  explicit Bricklayer(Wall wall) : wall_(std::move(wall)) {
    courses_ = edges_of(wall_.size.z(), wall_.unit.z(), false);
    leaves_ = edges_of(wall_.size.y(), wall_.unit.y(), false);
    for (int parity = 0; parity < 2; ++parity)
      joints_[static_cast<std::size_t>(parity)] =
          edges_of(wall_.size.x(), wall_.unit.x(), wall_.staggered && parity == 1);
  }

  /// Leaves a box free. @return true if it meets the wall
  bool cut_out(WallBox hole) {
    snap(hole, 2, courses_);
    for (const auto& joints : joints_) snap(hole, 0, joints);
    const bool meets = hole.low.x() < wall_.size.x() && hole.high.x() > 0.0 &&
                       hole.low.z() < wall_.size.z() && hole.high.z() > 0.0;
    holes_.push_back(hole);
    return meets;
  }

  /// Bricks, or the first of them: at most `most` are laid.
  std::vector<WallBox> lay(std::size_t most) const {
    std::vector<WallBox> bricks;
    for (std::size_t course = 0; course + 1 < courses_.size(); ++course) {
      const std::vector<double>& joints = joints_[course % 2];
      for (std::size_t leaf = 0; leaf + 1 < leaves_.size(); ++leaf)
        for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
          add_rest_of({{joints[k], leaves_[leaf], courses_[course]},
                       {joints[k + 1], leaves_[leaf + 1], courses_[course + 1]}},
                      bricks, most);
          if (bricks.size() > most) return bricks;
        }
    }
    return bricks;
  }

  [[nodiscard]] const std::vector<WallBox>& holes() const { return holes_; }

 private:
  // Moves an edge that differs from a joint by rounding onto it; so no brick is cut into a sliver.
  void snap(WallBox& hole, int axis, const std::vector<double>& edges) const {
    const double tolerance = same_edge * wall_.unit[axis];
    for (double* value : {&hole.low[axis], &hole.high[axis]}) {
      const auto next = std::lower_bound(edges.begin(), edges.end(), *value - tolerance);
      if (next != edges.end() && std::abs(*next - *value) <= tolerance) *value = *next;
    }
  }

  // Adds the remains of a brick around holes: left and right of each hole at full height, then below and above it.
  // Crossing holes may cut one brick into very many: beyond `most` bricks no further hole is processed.
  void add_rest_of(const WallBox& brick, std::vector<WallBox>& bricks, std::size_t most) const {
    std::vector<WallBox> rest = {brick};
    for (const WallBox& hole : holes_) {
      if (bricks.size() + rest.size() > most) break;
      std::vector<WallBox> smaller;
      for (const WallBox& piece : rest) cut(piece, hole, smaller);
      rest = std::move(smaller);
    }
    bricks.insert(bricks.end(), rest.begin(), rest.end());
  }

  static void cut(const WallBox& piece, const WallBox& hole, std::vector<WallBox>& rest) {
    const double left = std::max(piece.low.x(), hole.low.x()),
                 right = std::min(piece.high.x(), hole.high.x());
    const double low = std::max(piece.low.z(), hole.low.z()), high = std::min(piece.high.z(), hole.high.z());
    if (!(left < right && low < high)) {
      rest.push_back(piece);
      return;
    }
    const auto add = [&](double x0, double x1, double z0, double z1) {
      if (x0 < x1 && z0 < z1) rest.push_back({{x0, piece.low.y(), z0}, {x1, piece.high.y(), z1}});
    };
    add(piece.low.x(), left, piece.low.z(), piece.high.z());
    add(left, right, piece.low.z(), low);
    add(left, right, high, piece.high.z());
    add(right, piece.high.x(), piece.low.z(), piece.high.z());
  }

  Wall wall_;
  std::vector<double> courses_;
  std::vector<double> leaves_;
  std::array<std::vector<double>, 2> joints_;
  std::vector<WallBox> holes_;
};

std::optional<Wall> read_wall_keys(TomlTableReader& table) {
  SceneWall given;
  if (!keys::wall_keys().read(table, given)) return std::nullopt;
  Wall wall;
  wall.origin = given.origin - table.reading().origin();
  wall.turn = turn_to(given.direction, wall.origin);
  wall.staggered = given.bond != SceneWall::Bond::stack;
  wall.unit = given.brick;
  if (given.bond == SceneWall::Bond::header) std::swap(wall.unit.x(), wall.unit.y());
  wall.size = {given.length, given.thickness.value_or(wall.unit.y()), given.height};
  wall.openings = std::move(given.openings);
  return wall;
}

// Checks that bricks can be laid around openings.
bool check_openings(TomlTableReader& table, const Wall& wall, Bricklayer& bricklayer) {
  bool good = true;
  for (std::size_t k = 0; k < wall.openings.size(); ++k) {
    const WallBox box = {wall.openings[k].box.min, wall.openings[k].box.max};
    const std::string key = fmt::format("openings.{}", k);
    const double tolerance = same_edge * wall.unit.y();
    if (box.low.y() > tolerance || box.high.y() < wall.size.y() - tolerance) {
      table.error_at_key(key,
                         fmt::format("opening does not go through the wall (across from {} to {} m), from 0 "
                                     "to {} is needed",
                                     box.low.y(), box.high.y(), wall.size.y()));
      good = false;
    }
    if (bricklayer.cut_out(box)) continue;
    table.error_at_key(
        key, fmt::format("opening is not in the wall (along {} to {}, up {} to {} m), along 0 to "
                         "{}, up 0 to {} is the wall",
                         box.low.x(), box.high.x(), box.low.z(), box.high.z(), wall.size.x(), wall.size.z()));
    good = false;
  }
  return good;
}

// Places the lintels, which are cut out of the bricks like openings.
std::optional<std::vector<WallBox>> place_lintels(TomlTableReader& table, const Wall& wall,
                                                  Bricklayer& bricklayer) {
  std::vector<WallBox> lintels;
  const std::vector<WallBox> openings = bricklayer.holes();
  for (std::size_t k = 0; k < wall.openings.size(); ++k) {
    if (!wall.openings[k].lintel) continue;
    const auto& [height, bearing] = *wall.openings[k].lintel;
    const WallBox& hole = openings[k];
    const Vector3 near = same_edge * wall.unit;
    const WallBox lintel = {{hole.low.x() - bearing, 0.0, hole.high.z()},
                            {hole.high.x() + bearing, wall.size.y(), hole.high.z() + height}};
    if (lintel.low.x() < -near.x() || lintel.high.x() > wall.size.x() + near.x() ||
        lintel.high.z() > wall.size.z() + near.z()) {
      table.error_at_key(
          fmt::format("openings.{}.lintel", k),
          fmt::format("lintel is not in the wall (along {} to {}, up to {} m), along 0 to {}, up "
                      "to {} is the wall",
                      lintel.low.x(), lintel.high.x(), lintel.high.z(), wall.size.x(), wall.size.z()));
      return std::nullopt;
    }
    bricklayer.cut_out(lintel);
    lintels.push_back(bricklayer.holes().back());
  }
  return lintels;
}

void warn_of_thin_pieces(TomlTableReader& table, const Wall& wall, const std::vector<WallBox>& bricks) {
  std::size_t thin = 0;
  for (const WallBox& brick : bricks)
    if (((brick.high - brick.low).array() < thin_piece * wall.unit.array()).any()) ++thin;
  if (thin == 0) return;
  table.reading().diagnostics().warning(
      table.reading().places().key(table.path()),
      fmt::format("{} of {} pieces of the wall are thinner than a hundredth of a brick: length, height, "
                  "thickness and openings that are whole or half bricks leave none",
                  thin, bricks.size()));
}

MasonryPiece piece_of(const Wall& wall, const WallBox& box, std::string name) {
  return {std::move(name), SceneBox{wall.origin + box.low, wall.origin + box.high}, wall.turn, {}};
}

}  // namespace

std::vector<MasonryPiece> read_wall(TomlTableReader& table) {
  const std::optional<Wall> wall = read_wall_keys(table);
  if (!wall) return {};
  const Vector3 bricks = (wall->size.array() / wall->unit.array() + 1.0).matrix();
  const double estimate = bricks.prod() + 3.0 * static_cast<double>(wall->openings.size());
  if (!check_pieces(table, estimate)) return {};
  Bricklayer bricklayer(*wall);
  if (!check_openings(table, *wall, bricklayer)) return {};
  const auto lintels = place_lintels(table, *wall, bricklayer);
  if (!lintels) return {};
  const std::vector<WallBox> laid = bricklayer.lay(most_laid_blocks);
  // Crossing openings cut bricks into more pieces than estimated.
  if (!check_pieces(table, std::max(0.0, static_cast<double>(laid.size()) - estimate))) return {};
  if (laid.empty()) {
    table.error_at_key("openings",
                       "openings leave nothing of the wall (0 bricks), at least one brick is needed");
    return {};
  }
  warn_of_thin_pieces(table, *wall, laid);
  std::vector<MasonryPiece> pieces;
  for (const WallBox& brick : laid)
    pieces.push_back(piece_of(*wall, brick, std::to_string(pieces.size() + 1)));
  for (std::size_t k = 0; k < lintels->size(); ++k)
    pieces.push_back(piece_of(*wall, (*lintels)[k], fmt::format("lintel.{}", k + 1)));
  return pieces;
}

}  // namespace ashlar
