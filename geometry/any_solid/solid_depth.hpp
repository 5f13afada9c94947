// How deep a point or a segment is inside a solid: the distance to the surface of the solid.
//
// It knows nothing of contacts: it is the measure that they are held against. A solid that is convex but for
// the rounding of its coordinates is the common part of the half spaces of its faces: the depth of a point is
// the least of its depths below them, a concave function along a segment. Of other solids the closest point
// of the surface is found exactly (closest_point.hpp). A segment is divided where it comes within the asked
// resolution of a triangle: stretches nearer than that to the surface are not deeper, and each of the others lies
// on one side of the surface, which its middle decides. Within the solid the depth on a part of the segment is
// bounded above by the distance to the triangle that is nearest at the part's middle, which is convex along
// the segment, so that parts without a deeper point are left out for certain.
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
  Vector3 way_out;     ///< unit, from the point to the nearest one of the surface
  int face = -1;       ///< the face with the nearest point, or one that meets there
};

/// A solid made ready for questions. Constant after construction: questions may be asked from many threads.
class SolidDepthFinder {
 public:
  explicit SolidDepthFinder(const Polyhedron& solid);

  /// @param x m, finite
  /// @param clearance of solids that are not convex: set to the distance to the solid, m; 0: the point is not outside;
  /// null: not wanted
  /// @return none: not inside
  [[nodiscard]] std::optional<SolidDepth> of_point(const Vector3& x, double* clearance = nullptr) const;
  /// The deepest point of a segment; of equally deep ones any.
  /// @param start,end m, finite
  /// @param resolution m, > 0, above the rounding of coordinates: solids that are not convex are searched until no
  /// other point is deeper than the answer by more than this
  /// @param known m, >= 0: only points deeper than this are of interest
  /// @param clearance of solids that are not convex: set to how far the segment is from the solid at least,
  /// m; 0: not known; null: not wanted
  /// @return none: no point is inside, or none is deeper than `known` to the resolution
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
