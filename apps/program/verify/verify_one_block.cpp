#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "apps/program/verify/verification.hpp"
#include "apps/program/verify/verification_blocks.hpp"

namespace ashlar {
namespace {

/// Every case is run as given, and rotated and translated by this: results must transform likewise.
struct NamedPlacement : Placement {
  const char* name;
};

std::vector<NamedPlacement> placements() {
  return {{{}, ""}, {some_placement(), ", turned and moved"}};
}

Eigen::MatrixX3d rest_position(const BlockModel& block, const Vector3& gravity) {
  const auto position = block.equilibrium(gravity, 0.0);
  if (!position) throw std::runtime_error("the block is not held");
  return *position;
}

/// Clamped in one corner, supported against rotation in two more: three points transmit no self-equilibrated forces.
void hold_in_three_corners(BlockDefinition& block) {
  const auto& points = block.solid->mesh().points;
  const Vector3& first = points[0];
  std::size_t far = 1;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if ((points[k] - first).norm() > (points[far] - first).norm()) far = k;
  }
  const Vector3 along = (points[far] - first).normalized();
  std::size_t off = 1;
  const auto distance = [&](const Vector3& point) { return (point - first).cross(along).norm(); };
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (distance(points[k]) > distance(points[off])) off = k;
  }
  block.supports.push_back({first, {true, true, true}});
  // The far point may move along the line only as far as components allow: the component closest to the line is free.
  Eigen::Index axis = 0;
  along.cwiseAbs().maxCoeff(&axis);
  std::array<bool, 3> held = {true, true, true};
  held[static_cast<std::size_t>(axis)] = false;
  block.supports.push_back({points[far], held});
  const Vector3 normal = along.cross(points[off] - first);
  Eigen::Index across = 0;
  normal.cwiseAbs().maxCoeff(&across);
  std::array<bool, 3> third = {false, false, false};
  third[static_cast<std::size_t>(across)] = true;
  block.supports.push_back({points[off], third});
}

std::vector<VerificationCheck> stress_patch() {
  const Eigen::Matrix3d stress =
      1e6 * (Eigen::Matrix3d() << 3.0, 0.5, -0.2, 0.5, -1.0, 0.7, -0.2, 0.7, 2.0).finished();
  std::vector<VerificationCheck> checks;
  for (const auto& [name, solid] : {std::pair{"notched block", notched_block()}, {"hull", skew_hull()}}) {
    for (int order = 1; order <= 8; ++order) {
      BlockDefinition definition = define_block(solid, {2000, 2.5e9, 0.3}, order);
      hold_in_three_corners(definition);
      for (const PolyhedronFace& face : solid.faces()) {
        const Vector3& point = solid.mesh().points[static_cast<std::size_t>(face.loops[0][0])];
        const bool first_in_plane =
            std::none_of(definition.loads.begin(), definition.loads.end(), [&](const Load& load) {
              const Plane& plane = std::get<Plane>(load.where);
              return (plane.normal - face.normal).norm() < 1e-9 &&
                     std::abs(face.normal.dot(plane.point - point)) < 1e-9;
            });
        if (!first_in_plane) continue;
        definition.loads.push_back({Plane{point, face.normal}, true, stress * face.normal, {}});
      }
      const BlockModel block(std::move(definition));
      BlockState state = block.initial_state();
      state.position = rest_position(block, Vector3::Zero());
      double worst = 0.0;
      for (const Vector3& point : solid.mesh().points)
        worst = std::max(worst, (block.stress(state, point) - stress).norm() / stress.norm());
      checks.push_back(
          check_absolute(fmt::format("relative error of stress, {}, n = {}", name, order), worst, 0.0, 1e-9));
    }
  }
  return checks;
}

