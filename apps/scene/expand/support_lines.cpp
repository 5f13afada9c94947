#include "apps/scene/expand/support_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "apps/scene/model/name_pattern.hpp"
#include "geometry/boxes/box.hpp"
#include "geometry/index.hpp"
#include "geometry/solid/line_in_solid.hpp"
#include "mechanics/supports/face_selection.hpp"

namespace ashlar {
namespace {

/// Of the length of a line: an end this near to a block is on it.
constexpr double end_share = 1e-6;

std::string point_in_words(const Vector3& point) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", point.x(), point.y(), point.z());
}

bool is_removed(const std::vector<std::string>& patterns, const std::string& name) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return pattern_matches(pattern, name); });
}

/// Blocks along lines.
class LinesInBlocks {
 public:
  LinesInBlocks(const Scene& scene, const std::vector<const Polyhedron*>& solids)
      : scene_(scene), solids_(solids) {
    for (const Polyhedron* solid : solids) {
      Box& box = boxes_.emplace_back();
      if (solid != nullptr)
        for (const Vector3& point : solid->mesh().points) box.include(point);
    }
  }

  /// Parts of a line in blocks, by their start. @param low,high m along the line
  [[nodiscard]] std::vector<BoltSpan> spans(const Vector3& from, const Vector3& direction, double low,
                                            double high) const {
    std::vector<BoltSpan> result;
    for (std::size_t k = 0; k < solids_.size(); ++k) {
      if (solids_[k] == nullptr || !part_within(boxes_[k], from + low * direction, from + high * direction))
        continue;
      for (const auto& [start, end] : parts_inside(solids_[k]->mesh(), from, direction, low, high))
        result.push_back({static_cast<int>(k), std::max(1, scene_.block[k].order), start, end});
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const BoltSpan& a, const BoltSpan& b) { return a.start < b.start; });
    return result;
  }
  /// Scene::origin, for messages.
  [[nodiscard]] const Vector3& origin() const { return scene_.origin; }
  [[nodiscard]] const Polyhedron* solid(std::size_t block) const { return solids_[block]; }
  [[nodiscard]] std::size_t count() const { return solids_.size(); }

 private:
  const Scene& scene_;
  const std::vector<const Polyhedron*>& solids_;
  std::vector<Box> boxes_;
};

/// Parts without overlaps and slivers. @param least m, shorter ones are left out
std::vector<BoltSpan> parted(std::vector<BoltSpan> spans, double least) {
  std::vector<BoltSpan> result;
  for (BoltSpan& span : spans) {
    if (!result.empty()) span.start = std::max(span.start, result.back().end);
    if (span.end - span.start > least) result.push_back(span);
  }
  return result;
}

BoltLaw law_of(const SceneBolt& bolt) {
  BoltLaw law;
  const bool grouted = bolt.anchored == SceneBolt::Anchorage::grouted;
  law.anchorage = grouted ? BoltAnchorage::grouted : BoltAnchorage::ends;
  law.axial_stiffness = bolt.young_modulus * bolt.area;
  law.yield_force = bolt.yield_force.value_or(BoltLaw::unlimited);
  law.rupture_strain = bolt.rupture_strain.value_or(BoltLaw::unlimited);
  law.pretension = bolt.pretension;
  law.compression = grouted;
  law.bond_stiffness = bolt.bond_stiffness;
  law.bond_strength = bolt.bond_strength.value_or(BoltLaw::unlimited);
  law.shear_stiffness = bolt.shear_stiffness;
  law.shear_strength = bolt.shear_strength.value_or(BoltLaw::unlimited);
  return law;
}

/// Finds the blocks of a bolt.
void find_blocks(const LinesInBlocks& blocks, SupportLine& line) {
  const Vector3 span = line.to - line.from;
  const double length = span.norm();
  std::vector<BoltSpan> spans =
      parted(blocks.spans(line.from, span / length, 0.0, length), 0.1 * line.thickness);
  if (spans.empty()) {
    line.fault =
        fmt::format("bolt \"{}\" meets no block (from {} to {}), a line through blocks is needed", line.name,
                    point_in_words(blocks.origin() + line.from), point_in_words(blocks.origin() + line.to));
    return;
  }
  line.spans = std::move(spans);
}

/// The block that holds an end.
/// @param spans parts of the line in blocks, measured from the end, the bar on the positive side
/// @param behind true: of two that meet there the one behind the end, false: the one that the bar goes into
std::optional<BoltSpan> block_at_end(const std::vector<BoltSpan>& spans, double allowed, bool behind) {
  std::optional<BoltSpan> back, ahead;
  for (const BoltSpan& span : spans) {
    if (!back && span.start < -allowed && span.end >= -allowed) back = span;
    if (!ahead && span.start <= allowed && span.end > allowed) ahead = span;
  }
  return (behind ? back : ahead) ? (behind ? back : ahead) : (behind ? ahead : back);
}

