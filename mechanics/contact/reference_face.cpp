#include "mechanics/contact/reference_face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/index.hpp"
#include "mechanics/contact/overlap_outline.hpp"

namespace ashlar {
namespace {

/// A side of an overlap.
struct Side {
  Eigen::Vector2d start;
  Eigen::Vector2d end;
};

/// True if a body's surface turns away from another one behind side k of a cell, which is on an edge. At edges of a
/// notch and between faces coplanar within rounding error it does not.
bool turns_away(const PlacedSurface& body, int index, std::size_t k, const Vector3& other_normal) {
  const SurfaceCell& cell = body.surface().cells[at(index)];
  const std::array<int, 2> ends{cell.corners[k], cell.corners[(k + 1) % cell.corners.size()]};
  for (const SurfaceEdge& edge : body.surface().edges) {
    const bool as_left = edge.ends == ends;
    if (!as_left && edge.ends != std::array{ends[1], ends[0]}) continue;
    const Vector3& behind = body.normal(edge.cells[as_left ? 1 : 0]);
    const Vector3 along = body.point(ends[1]) - body.point(ends[0]);
    constexpr double rounding = 1e-9;
    return along.cross(behind).dot(other_normal) > rounding * along.norm();
  }
  return false;
}

/// For a side of an overlap on an edge around a cell's face, within rounding error: true if the surface turns away
/// there. Empty for other sides.
/// @param other_normal of the other cell
std::optional<bool> ends_at(const PlacedSurface& body, int index, const Vector3& other_normal,
                            const ViewFrame& frame, const Side& side, double tolerance) {
  const SurfaceCell& cell = body.surface().cells[at(index)];
  for (std::size_t k = 0; k < cell.corners.size(); ++k) {
    if (cell.rim[k] < 0) continue;
    const Eigen::Vector2d start = frame.project(body.point(cell.corners[k]));
    const Eigen::Vector2d along =
        frame.project(body.point(cell.corners[(k + 1) % cell.corners.size()])) - start;
    const auto distance = [&](const Eigen::Vector2d& place) {
      const Eigen::Vector2d off = place - start;
      return std::abs(along.x() * off.y() - along.y() * off.x()) / along.norm();
    };
    if (distance(side.start) <= tolerance && distance(side.end) <= tolerance)
      return turns_away(body, index, k, other_normal);
  }
  return std::nullopt;
}

/// Direction of steepest descent of the gap of two flat cells, in the frame's plane.
Eigen::Vector2d downhill(const Vector3& normal_a, const Vector3& normal_b, const ViewFrame& frame) {
  const auto slope = [&](const Vector3& normal) {
    return Eigen::Vector2d(-Eigen::Vector2d(normal.dot(frame.e1), normal.dot(frame.e2)) /
                           normal.dot(frame.w));
  };
  return slope(normal_b) - slope(normal_a);
}

/// Faces that end at the deep end of their overlap.
struct DeepEnd {
  double facing = 0.0;  ///< cosine between the normal of the deep end's side and the direction of descent; 0:
                        ///< no side known
  bool of_a = false;
  bool of_b = false;
};

class DeepEndSearch {
 public:
  DeepEndSearch(const PlacedSurface& a, const PlacedSurface& b, const std::vector<CellOverlap>& overlaps,
                const SurfaceContinues& continues)
      : a_(a), b_(b), overlaps_(overlaps), continues_(continues), tolerance_(outline_tolerance(a, b)) {}

  /// @param cells overlaps of two faces
  [[nodiscard]] DeepEnd of(const std::vector<std::size_t>& cells) const {
    double deepest = overlaps_[cells.front()].gaps.front();
    double highest = deepest;
    for (const std::size_t n : cells) {
      const auto [low, high] = std::minmax_element(overlaps_[n].gaps.begin(), overlaps_[n].gaps.end());
      deepest = std::min(deepest, *low);
      highest = std::max(highest, *high);
    }
    DeepEnd result;
    if (!(highest - deepest > tolerance_)) return result;
    for (const std::size_t n : cells) look_at(overlaps_[n], deepest, highest, result);
    return result;
  }

