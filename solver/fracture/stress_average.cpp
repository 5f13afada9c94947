#include "solver/fracture/stress_average.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/boxes/box.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "geometry/lexicographic.hpp"
#include "geometry/solid/solid_location.hpp"

namespace ashlar {
namespace {

/// Distance outside of a face that counts as inside, relative to the rounding errors that a solid may have.
constexpr double on_a_face = 1e-12;

constexpr double most_probes = 4000.0;   // about: inside and on the faces together
constexpr int points_per_radius = 3;     // of the rule for means, along each axis
constexpr double same_stress = 1e-3;     // share of the largest
constexpr double same_direction = 1e-6;  // components of a unit normal that are rounding errors

double area_of(const Polyhedron& solid) {
  double sum = 0.0;
  for (const auto& [a, b, c] : solid.mesh().triangles) {
    const std::vector<Vector3>& points = solid.mesh().points;
    sum += 0.5 * (points[at(b)] - points[at(a)]).cross(points[at(c)] - points[at(a)]).norm();
  }
  return sum;
}

/// Is a point in a solid?
class Inside {
 public:
  explicit Inside(const Polyhedron& solid) : solid_(solid), tolerance_(on_a_face * allowed_offset(solid)) {}

  bool operator()(const Vector3& point) const {
    if (!solid_.convex()) return is_inside(solid_.mesh(), point);
    return std::all_of(solid_.faces().begin(), solid_.faces().end(), [&](const PolyhedronFace& face) {
      const Vector3& corner = solid_.mesh().points[at(face.loops.front().front())];
      return face.normal.dot(point - corner) <= tolerance_;
    });
  }

 private:
  const Polyhedron& solid_;
  double tolerance_;  ///< m
};

/// Centres of cells of a lattice over the box of a solid, an odd number along each axis.
void add_inner_points(const Polyhedron& solid, double spacing, const Inside& inside,
                      std::vector<Vector3>& points) {
  const Box box = box_of(solid.mesh().points);
  std::array<int, 3> count{};
  for (int axis = 0; axis < 3; ++axis)
    count[at(axis)] = 2 * static_cast<int>(std::ceil(0.5 * (box.high - box.low)[axis] / spacing)) + 1;
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) {
        const Vector3 share((i + 0.5) / count[0], (j + 0.5) / count[1], (k + 0.5) / count[2]);
        const Vector3 point = box.low + share.cwiseProduct(box.high - box.low);
        if (inside(point)) points.push_back(point);
      }
}

void add_face_points(const Polyhedron& solid, double spacing, std::vector<Vector3>& points) {
  for (const auto& corners : solid.mesh().triangles) {
    const auto corner = [&](std::size_t k) { return solid.mesh().points[at(corners.at(k))]; };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int count = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
    for (int i = 0; i <= count; ++i)
      for (int j = 0; i + j <= count; ++j)
        points.emplace_back(a + static_cast<double>(i) / count * (b - a) +
                            static_cast<double>(j) / count * (c - a));
  }
}

/// Places of the rule of a mean, around zero.
std::vector<Vector3> ball_points(double radius) {
  std::vector<Vector3> points;
  const double step = radius / points_per_radius;
  for (int i = -points_per_radius; i < points_per_radius; ++i)
    for (int j = -points_per_radius; j < points_per_radius; ++j)
      for (int k = -points_per_radius; k < points_per_radius; ++k) {
        const Vector3 point = step * Vector3(i + 0.5, j + 0.5, k + 0.5);
        if (point.norm() <= radius) points.push_back(point);
      }
  return points;
}

/// Gradients seen from the frame of the block, from which stress and principal directions follow.
struct FramedGradients {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  std::array<Eigen::MatrixX3d, 3> derivatives;  ///< (#probes, 3), by axes of X

  [[nodiscard]] Eigen::Matrix3d at_probe(std::size_t probe) const {
    Eigen::Matrix3d gradient;
    for (int axis = 0; axis < 3; ++axis)
      gradient.col(axis) = derivatives[at(axis)].row(static_cast<Eigen::Index>(probe)).transpose();
    return gradient;
  }
};

/// As BlockModel::stress(): of a block with linear elasticity those of its displacement.
FramedGradients gradients_of(const BlockModel& block, const BlockState& state, const Eigen::MatrixXd& means) {
  FramedGradients result;
  const PolynomialBasis& basis = block.basis();
  if (block.corotational())
    result.rotation =
        polar_decomposition(state.position.transpose() * block.parts()->mean_gradients).rotation;
  Eigen::MatrixX3d field = state.position;
  if (!block.parts()->large) field = state.position * result.rotation - basis.identity_map();
  for (int axis = 0; axis < 3; ++axis)
    result.derivatives[at(axis)] =
        means * (basis.derivative(axis).triangularView<Eigen::Lower>().transpose() * field);
  return result;
}

/// Stress in the frame of the block; of a block with large strains in space.
Eigen::Matrix3d framed_stress(const BlockModel& block, const Eigen::Matrix3d& gradient) {
  return block.parts()->large ? st_venant_kirchhoff_stress(block.material(), gradient)
                              : linear_stress(block.material(), gradient, Eigen::Matrix3d::Identity());
}

/// Bound from above of the largest principal stress: mean plus 2/sqrt(3) sqrt(J2).
double bound_of_tension(const Eigen::Matrix3d& stress) {
  const double mean = stress.trace() / 3.0;
  const double squared_norm = (stress - mean * Eigen::Matrix3d::Identity()).squaredNorm();
  return mean + std::sqrt(2.0 / 3.0 * squared_norm);
}

/// Without components that are rounding errors; the first other one is positive.
Vector3 tidy_normal(Vector3 normal) {
  normal.normalize();
  for (double& component : normal)
    if (std::abs(component) < same_direction) component = 0.0;
  normal.normalize();
  for (const double component : normal)
    if (component != 0.0) return component > 0.0 ? normal : Vector3(-normal);
  return normal;
}

}  // namespace