/// Finds the blocks at both ends. @param what bolt or prop
void find_ends(const LinesInBlocks& blocks, const char* what, SupportLine& line) {
  const Vector3 span = line.to - line.from;
  const double length = span.norm();
  const bool is_prop = line.thickness == 0.0;
  const auto find = [&](const Vector3& end, const Vector3& along) {
    return block_at_end(blocks.spans(end, along, -length, length), end_share * length, is_prop);
  };
  const std::optional<BoltSpan> first = find(line.from, span / length), last = find(line.to, -span / length);
  if (!first || !last) {
    line.fault =
        fmt::format("the end `{}` of {} \"{}\" is at no block ({}), a point on or in a block is needed",
                    first ? "to" : "from", what, line.name,
                    point_in_words(blocks.origin() + (first ? line.to : line.from)));
  } else if (first->block == last->block) {
    line.fault =
        fmt::format("both ends of {} \"{}\" are at one block, two blocks are needed", what, line.name);
  } else {
    line.spans = {{first->block, first->order, 0.0, 0.0}, {last->block, last->order, length, length}};
  }
}

/// Heads of the bolts of a pattern: points of its grid on faces in its plane, from which the bar goes into a block at
/// once.
class PatternHeads {
 public:
  PatternHeads(const SceneBolt::Pattern& pattern, const LinesInBlocks& blocks)
      : pattern_(pattern),
        blocks_(blocks),
        normal_(pattern.plane.normal.stableNormalized()),
        along_(pattern_row(normal_)) {
    across_ = normal_.cross(along_);
    direction_ = pattern.direction ? Vector3(pattern.direction->stableNormalized()) : Vector3(-normal_);
    for (std::size_t k = 0; k < blocks_.count(); ++k)
      if (blocks_.solid(k) != nullptr) add_triangles(*blocks_.solid(k));
  }

  [[nodiscard]] const Vector3& direction() const { return direction_; }
  /// Row after row.
  [[nodiscard]] std::vector<Vector3> find() const {
    std::vector<Vector3> heads;
    const std::array<std::array<int, 2>, 2> range = grid();
    for (int j = range[1][0]; j <= range[1][1]; ++j) {
      for (int i = range[0][0]; i <= range[0][1]; ++i) {
        const Vector3 head =
            pattern_.plane.point + i * pattern_.spacing[0] * along_ + j * pattern_.spacing[1] * across_;
        if (!is_on_a_face({i * pattern_.spacing[0], j * pattern_.spacing[1]})) continue;
        const std::vector<BoltSpan> spans = blocks_.spans(head, direction_, 0.0, pattern_.length);
        if (!spans.empty() && spans.front().start <= end_share * pattern_.length) heads.push_back(head);
      }
    }
    return heads;
  }

 private:
  /// A triangle of a face in the plane: coordinates along and across from the plane's point, counter-clockwise.
  struct FlatTriangle {
    std::array<Eigen::Vector2d, 3> corners;
    double offset;  ///< m, by which coordinates of its block may be rounded
  };

  void add_triangles(const Polyhedron& solid) {
    const double offset = allowed_offset(solid);
    for (const int face : faces_in_plane(solid, {pattern_.plane.point, pattern_.plane.normal})) {
      for (const int triangle : solid.faces()[at(face)].triangles) {
        FlatTriangle flat{{}, offset};
        for (std::size_t n = 0; n < 3; ++n) {
          const int corner = solid.mesh().triangles[at(triangle)][n];
          const Vector3 place = solid.mesh().points[at(corner)] - pattern_.plane.point;
          flat.corners[n] = {place.dot(along_), place.dot(across_)};
        }
        const auto& [a, b, c] = flat.corners;
        if (area(a, b, c) < 0.0) std::swap(flat.corners[1], flat.corners[2]);
        triangles_.push_back(flat);
      }
    }
  }