 private:
  /// Examines sides with a deep corner.
  void look_at(const CellOverlap& overlap, double deepest, double highest, DeepEnd& result) const {
    const std::size_t count = overlap.corners.size();
    const Vector3& normal_a = a_.normal(overlap.cell_a);
    const Vector3& normal_b = b_.normal(overlap.cell_b);
    const Eigen::Vector2d down = downhill(normal_a, normal_b, overlap.frame);
    if (down.isZero(0.0)) return;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t next = (k + 1) % count;
      if (std::min(overlap.gaps[k], overlap.gaps[next]) > deepest + tolerance_) continue;
      const Side side{overlap.corners[k].place, overlap.corners[next].place};
      const Eigen::Vector2d along = side.end - side.start;
      if (!(along.norm() > tolerance_)) continue;
      const Eigen::Vector2d outward = Eigen::Vector2d(along.y(), -along.x()).normalized();
      const double facing = outward.dot(down.normalized());
      // Sides with the same angle to the deep end count together: rounding must not choose between them.
      constexpr double alike = 1e-6;
      if (!(facing > alike) || facing < result.facing - alike) continue;
      const Eigen::Vector2d middle = 0.5 * (side.start + side.end);
      // A surface that continues lower than the edge by up to a tenth of the effect of the tilt counts as continuing.
      const double gap = 0.5 * (overlap.gaps[k] + overlap.gaps[next]);
      const double near = std::max(0.0, gap) + std::max(tolerance_, 0.1 * (highest - deepest));
      const ViewFrame& frame = overlap.frame;
      const auto continues = [&](bool rim_of_a, int face) {
        return continues_({rim_of_a, face, frame.origin + middle.x() * frame.e1 + middle.y() * frame.e2,
                           outward.x() * frame.e1 + outward.y() * frame.e2, near});
      };
      const std::optional<bool> a_ends = ends_at(a_, overlap.cell_a, normal_b, frame, side, tolerance_);
      const std::optional<bool> b_ends = ends_at(b_, overlap.cell_b, normal_a, frame, side, tolerance_);
      if (!a_ends && !b_ends) continue;
      // If the surface continues at the deep end, sides less aligned with it do not count instead.
      if (facing > result.facing + alike) result = {facing, false, false};
      if (a_ends.value_or(false) && !continues(true, b_.surface().cells[at(overlap.cell_b)].face))
        result.of_a = true;
      if (b_ends.value_or(false) && !continues(false, a_.surface().cells[at(overlap.cell_a)].face))
        result.of_b = true;
    }
  }

  const PlacedSurface& a_;
  const PlacedSurface& b_;
  const std::vector<CellOverlap>& overlaps_;
  const SurfaceContinues& continues_;
  double tolerance_;
};

/// True if the reference face is on block a where edges do not decide. @param otherwise for blocks of one kind and
/// size
bool is_first_by_kind(const ContactBody& a, const ContactBody& b, bool otherwise) {
  if (a.model->fixed() != b.model->fixed()) return a.model->fixed();
  const bool divided_a = a.placed->surface().divided;
  const bool divided_b = b.placed->surface().divided;
  if (divided_a != divided_b) return !divided_a;
  // Volumes of equal blocks in different places differ by rounding, which must not decide.
  constexpr double equal_volumes = 1.0 + 1e-9;
  const double volume_a = a.model->basis().volume();
  const double volume_b = b.model->basis().volume();
  if (volume_a > equal_volumes * volume_b) return true;
  return volume_b > equal_volumes * volume_a ? false : otherwise;
}

}  // namespace

std::vector<bool> reference_is_on_a(const ContactBody& a, const ContactBody& b,
                                    const std::vector<CellOverlap>& overlaps,
                                    const SurfaceContinues& continues, bool otherwise) {
  std::map<std::array<int, 2>, std::vector<std::size_t>> of_faces;
  for (std::size_t n = 0; n < overlaps.size(); ++n) {
    of_faces[{a.placed->surface().cells[at(overlaps[n].cell_a)].face,
              b.placed->surface().cells[at(overlaps[n].cell_b)].face}]
        .push_back(n);
  }
  const DeepEndSearch search(*a.placed, *b.placed, overlaps, continues);
  std::vector<bool> result(overlaps.size(), is_first_by_kind(a, b, otherwise));
  for (const auto& [faces, cells] : of_faces) {
    const DeepEnd end = search.of(cells);
    if (end.of_a == end.of_b) continue;
    for (const std::size_t n : cells) result[n] = end.of_b;
  }
  return result;
}

}  // namespace ashlar
