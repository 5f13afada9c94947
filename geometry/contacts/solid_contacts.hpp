// The contacts of two solids that need not be convex, feature by feature.
#pragma once

#include <optional>

#include "geometry/contacts/contact_report.hpp"

namespace ashlar {

/// Relation, distance and contacts of two solids of any shape (solid_relation.hpp, distance_minima.hpp): one contact
/// for each pair of merged faces, edges and corners at a local minimum of the distance, except pairs in the closure
/// of another one. The numbers are those of the exact contact, rounded once.
///
/// @param distance m, >= 0: all contacts up to this distance. Empty: those at the least distance, i.e. touching
/// contacts if the solids touch. Solids that cross have no contacts.
/// @throws std::invalid_argument for a negative or non-finite distance.
[[nodiscard]] ContactReport report_solids(const Polyhedron& a, const Polyhedron& b,
                                          const std::optional<double>& distance = std::nullopt);

}  // namespace ashlar