  /// Twice the area, positive if counter-clockwise.
  static double area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  }

  [[nodiscard]] bool is_on_a_face(const Eigen::Vector2d& head) const {
    return std::any_of(triangles_.begin(), triangles_.end(), [&](const FlatTriangle& triangle) {
      for (std::size_t n = 0; n < 3; ++n) {
        const Eigen::Vector2d &from = triangle.corners[n], &to = triangle.corners[(n + 1) % 3];
        if (area(from, to, head) < -triangle.offset * (to - from).norm()) return false;
      }
      return true;
    });
  }

  /// Numbers of the first and last head in both directions that may be on a face in the plane.
  [[nodiscard]] std::array<std::array<int, 2>, 2> grid() const {
    std::array<std::array<int, 2>, 2> range = {{{0, -1}, {0, -1}}};
    bool any = false;
    for (const FlatTriangle& triangle : triangles_) {
      for (const Eigen::Vector2d& corner : triangle.corners) {
        for (const std::size_t n : {0U, 1U}) {
          const double steps = corner[static_cast<Eigen::Index>(n)] / pattern_.spacing[n];
          const int low = static_cast<int>(std::floor(std::clamp(steps, -farthest, farthest)));
          range[n] = any ? std::array{std::min(range[n][0], low), std::max(range[n][1], low + 1)}
                         : std::array{low, low + 1};
        }
        any = true;
      }
    }
    return range;
  }

  static constexpr double farthest = 1e4;  ///< heads in each direction

  const SceneBolt::Pattern& pattern_;
  const LinesInBlocks& blocks_;
  Vector3 normal_;
  Vector3 along_;
  Vector3 across_;
  Vector3 direction_;
  std::vector<FlatTriangle> triangles_;
};

void add_bolt(const SceneBolt& bolt, const std::string& path, const LinesInBlocks& blocks,
              std::vector<SupportLine>& lines) {
  const double thickness = std::sqrt(4.0 * bolt.area / std::numbers::pi);
  const auto add = [&](const std::string& name, const Vector3& from, const Vector3& to) {
    SupportLine& line = lines.emplace_back(SupportLine{name,
                                                       path,
                                                       law_of(bolt),
                                                       from,
                                                       to,
                                                       thickness,
                                                       {},
                                                       bolt.installed && !is_removed(bolt.removed, name),
                                                       {}});
    if (line.law.anchorage == BoltAnchorage::grouted)
      find_blocks(blocks, line);
    else
      find_ends(blocks, "bolt", line);
  };
  if (!bolt.pattern) {
    if (bolt.from.allFinite() && bolt.to.allFinite()) add(bolt.name, bolt.from, bolt.to);
    return;
  }
  const PatternHeads pattern(*bolt.pattern, blocks);
  int number = 0;
  for (const Vector3& head : pattern.find())
    add(fmt::format("{}.{}", bolt.name, ++number), head, head + bolt.pattern->length * pattern.direction());
  if (number > 0) return;
  lines.push_back(
      {bolt.name,
       path,
       law_of(bolt),
       bolt.pattern->plane.point,
       bolt.pattern->plane.point,
       thickness,
       {},
       bolt.installed,
       fmt::format("pattern \"{}\" has no bolts: no face of a block in the plane has a head from which "
                   "the bar goes into a block, see plane, spacing and direction",
                   bolt.name)});
}

}  // namespace

Vector3 pattern_row(const Vector3& normal) {
  constexpr double horizontal = 1e-6;  // sine of the slope of a plane that counts as horizontal
  const Vector3 level = Vector3::UnitZ().cross(normal.stableNormalized());
  return level.norm() > horizontal ? Vector3(level.normalized()) : Vector3(Vector3::UnitX());
}

std::vector<SupportLine> support_lines(const Scene& scene, const std::vector<const Polyhedron*>& solids) {
  std::vector<SupportLine> lines;
  if (scene.bolt.empty() && scene.prop.empty()) return lines;
  const LinesInBlocks blocks(scene, solids);
  for (std::size_t k = 0; k < scene.bolt.size(); ++k)
    if (scene.bolt[k].area > 0.0) add_bolt(scene.bolt[k], fmt::format("bolt.{}", k), blocks, lines);
  for (std::size_t k = 0; k < scene.prop.size(); ++k) {
    const SceneProp& prop = scene.prop[k];
    if (!prop.from.allFinite() || !prop.to.allFinite() || !(prop.stiffness > 0.0)) continue;
    BoltLaw law;
    law.anchorage = BoltAnchorage::ends;
    law.axial_stiffness = prop.stiffness * (prop.to - prop.from).norm();
    law.yield_force = prop.yield_force.value_or(BoltLaw::unlimited);
    law.tension = prop.tension;
    SupportLine& line = lines.emplace_back(SupportLine{prop.name,
                                                       fmt::format("prop.{}", k),
                                                       law,
                                                       prop.from,
                                                       prop.to,
                                                       0.0,
                                                       {},
                                                       prop.installed && !is_removed(prop.removed, prop.name),
                                                       {}});
    find_ends(blocks, "prop", line);
  }
  return lines;
}

}  // namespace ashlar
