#include "geometry/any_solid/solid_depth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/any_solid/triangle_distance.hpp"
#include "geometry/index.hpp"
#include "geometry/solid/rounded_convexity.hpp"

namespace ashlar {
namespace {

std::array<Vector3, 3> triangle_of(const Polyhedron& solid, int triangle) {
  const auto& [i, j, k] = solid.mesh().triangles[at(triangle)];
  const auto& points = solid.mesh().points;
  return {points[at(i)], points[at(j)], points[at(k)]};
}

/// A face that contains a feature of the solid.
int face_with(const Polyhedron& solid, const ContactFeature& feature) {
  if (feature.dimension == 2) return feature.index;
  if (feature.dimension == 1) return solid.edges()[at(feature.index)].faces[0];
  for (const PolyhedronEdge& edge : solid.edges())
    if (edge.vertices[0] == feature.index || edge.vertices[1] == feature.index) return edge.faces[0];
  return -1;
}

/// Depth of an inner point. The nearest point is rounded: if it coincides with the point, the direction out is the
/// normal of its face.
SolidDepth depth_of(const Polyhedron& solid, const Vector3& x, double depth, const ClosestPoint& nearest) {
  const Vector3 offset = nearest.point - x;
  const int face = face_with(solid, nearest.feature);
  return {depth, x, offset.squaredNorm() > 0.0 ? offset.normalized() : solid.faces()[at(face)].normal, face};
}

/// Shares of a segment.
using Stretch = std::array<double, 2>;

/// Part of a segment that contains all points within a reach of a triangle, and possibly others.
class NearStretch {
 public:
  NearStretch(const Vector3& start, const Vector3& end, double reach)
      : start_(start), along_(end - start), reach_(reach) {}

  [[nodiscard]] std::optional<Stretch> of(const std::array<Vector3, 3>& corners) const {
    const auto part = part_within(box_of(corners).grown(reach_), start_, start_ + along_);
    if (!part) return std::nullopt;
    Stretch stretch = *part;
    const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    if (!keep_below(stretch, normal, corners[0]) || !keep_below(stretch, -normal, corners[0]))
      return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 out = (corners[(k + 1) % 3] - corners[k]).cross(normal).normalized();
      if (!keep_below(stretch, out, corners[k])) return std::nullopt;
    }
    return stretch;
  }
  [[nodiscard]] Vector3 at_share(double share) const { return start_ + share * along_; }

 private:
  /// Clips parts higher than the reach above a plane. @return true if anything is left
  [[nodiscard]] bool keep_below(Stretch& stretch, const Vector3& normal, const Vector3& point) const {
    const double room = reach_ - normal.dot(start_ - point), rise = normal.dot(along_);
    if (rise > 0.0) stretch[1] = std::min(stretch[1], room / rise);
    if (rise < 0.0) stretch[0] = std::max(stretch[0], room / rise);
    return (rise != 0.0 || room >= 0.0) && stretch[0] <= stretch[1];
  }

  Vector3 start_, along_;
  double reach_;
};

/// Calls visit(item) for all boxes of a tree that may be within a reach of a segment.
template <class Visit>
void for_each_along(const BoxTree& tree, const Vector3& start, const Vector3& end, double reach,
                    Visit visit) {
  std::vector<int> open = {0};
  while (!open.empty()) {
    const BoxTree::Node& node = tree.nodes()[at(open.back())];
    open.pop_back();
    if (!part_within(node.box.grown(reach), start, end)) continue;
    if (node.children >= 0) {
      open.insert(open.end(), {node.children, node.children + 1});
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) visit(tree.items()[at(i)]);
  }
}

}  // namespace

/// A part of a segment that may have deeper points than known.
struct SolidDepthFinder::Part {
  Vector3 start;
  Vector3 end;
  bool one_sided = false;  ///< the surface does not cross it: all of it is inside, or outside
  bool shallow = false;    ///< none of it is deeper than the resolution
};

