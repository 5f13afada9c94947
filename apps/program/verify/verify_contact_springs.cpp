// Cases of contact springs at rest: derivatives, uniform pressure, the six types of contact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>

#include "apps/program/verify/patch_test.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "solver/contact/contact_pair.hpp"

namespace ashlar {
namespace {

/// Numbers of a fixed stream, from -1 to 1.
class Numbers {
 public:
  double next() { return std::ldexp(static_cast<double>(engine_() >> 11U), -52) - 1.0; }
  Eigen::VectorXd vector(Eigen::Index size, double scale) {
    Eigen::VectorXd result(size);
    for (double& value : result) value = scale * next();
    return result;
  }

 private:
  std::mt19937_64 engine_{2010};
};

/// A contact point with any frame between points of two blocks, with a gap.
ContactPoint some_point(Numbers& numbers, const Vector3& center_a, const Vector3& center_b, double gap) {
  ContactPoint point{};
  point.material_a = center_a + 0.4 * Vector3(numbers.vector(3, 1.0));
  point.material_b = center_b + 0.4 * Vector3(numbers.vector(3, 1.0));
  const Vector3 other = numbers.vector(3, 1.0);
  point.normal = Vector3(numbers.vector(3, 1.0)).normalized();
  point.tangent_1 = point.normal.cross(other).normalized();
  point.tangent_2 = point.normal.cross(point.tangent_1);
  point.gap = gap;
  point.place_b = point.material_b;
  point.place_a = point.material_b + gap * point.normal;
  point.area = 0.7;
  return point;
}

/// Largest difference between a matrix and central differences of a function, over the largest entry.
double difference(const Eigen::MatrixXd& derivative, const std::function<Eigen::VectorXd(double, int)>& at,
                  double step) {
  Eigen::MatrixXd numeric(derivative.rows(), derivative.cols());
  for (Eigen::Index k = 0; k < derivative.cols(); ++k) {
    const int column = static_cast<int>(k);
    numeric.col(k) = (at(step, column) - at(-step, column)) / (2.0 * step);
  }
  return (numeric - derivative).cwiseAbs().maxCoeff() / derivative.cwiseAbs().maxCoeff();
}

/// Gradient of the spring energy and Hessian blocks Kii, Kij, Kjj against differences.
std::vector<VerificationCheck> pair_derivatives(const char* state, const JointLaw& law, double slip) {
  Numbers numbers;
  const Vector3 center_a(0.5, 0.5, 1.5), center_b(0.5, 0.5, 0.5);
  const BlockModel a(define_block(Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), {2500, 1e9, 0.2}, 2));
  const BlockModel b(define_block(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 3));
  BlockState state_a = a.initial_state();
  BlockState state_b = b.initial_state();
  std::vector<ContactPoint> points;
  std::vector<PointMemory> memory;
  for (int k = 0; k < 5; ++k) {
    points.push_back(some_point(numbers, center_a, center_b, -0.01));
    const Vector3 along = points.back().tangent_1 + numbers.next() * points.back().tangent_2;
    memory.push_back({slip * along, ContactState::locked, true});
  }
  const ContactPair pair({0, 1, {&a, &state_a, nullptr}, {&b, &state_b, nullptr}}, law, {points}, memory);
  const Eigen::VectorXd ya = numbers.vector(a.unknowns(), 1e-4);
  const Eigen::VectorXd yb = numbers.vector(b.unknowns(), 1e-4);
  const PairResponse response = pair.respond(ya, yb, false);
  const PairTangent tangent = pair.tangent(response);
  constexpr double step = 1e-5;
  const auto moved = [&](bool of_a, double by, int k) {
    Eigen::VectorXd za = ya, zb = yb;
    (of_a ? za : zb)[k] += by;
    return pair.respond(za, zb, false);
  };
  const auto forces = [&](bool of_a, bool on_a) {
    return [&, of_a, on_a](double by, int k) -> Eigen::VectorXd {
      const PairResponse result = moved(of_a, by, k);
      return -(on_a ? result.force_on_a : result.force_on_b);
    };
  };
  const auto check = [&](const char* what, double error) {
    return check_absolute(fmt::format("{}, {}", state, what), error, 0.0, 1e-6);
  };
  std::vector<VerificationCheck> checks;
  if (law.friction == 0.0 && law.cohesion > 1e6) {
    const auto energy = [&](bool of_a) {
      return [&, of_a](double by, int k) {
        return Eigen::VectorXd::Constant(1, ContactPair::energies(moved(of_a, by, k)).total());
      };
    };
    checks.push_back(
        check("force on i and energy", difference(-response.force_on_a.transpose(), energy(true), step)));
    checks.push_back(
        check("force on j and energy", difference(-response.force_on_b.transpose(), energy(false), step)));
  }
  checks.push_back(check("Kii", difference(tangent.aa, forces(true, true), step)));
  checks.push_back(check("Kij", difference(tangent.ab, forces(false, true), step)));
  checks.push_back(check("Kji", difference(tangent.ab.transpose(), forces(true, false), step)));
  checks.push_back(check("Kjj", difference(tangent.bb, forces(false, false), step)));
  return checks;
}

std::vector<VerificationCheck> contact_derivatives() {
  // Locked: the energy is quadratic. Sliding at a limit independent of the normal force: the part of the derivative
  // in the symmetric solution.
  auto checks = pair_derivatives("locked", {3e5, 2e5, 0.0, 1e9, 0.0, true}, 1e-3);
  const auto sliding = pair_derivatives("sliding", {3e5, 2e5, 0.0, 10.0, 0.0, true}, 1e-2);
  checks.insert(checks.end(), sliding.begin(), sliding.end());
  return checks;
}

std::vector<VerificationCheck> contact_patch() {
  std::vector<VerificationCheck> checks;
  for (const double nu : {0.0, 0.3}) {
    for (const int order : {1, 2, 3, 4, 6}) {
      PatchTest patch;
      patch.poisson_ratio = nu;
      patch.order = order;
      const PatchErrors errors = press(patch);
      const std::string where = fmt::format("nu {}, n = {}", nu, order);
      checks.push_back(check_absolute("stress over p, largest error, " + where, errors.stress, 0.0, 1e-9));
      checks.push_back(check_absolute("jump over p/kn, largest error, " + where, errors.jump, 0.0, 1e-9));
    }
  }
  return checks;
}

std::vector<VerificationCheck> contact_patch_point() {
  std::vector<VerificationCheck> checks;
  constexpr double reported = std::numeric_limits<double>::infinity();
  for (int order = 1; order <= 4; ++order) {
    PatchTest patch;
    patch.order = order;
    patch.area_springs = false;
    const PatchErrors errors = press(patch);
    checks.push_back(check_absolute(fmt::format("stress over p, largest error, nu 0.3, n = {}", order),
                                    errors.stress, 0.0, reported));
  }
  return checks;
}

/// A block that can only move vertically, and its support.
struct Rest {
  const char* name;
  std::vector<Vector3> upper;
  std::vector<Vector3> lower;
  int springs;  ///< number of vertical springs that carry it; 0: springs along the normals of the faces
                ///< adjacent to the edge or vertex
};

std::vector<VerificationCheck> resting_six_types() {
  const std::vector<Vector3> box = {{-.5, -.5, 0}, {.5, -.5, 0}, {-.5, .5, 0}, {.5, .5, 0},
                                    {-.5, -.5, 1}, {.5, -.5, 1}, {-.5, .5, 1}, {.5, .5, 1}};
  const std::vector<Vector3> ridge = {{-.5, 0, 0},  {.5, 0, 0},   {-.5, -.5, 1},
                                      {.5, -.5, 1}, {-.5, .5, 1}, {.5, .5, 1}};
  const std::vector<Vector3> tip = {{0, 0, 0}, {-.5, -.5, 1}, {.5, -.5, 1}, {-.5, .5, 1}, {.5, .5, 1}};
  const auto slab = [](double x, double y) {
    return std::vector<Vector3>{{-2, -2, -1}, {x, -2, -1}, {-2, y, -1}, {x, y, -1},
                                {-2, -2, 0},  {x, -2, 0},  {-2, y, 0},  {x, y, 0}};
  };
  const std::vector<Vector3> roof = {{0, -.5, 0},   {0, .5, 0},    {-.5, -.5, -1},
                                     {.5, -.5, -1}, {-.5, .5, -1}, {.5, .5, -1}};
  std::vector<VerificationCheck> checks;
  for (const Rest& rest :
       {Rest{"face on face", box, slab(2, 2), 4}, Rest{"edge on face", ridge, slab(2, 2), 2},
        Rest{"vertex on face", tip, slab(2, 2), 1}, Rest{"crossed edges", ridge, roof, 1},
        Rest{"vertex on edge", tip, slab(0, 2), 0}, Rest{"vertex on vertex", tip, slab(0, 0), 0}}) {
    constexpr double kn = 1e7;
    ContactScene scene;
    *scene.law = {kn, 0.0, 0.0, 0.0, 0.0, false};
    scene.settings.area_springs = false;
    scene.add_fixed(hull_of(rest.lower));
    // A ten-thousandth above, so that it approaches from above for any face adjacent to the edge or vertex below.
    std::vector<Vector3> upper = rest.upper;
    for (Vector3& point : upper) point.z() += 1e-4;
    BlockDefinition block = define_block(hull_of(upper), {2500, 1e9, 0.2}, 1);
    const double level = 1.0 + 1e-4;
    block.supports.push_back({Plane{{0, 0, level}, Vector3::UnitZ()}, {true, true, false}});
    block.supports.push_back({upper[0], {true, true, false}});
    scene.add(std::move(block));
    Simulation simulation = scene.build();
    const double weight = simulation.blocks()[1].mass() * 9.81;
    const bool found =
        find_equilibrium(simulation) == StaticStatus::equilibrium && !simulation.contacts().empty();
    const double nan = std::nan("");
    const double force = found ? -force_on_a(simulation.contacts()[0]).z() : nan;
    checks.push_back(check_relative(fmt::format("{}: contact force, N", rest.name), force, weight, 1e-8));
    // Springs along inclined normals carry the weight with k n_z^2 each.
    double upright = 0.0;
    for (const PairRecord& record : simulation.contacts()) {
      for (std::size_t k = 0; k < record.points.size(); ++k) {
        if (record.responses[k].state != ContactState::open)
          upright += kn * record.points[k].normal.z() * record.points[k].normal.z();
      }
    }
    const double settled =
        -simulation.blocks()[1].motion_of(simulation.states()[1], {0, 0, 1e-4}).displacement.z() - 1e-4;
    checks.push_back(check_relative(fmt::format("{}: settlement, m", rest.name), found ? settled : nan,
                                    weight / upright, 1e-8));
    if (rest.springs == 0) continue;
    checks.push_back(check_relative(fmt::format("{}: penetration, m", rest.name),
                                    found ? simulation.report().penetration : nan,
                                    weight / (rest.springs * kn), 1e-8));
  }
  return checks;
}

/// Two blocks in uniform pressure and shear on a clamped base, through a joint in sticking contact: shear tractions
/// on the sides make the stress uniform. The loads are so small that changes of shape, of second order in the
/// strains, are below the tolerance.
Simulation sheared_blocks(int order, double height, double friction_angle) {
  constexpr double p = 2e4;
  constexpr double tau = 1e4;
  ContactScene scene;
  *scene.law = {1e10, 1e10, tangent_of(friction_angle), 0.0, 0.0, true};
  scene.settings.gravity.setZero();
  scene.settings.search.subdivisions = 0;
  scene.settings.search.chord_tolerance = 5e-3;
  for (const auto& [low, high] : {std::pair{0.0, 1.0}, std::pair{1.0, 1.0 + height}}) {
    BlockDefinition block =
        define_block(Polyhedron(make_box({0, 0, low}, {1, 1, high})), {2500, 1e10, 0.0}, order);
    for (const double side : {0.0, 1.0})
      block.loads.push_back(
          {Plane{{side, 0, 0}, Vector3::UnitX()}, true, {0, 0, side > 0.0 ? tau : -tau}, {}});
    const Plane end{{0, 0, low > 0.0 ? high : 0.0}, Vector3::UnitZ()};
    if (low > 0.0)
      block.loads.push_back({end, true, {tau, 0, -p}, {}});
    else
      block.supports.push_back({end, {true, true, true}});
    scene.add(std::move(block));
  }
  return scene.build();
}

/// No point slides if the exact solution has no sliding, independent of the path.
std::vector<VerificationCheck> shear_patch() {
  constexpr double p = 2e4;
  constexpr double tau = 1e4;
  constexpr double slip = tau / 1e10;
  std::vector<VerificationCheck> checks;
  for (const double height : {0.7, 1.0}) {
    for (int order = 1; order <= 4; ++order) {
      for (const double friction_angle : {28.0, 80.0}) {
        Simulation simulation = sheared_blocks(order, height, friction_angle);
        const bool found = find_equilibrium(simulation) == StaticStatus::equilibrium;
        const auto at = [&](std::size_t block, const Vector3& point) {
          return simulation.blocks()[block].motion_of(simulation.states()[block], point).displacement.x();
        };
        double stress_error = 0.0;
        for (const Vector3& point : {Vector3(0.9, 0.1, 0.9), Vector3(0.2, 0.7, 0.1)}) {
          for (const std::size_t block : {0U, 1U}) {
            const Vector3 place =
                block == 0 ? point : Vector3(point.x(), point.y(), 1.0 + height * point.z());
            Eigen::Matrix3d stress = simulation.blocks()[block].stress(simulation.states()[block], place);
            stress(2, 2) += p;
            stress(0, 2) -= tau;
            stress(2, 0) -= tau;
            stress_error = std::max(stress_error, stress.cwiseAbs().maxCoeff() / tau);
          }
        }
        const std::string name = fmt::format("height {}, order {}, phi {}", height, order, friction_angle);
        const Vector3 middle(0.5, 0.5, 1.0);
        checks.push_back(check_relative(fmt::format("{}: slip, m", name),
                                        found ? at(1, middle) - at(0, middle) : std::nan(""), slip, 1e-4));
        checks.push_back(
            check_absolute(fmt::format("{}: stress error over tau", name), stress_error, 0.0, 1e-4));
      }
    }
  }
  return checks;
}

constexpr VerificationCase contact_spring_case_list[] = {
    {"contact-derivatives", "contact matrices against differences of forces and energies",
     contact_derivatives},
    {"contact-patch", "uniform pressure through a joint, area springs", contact_patch},
    {"contact-patch-point", "the same with point springs, error reported", contact_patch_point},
    {"shear-patch", "a joint in shear and pressure that all of it sticks", shear_patch},
    {"resting-six-types", "a block at rest on another by each type of contact", resting_six_types},
};

}  // namespace

std::span<const VerificationCase> contact_spring_cases() {
  return contact_spring_case_list;
}

}  // namespace ashlar
