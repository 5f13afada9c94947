#include "mechanics/supports/loads.hpp"

#include <stdexcept>

#include "mechanics/basis/quadrature.hpp"
#include "mechanics/supports/linear_rows.hpp"

namespace ashlar {

double History::at(double time) const {
  return times.empty() ? 1.0 : linear_between_rows(times, values, time);
}

bool History::changes_between(double start, double end) const {
  return rows_change_between(times, start, end);
}

/// Exact: the pressure is linear, and functions are polynomials.
static Eigen::MatrixX3d pressure_coefficients(const PolynomialBasis& basis,
                                              const std::vector<PressedPart>& parts) {
  const TriangleRule rule = triangle_rule(basis.order() + 1);
  std::vector<Vector3> points;
  std::vector<Vector3> forces;
  for (const PressedPart& part : parts) {
    const std::vector<Vector3>& corners = part.pressure.corners;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const double area = 0.5 * (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]).norm();
      for (std::size_t n = 0; n < rule.weights.size(); ++n) {
        const Vector3& share = rule.barycentric[n];
        points.emplace_back(share[0] * corners[0] + share[1] * corners[k] + share[2] * corners[k + 1]);
        forces.emplace_back(area * rule.weights[n] * part.pressure.at(points.back()) * part.direction);
      }
    }
  }
  const Eigen::Map<const Eigen::Matrix3Xd> matrix(forces.front().data(), 3,
                                                  static_cast<Eigen::Index>(forces.size()));
  return basis.values(points).transpose() * matrix.transpose();
}

Eigen::MatrixX3d load_coefficients(const Polyhedron& solid, const PolynomialBasis& basis, const Load& load) {
  if (!load.parts.empty()) return pressure_coefficients(basis, load.parts);
  if (const auto* point = std::get_if<Vector3>(&load.where)) {
    if (load.traction) throw std::invalid_argument("a traction needs a plane, not a point");
    return basis.values(*point) * load.vector.transpose();
  }
  const auto faces = faces_at(solid, load.where);
  if (faces.empty()) throw std::invalid_argument("no face of the block lies in the load's plane");
  const SurfaceRule rule = surface_rule(solid, faces, basis.order() + (load.field ? load.field_degree : 0));
  const Eigen::Map<const Eigen::VectorXd> weights(rule.weights.data(),
                                                  static_cast<Eigen::Index>(rule.weights.size()));
  if (load.field) {
    Eigen::MatrixX3d forces(weights.size(), 3);
    for (Eigen::Index k = 0; k < weights.size(); ++k)
      forces.row(k) = weights[k] * load.field(rule.points[static_cast<std::size_t>(k)]).transpose();
    return basis.values(rule.points).transpose() * forces;
  }
  const Eigen::VectorXd integral = basis.values(rule.points).transpose() * weights;
  const double scale = load.traction ? 1.0 : 1.0 / weights.sum();
  return scale * integral * load.vector.transpose();
}

}  // namespace ashlar
