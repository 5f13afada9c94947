// The contacts of two solids that need not be convex, feature by feature.
#pragma once

#include "geometry/contact_report.hpp"

namespace ashlar {

/// Relation, distance and contacts of two solids of any shape (solid_relation.hpp).
///
/// The nearest triangles are merged to the faces, edges and corners of the solids: one contact for each pair
/// of features, but none for a pair in the closure of another one. Contacts are listed at the least distance
/// only. Points are the vertices of the common region of two features: not those where only edges within flat
/// faces meet.
[[nodiscard]] ContactReport report_solids(const Polyhedron& a, const Polyhedron& b);

}  // namespace ashlar
