// Outlines of drawings with a thickness: closed polylines in a plane z = constant, as prisms.
#pragma once

#include <vector>

#include "geometry/mesh/mesh_formats.hpp"

namespace ashlar {

/// A LWPOLYLINE, or a POLYLINE that is no mesh.
struct DxfOutline {
  std::vector<Vector3> points;  ///< z is not used
  double elevation = 0.0;       ///< z of the outline
  double thickness = 0.0;       ///< along z, of either sign; 0: a line
  bool closed = false;          ///< flag 1; an outline whose last point is its first one is closed too
  bool has_arcs = false;        ///< a bulge other than 0
  bool upward = true;           ///< direction (0, 0, 1)
  int line = 0;                 ///< in the file
};

/// Adds a polygon with points of its own.
void add_face(PolygonSoup& soup, const std::vector<Vector3>& corners);

/// Adds the faces of the prism, outward. Lines (without thickness, or open) are passed over.
/// @throws MeshFileError for arcs, another direction than (0, 0, 1), and less than three different corners
void add_prism(DxfOutline outline, PolygonSoup& soup);

}  // namespace ashlar
