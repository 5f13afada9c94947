// The exact contact type of two triangles, without its region: the question asked millions of times.
#pragma once

#include <Eigen/Core>
#include <array>

#include "geometry/contact_type.hpp"

namespace ashlar {

/// Corners of a triangle in space, not collinear, m.
using TriangleCorners = std::array<Eigen::Vector3d, 3>;

struct TrianglePairType {
  Relation relation = Relation::apart;
  ContactType type = ContactType::vertex_vertex;
  int a_dimension = 0;  ///< of the carriers
  int b_dimension = 0;
  int region_dimension = 0;

  friend bool operator==(const TrianglePairType&, const TrianglePairType&) = default;
};

/// The same answer as classify() for the two shapes (convex_contact.hpp). A floating guess is certified by
/// static error bounds; where they do not suffice classify() is asked.
/// @throws std::invalid_argument for collinear or non-finite points, if classify() had to be asked.
[[nodiscard]] TrianglePairType classify_triangles(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace ashlar
