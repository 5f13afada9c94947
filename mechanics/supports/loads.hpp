// Tractions and forces on one block, with their histories in time. Gravity: BlockModel::external_force.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "mechanics/basis/basis.hpp"
#include "mechanics/supports/face_selection.hpp"
#include "mechanics/supports/linear_patch.hpp"

namespace ashlar {

/// A factor over time: linear between the points, constant before the first and after the last; 1 if there
/// are none.
struct History {
  std::vector<double> times;   ///< s, increasing
  std::vector<double> values;  ///< same number
  [[nodiscard]] double at(double time) const;
  /// True if the factor may differ between two times.
  [[nodiscard]] bool changes_between(double start, double end) const;
};

/// Pressure on a part of the surface.
struct PressedPart {
  LinearPatch pressure;  ///< Pa
  Vector3 direction;     ///< of the traction, unit length: inward for a pressure
};

/// A load of constant direction. `vector` is a traction (Pa) on the faces of a plane, or a force (N) distributed
/// evenly over them, or a force (N) at a material point.
struct Load {
  BlockPlace where;      ///< reference coordinates, m
  bool traction = true;  ///< on a plane: true Pa, false total N
  Vector3 vector = Vector3::Zero();
  History history;
  /// A traction that varies over the faces, Pa, in place of `vector`, by places (m). Polynomials of degree
  /// `field_degree` are integrated exactly
  std::function<Vector3(const Vector3&)> field = nullptr;
  std::vector<PressedPart> parts = {};  ///< not empty: in place of `where` and `vector`
  int field_degree = 4;                 ///< >= 0
  double factor = 1.0;                  ///< in addition to the history; set by BlockModel::set_load_factor
};

/// Work-conjugate coefficients: integral of C' f. @return (p, 3) at factor 1
/// @throws std::invalid_argument if a plane holds no face of the solid, or a traction is given for a point
[[nodiscard]] Eigen::MatrixX3d load_coefficients(const Polyhedron& solid, const PolynomialBasis& basis,
                                                 const Load& load);

}  // namespace ashlar
