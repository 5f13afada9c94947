// The contact report of two solids with the numbering of their meshes, printed by `ashlar contacts`.
//
// A solid whose mesh is exactly convex is represented by the exact set of its corners, edges and facets
// (convex_shape.hpp). A rotated copy of a convex solid is rarely convex in its rounded coordinates: some edges within
// its former facets are concave by rounding. Such a mesh is reported as the exact convex hull of its points, and the
// report says so. All other solids are reported as nonconvex.
#pragma once

#include <optional>
#include <stdexcept>
#include <vector>

#include "geometry/convex/convex_contact.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// A corner, edge or face of a solid as Polyhedron numbers it.
struct ReportedFeature {
  int dimension = -1;  ///< 0 corner, 1 edge, 2 face
  /// Point of the mesh, or index into edges() or faces(); -1: not one of them (see points).
  int index = -1;
  /// For index -1: the points of the mesh it joins (an edge or facet of the hull of a rounded mesh); empty
  /// for a side or polygon that only exists in the projection at a resolution.
  std::vector<int> points;

  friend bool operator==(const ReportedFeature&, const ReportedFeature&) = default;
};

enum class ReportedBody { a, b };

/// One contact point: a point of a body on a plane of the other. The numbers of exact contacts are correctly rounded.
/// At a resolution the plane is normal to the contact direction at the end of the body of the facet; each point has
/// its own gap, and foot and gap are computed from rounded numbers.
struct ReportedPoint {
  PairKind pair = PairKind::vertex_vertex;
  /// The body whose facet is the plane: that of the facet in `pair`, else a facet among the carriers of the whole
  /// contact (that of B if both are); empty if there is no facet.
  std::optional<ReportedBody> face_of;
  Vector3 point;         ///< on the other body (no facet: on A), m
  Vector3 foot;          ///< on the plane, under the point along the contact direction (no facet: on B), m
  Vector3 plane_point;   ///< a point of the plane, m
  Vector3 plane_normal;  ///< unit, out of the body of the facet (no facet: the contact normal, B to A)
  double gap = 0.0;      ///< m, negative in a crossing
};

/// One contact of a pair of features.
struct ReportedContact {
  ContactType type = ContactType::vertex_vertex;
  ReportedFeature a, b;
  int region_dimension = 0;
  /// m^2, of the polygon of the rounded points (solids that are not convex: correctly rounded); zero for
  /// points and segments
  double area = 0.0;
  std::vector<ReportedPoint> points;
  /// Solids that are not convex: each contact has its own distance (m^2, correctly rounded) and unit
  /// direction from B to A, zero where the touching features do not fix one (V-V, V-E, collinear edges).
  /// Convex ones have those of the report.
  double squared_distance = 0.0;
  Vector3 direction = Vector3::Zero();
};

/// Data for two convex solids only.
struct ConvexReport {
  ContactType type = ContactType::crossing;
  int a_dimension = -1, b_dimension = -1, region_dimension = -1;
  Vector3 direction;  ///< unit, from B to A
  DirectionRule rule = DirectionRule::closest_points;
  std::vector<Vector3> region;  ///< vertices of K on A, m; crossing: those of the common solid
};

struct ContactReport {
  Relation relation = Relation::apart;
  double squared_distance = 0.0;  ///< m^2, correctly rounded
  std::optional<ConvexReport> convex;
  std::vector<ReportedContact> contacts;  ///< empty if the solids cross, unless a resolution is given
  /// Convex solids that cross: m, correctly rounded, and the translations of A of that length that end the
  /// crossing; else zero and none.
  double depth = 0.0;
  std::vector<Vector3> minimal_translations;
  bool hull_of_a = false, hull_of_b = false;  ///< reported as the hull of a rounded mesh
  std::optional<Resolution> resolution;       ///< if given: that of type, region and contacts
  DecisionCounts decided_by;
};

/// A solid prepared for reports. Constant after construction.
class ReportedSolid {
 public:
  explicit ReportedSolid(Polyhedron solid);

  [[nodiscard]] const Polyhedron& solid() const { return solid_; }
  /// Its exact shape, or that of its hull; null if it is not convex.
  [[nodiscard]] const ConvexShape* shape() const { return shape_ ? &*shape_ : nullptr; }
  /// True if the shape is the hull of a mesh that is concave by rounding.
  [[nodiscard]] bool is_hull() const { return is_hull_; }
  /// The face of the mesh for a face of the shape.
  [[nodiscard]] ReportedFeature feature(const ContactFeature& of_shape) const;

 private:
  Polyhedron solid_;
  std::optional<ConvexShape> shape_;
  bool is_hull_ = false;
};

/// Thrown for a type at a contact angle if a solid is not convex.
class NotConvexError : public std::invalid_argument {
 public:
  NotConvexError() : invalid_argument("solid is not convex") {}
};

/// @param resolution if given, type, region and contacts are at this resolution instead of exact; for nonconvex
/// solids, all contacts up to its distance (zero: the exact report), each with its exact type.
/// @throws NotConvexError for a resolution with an angle if one of the two is not convex;
/// std::invalid_argument as classify_at().
[[nodiscard]] ContactReport report_contact(const ReportedSolid& a, const ReportedSolid& b,
                                           const std::optional<Resolution>& resolution = std::nullopt);

}  // namespace ashlar
