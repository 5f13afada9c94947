#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "apps/program/verify/verification.hpp"
#include "apps/program/verify/verification_blocks.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "mechanics/basis/moments.hpp"

namespace ashlar {
namespace {

std::vector<VerificationCheck> moments_tetrahedron() {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}}};
  constexpr int degree = 24;
  const auto values = moments(mesh, degree);
  const auto factorial = [](int k) { return std::tgamma(k + 1.0); };
  double worst = 0.0;
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    const double exact = factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
    const double value = values[static_cast<std::size_t>(monomial_index(a, b, c))];
    worst = std::max(worst, std::abs(value - exact) / exact);
  }
  return {check_absolute("largest relative error, a + b + c <= 24", worst, 0.0, 1e-14)};
}

std::vector<VerificationCheck> free_fall() {
  std::vector<VerificationCheck> checks;
  SimulationSettings settings;
  settings.time_step = 0.01;
  const double time = 1.0;
  for (const auto& [name, solid] : {std::pair{"notched block", notched_block()}, {"hull", skew_hull()}}) {
    for (const int order : {1, 3, 6}) {
      Simulation simulation = lone_block(define_block(solid, {2500, 1e9, 0.2}, order), {}, settings);
      while (!simulation.reached(time)) take_step(simulation, time);
      const BlockModel& block = simulation.blocks()[0];
      double fallen = 0.0;
      double worst = -1.0;
      for (const Vector3& point : block.solid().mesh().points) {
        const double z = -displacement(block, simulation.states()[0].position, point).z();
        const double error = std::abs(z - 0.5 * 9.81);
        if (error <= worst) continue;
        worst = error;
        fallen = z;
      }
      checks.push_back(check_relative(fmt::format("fall of a corner, {}, n = {}, m", name, order), fallen,
                                      0.5 * 9.81, 1e-12));
    }
  }
  return checks;
}

double volume_of(const BlockModel& block, const BlockState& state) {
  double volume = 0.0;
  const auto place = [&](int point) {
    return Vector3(state.position.transpose() *
                   block.basis().values(block.solid().mesh().points[static_cast<std::size_t>(point)]));
  };
  for (const auto& [a, b, c] : block.solid().mesh().triangles)
    volume += place(a).dot(place(b).cross(place(c))) / 6.0;
  return volume;
}

/// A box of volume 6 after one turn about z at 0.01 rad a step, n = 1.
double volume_after_turn(Formulation formulation) {
  SimulationSettings settings;
  settings.time_step = 0.01;
  settings.gravity.setZero();
  // Stiff, so that the centrifugal stretch rho w^2 L^2 / E is below the tolerance.
  BlockDefinition definition = define_block(Polyhedron(make_box({0, 0, 0}, {1, 2, 3})), {1, 1e12, 0.2}, 1);
  definition.formulation = formulation;
  Simulation simulation = lone_block(std::move(definition), {Vector3::Zero(), {0, 0, 1}}, settings);
  const double time = 2.0 * std::numbers::pi;
  while (!simulation.reached(time)) take_step(simulation, time);
  return volume_of(simulation.blocks()[0], simulation.states()[0]);
}

std::vector<VerificationCheck> spin_volume() {
  // 628 steps of t = 0.01 and the rest of the rotation, each with the factor 1 + t^2: the error of the incremental
  // formulation.
  const double rest = 2.0 * std::numbers::pi - 6.28;
  const double growth = std::pow(1.0 + 1e-4, 628) * (1.0 + rest * rest);
  return {check_relative("volume after a turn, m^3", volume_after_turn(Formulation::total), 6.0, 1e-10),
          check_relative("volume after a turn, incremental, m^3", volume_after_turn(Formulation::incremental),
                         6.0 * growth, 1e-9)};
}