std::vector<VerificationCheck> pure_bending() {
  const double curvature = 1e-4, modulus = 3e9, ratio = 0.25;
  std::vector<VerificationCheck> checks;
  for (const int order : {2, 3, 5, 8}) {
    const BlockModel block(
        define_block(Polyhedron(make_box({-2, -0.5, -0.4}, {2, 0.5, 0.4})), {2000, modulus, ratio}, order));
    const auto field = [&](const Vector3& x) {
      return Vector3(-curvature * x.x() * x.z(), ratio * curvature * x.y() * x.z(),
                     0.5 * curvature * (x.x() * x.x() + ratio * (x.z() * x.z() - x.y() * x.y())));
    };
    // Coefficients of the field from its values, by least squares on a grid: the field is in the function space.
    std::vector<Vector3> points;
    for (int i = 0; i <= 12; ++i) {
      for (int j = 0; j <= 12; ++j) {
        for (int k = 0; k <= 12; ++k) points.emplace_back(-2 + i / 3.0, -0.5 + j / 12.0, -0.4 + k / 15.0);
      }
    }
    const Eigen::MatrixXd phi = block.basis().values(points);
    Eigen::MatrixX3d values(phi.rows(), 3);
    for (Eigen::Index k = 0; k < phi.rows(); ++k) values.row(k) = field(points[static_cast<std::size_t>(k)]);
    BlockState state = block.initial_state();
    state.position += phi.colPivHouseholderQr().solve(values);
    double worst = 0.0;
    double scale = 0.0;
    for (const Vector3& point : points) {
      Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
      expected(0, 0) = -modulus * curvature * point.z();
      worst = std::max(worst, (block.stress(state, point) - expected).norm());
      scale = std::max(scale, std::abs(expected(0, 0)));
    }
    checks.push_back(
        check_absolute(fmt::format("relative error of stress, n = {}", order), worst / scale, 0.0, 1e-8));
    // In equilibrium with tractions on the ends alone: the internal force equals their work-conjugate force.
    Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(block.basis().size(), 3);
    for (const double side : {-1.0, 1.0}) {
      const Plane end{{2 * side, 0, 0}, {1, 0, 0}};
      const SurfaceRule rule = surface_rule(block.solid(), faces_in_plane(block.solid(), end), 2 * order);
      for (std::size_t k = 0; k < rule.points.size(); ++k) {
        force.col(0) += rule.weights[k] * side * -modulus * curvature * rule.points[k].z() *
                        block.basis().values(rule.points[k]);
      }
    }
    checks.push_back(check_absolute(fmt::format("relative imbalance of forces, n = {}", order),
                                    (block.elastic(state.position).force - force).norm() / force.norm(), 0.0,
                                    1e-8));
  }
  return checks;
}

std::vector<VerificationCheck> self_weight_column() {
  const double density = 2500, length = 10, modulus = 1e8, gravity = 9.81;
  const double exact = density * gravity * length * length / (2.0 * modulus);
  std::vector<VerificationCheck> checks;
  for (const NamedPlacement& placement : placements()) {
    for (const int order : {2, 3, 5, 8}) {
      const Polyhedron column(make_box({0, 0, 0}, {1, 1.5, length}));
      BlockDefinition definition = define_block(placed(column, placement), {density, modulus, 0.0}, order);
      definition.supports.push_back({Plane{placement.shift, placement.turn * Vector3::UnitZ()}});
      const BlockModel block(std::move(definition));
      const Vector3 down = placement.turn * Vector3(0, 0, -1);
      const Vector3 top = placement.point({0.5, 0.75, length});
      const double settled = down.dot(displacement(block, rest_position(block, gravity * down), top));
      checks.push_back(check_relative(
          fmt::format("settlement of the top, n = {}{}, m", order, placement.name), settled, exact, 1e-9));
    }
  }
  return checks;
}

/// The reference cantilever: 8 by 3 by 1, clamped at x = 0.
BlockDefinition cantilever(int order, double ratio, const Placement& placement) {
  const Polyhedron box(make_box({0, -1.5, -0.5}, {8, 1.5, 0.5}));
  BlockDefinition definition = define_block(placed(box, placement), {3600, 1e9, ratio}, order);
  definition.supports.push_back({Plane{placement.shift, placement.turn * Vector3(-1, 0, 0)}});
  return definition;
}

struct CantileverReference {
  double ratio;
  int order;
  double value;
};

