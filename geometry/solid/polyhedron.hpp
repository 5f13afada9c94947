// A checked solid: closed, oriented outward, free of self-intersections, one component, with its coplanar
// triangles merged into faces and its collinear pieces into edges. Every block starts as one. Exact contact geometry
// refers to its merged faces, edges and corners, never to the triangles that carry them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/solid/mesh_defects.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A maximal flat piece of the boundary, connected over edges: coplanar pieces that touch in a point only are
/// two faces.
struct PolyhedronFace {
  Vector3 normal;              ///< unit, outward, rounded
  std::vector<int> triangles;  ///< indices into Polyhedron::mesh().triangles, increasing
  /// Corners in order; first the outer loop, counter-clockwise from outside, then holes, clockwise. Points
  /// inside straight sides are left out, so each step of a loop is one edge; a corner may still be straight
  /// where the neighbour across the side changes. No loop visits a corner twice: a hole that touches the
  /// outer loop in a corner is a loop of its own.
  std::vector<std::vector<int>> loops;
  bool convex;  ///< one loop without a reflex corner
};

/// A maximal straight piece between two faces.
struct PolyhedronEdge {
  std::array<int, 2> vertices;  ///< corners; the left face has it in this direction on its loop
  std::array<int, 2> faces;     ///< left and right face, never the same: a slit is a defect
  bool convex;                  ///< angle inside the solid below 180 degrees (exact)
};

/// Constant after construction.
class Polyhedron {
 public:
  /// Every defect of a mesh, at most `limit` of each kind; empty when it bounds a solid.
  [[nodiscard]] static std::vector<MeshDefect> find_defects(const TriangleMesh& mesh, std::size_t limit = 10);

  /// Builds a solid. @param resolution of the coordinates, m, >= 0. 0: they are exact, and so are flat and straight
  /// parts; otherwise parts that are flat within it are one face (flat_regions()).
  /// @throws MeshError carrying all defects, which are always decided exactly, if there are any.
  explicit Polyhedron(TriangleMesh mesh, double resolution = 0.0);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<PolyhedronFace>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<PolyhedronEdge>& edges() const { return edges_; }
  /// (#triangles): the face of each triangle.
  [[nodiscard]] const std::vector<int>& face_of_triangle() const { return face_of_triangle_; }
  /// Points that are end of at least one edge, increasing. Points inside flat faces or straight sides are not
  /// corners.
  [[nodiscard]] const std::vector<int>& corners() const { return corners_; }
  /// True if the solid is convex (exact).
  [[nodiscard]] bool convex() const { return convex_; }
  /// m^3, correctly rounded.
  [[nodiscard]] double volume() const { return volume_; }

  /// The same solid with its points moved and its faces, edges and corners kept as they are: a placed copy of
  /// an exactly modelled shape keeps its flat faces although rounding tilts their triangles by an ulp.
  /// @param points (#points), m: rotated, translated, scaled, or of a block that deformed, whose faces are
  /// then no longer planar; volume and normals are updated.
  /// @throws std::invalid_argument if the number of points differs, a value is not finite, or the volume is
  /// no longer positive and finite.
  [[nodiscard]] Polyhedron with_points(std::vector<Vector3> points) const;

  /// The same solid with its faces covered by other triangles; faces, edges and corners are kept, so that
  /// midpoints that rounding puts an ulp off a face make no new faces.
  /// @param mesh its points contain every corner bit for bit; closed, outward
  /// @param face_of_triangle (#triangles) indices into faces()
  /// @throws std::invalid_argument if a corner is missing or the sizes differ
  [[nodiscard]] Polyhedron with_triangles(TriangleMesh mesh, std::vector<int> face_of_triangle) const;

 private:
  TriangleMesh mesh_;
  std::vector<PolyhedronFace> faces_;
  std::vector<PolyhedronEdge> edges_;
  std::vector<int> face_of_triangle_;
  std::vector<int> corners_;
  bool convex_ = false;
  double volume_ = 0.0;
};

}  // namespace ashlar
