// Where a contact point is in a configuration of its two blocks, and along which directions its force acts
// (theory.md sections 6.4 and 6.5).
//
// The search decides which surfaces meet at a point, at the start of a step. Where they meet moves on:
//   face of a or b (the master)   the other block's point keeps its place in the material; its foot is the
//                                 closest point of the master's true surface, the normal is the one there
//   crossed edges                 the points where the two edges are nearest; the normal is across both
// Both material points are then on one normal, and
//
//   g = n . (x_a - x_b),   dg = n . (dx_a - dx_b)
//
// since the derivatives by the foot and by n vanish there: the rows of a point are the gradient of its gap.
//
// Blocks may be placed in each other by a known depth. With N the normal in the reference configuration, the gap
// of such blocks counts from there:
//
//   g = n . (x_a - x_b) + r,   r = -N . (X_a - X_b), between 0 and a bound
//
// r belongs to the two material points, so that the points touch without force where they were placed.
#pragma once

#include <vector>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// How a contact point came about.
enum class ContactPointType { face_face, vertex_face, edge_edge };

/// What a contact point takes its normal from.
enum class NormalSource {
  as_found,   ///< flat sub-faces of a block that bends: known at the start of the step only
  face_of_a,  ///< a is the master
  face_of_b,  ///< b is the master
  edges,      ///< two that cross
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
  Vector3 edge_a = Vector3::Zero();  ///< of crossed edges, from end to end, reference coordinates, m
  Vector3 edge_b = Vector3::Zero();
  double overlap = 0.0;  ///< m, >= 0: how deep the two material points were placed in each other
};

/// A vector by its components along normal, tangent 1 and tangent 2 of a point, and back.
[[nodiscard]] inline Vector3 in_frame(const ContactPoint& point, const Vector3& vector) {
  return {point.normal.dot(vector), point.tangent_1.dot(vector), point.tangent_2.dot(vector)};
}
[[nodiscard]] inline Vector3 out_of_frame(const ContactPoint& point, const Vector3& components) {
  return components[0] * point.normal + components[1] * point.tangent_1 + components[2] * point.tangent_2;
}

/// A block in a configuration that need not be that of a state: x(X) and d x / d X as the polynomials that they are.
class PlacedBlock {
 public:
  struct Local {
    Vector3 place;             ///< m
    Eigen::Matrix3d gradient;  ///< d x / d X
  };

  /// @param position (p, 3). Both are to live as long as this
  PlacedBlock(const BlockModel& model, const Eigen::MatrixX3d& position);

  [[nodiscard]] const BlockModel& model() const { return *model_; }
  /// Current place of a material point, m.
  [[nodiscard]] Vector3 place(const Vector3& material) const;
  /// At a material point. A block that bends takes as many products as there are functions, not their square.
  [[nodiscard]] Local at(const Vector3& material) const;

 private:
  const BlockModel* model_;
  const Eigen::MatrixX3d* position_;
  bool affine_;
  Local centroid_;  ///< of affine blocks
  Eigen::Matrix<double, Eigen::Dynamic, 9>
      coefficients_;  ///< of d x / d X, axis by axis; of blocks that bend
};

/// Whether the motion of a block is an affine map.
[[nodiscard]] bool is_affine(const BlockModel& model);

/// Puts the foot of the other block's point on a face of the master's true surface, with the normal there.
/// Gap and tangents are left as they are. @param face of the master
void set_foot(ContactPoint& point, const PlacedBlock& master, int face, bool master_is_a);

/// Sets gap and tangents of a point whose places and normal are known.
void complete(ContactPoint& point);

/// The contact point in another configuration of its blocks. The tangents turn with the normal and not about
/// it. A point whose normal is known at the start only, and one whose edges would cross farther beyond an end
/// than they are long, keep normal and material points.
[[nodiscard]] ContactPoint moved_to(const ContactPoint& point, const PlacedBlock& a, const PlacedBlock& b);
[[nodiscard]] std::vector<ContactPoint> moved_to(const std::vector<ContactPoint>& points,
                                                 const PlacedBlock& a, const PlacedBlock& b);

}  // namespace ashlar