std::vector<VerificationCheck> torque_free() {
  SimulationSettings settings;
  settings.time_step = 4e-3;
  settings.gravity.setZero();
  settings.integrator = Integrator::average_acceleration;
  // Centred, density 1, sides 1, 2, 3: principal moments 6.5, 5, 2.5.
  Simulation simulation =
      lone_block(define_block(Polyhedron(make_box({-0.5, -1, -1.5}, {0.5, 1, 1.5})), {1, 1e6, 0.2}, 1),
                 {Vector3::Zero(), {0.01, 1, 0.01}}, settings);
  const auto spin_about_middle_axis = [&] {
    const BlockModel& block = simulation.blocks()[0];
    const Eigen::Matrix3d gradient =
        simulation.states()[0].position.transpose() * mean_gradients(block.basis());
    const Eigen::Matrix3d rotation = polar_decomposition(gradient).rotation;
    return (rotation.transpose() * simulation.angular_momentum()).y() / 5.0;
  };
  std::vector<double> zeros;
  double worst = 0.0;
  double last = spin_about_middle_axis();
  while (!simulation.reached(62.0)) {
    take_step(simulation, 62.0);
    const double spin = spin_about_middle_axis();
    if ((spin > 0.0) != (last > 0.0))
      zeros.push_back(simulation.time() - simulation.report().step * spin / (spin - last));
    last = spin;
    worst = std::max(worst, std::abs(simulation.angular_momentum().norm() - 5.000485));
  }
  std::vector<VerificationCheck> checks;
  const std::array<double, 3> expected = {10.4848, 36.0356, 61.5864};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    checks.push_back(check_relative(fmt::format("time of zero {} of the middle spin, s", k + 1),
                                    k < zeros.size() ? zeros[k] : std::nan(""), expected[k], 0.01));
  }
  const double exact = std::sqrt(0.065 * 0.065 + 25.0 + 0.025 * 0.025);
  checks.push_back(
      check_relative("angular momentum at the end", simulation.angular_momentum().norm(), exact, 1e-8));
  return checks;
}

/// The mean under a Hann window: removes oscillations of several periods.
class WindowedMean {
 public:
  WindowedMean(double start, double end) : start_(start), end_(end) {}
  void add(double time, double value) {
    const double weight = 1.0 - std::cos(2.0 * std::numbers::pi * (time - start_) / (end_ - start_));
    sum_ += weight * value;
    weights_ += weight;
  }
  [[nodiscard]] double mean() const { return sum_ / weights_; }

 private:
  double start_;
  double end_;
  double sum_ = 0.0;
  double weights_ = 0.0;
};

std::vector<VerificationCheck> spinning_bar() {
  const double density = 8000.0, spin = 100.0, modulus = 200e9;
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.integrator = Integrator::average_acceleration;
  // The slowest stretching mode has a period of 4e-4 s. Elastic forces are evaluated at the middle of the chord of a
  // point's motion, (w dt)^2 / 8 closer to the axis: far below the strain of 3e-5.
  settings.time_step = 2.5e-6;
  Simulation simulation = lone_block(
      define_block(Polyhedron(make_box({-0.5, -0.05, -0.05}, {0.5, 0.05, 0.05})), {density, modulus, 0.0}, 3),
      {Vector3::Zero(), {0, 0, spin}}, settings);
  const BlockModel& block = simulation.blocks()[0];
  // Released without stretch the bar oscillates about its steady state, which is the mean over many periods.
  const double time = 8e-3;
  WindowedMean stress(0.0, time);
  WindowedMean length(0.0, time);
  while (!simulation.reached(time)) {
    take_step(simulation, time);
    const BlockState& state = simulation.states()[0];
    const auto place = [&](double x) {
      return Vector3(state.position.transpose() * block.basis().values(Vector3(x, 0, 0)));
    };
    const Vector3 along = (place(0.5) - place(-0.5)).normalized();
    stress.add(simulation.time(), along.dot(block.stress(state, Vector3::Zero()) * along));
    length.add(simulation.time(), (place(0.5) - place(-0.5)).norm());
  }
  return {
      check_relative("peak axial stress, Pa", stress.mean(), density * spin * spin / 8.0, 1e-3),
      check_relative("elongation, m", length.mean() - 1.0, density * spin * spin / (12.0 * modulus), 1e-3)};
}