std::vector<VerificationCheck> cantilever_end_load() {
  const std::array<CantileverReference, 6> references = {{{0.0, 1, 0.00533333},
                                                          {0.0, 2, 0.51733333},
                                                          {0.0, 3, 0.68800000},
                                                          {0.2, 2, 0.4672000},
                                                          {0.2, 3, 0.6386072},
                                                          {0.2, 5, 0.6737756}}};
  std::vector<VerificationCheck> checks;
  for (const NamedPlacement& placement : placements()) {
    for (const auto& [ratio, order, value] : references) {
      BlockDefinition definition = cantilever(order, ratio, placement);
      const Vector3 down = placement.turn * Vector3(0, 0, -1);
      const Vector3 end = placement.point({8, 0, 0});
      definition.loads.push_back({Plane{end, placement.turn * Vector3::UnitX()}, false, 1e6 * down, {}});
      const BlockModel block(std::move(definition));
      const double deflection = down.dot(displacement(block, rest_position(block, Vector3::Zero()), end));
      checks.push_back(
          check_relative(fmt::format("deflection, nu = {}, n = {}{}, m", ratio, order, placement.name),
                         deflection, value, 1e-6));
    }
  }
  return checks;
}

std::vector<VerificationCheck> cantilever_self_weight() {
  const std::array<CantileverReference, 4> references = {
      {{0.0, 1, 0.002260224}, {0.0, 2, 0.146914560}, {0.0, 3, 0.219241728}, {0.2, 3, 0.2017689}}};
  std::vector<VerificationCheck> checks;
  for (const NamedPlacement& placement : placements()) {
    for (const auto& [ratio, order, value] : references) {
      const BlockModel block(cantilever(order, ratio, placement));
      const Vector3 down = placement.turn * Vector3(0, 0, -1);
      const Vector3 end = placement.point({8, 0, 0});
      const double deflection = down.dot(displacement(block, rest_position(block, 9.81 * down), end));
      checks.push_back(
          check_relative(fmt::format("deflection, nu = {}, n = {}{}, m", ratio, order, placement.name),
                         deflection, value, 1e-6));
    }
  }
  return checks;
}

std::vector<VerificationCheck> cantilever_frequencies() {
  const std::array<CantileverReference, 4> references = {
      {{0.0, 2, 1.6698}, {0.0, 3, 1.3245}, {0.0, 5, 1.3171}, {0.2, 3, 1.3830}}};
  std::vector<VerificationCheck> checks;
  for (const NamedPlacement& placement : placements()) {
    for (const auto& [ratio, order, value] : references) {
      const BlockModel block(cantilever(order, ratio, placement));
      // The mass matrix is rho I.
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(block.tangent(Eigen::Matrix3d::Identity()),
                                                                 Eigen::EigenvaluesOnly);
      const double frequency =
          std::sqrt(modes.eigenvalues()[0] / block.material().density) / (2.0 * std::numbers::pi);
      checks.push_back(check_relative(fmt::format("f1, nu = {}, n = {}{}, Hz", ratio, order, placement.name),
                                      frequency, value, 1e-4));
    }
  }
  return checks;
}

/// Torsional stiffness GJ of a bar from the least energy of displacements (-t z y, t z x, w), w free: the warping is
/// found among the polynomials of the block's order.
double torsional_constant(double a, double b, int order) {
  const double length = 1.0, twist = 1e-3, modulus = 2.6e9, ratio = 0.3;
  const BlockModel block(define_block(
      Polyhedron(make_box({-0.5 * a, -0.5 * b, 0}, {0.5 * a, 0.5 * b, length})), {1, modulus, ratio}, order));
  const Eigen::Index p = block.basis().size();
  const Eigen::MatrixXd stiffness = elastic_stiffness(block.basis(), block.material());
  std::vector<Vector3> points;
  for (int i = 0; i <= order + 2; ++i) {
    for (int j = 0; j <= order + 2; ++j) {
      for (int k = 0; k <= order + 2; ++k) {
        const double share = 1.0 / (order + 2);
        points.emplace_back(a * (i * share - 0.5), b * (j * share - 0.5), length * k * share);
      }
    }
  }
  const Eigen::MatrixXd phi = block.basis().values(points);
  Eigen::MatrixXd values(phi.rows(), 2);
  for (Eigen::Index k = 0; k < phi.rows(); ++k) {
    const Vector3& x = points[static_cast<std::size_t>(k)];
    values.row(k) << -twist * x.z() * x.y(), twist * x.z() * x.x();
  }
  const Eigen::MatrixXd across = phi.colPivHouseholderQr().solve(values);
  const Eigen::VectorXd given = Eigen::Map<const Eigen::VectorXd>(across.data(), 2 * p);
  const auto kzz = stiffness.bottomRightCorner(p, p);
  const Eigen::VectorXd load = -stiffness.bottomLeftCorner(p, 2 * p) * given;
  const Eigen::VectorXd warping = kzz.completeOrthogonalDecomposition().solve(load);
  const double energy =
      0.5 * given.dot(stiffness.topLeftCorner(2 * p, 2 * p) * given) - 0.5 * warping.dot(load);
  return 2.0 * energy / (twist * twist * length * block.material().lame_mu());
}

