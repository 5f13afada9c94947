#include "mechanics/supports/loads.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace ashlar {

double History::at(double time) const {
  if (times.empty()) return 1.0;
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return values.front();
  if (after == times.end()) return values.back();
  const auto k = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

bool History::changes_between(double start, double end) const {
  return !times.empty() && times.front() < end && times.back() > start;
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
