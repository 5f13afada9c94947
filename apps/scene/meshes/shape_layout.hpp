// Shapes of a mesh file and their placements.
//
// 3MF, DXF and glTF files define a shape once and place it any number of times, in nested groups: 1 kB can represent
// 2^26 placements. So a reader counts the placements of a file before it makes any.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

/// Size of a file with all shapes placed. Counted in double, without overflow.
struct LayoutSize {
  double placements = 0.0;  ///< including groups, which place others
  double faces = 0.0;

  LayoutSize& operator+=(const LayoutSize& other);
};

/// Limits of the size. A solid has at least four faces, hence four faces for each placement. Time and memory of a
/// layout are proportional to them: about 400 bytes a face.
struct LayoutLimits {
  std::size_t faces = 1'000'000;
  std::size_t placements = 250'000;
};

/// Limits for a file of `bytes`: 50 faces per byte (at least 100,000) up to 1,000,000, beyond that one per byte.
[[nodiscard]] LayoutLimits layout_limits(std::size_t bytes);

/// Longest name of an object, in bytes.
inline constexpr std::size_t longest_object_name = 1000;

class ShapeLayout {
 public:
  /// Objects of one name: each a group, with a number appended after the first; or one group.
  enum class SameName { numbered, joined };

  ShapeLayout(SameName same_name, const LayoutLimits& limits) : same_name_(same_name), limits_(limits) {}

  /// @param shape faces of indices in range; unused points are removed. @return its index
  std::size_t add(PolygonSoup shape);

  [[nodiscard]] std::size_t faces(std::size_t shape) const { return shapes_[shape].face_count(); }

  /// @throws MeshFileError if the limits do not allow this size
  void require_room(const LayoutSize& size) const;

  /// Counts and stores a placement. Faces are reversed if the transformation is a reflection, so that the outside
  /// stays outside. A shape without faces is ignored.
  /// @param name of the object in the file; "object" if empty
  /// @throws MeshFileError: too many faces, a transformation that is singular or not finite, a name that is too long or
  /// has control characters
  void place(const std::string& name, std::size_t shape, const Eigen::Affine3d& transformation);

  /// One mesh of all objects, group after group. Equal points are merged. @throws MeshFileError "file has no faces",
  /// a coordinate beyond largest_coordinate, or as triangulated
  [[nodiscard]] TriangleMesh whole() const;

  /// A mesh for each group, in the order of their first placements; equal points of a group are merged. @throws as
  /// whole
  [[nodiscard]] std::vector<MeshGroup> groups() const;

 private:
  struct Placement {
    std::size_t name;  ///< in names_
    std::size_t shape;
    Eigen::Affine3d transformation;
    bool mirrored;
  };
  struct Group {
    std::string name;
    std::vector<std::size_t> placements;
  };

  [[nodiscard]] std::vector<Group> grouped() const;
  void append(const Placement& placement, PolygonSoup& soup) const;
  void require_faces() const;

  SameName same_name_;
  LayoutLimits limits_;
  std::vector<PolygonSoup> shapes_;
  std::vector<std::string> names_;  ///< each once
  std::map<std::string, std::size_t> number_of_name_;
  std::vector<Placement> placements_;
  LayoutSize size_;
};

/// Points used by any face, in their order. @param soup indices in range
[[nodiscard]] PolygonSoup only_used_points(PolygonSoup soup);

/// Replaces equal points by the first of them. @param soup without NaN
[[nodiscard]] PolygonSoup equal_points_joined(PolygonSoup soup);

}  // namespace ashlar