std::vector<VerificationCheck> torsion_bar() {
  const double a = 0.2;
  return {check_relative("k1 of a square bar", torsional_constant(a, a, 6) / std::pow(a, 4), 0.14058, 0.01),
          check_relative("k1 of a bar with sides 1 : 2",
                         torsional_constant(2 * a, a, 6) / (2 * a * std::pow(a, 3)), 0.22868, 0.01)};
}

/// A slender strip clamped at x = 0, bent by a couple of two forces +-F x of constant direction, at the upper and the
/// lower edge of its end. There is no resultant force, so that the moment is constant: M = F h cos(angle of the end),
/// and the strip is an arc of radius E I / M: angle = F h L cos(angle) / (E I). Such a couple cannot rotate the end
/// beyond 90 degrees; that would need follower forces, which loads are not.
std::vector<VerificationCheck> large_rotation_cantilever() {
  const double length = 10.0, height = 0.25, modulus = 1e9;
  const double stiffness = modulus * std::pow(height, 4) / 12.0;
  std::vector<VerificationCheck> checks;
  for (const double degrees : {30.0, 60.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const double force = stiffness * angle / (height * length * std::cos(angle));
    for (const NamedPlacement& placement : placements()) {
      const Polyhedron strip(
          make_box({0, -0.5 * height, -0.5 * height}, {length, 0.5 * height, 0.5 * height}));
      BlockDefinition definition =
          define_block(placed(strip, placement), {2000, modulus, 0.0, Elasticity::st_venant_kirchhoff}, 4);
      const auto place = [&](const Vector3& point) { return placement.point(point); };
      definition.supports.push_back({Plane{place({0, 0, 0}), placement.turn * Vector3(-1, 0, 0)}});
      for (const double side : {-1.0, 1.0}) {
        definition.loads.push_back({place({length, 0, 0.5 * side * height}),
                                    false,
                                    placement.turn * Vector3(-side * force, 0, 0),
                                    {}});
      }
      const BlockModel block(std::move(definition));
      const Eigen::MatrixX3d position = rest_position(block, Vector3::Zero());
      const Vector3 point = place({length, 0, 0});
      const Vector3 end =
          placement.turn.transpose() * (position.transpose() * block.basis().values(point) - placement.shift);
      const Vector3 along = placement.turn.transpose() * position.transpose() *
                            block.basis().gradients(point) * placement.turn.col(0);
      const double radius = length / angle;
      const auto add = [&](const char* what, double measured, double reference) {
        checks.push_back(check_relative(fmt::format("{}, {} degrees, n = 4{}", what, degrees, placement.name),
                                        measured, reference, 1e-2));
      };
      add("rotation of the end", std::atan2(along.z(), along.x()), angle);
      add("x of the end", end.x(), radius * std::sin(angle));
      add("z of the end", end.z(), radius * (1.0 - std::cos(angle)));
    }
  }
  return checks;
}

constexpr std::array<VerificationCase, 8> one_block_case_list = {{
    {"stress-patch", "uniform traction on polyhedra of order 1 to 8 gives uniform stress", stress_patch},
    {"pure-bending", "the stress of pure bending, and its equilibrium", pure_bending},
    {"self-weight-column", "a column settles under its own weight", self_weight_column},
    {"cantilever-end-load", "deflection of the cantilever 8 x 3 x 1 under 1 MN of end shear",
     cantilever_end_load},
    {"cantilever-self-weight", "deflection of the cantilever under its own weight", cantilever_self_weight},
    {"cantilever-frequencies", "first natural frequency of the cantilever", cantilever_frequencies},
    {"torsion-bar", "torsional stiffness of rectangular bars", torsion_bar},
    {"large-rotation-cantilever", "a slender strip bent to an arc by a couple at its end",
     large_rotation_cantilever},
}};

}  // namespace

std::span<const VerificationCase> one_block_cases() {
  return one_block_case_list;
}

}  // namespace ashlar
