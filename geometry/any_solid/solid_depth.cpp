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

/// A face that has a feature of the solid.
int face_with(const Polyhedron& solid, const ContactFeature& feature) {
  if (feature.dimension == 2) return feature.index;
  if (feature.dimension == 1) return solid.edges()[at(feature.index)].faces[0];
  for (const PolyhedronEdge& edge : solid.edges())
    if (edge.vertices[0] == feature.index || edge.vertices[1] == feature.index) return edge.faces[0];
  return -1;
}

/// What is known of a place inside. The nearest point is rounded: where it is the place itself, the way out is the
/// normal of its face.
SolidDepth depth_of(const Polyhedron& solid, const Vector3& x, double depth, const ClosestPoint& nearest) {
  const Vector3 way = nearest.point - x;
  const int face = face_with(solid, nearest.feature);
  return {depth, x, way.squaredNorm() > 0.0 ? way.normalized() : solid.faces()[at(face)].normal, face};
}

}  // namespace

/// A part of a segment that may have deeper points than are known.
struct SolidDepthFinder::Part {
  Vector3 start;
  Vector3 end;
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

/// The depth below plane k is linear along the segment, d_k + s r_k; the least of them is concave. From a
/// bracket whose ends are bounded by a rising and a falling plane, the place where these two meet is either
/// the answer or is bounded by another plane that takes the place of one of them.
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

std::optional<SolidDepth> SolidDepthFinder::of_point(const Vector3& x) const {
  if (convex()) return of_point_in_convex(x);
  const ClosestPoint nearest = closest_->find_any(x);
  if (nearest.place != PointPlace::inside) return std::nullopt;
  const double depth = std::sqrt(nearest.squared_distance);
  if (!(depth > 0.0)) return std::nullopt;
  return depth_of(closest_->solid(), x, depth, nearest);
}

double SolidDepthFinder::clear_radius(const Vector3& x) const {
  const ClosestPoint nearest = closest_->find_any(x);
  return nearest.place == PointPlace::outside ? std::sqrt(nearest.squared_distance) : 0.0;
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
    // Blocks that were cut apart have edges along each other.
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

std::optional<SolidDepth> SolidDepthFinder::of_segment(const Vector3& start, const Vector3& end,
                                                       double resolution, double known,
                                                       double* clearance) const {
  if (clearance != nullptr) *clearance = 0.0;
  if (convex()) {
    auto depth = of_segment_in_convex(start, end);
    return depth && depth->depth > known ? depth : std::nullopt;
  }
  std::optional<SolidDepth> deepest;
  double least_clear = std::numeric_limits<double>::infinity();
  std::vector<Part> parts = {{start, end}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const Vector3 middle = 0.5 * (part.start + part.end);
    const double half = 0.5 * (part.end - part.start).norm();
    const ClosestPoint nearest = closest_->find_any(middle);
    const double distance = std::sqrt(nearest.squared_distance);
    const bool inside = nearest.place == PointPlace::inside;
    if (inside && distance > (deepest ? deepest->depth : known)) {
      deepest = depth_of(closest_->solid(), middle, distance, nearest);
    }
    const double deeper = (deepest ? deepest->depth : known) + resolution;
    // Outside, a part goes in only beyond its nearest surface; inside, its ends are at most `half` deeper.
    const double most = std::min(inside ? half + distance : half - distance, bound(part, middle, nearest));
    if (most <= deeper) {
      least_clear = std::min(least_clear, inside ? 0.0 : std::max(distance - half, 0.0));
      continue;
    }
    parts.push_back({middle, part.end});
    parts.push_back({part.start, middle});
  }
  if (clearance != nullptr) *clearance = least_clear;
  return deepest;
}

}  // namespace ashlar