SolidDepthFinder::SolidDepthFinder(const Polyhedron& solid) {
  if (!is_convex_but_for_rounding(solid)) {
    closest_ = std::make_shared<const ClosestPointFinder>(solid);
    return;
  }
  for (const PolyhedronFace& face : solid.faces())
    planes_.push_back({face.normal, solid.mesh().points[at(face.loops.front().front())]});
}

SolidDepth SolidDepthFinder::below(int face, double depth, const Vector3& x) const {
  return {depth, x, planes_[at(face)].normal, face};
}

std::optional<SolidDepth> SolidDepthFinder::of_point_in_convex(const Vector3& x) const {
  double least = std::numeric_limits<double>::infinity();
  int face = -1;
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const double depth = planes_[k].normal.dot(planes_[k].point - x);
    if (!(depth > 0.0)) return std::nullopt;
    if (depth >= least) continue;
    least = depth;
    face = static_cast<int>(k);
  }
  return below(face, least, x);
}

/// The depth below plane k is linear along the segment, d_k + s r_k; their minimum is concave. In a bracket whose
/// ends are bounded by an increasing and a decreasing plane, the intersection of these two is either the answer or
/// bounded by another plane, which replaces one of them.
std::optional<SolidDepth> SolidDepthFinder::of_segment_in_convex(const Vector3& start,
                                                                 const Vector3& end) const {
  struct Least {
    double depth;
    double rise;
    int face;
  };
  const Vector3 along = end - start;
  const auto least_at = [&](double share) {
    Least least{std::numeric_limits<double>::infinity(), 0.0, -1};
    const Vector3 x = start + share * along;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const double depth = planes_[k].normal.dot(planes_[k].point - x);
      if (depth < least.depth) least = {depth, -planes_[k].normal.dot(along), static_cast<int>(k)};
    }
    return least;
  };
  const auto answer = [&](double share, const Least& least) -> std::optional<SolidDepth> {
    if (!(least.depth > 0.0)) return std::nullopt;
    return below(least.face, least.depth, start + share * along);
  };
  double low = 0.0, high = 1.0;
  Least rising = least_at(low);
  if (rising.rise <= 0.0) return answer(low, rising);
  Least falling = least_at(high);
  if (falling.rise >= 0.0) return answer(high, falling);
  for (std::size_t round = 0; round <= planes_.size(); ++round) {
    // low + d where both bounds are equal.
    const double share = (falling.depth - rising.depth + rising.rise * low - falling.rise * high) /
                         (rising.rise - falling.rise);
    const double middle = std::clamp(share, low, high);
    const Least least = least_at(middle);
    if (least.face == rising.face || least.face == falling.face || least.rise == 0.0)
      return answer(middle, least);
    if (least.rise > 0.0) {
      low = middle;
      rising = least;
    } else {
      high = middle;
      falling = least;
    }
  }
  const Least first = least_at(low), last = least_at(high);
  return first.depth >= last.depth ? answer(low, first) : answer(high, last);
}

std::optional<SolidDepth> SolidDepthFinder::of_point(const Vector3& x, double* clearance) const {
  if (clearance != nullptr) *clearance = 0.0;
  if (convex()) return of_point_in_convex(x);
  const ClosestPoint nearest = closest_->find_any(x);
  const double depth = std::sqrt(nearest.squared_distance);
  if (clearance != nullptr && nearest.place == PointPlace::outside) *clearance = depth;
  if (nearest.place != PointPlace::inside) return std::nullopt;
  if (!(depth > 0.0)) return std::nullopt;
  return depth_of(closest_->solid(), x, depth, nearest);
}

