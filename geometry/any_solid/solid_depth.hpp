// Depth of a point or a segment inside a solid: the distance to the surface of the solid.
//
// It is independent of contacts, as a reference for them. A solid that is convex but for the rounding of its
// coordinates is the intersection of the half spaces of its faces: the depth of a point is the smallest of its depths
// below them, a concave function along a segment. For other solids the closest point of the surface is found exactly
// (closest_point.hpp). A segment is divided where it comes within the given resolution of a triangle: parts closer to
// the surface are not deeper, and each of the others lies on one side of the surface, determined by its midpoint.
// Within the solid the depth on a part of the segment is bounded above by the distance to the triangle closest to the
// part's midpoint, which is convex along the segment, so that parts without a deeper point are excluded with
// certainty.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/any_solid/closest_point.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// A point inside a solid with the nearest point of its surface.
struct SolidDepth {
  double depth = 0.0;  ///< m, > 0, distance of the two points, rounded
  Vector3 place;       ///< the point inside, m
  Vector3 outward;     ///< unit, from the point to the nearest one of the surface
  int face = -1;       ///< the face with the nearest point, or one that meets there
};

/// A solid prepared for queries. Constant after construction: may be used by many threads.
class SolidDepthFinder {
 public:
  explicit SolidDepthFinder(const Polyhedron& solid);

  /// @param x m, finite
  /// @param clearance for nonconvex solids: set to the distance to the solid, m; 0: the point is not outside; null:
  /// not computed
  /// @return empty if not inside
  [[nodiscard]] std::optional<SolidDepth> of_point(const Vector3& x, double* clearance = nullptr) const;
  /// The deepest point of a segment; of equally deep ones any.
  /// @param start,end m, finite
  /// @param resolution m, > 0, above the rounding of coordinates: solids that are not convex are searched until no
  /// other point is deeper than the answer by more than this
  /// @param known m, >= 0: only points deeper than this are of interest
  /// @param clearance for nonconvex solids: set to a lower bound of the distance of the segment from the solid, m; 0:
  /// unknown; null: not computed
  /// @return empty if no point is inside, or none is deeper than `known` within the resolution
  [[nodiscard]] std::optional<SolidDepth> of_segment(const Vector3& start, const Vector3& end,
                                                     double resolution, double known = 0.0,
                                                     double* clearance = nullptr) const;
  [[nodiscard]] bool convex() const { return closest_ == nullptr; }

 private:
  struct Plane {
    Vector3 normal;  ///< unit, outward
    Vector3 point;
  };
  struct Part;
  /// Appends the parts of a segment that may have points deeper than a reach, m.
  void divide(const Vector3& start, const Vector3& end, double reach, std::vector<Part>& parts) const;
  [[nodiscard]] std::optional<SolidDepth> of_point_in_convex(const Vector3& x) const;
  [[nodiscard]] std::optional<SolidDepth> of_segment_in_convex(const Vector3& start,
                                                               const Vector3& end) const;
  [[nodiscard]] SolidDepth below(int face, double depth, const Vector3& x) const;
  [[nodiscard]] double bound(const Part& part, const Vector3& middle, const ClosestPoint& nearest) const;

  std::vector<Plane> planes_;                          ///< of a convex solid, one for each face
  std::shared_ptr<const ClosestPointFinder> closest_;  ///< of other solids
};

}  // namespace ashlar
