#include "geometry/contacts/cell_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Height of the plane of a cell over a place of the frame, along w.
class CellHeight {
 public:
  CellHeight(const PlacedSurface& s, int cell, const ViewFrame& frame)
      : point_(s.point(s.surface().cells[at(cell)].corners[0]) - frame.origin),
        normal_(s.normal(cell)),
        frame_(&frame) {}
  double operator()(const Eigen::Vector2d& place) const {
    const Vector3 flat = place.x() * frame_->e1 + place.y() * frame_->e2;
    return normal_.dot(point_ - flat) / normal_.dot(frame_->w);
  }

 private:
  Vector3 point_;
  Vector3 normal_;
  const ViewFrame* frame_;
};

/// The corners of a cell as a plane set projected along w: counter-clockwise and strictly convex, which rounding or
/// straight corners may violate.
class ProjectedCell {
 public:
  /// @param towards_viewer true if the cell's outside faces the viewer
  ProjectedCell(const PlacedSurface& s, int cell, bool towards_viewer, const ContactDirection& w,
                PredicateLadder& ladder)
      : points_(s.corners(cell)), loop_(points_.size()) {
    std::iota(loop_.begin(), loop_.end(), 0);
    if (!towards_viewer) std::reverse(loop_.begin(), loop_.end());
    bool convex = true;
    for (std::size_t k = 0; convex && k < (loop_.size() == 3 ? 1 : loop_.size()); ++k)
      convex = sign_turn(w, corner(k), corner(k + 1), corner(k + 2), ladder) > 0;
    if (convex) return;
    loop_ = loop_.size() > 3 ? projected_hull(w, points_.data(), loop_, ladder) : std::vector<int>{};
  }
  [[nodiscard]] bool has_area() const { return loop_.size() >= 3; }
  [[nodiscard]] PlaneSet plane_set() const { return {points_.data(), loop_}; }
  /// In the numbering of the cell: a side of the loop is the cell's side at the first of its two corners.
  [[nodiscard]] PlaneLocation in_cell(const PlaneLocation& location) const {
    if (location.dimension == 2) return location;
    const int start = loop_[at(location.index)];
    if (location.dimension == 0) return {0, start};
    const int end = loop_[(at(location.index) + 1) % loop_.size()];
    const int count = static_cast<int>(points_.size());
    return {1, (start + 1) % count == end ? start : (end + 1) % count == start ? end : std::min(start, end)};
  }
  [[nodiscard]] const Vector3& corner(std::size_t k) const { return points_[at(loop_[k % loop_.size()])]; }

 private:
  std::vector<Vector3> points_;
  std::vector<int> loop_;
};

/// Crossing of the sides ab and cd, which is known to exist: rounding may have made them parallel, or moved the
/// crossing of almost coincident sides off one of them.
Eigen::Vector2d crossing_place(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                               const Eigen::Vector2d& d) {
  const auto cross = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const Eigen::Vector2d along = b - a;
  const double squared_length = along.squaredNorm();
  if (squared_length == 0.0) return a;
  const double at_c = along.dot(c - a) / squared_length;
  const double at_d = along.dot(d - a) / squared_length;
  const double low = std::clamp(std::min(at_c, at_d), 0.0, 1.0);
  const double high = std::clamp(std::max(at_c, at_d), 0.0, 1.0);
  const double share = cross(c - a, d - c) / cross(along, d - c);
  return a + (std::isnan(share) ? 0.5 * (low + high) : std::clamp(share, low, high)) * along;
}

}  // namespace

bool within_range(const PlacedSurface& a, const PlacedSurface& b, const Vector3& w) {
  NumericRange range = a.range();
  range.include(b.range());
  for (const double component : w) range.include(component);
  return range.safe();
}

std::optional<CellOverlap> overlap_of_cells(const PlacedSurface& a, int cell_a, const PlacedSurface& b,
                                            int cell_b, DecisionCounts& counts) {
  const ViewFrame frame(b.point(b.surface().cells[at(cell_b)].corners[0]),
                        without_tiny_parts(b.normal(cell_b) - a.normal(cell_a)));
  const Vector3 direction = without_tiny_parts(frame.w);
  PredicateLadder ladder{within_range(a, b, direction), counts};
  const ContactDirection w = ContactDirection::along({&direction});
  const ProjectedCell seen_a(a, cell_a, false, w, ladder);
  const ProjectedCell seen_b(b, cell_b, true, w, ladder);
  std::vector<OverlapVertex> vertices;
  if (seen_a.has_area() && seen_b.has_area())
    vertices = overlap(w, PlaneSetting::tilted, seen_a.plane_set(), seen_b.plane_set(), ladder);
  counts = ladder.counts;
  if (vertices.size() < 3) return std::nullopt;
  CellOverlap overlap{cell_a, cell_b, frame, {}, {}};
  const CellHeight height_a(a, cell_a, frame);
  const CellHeight height_b(b, cell_b, frame);
  for (const OverlapVertex& vertex : vertices) {
    const auto corner = [&](const ProjectedCell& cell, int k) {
      return frame.project(cell.corner(static_cast<std::size_t>(k)));
    };
    const Eigen::Vector2d place =
        vertex.a.dimension == 0 ? corner(seen_a, vertex.a.index)
        : vertex.b.dimension == 0
            ? corner(seen_b, vertex.b.index)
            : crossing_place(corner(seen_a, vertex.a.index), corner(seen_a, vertex.a.index + 1),
                             corner(seen_b, vertex.b.index), corner(seen_b, vertex.b.index + 1));
    overlap.corners.push_back({seen_a.in_cell(vertex.a), seen_b.in_cell(vertex.b), place});
    overlap.gaps.push_back(height_a(place) - height_b(place));
  }
  return overlap;
}

PlaceOverCell place_over_cell(const PlacedSurface& with_point, const Vector3& point, const PlacedSurface& s,
                              int cell, bool past_convex, DecisionCounts& counts) {
  const SurfaceCell& sides = s.surface().cells[at(cell)];
  const auto& corners = sides.corners;
  const Vector3 normal = without_tiny_parts(s.normal(cell));
  PredicateLadder ladder{within_range(with_point, s, normal), counts};
  const ContactDirection w = ContactDirection::along({&normal});
  PlaceOverCell place{true, {}};
  for (std::size_t k = 0; place.over && k < corners.size(); ++k) {
    const Vector3& end = s.point(corners[(k + 1) % corners.size()]);
    if (sign_turn(w, s.point(corners[k]), end, point, ladder) >= 0) continue;
    place.over = sides.across[k] >= 0 && (past_convex || sides.reflex[k]);
    place.past.push_back(static_cast<int>(k));
  }
  counts = ladder.counts;
  return place;
}

bool is_over_cell(const PlacedSurface& with_point, const Vector3& point, const PlacedSurface& s, int cell,
                  DecisionCounts& counts) {
  const PlaceOverCell place = place_over_cell(with_point, point, s, cell, false, counts);
  return place.over && place.past.empty();
}

}  // namespace ashlar