/// No point of the part is deeper: none is deeper than its distance to any triangle of the surface, and the
/// distance to a convex set is convex along the part.
double SolidDepthFinder::bound(const Part& part, const Vector3& middle, const ClosestPoint& nearest) const {
  const Polyhedron& solid = closest_->solid();
  const auto farther_end = [&](const std::array<Vector3, 3>& corners) {
    return std::max(distance_to_triangle(part.start, corners), distance_to_triangle(part.end, corners));
  };
  if (nearest.feature.dimension == 0)
    return std::max((part.start - nearest.point).norm(), (part.end - nearest.point).norm());
  if (nearest.feature.dimension == 1) {
    // Blocks made by cuts have collinear edges.
    const auto& [from, to] = solid.edges()[at(nearest.feature.index)].vertices;
    const Vector3& last = solid.mesh().points[at(to)];
    return farther_end({solid.mesh().points[at(from)], last, last});
  }
  double least = std::numeric_limits<double>::infinity();
  int triangle = -1;
  for (const int candidate : solid.faces()[at(nearest.feature.index)].triangles) {
    const double distance = distance_to_triangle(middle, triangle_of(solid, candidate));
    if (distance >= least) continue;
    least = distance;
    triangle = candidate;
  }
  return farther_end(triangle_of(solid, triangle));
}

/// Points within the reach of a triangle lie in that triangle's part of the segment. A part whose ends are at most
/// twice the reach from its triangle is not deeper than that anywhere, as the distance to a triangle is convex along
/// it.
void SolidDepthFinder::divide(const Vector3& start, const Vector3& end, double reach,
                              std::vector<Part>& parts) const {
  const NearStretch near(start, end, reach);
  std::vector<Stretch> stretches;
  for_each_along(closest_->triangle_boxes(), start, end, reach, [&](int triangle) {
    const auto corners = triangle_of(closest_->solid(), triangle);
    const auto stretch = near.of(corners);
    if (!stretch) return;
    stretches.push_back(*stretch);
    const Vector3 first = near.at_share((*stretch)[0]), last = near.at_share((*stretch)[1]);
    if (std::max(distance_to_triangle(first, corners), distance_to_triangle(last, corners)) > 2.0 * reach)
      parts.push_back({first, last});
  });
  std::sort(stretches.begin(), stretches.end());
  double done = 0.0;
  for (std::size_t k = 0; k < stretches.size();) {
    Stretch joined = stretches[k];
    for (; k < stretches.size() && stretches[k][0] <= joined[1]; ++k)
      joined[1] = std::max(joined[1], stretches[k][1]);
    if (joined[0] > done) parts.push_back({near.at_share(done), near.at_share(joined[0]), true});
    parts.push_back({near.at_share(joined[0]), near.at_share(joined[1]), false, true});
    done = joined[1];
  }
  if (done < 1.0) parts.push_back({near.at_share(done), end, true});
}

std::optional<SolidDepth> SolidDepthFinder::of_segment(const Vector3& start, const Vector3& end,
                                                       double resolution, double known,
                                                       double* clearance) const {
  if (clearance != nullptr) *clearance = 0.0;
  if (convex()) {
    auto depth = of_segment_in_convex(start, end);
    return depth && depth->depth > known ? depth : std::nullopt;
  }
  const double reach = 0.5 * resolution;
  std::vector<Part> parts;
  divide(start, end, reach, parts);
  const bool whole =
      parts.size() == 1 && parts[0].one_sided && parts[0].start == start && parts[0].end == end;
  std::optional<SolidDepth> deepest;
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const Vector3 middle = 0.5 * (part.start + part.end);
    const double half = 0.5 * (part.end - part.start).norm();
    const ClosestPoint nearest = closest_->find_any(middle);
    const double distance = std::sqrt(nearest.squared_distance);
    const bool inside = nearest.place == PointPlace::inside;
    if (!inside && part.one_sided) {
      if (whole && clearance != nullptr) *clearance = std::max(reach, distance - half);
      continue;
    }
    if (inside && distance > (deepest ? deepest->depth : known)) {
      deepest = depth_of(closest_->solid(), middle, distance, nearest);
    }
    if (part.shallow) continue;
    const double deeper = (deepest ? deepest->depth : known) + resolution;
    // Outside, a part enters only beyond its nearest surface; inside, its ends are at most `half` deeper.
    const double most = std::min(inside ? half + distance : half - distance, bound(part, middle, nearest));
    if (most <= deeper) continue;
    parts.push_back({middle, part.end, part.one_sided, false});
    parts.push_back({part.start, middle, part.one_sided, false});
  }
  return deepest;
}

}  // namespace ashlar
