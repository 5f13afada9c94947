// The point of a solid's surface closest to a given point, exactly.
//
// A tree of boxes and floating lower and upper bounds of the distance to single triangles leave the few
// triangles that can be nearest. For each of them exact signs tell which corner, side or inner part has its
// nearest point: the merged feature of the solid. If more than one feature is left their distances are
// compared in rational numbers. Nothing is decided on a rounded distance.
#pragma once

#include <memory>

#include "geometry/boxes/box_tree.hpp"
#include "geometry/convex/contact_region.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

enum class PointPlace { outside, on_surface, inside };

struct ClosestPoint {
  Vector3 point;                  ///< m, correctly rounded
  double squared_distance = 0.0;  ///< m^2, correctly rounded
  /// Feature with the point in its relative interior: corner (dimension 0, index: the point of the mesh), edge or
  /// face of the Polyhedron. Of several equally near ones the one of lowest dimension, then lowest index; a face or
  /// edge has only one nearest point.
  ContactFeature feature;
  PointPlace place = PointPlace::outside;  ///< of the given point
};

/// A solid prepared for queries; keeps a copy of it. Constant after construction: may be used by many threads.
class ClosestPointFinder {
 public:
  explicit ClosestPointFinder(Polyhedron solid);
  ~ClosestPointFinder();
  ClosestPointFinder(ClosestPointFinder&&) noexcept;
  ClosestPointFinder& operator=(ClosestPointFinder&&) noexcept;

  [[nodiscard]] const Polyhedron& solid() const;
  /// Boxes of the triangles of the solid's mesh, one a leaf.
  [[nodiscard]] const BoxTree& triangle_boxes() const;
  /// @param x finite. @throws std::invalid_argument if it is not.
  [[nodiscard]] ClosestPoint find(const Vector3& x) const;
  /// The same without rational numbers: of features equally near within rounding error any one may be returned.
  [[nodiscard]] ClosestPoint find_any(const Vector3& x) const;

 private:
  class Surface;
  std::unique_ptr<const Surface> surface_;
};

}  // namespace ashlar
