#include "mechanics/supports/quiet_faces.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ashlar {

Eigen::Matrix3d impedance(const Material& material, const Vector3& normal) {
  const double along = std::sqrt(material.density * (material.lame_lambda() + 2.0 * material.lame_mu()));
  const double across = std::sqrt(material.density * material.lame_mu());
  return across * Eigen::Matrix3d::Identity() + (along - across) * normal * normal.transpose();
}

Eigen::MatrixXd dashpot_matrix(const Polyhedron& solid, const PolynomialBasis& basis,
                               const Material& material, const std::vector<QuietFaces>& quiet) {
  const Eigen::Index p = basis.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * p, 3 * p);
  for (const QuietFaces& entry : quiet) {
    const std::vector<int> faces = faces_at(solid, entry.where);
    if (faces.empty()) throw std::invalid_argument("no face of the block lies in the quiet plane");
    for (const int face : faces) {
      const SurfaceRule rule = surface_rule(solid, {face}, 2 * basis.order());
      const Eigen::Map<const Eigen::VectorXd> weights(rule.weights.data(),
                                                      static_cast<Eigen::Index>(rule.weights.size()));
      const Eigen::MatrixXd phi = basis.values(rule.points);
      const Eigen::MatrixXd products = phi.transpose() * weights.asDiagonal() * phi;
      const Eigen::Matrix3d resistance =
          impedance(material, solid.faces()[static_cast<std::size_t>(face)].normal);
      for (Eigen::Index i = 0; i < 3; ++i)
        for (Eigen::Index j = 0; j < 3; ++j) matrix.block(i * p, j * p, p, p) += resistance(i, j) * products;
    }
  }
  return matrix;
}

std::vector<Load> wave_loads(const Polyhedron& solid, const std::vector<int>& faces, const Material& material,
                             const WaveVelocity& velocity) {
  std::vector<Load> loads;
  if (faces.empty()) return loads;
  const Eigen::Matrix3d resistance =
      impedance(material, solid.faces()[static_cast<std::size_t>(faces.front())].normal);
  for (int axis = 0; axis < 3; ++axis) {
    const History& history = velocity[static_cast<std::size_t>(axis)];
    if (std::all_of(history.values.begin(), history.values.end(), [](double v) { return v == 0.0; }))
      continue;
    loads.push_back({FaceList{faces}, true, 2.0 * resistance.col(axis), history});
  }
  return loads;
}

std::vector<int> outer_faces(const Polyhedron& solid, const Plane& plane) {
  std::vector<int> faces = faces_in_plane(solid, plane);
  std::erase_if(faces, [&](int face) {
    return solid.faces()[static_cast<std::size_t>(face)].normal.dot(plane.normal) <= 0.0;
  });
  return faces;
}

}  // namespace ashlar