StressProbes stress_probes(const BlockModel& block, double least_size) {
  const Polyhedron& solid = block.solid();
  const Inside inside(solid);
  const double spacing =
      std::max({0.5 * least_size, correctly_rounded::cbrt(2.0 * solid.volume() / most_probes),
                std::sqrt(2.0 * area_of(solid) / most_probes)});
  std::vector<Vector3> places = {block.basis().centroid()};
  if (!inside(places.front())) places.clear();
  add_inner_points(solid, spacing, inside, places);
  std::vector<Vector3> on_faces;
  add_face_points(solid, spacing, on_faces);
  std::sort(on_faces.begin(), on_faces.end(), lexicographically_less);
  on_faces.erase(std::unique(on_faces.begin(), on_faces.end()), on_faces.end());
  places.insert(places.end(), on_faces.begin(), on_faces.end());

  const std::vector<Vector3> ball = ball_points(0.5 * least_size);
  StressProbes probes;
  std::vector<Eigen::VectorXd> means;
  for (const Vector3& place : places) {
    std::vector<Vector3> near;
    for (const Vector3& offset : ball)
      if (inside(place + offset)) near.emplace_back(place + offset);
    // In an acute wedge, whose neighbours have means.
    if (near.empty()) continue;
    probes.points.push_back(place);
    means.emplace_back(block.basis().values(near).colwise().mean().transpose());
  }
  probes.means.resize(static_cast<Eigen::Index>(means.size()), block.basis().size());
  for (std::size_t k = 0; k < means.size(); ++k)
    probes.means.row(static_cast<Eigen::Index>(k)) = means[k].transpose();
  return probes;
}

std::optional<WeakPlace> weakest_place(const BlockModel& block, const BlockState& state,
                                       const StressProbes& probes, double strength) {
  const FramedGradients gradients = gradients_of(block, state, probes.means);
  struct Found {
    std::size_t probe;
    double stress;
    Vector3 direction;
  };
  std::vector<Found> found;
  double largest = strength;
  for (std::size_t k = 0; k < probes.points.size(); ++k) {
    const Eigen::Matrix3d stress = framed_stress(block, gradients.at_probe(k));
    if (!(bound_of_tension(stress) >= (1.0 - same_stress) * largest)) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(stress);
    const double tension = principal.eigenvalues()[2];
    if (!(tension >= (1.0 - same_stress) * largest)) continue;
    largest = std::max(largest, tension);
    found.push_back({k, tension, principal.eigenvectors().col(2)});
  }
  std::erase_if(found, [&](const Found& one) { return one.stress < (1.0 - same_stress) * largest; });
  const auto reaches = [&](const Found& one) { return one.stress >= strength; };
  if (std::none_of(found.begin(), found.end(), reaches)) return std::nullopt;
  const auto distance = [&](const Found& one) {
    return (probes.points[one.probe] - block.basis().centroid()).squaredNorm();
  };
  const auto nearest = std::min_element(
      found.begin(), found.end(), [&](const Found& x, const Found& y) { return distance(x) < distance(y); });
  // Planes follow the material: those across n in space are across F' n in the undeformed block.
  const Vector3 across = block.parts()->large
                             ? Vector3(gradients.at_probe(nearest->probe).transpose() * nearest->direction)
                             : nearest->direction;
  return WeakPlace{-1, {probes.points[nearest->probe], tidy_normal(across)}, nearest->stress};
}

Eigen::Matrix3d mean_stress(const BlockModel& block, const BlockState& state, const StressProbes& probes,
                            std::size_t probe) {
  const FramedGradients gradients =
      gradients_of(block, state, probes.means.row(static_cast<Eigen::Index>(probe)));
  return gradients.rotation * framed_stress(block, gradients.at_probe(0)) * gradients.rotation.transpose();
}

}  // namespace ashlar
