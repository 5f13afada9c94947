// Defects of a triangle mesh that should bound a solid. All decisions are exact for the given doubles, without
// tolerance: a mesh is either valid or refused with the faulty elements.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Kinds of defects for which a mesh does not bound a solid.
enum class MeshDefectKind {
  empty,                ///< no points or no triangles
  non_finite_point,     ///< a coordinate is NaN or infinite
  index_out_of_range,   ///< a triangle names a point that does not exist
  degenerate_triangle,  ///< zero area: repeated index, repeated point or collinear points
  open_edge,            ///< an edge has one triangle only
  non_manifold_edge,    ///< an edge has more than two triangles
  inconsistent_edge,    ///< two neighbours run along their edge in the same direction (one is flipped)
  non_manifold_vertex,  ///< the triangles around a point form more than one fan
  fused_vertices,       ///< two different points have equal coordinates
  unused_vertex,        ///< a point belongs to no triangle
  self_intersection,    ///< two triangles meet elsewhere than in their common edge or point
  several_components,   ///< more than one closed surface, inner shells included
  inside_out,           ///< closed and consistent, but the volume is negative
  zero_volume,          ///< closed and consistent, but the volume is zero (or rounds to it)
  volume_overflow,      ///< closed and consistent, but the volume exceeds the largest double
};

/// The usual term for a defect, as printed to users ("open edge", ...).
[[nodiscard]] std::string to_string(MeshDefectKind kind);

/// One defect with the element it was found at.
struct MeshDefect {
  MeshDefectKind kind;
  std::string element;  ///< e.g. "edge 3-7 of triangle 12", in the numbering of the given mesh, from 0
};

/// Thrown when a mesh does not bound a solid; what() names the first defect and the number of others.
class MeshError : public std::runtime_error {
 public:
  explicit MeshError(std::vector<MeshDefect> defects);
  [[nodiscard]] const std::vector<MeshDefect>& defects() const { return defects_; }

 private:
  std::vector<MeshDefect> defects_;
};

/// All defects of a mesh, and data found for a valid one.
///
/// The search proceeds from cheap to costly checks: a bad coordinate or index ends it (nothing else can be decided);
/// zero area, connection and self-intersections are always checked; the volume is computed for closed and consistent
/// surfaces only. Points with equal coordinates count as one in the search for self-intersections, so that fused
/// vertices are not reported again as touching triangles.
struct MeshCheck {
  std::vector<MeshDefect>
      defects;             ///< at most `limit` of each kind, in the order of the enumeration's checks
  std::vector<int> twins;  ///< twins[3 t + k]: the half-edge opposite to the one from corner k of triangle t
                           ///< to the next corner; complete for a sound mesh only
  double volume = 0.0;     ///< m^3, correctly rounded; for a sound mesh only
};

/// Self-intersections of a mesh with other defects are searched in the first 100 pairs of near triangles
/// for each triangle (notes/overlapping_triangles.md). @param limit most defects listed of each kind, at
/// least 1.
[[nodiscard]] MeshCheck check_mesh(const TriangleMesh& mesh, std::size_t limit);

}  // namespace ashlar
