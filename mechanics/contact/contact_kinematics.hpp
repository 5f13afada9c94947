// Place of a contact point in a configuration of its two blocks, and the directions of its force (theory.md sections
// 6.4 and 6.5).
//
// The search determines the surfaces that meet at a point, at the start of a step. Their point of contact moves:
//   face of a or b (reference face)   the other block's point keeps its place in the material; its foot is the closest
//                                     point of the reference block's true surface, with the normal there
//   crossed edges                     the closest points of the two edges; the normal is normal to both
// Both material points are then on one normal, and
//
//   g = n . (x_a - x_b),   dg = n . (dx_a - dx_b)
//
// since the derivatives with respect to the foot and to n vanish there: the rows of a point are the gradient of its
// gap.
//
// Blocks may have a known initial overlap. With N the normal in the reference configuration, the gap of such blocks
// is relative to it:
//
//   g = n . (x_a - x_b) + r,   r = -N . (X_a - X_b), between 0 and a bound
//
// r belongs to the two material points, so that the points touch without force at their initial placement.
#pragma once

#include <vector>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Origin of a contact point.
enum class ContactPointType { face_face, vertex_face, edge_edge };

/// Source of the normal of a contact point.
enum class NormalSource {
  as_found,   ///< flat sub-faces of a block that bends: known at the start of the step only
  face_of_a,  ///< a has the reference face
  face_of_b,  ///< b has the reference face
  edges,      ///< two crossed edges
};

/// One point-to-face contact between blocks a and b.
struct ContactPoint {
  ContactPointType type;
  int face_a;  ///< faces of the polyhedra that meet here
  int face_b;
  Vector3 material_a;  ///< reference coordinates, m
  Vector3 material_b;
  Vector3 place_a;  ///< current coordinates, m
  Vector3 place_b;
  Vector3 normal;     ///< unit, out of b
  Vector3 tangent_1;  ///< with normal and tangent_2 a right-handed orthonormal frame
  Vector3 tangent_2;
  double gap;   ///< n . (x_a - x_b) + overlap, m
  double area;  ///< m^2
  NormalSource source = NormalSource::as_found;
  Vector3 edge_a = Vector3::Zero();  ///< for crossed edges, from end to end, reference coordinates, m
  Vector3 edge_b = Vector3::Zero();
  double overlap = 0.0;  ///< m, >= 0: initial overlap of the two material points
};

/// Components of a vector along normal, tangent 1 and tangent 2 of a point, and the inverse.
[[nodiscard]] inline Vector3 in_frame(const ContactPoint& point, const Vector3& vector) {
  return {point.normal.dot(vector), point.tangent_1.dot(vector), point.tangent_2.dot(vector)};
}
[[nodiscard]] inline Vector3 out_of_frame(const ContactPoint& point, const Vector3& components) {
  return components[0] * point.normal + components[1] * point.tangent_1 + components[2] * point.tangent_2;
}

/// A block in a configuration that need not be that of a state: the polynomials x(X) and d x / d X.
class PlacedBlock {
 public:
  struct Local {
    Vector3 place;             ///< m
    Eigen::Matrix3d gradient;  ///< d x / d X
  };

  /// @param position (p, 3). Both must outlive this
  PlacedBlock(const BlockModel& model, const Eigen::MatrixX3d& position);

  [[nodiscard]] const BlockModel& model() const { return *model_; }
  /// Current place of a material point, m.
  [[nodiscard]] Vector3 place(const Vector3& material) const;
  /// Place and gradient at a material point. The cost for a block that bends is linear in the number of functions,
  /// not quadratic.
  [[nodiscard]] Local at(const Vector3& material) const;

 private:
  const BlockModel* model_;
  const Eigen::MatrixX3d* position_;
  bool affine_;
  Local centroid_;  ///< for affine blocks
  Eigen::Matrix<double, Eigen::Dynamic, 9>
      coefficients_;  ///< of d x / d X, axis by axis; for blocks that bend
};

/// True if the motion of a block is an affine map.
[[nodiscard]] bool is_affine(const BlockModel& model);

/// Sets the foot of the other block's point on a face of the reference block's true surface, and the normal there.
/// Gap and tangents are unchanged. @param face of the reference block
void set_foot(ContactPoint& point, const PlacedBlock& master, int face, bool master_is_a);

/// Sets gap and tangents of a point whose places and normal are known.
void complete(ContactPoint& point);

/// The contact point in another configuration of its blocks. The tangents follow the normal without spin about it.
/// Normal and material points are kept if the normal is known at the start only, or if the edges would cross beyond
/// an end by more than their length.
[[nodiscard]] ContactPoint moved_to(const ContactPoint& point, const PlacedBlock& a, const PlacedBlock& b);
[[nodiscard]] std::vector<ContactPoint> moved_to(const std::vector<ContactPoint>& points,
                                                 const PlacedBlock& a, const PlacedBlock& b);

}  // namespace ashlar
