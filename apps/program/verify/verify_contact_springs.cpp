// Matrices of contact springs against differences of forces and energies: they are in no result of a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>

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
constexpr VerificationCase contact_spring_case_list[] = {
    {"contact-derivatives", "contact matrices against differences of forces and energies",
     contact_derivatives},
};

}  // namespace

std::span<const VerificationCase> contact_spring_cases() {
  return contact_spring_case_list;
}

}  // namespace ashlar
