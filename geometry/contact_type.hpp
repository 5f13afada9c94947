// The words for the exact contact of two bodies. Contact points have types of their own (mechanics).
#pragma once

#include <string_view>

namespace ashlar {

/// Relation of two closed convex sets, decided exactly.
enum class Relation {
  apart,     ///< positive distance
  touching,  ///< distance zero, no common inner point
  crossing,  ///< common inner points (two triangles: their planes differ and inner points meet)
};

/// The exact type {a, b} of a contact: the dimensions of the faces that carry the contact region, lower one
/// first.
enum class ContactType {
  vertex_vertex,  ///< region a point; at distance zero the normal is history's choice
  vertex_edge,    ///< region a point; at distance zero the normal is history's choice
  vertex_face,    ///< region a point; normal of the facet
  edge_edge,      ///< region a point (skew or crossing: normal u x v) or, parallel, a segment
  edge_face,      ///< region a segment; normal of the facet
  face_face,      ///< region a polygon; common normal
  crossing,       ///< region a solid (two triangles: a segment)
};

/// Dimensions of the faces that carry one vertex of a contact region, that on A first. The first seven occur
/// for contacts; those with a solid or a facet crossed by an edge only for crossings.
enum class PairKind {
  vertex_vertex,  ///< two corners coincide (in the projection along the contact direction)
  vertex_edge,    ///< a corner of A on an edge of B
  edge_vertex,    ///< an edge of A under a corner of B
  edge_edge,      ///< two edges cross in inner points
  vertex_face,    ///< a corner of A over a facet of B
  face_vertex,    ///< a corner of B over a facet of A
  edge_face,      ///< crossing: an edge of A pierces a facet of B
  face_edge,      ///< crossing: an edge of B pierces a facet of A
  vertex_solid,   ///< crossing: a corner of A inside B
  solid_vertex,   ///< crossing: a corner of B inside A
};

/// The type with carriers of dimensions a and b (each 0, 1 or 2), in any order.
/// @throws std::logic_error for a dimension outside 0..2.
[[nodiscard]] ContactType contact_type(int a_dim, int b_dim);

/// @throws std::logic_error for a pair that no region vertex has.
[[nodiscard]] PairKind pair_kind(int a_dim, int b_dim);

/// "apart", "touching", "crossing".
[[nodiscard]] std::string_view to_string(Relation relation);
/// "V-V", "V-E", "V-F", "E-E", "E-F", "F-F", "crossing".
[[nodiscard]] std::string_view to_string(ContactType type);
/// "V-V", "V-E", "E-V", "E-E", "V-F", "F-V", "E-F", "F-E", "V-S", "S-V": A first.
[[nodiscard]] std::string_view to_string(PairKind kind);

}  // namespace ashlar