std::vector<VerificationCheck> dda_damping() {
  // A bar clamped at one end with nu = 0 and n = 1 has one stretching mode, w^2 = 3 E / (rho L^2), excited by gravity
  // along it. With s_k = (u - u_rest, v), det(s_k, s_k+1) decreases by the squared spectral radius in each step.
  const double density = 2000.0, modulus = 1e8, length = 2.0, gravity = 10.0;
  const double frequency = std::sqrt(3.0 * modulus / density) / length;
  const double rest = density * gravity * length * length / (2.0 * modulus);
  std::vector<VerificationCheck> checks;
  for (const double omega : {0.1, 0.2, 0.5, 1.0}) {
    SimulationSettings settings;
    settings.gravity = {gravity, 0, 0};
    settings.time_step = omega / frequency;
    BlockDefinition bar =
        define_block(Polyhedron(make_box({0, 0, 0}, {length, 0.5, 0.5})), {density, modulus, 0.0}, 1);
    bar.supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
    Simulation simulation = lone_block(std::move(bar), {}, settings);
    const BlockModel& block = simulation.blocks()[0];
    const Vector3 end(length, 0.25, 0.25);
    const auto state = [&] {
      const BlockState& now = simulation.states()[0];
      return Eigen::Vector2d(displacement(block, now.position, end).x() - rest,
                             (now.velocity.transpose() * block.basis().values(end)).x() / frequency);
    };
    std::array<Eigen::Vector2d, 3> states;
    states[0] = state();
    for (std::size_t k = 1; k < states.size(); ++k) {
      take_step(simulation, 1e9);
      states[k] = state();
    }
    const auto determinant = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    const double radius = std::sqrt(determinant(states[1], states[2]) / determinant(states[0], states[1]));
    checks.push_back(check_relative(fmt::format("spectral radius at w dt = {}", omega), radius,
                                    1.0 / std::sqrt(1.0 + 0.5 * omega * omega), 1e-10));
  }
  return checks;
}

std::vector<VerificationCheck> collision_momentum() {
  std::vector<VerificationCheck> checks;
  for (const auto& [name, integrator] : {std::pair{"dda", Integrator::dda},
                                         {"average-acceleration", Integrator::average_acceleration},
                                         {"generalized-alpha", Integrator::generalized_alpha}}) {
    SimulationSettings settings;
    settings.gravity.setZero();
    settings.time_step = 2e-4;
    settings.integrator = integrator;
    const JointLaw law{1e9, 5e8, std::tan(0.5), 0.0, 0.0, true};
    std::vector<BlockModel> blocks;
    blocks.emplace_back(define_block(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2000, 1e8, 0.2}, 2));
    blocks.emplace_back(
        define_block(Polyhedron(make_box({1.05, 0.6, 0.3}, {2.05, 1.6, 1.3})), {2500, 1e8, 0.3}, 1));
    Simulation simulation(
        std::move(blocks), {{{3.0, 0.2, -0.1}, Vector3::Zero()}, {}}, [law](int, int) { return law; },
        settings);
    const Vector3 momentum = simulation.momentum();
    const Vector3 angular = simulation.angular_momentum();
    while (!simulation.reached(0.15)) take_step(simulation, 0.15);
    const double taken = simulation.blocks()[1].momentum(simulation.states()[1]).norm();
    if (taken < 0.1 * momentum.norm()) throw std::runtime_error("the blocks missed each other");
    checks.push_back(check_absolute(std::string("change of momentum, of its size, ") + name,
                                    (simulation.momentum() - momentum).norm() / momentum.norm(), 0.0, 1e-10));
    checks.push_back(check_absolute(std::string("change of angular momentum, of its size, ") + name,
                                    (simulation.angular_momentum() - angular).norm() / angular.norm(), 0.0,
                                    1e-6));
  }
  return checks;
}

constexpr std::array<VerificationCase, 7> kinematics_case_list = {{
    {"moments-tetrahedron", "moments of the unit tetrahedron against a! b! c! / (a+b+c+3)!",
     moments_tetrahedron},
    {"free-fall", "polyhedra of order 1, 3, 6 fall by g t^2 / 2", free_fall},
    {"spin-volume", "a block that turns by 0.01 rad a step keeps its volume", spin_volume},
    {"torque-free", "a box that tumbles about its middle axis", torque_free},
    {"spinning-bar", "stress and elongation of a bar that spins", spinning_bar},
    {"dda-damping", "spectral radius of the dda step for one elastic mode", dda_damping},
    {"collision-momentum", "two deformable blocks collide off-centre", collision_momentum},
}};

}  // namespace

std::span<const VerificationCase> kinematics_cases() {
  return kinematics_case_list;
}

}  // namespace ashlar
