#include "mechanics/supports/loads.hpp"

#include <stdexcept>

#include "mechanics/supports/linear_rows.hpp"

namespace ashlar {

double History::at(double time) const {
  return times.empty() ? 1.0 : linear_between_rows(times, values, time);
}

bool History::changes_between(double start, double end) const {
  return rows_change_between(times, start, end);
}

Eigen::MatrixX3d load_coefficients(const Polyhedron& solid, const PolynomialBasis& basis, const Load& load) {
  if (const auto* point = std::get_if<Vector3>(&load.where)) {
    if (load.traction) throw std::invalid_argument("a traction needs a plane, not a point");
    return basis.values(*point) * load.vector.transpose();
  }
  const auto faces = faces_at(solid, load.where);
  if (faces.empty()) throw std::invalid_argument("no face of the block lies in the load's plane");
  const SurfaceRule rule = surface_rule(solid, faces, basis.order());
  const Eigen::Map<const Eigen::VectorXd> weights(rule.weights.data(),
                                                  static_cast<Eigen::Index>(rule.weights.size()));
  const Eigen::VectorXd integral = basis.values(rule.points).transpose() * weights;
  const double scale = load.traction ? 1.0 : 1.0 / weights.sum();
  return scale * integral * load.vector.transpose();
}

}  // namespace ashlar
