#include "mechanics/block/incremental_block.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "mechanics/material/symmetric_components.hpp"

namespace ashlar {
namespace {

std::array<double, 3> key_of(const Vector3& point) {
  return {point.x(), point.y(), point.z()};
}

/// Replaces a plane by the faces in it.
void name_faces(const Polyhedron& solid, BlockPlace& place, const char* what) {
  if (!std::holds_alternative<Plane>(place)) return;
  FaceList list{faces_in_plane(solid, std::get<Plane>(place))};
  if (list.faces.empty()) throw std::invalid_argument(what);
  place = std::move(list);
}

/// The solid with the surface's cells as its triangles.
Polyhedron solid_of_cells(const Polyhedron& solid, const SubFaceSurface& surface) {
  TriangleMesh mesh;
  mesh.points = surface.points;
  std::vector<int> faces;
  for (const SurfaceCell& cell : surface.cells) {
    mesh.triangles.push_back({cell.corners[0], cell.corners[1], cell.corners[2]});
    faces.push_back(cell.face);
  }
  return solid.with_triangles(std::move(mesh), std::move(faces));
}

}  // namespace

IncrementalForm::IncrementalForm(const BlockDefinition& definition) : definition_(definition) {
  definition_.shape = nullptr;
  if (definition.material.elasticity != Elasticity::linear)
    throw std::invalid_argument("the incremental formulation needs linear elasticity");
  const Polyhedron& solid = *definition.solid;
  for (BlockSupport& support : definition_.supports)
    name_faces(solid, support.where, "no face of the block lies in the support's plane");
  for (Load& load : definition_.loads)
    name_faces(solid, load.where, "no face of the block lies in the load's plane");
  if (definition.order >= 2) {
    surface_ = divide_surface(solid, definition.sub_face_levels);
    definition_.solid = std::make_shared<const Polyhedron>(solid_of_cells(solid, surface_));
  } else {
    surface_ = whole_surface(solid);
  }
  followed_ = definition.followed;
  for (const BlockSupport& support : definition_.supports) {
    if (const auto* point = std::get_if<Vector3>(&support.where)) followed_.push_back(*point);
  }
  for (const Load& load : definition_.loads) {
    if (const auto* point = std::get_if<Vector3>(&load.where)) followed_.push_back(*point);
  }
  int next = 0;
  for (const auto* points : {&surface_.points, &followed_}) {
    for (const Vector3& point : *points) index_.emplace(key_of(point), next++);
  }
}

CarriedShape IncrementalForm::start() const {
  return {surface_.points, followed_, Eigen::MatrixXd::Zero(polynomial_count(definition_.order), 6)};
}

BlockDefinition IncrementalForm::definition_at(const CarriedShape& shape) const {
  BlockDefinition now = definition_;
  now.solid = std::make_shared<const Polyhedron>(definition_.solid->with_points(shape.points));
  std::size_t next = definition_.followed.size();
  const auto move = [&](BlockPlace& place) {
    if (std::holds_alternative<Vector3>(place)) place = shape.followed.at(next++);
  };
  for (BlockSupport& support : now.supports) move(support.where);
  for (Load& load : now.loads) move(load.where);
  return now;
}

const Vector3& IncrementalForm::place(const CarriedShape& shape, const Vector3& reference) const {
  const auto found = index_.find(key_of(reference));
  if (found == index_.end()) throw std::invalid_argument("an incremental block has no such tracked point");
  const auto index = static_cast<std::size_t>(found->second);
  return index < shape.points.size() ? shape.points[index] : shape.followed[index - shape.points.size()];
}

Eigen::MatrixXd added_stress(const PolynomialBasis& basis, const Material& material,
                             const Eigen::MatrixX3d& change) {
  std::array<Eigen::MatrixX3d, 3> gradients;  // by the axis of the derivative
  for (int axis = 0; axis < 3; ++axis)
    gradients[static_cast<std::size_t>(axis)] = basis.derivative(axis).transpose() * change;
  Eigen::MatrixXd stress(basis.size(), 6);
  const Eigen::VectorXd trace = gradients[0].col(0) + gradients[1].col(1) + gradients[2].col(2);
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto& [i, j] = symmetric_components[static_cast<std::size_t>(k)];
    stress.col(k) = material.lame_mu() * (gradients[static_cast<std::size_t>(i)].col(j) +
                                          gradients[static_cast<std::size_t>(j)].col(i));
    if (i == j) stress.col(k) += material.lame_lambda() * trace;
  }
  return stress;
}

ElasticResponse incremental_response(const PolynomialBasis& basis, const Material& material,
                                     const Eigen::MatrixXd& stress, const Eigen::MatrixX3d& change) {
  const Eigen::MatrixXd total = stress + added_stress(basis, material, change);
  ElasticResponse response;
  response.rotation.setIdentity();
  response.force = Eigen::MatrixX3d::Zero(basis.size(), 3);
  double squares = 0.0;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto& [i, j] = symmetric_components[static_cast<std::size_t>(k)];
    response.force.col(j).noalias() += basis.derivative(i) * total.col(k);
    if (i != j) response.force.col(i).noalias() += basis.derivative(j) * total.col(k);
    squares += (i == j ? 1.0 : 2.0) * total.col(k).squaredNorm();
  }
  // sigma : inverse(C) sigma = ((1 + nu) sigma : sigma - nu tr(sigma)^2) / E
  const double nu = material.poisson_ratio;
  const double traces = (total.col(0) + total.col(1) + total.col(2)).squaredNorm();
  response.energy = 0.5 * ((1.0 + nu) * squares - nu * traces) / material.young_modulus;
  return response;
}

Eigen::Matrix3d incremental_stress(const Eigen::MatrixXd& stress, const Eigen::VectorXd& values) {
  const Eigen::VectorXd there = stress.transpose() * values;
  Eigen::Matrix3d result;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto& [i, j] = symmetric_components[static_cast<std::size_t>(k)];
    result(i, j) = result(j, i) = there[k];
  }
  return result;
}

Eigen::MatrixXd re_expansion(const PolynomialBasis& from, const PolynomialBasis& to, const Vector3& shift) {
  const std::vector<Vector3> points = to.sample_points();
  std::vector<Vector3> shifted;
  shifted.reserve(points.size());
  for (const Vector3& point : points) shifted.emplace_back(point - shift);
  return to.values(points).householderQr().solve(from.values(shifted));
}

}  // namespace ashlar
