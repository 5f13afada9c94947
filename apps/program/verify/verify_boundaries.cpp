// Cases of boundaries that do not reflect. Scenes are read as users write them: a column of tied blocks, 40 m high, on
// a quiet base; its sides allow a plane wave along it, P or S.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_scenes.hpp"
#include "apps/scene/build/initial_state.hpp"

namespace ashlar {
namespace {

constexpr double soil_density = 2000.0, shear_speed = 200.0, column_height = 40.0;
constexpr double pulse_time = 0.1;  // s, of a pulse
/// Poisson's ratio 1/4: lambda = mu, c_p = sqrt(3) c_s, E = 2.5 mu.
constexpr double shear_modulus = soil_density * shear_speed * shear_speed;

enum class Wave { pressure, shear };

double speed(Wave wave) {
  return wave == Wave::shear ? shear_speed : std::sqrt(3.0) * shear_speed;
}
/// Axis of the motion of a wave along z.
int axis_of(Wave wave) {
  return wave == Wave::shear ? 0 : 2;
}
const char* name_of(Wave wave) {
  return wave == Wave::shear ? "S" : "P";
}

/// A pulse of height 1 that begins at 0: sin^2.
double pulse(double time) {
  if (time <= 0.0 || time >= pulse_time) return 0.0;
  const double sine = std::sin(std::numbers::pi * time / pulse_time);
  return sine * sine;
}

std::string along(Wave wave, double value) {
  return wave == Wave::shear ? fmt::format("{:.17g}, 0, 0", value) : fmt::format("0, 0, {:.17g}", value);
}

std::string header(double time_step, const char* analysis) {
  return fmt::format(
      "[analysis]\nend_time = 10\ntime_step = {}\nintegrator = \"average-acceleration\"\n{}\n"
      "[[material]]\nname = \"soil\"\ndensity = {}\nyoung_modulus = {:.17g}\npoisson_ratio = 0.25\n",
      time_step, analysis, soil_density, 2.5 * shear_modulus);
}

constexpr const char* quiet_base =
    "[[boundary]]\nplane = { point = [0, 0, 0], normal = [0, 0, -1] }\nkind = \"quiet\"\n";

/// Supports of the sides that leave a plane wave along z.
std::string sides_for(Wave wave) {
  std::string sides;
  for (const int axis : {0, 1})
    for (const double side : {0.0, 4.0})
      sides += fmt::format(
          "[[block.fix]]\nplane = {{ point = [{0}, {0}, 0], normal = [{1}, {2}, 0] }}\ncomponents = {3}\n",
          side, 1 - axis, axis, wave == Wave::shear ? "[\"y\", \"z\"]" : "[\"x\", \"y\"]");
  return sides;
}

/// Ten tied blocks on each other.
std::string column(Wave wave) {
  return "[[joint]]\nblocks = [\"*\", \"*\"]\ntied = true\n"
         "[[block]]\nname = \"soil\"\nmaterial = \"soil\"\norder = 3\n"
         "box = { min = [0, 0, 0], max = [4, 4, 4] }\narray = { count = [10], step = [[0, 0, 4]] }\n" +
         sides_for(wave);
}

/// Velocity of the column along the motion of a wave at a height.
double velocity_at(const Simulation& simulation, Wave wave, double z) {
  const auto block = static_cast<std::size_t>(std::min(z / 4.0, 9.0));
  return simulation.blocks()[block].motion_of(simulation.states()[block], {2, 2, z}).velocity[axis_of(wave)];
}

/// Takes steps until a time and tells each.
void run_until(Simulation& simulation, double time, const std::function<void()>& look) {
  while (!simulation.reached(time)) {
    if (simulation.step(time) != StepStatus::accepted) return;
    look();
  }
}

/// A traction pulse on the top goes down as a wave of velocity traction / (rho c), and nothing comes back.
std::vector<VerificationCheck> quiet_pulse() {
  std::vector<VerificationCheck> checks;
  for (const Wave wave : {Wave::pressure, Wave::shear}) {
    constexpr double velocity = 0.01;  // m/s
    std::string history;
    for (int k = 0; k <= 100; ++k)
      history += fmt::format("[{:.17g}, {:.17g}], ", k * pulse_time / 100, pulse(k * pulse_time / 100));
    std::string scene = header(1e-3, "gravity = [0, 0, 0]") + column(wave) + quiet_base;
    scene += fmt::format(
        "[[assign]]\nblocks = [\"soil.10\"]\n[[assign.load]]\n"
        "plane = {{ point = [0, 0, 40], normal = [0, 0, 1] }}\ntraction = [{}]\nhistory = [{}]\n",
        along(wave, soil_density * speed(wave) * velocity), history);
    Simulation simulation = simulation_of(scene);
    const double gone = column_height / speed(wave) + pulse_time;  // through the base
    double passing = 0.0, after = 0.0, energy = 0.0;
    run_until(simulation, gone + 0.02, [&] {
      passing = std::max(passing, std::abs(velocity_at(simulation, wave, 20.0)));
      energy = std::max(energy, simulation.ledger().kinetic + simulation.ledger().elastic);
    });
    const double left = simulation.ledger().kinetic + simulation.ledger().elastic;
    run_until(simulation, gone + 0.02 + column_height / speed(wave), [&] {
      for (const double z : {20.0, 40.0}) after = std::max(after, std::abs(velocity_at(simulation, wave, z)));
    });
    const std::string what = name_of(wave);
    checks.push_back(
        check_relative(what + ": velocity of the pulse half way down, m/s", passing, velocity, 0.01));
    checks.push_back(check_absolute(what + ": largest velocity once it has left, of the pulse",
                                    after / velocity, 0.0, 0.01));
    checks.push_back(
        check_absolute(what + ": energy once it has left, of the pulse", left / energy, 0.0, 0.01));
    checks.push_back(check_absolute(what + ": error of the ledger, of the pulse",
                                    simulation.ledger().residual / energy, 0.0, 1e-9));
  }
  return checks;
}

/// An upward wave v(t) at the base moves the free top by 2 v(t - H/c), goes down again, and leaves.
std::vector<VerificationCheck> wave_at_free_surface() {
  std::vector<VerificationCheck> checks;
  for (const Wave wave : {Wave::pressure, Wave::shear}) {
    constexpr double velocity = 0.01;  // m/s
    std::string rows;
    for (int k = 0; k <= 100; ++k) {
      const double time = k * pulse_time / 100;
      rows += fmt::format("[{:.17g}, {}], ", time, along(wave, velocity * pulse(time)));
    }
    const std::string scene =
        header(1e-3, "gravity = [0, 0, 0]") + column(wave) + quiet_base + fmt::format("wave = [{}]\n", rows);
    Simulation simulation = simulation_of(scene);
    const double up = column_height / speed(wave);
    double largest = 0.0, error = 0.0, after = 0.0;
    run_until(simulation, up + pulse_time, [&] {
      const double top = velocity_at(simulation, wave, column_height);
      largest = std::max(largest, std::abs(top));
      error = std::max(error, std::abs(top - 2.0 * velocity * pulse(simulation.time() - up)));
    });
    run_until(simulation, 2.0 * up + pulse_time + 0.02, [] {});
    run_until(simulation, 3.0 * up + 2.0 * pulse_time, [&] {
      for (const double z : {0.0, 20.0, 40.0})
        after = std::max(after, std::abs(velocity_at(simulation, wave, z)));
    });
    const std::string what = name_of(wave);
    checks.push_back(
        check_relative(what + ": largest velocity of the free surface, m/s", largest, 2.0 * velocity, 0.01));
    checks.push_back(check_absolute(what + ": error of its velocity over time, of the largest",
                                    error / (2.0 * velocity), 0.0, 0.01));
    checks.push_back(check_absolute(what + ": largest velocity once it has left, of the wave",
                                    after / velocity, 0.0, 0.01));
  }
  return checks;
}

/// Blocks under gravity settle by statics on the base, which is held then. Released, the reaction stays. A part f of the
/// weight that it lacks moves the column by f t / (rho c A): with springs the residual of statics, with multipliers
/// their accuracy.
std::vector<VerificationCheck> settled_column(const std::string& what, const char* springs, double accuracy) {
  std::string scene = header(1e-3, "initial_state = \"static\"");
  scene += fmt::format("[contact]\nfriction_angle = 30\n{}", springs);
  for (int k = 0; k < 5; ++k)
    scene += fmt::format(
        "[[block]]\nname = \"{}\"\nmaterial = \"soil\"\norder = 2\nbox = {{ min = [0, 0, {}], max = [4, 4, "
        "{}] }}\n",
        k, 4 * k, 4 * k + 4);
  Simulation simulation = simulation_of(scene + quiet_base);
  const StaticStart start = start_in_statics(simulation, [] { return true; });
  const auto places = [&] {
    std::vector<Vector3> result;
    for (std::size_t k = 0; k < 5; ++k)
      for (const double z : {0.0, 4.0})
        result.push_back(simulation.blocks()[k]
                             .motion_of(simulation.states()[k], {1, 1, 4.0 * static_cast<double>(k) + z})
                             .place);
    return result;
  };
  const std::vector<Vector3> settled = places();
  double moved = 0.0;
  run_until(simulation, 0.5, [&] {
    const std::vector<Vector3> now = places();
    for (std::size_t k = 0; k < now.size(); ++k) moved = std::max(moved, (now[k] - settled[k]).norm());
  });
  const BlockModel& base = simulation.blocks()[0];
  const Vector3 reaction = std::sqrt(base.basis().volume()) * base.reaction().row(0).transpose();
  return {
      check_absolute(what + ": blocks without equilibrium before the motion",
                     start.message.empty() ? 0.0 : 1.0, 0.0, 0.0),
      check_relative(what + ": reaction of the base, N", reaction.z(), soil_density * 9.81 * 16.0 * 20.0,
                     accuracy),
      check_absolute(what + ": motion in 0.5 s, of the settlement", moved / (20.0 - settled.back().z()), 0.0,
                     10.0 * accuracy),
  };
}

std::vector<VerificationCheck> static_reaction() {
  std::vector<VerificationCheck> checks =
      settled_column("springs", "normal_stiffness = 1e11\nshear_stiffness = 1e11\n", 1e-9);
  for (VerificationCheck& check : settled_column("multipliers", "", 1e-5)) checks.push_back(std::move(check));
  return checks;
}

/// A soft layer on a stiff one, both wide, between free-field sides. A wave w(t) at the base passes into the soft layer
/// with T = 2 Z2 / (Z1 + Z2) and comes back from below with r = (Z1 - Z2) / (Z1 + Z2):
///   v(top) = 2 T sum over k of r^k w(t - H2/c2 - (2 k + 1) H1/c1)
std::vector<VerificationCheck> free_field_sides() {
  constexpr double soft_speed = 100.0, soft_height = 8.0, stiff_height = 12.0, velocity = 0.01, slower = 2.0;
  std::string scene = header(1e-3, "gravity = [0, 0, 0]");
  scene += fmt::format(
      "[[material]]\nname = \"soft\"\ndensity = {}\nyoung_modulus = {:.17g}\npoisson_ratio = 0.25\n",
      soil_density, 2.5 * soil_density * soft_speed * soft_speed);
  scene += "[[joint]]\nblocks = [\"*\", \"*\"]\ntied = true\n";
  for (int layer = 0; layer < 5; ++layer)
    scene += fmt::format(
        "[[block]]\nname = \"layer{0}\"\nmaterial = \"{1}\"\norder = 3\nbox = {{ min = [0, 0, {2}], max = "
        "[8, 4, "
        "{3}] }}\narray = {{ count = [4], step = [[8, 0, 0]] }}\n[[block.fix]]\nplane = {{ point = [0, 0, "
        "0], normal "
        "= [0, 1, 0] }}\ncomponents = [\"y\"]\n[[block.fix]]\nplane = {{ point = [0, 4, 0], normal = [0, 1, "
        "0] "
        "}}\ncomponents = [\"y\"]\n",
        layer, layer < 3 ? "soil" : "soft", 4 * layer, 4 * layer + 4);
  std::string rows;
  for (int k = 0; k <= 100; ++k) {
    const double time = k * pulse_time / 100;
    rows += fmt::format("[{:.17g}, {}], ", slower * time, along(Wave::shear, velocity * pulse(time)));
  }
  scene += quiet_base + fmt::format("wave = [{}]\n", rows);
  for (const double x : {0.0, 32.0})
    scene += fmt::format(
        "[[boundary]]\nplane = {{ point = [{}, 0, 0], normal = [{}, 0, 0] }}\nkind = \"free-field\"\n", x,
        x > 0.0 ? 1 : -1);
  Simulation simulation = simulation_of(scene);
  const auto reference = [&](double time) {
    const double first = time - stiff_height / shear_speed - soft_height / soft_speed;
    const double reflected = (soft_speed - shear_speed) / (soft_speed + shear_speed);
    double sum = 0.0, part = 2.0 * 2.0 * shear_speed / (soft_speed + shear_speed) * velocity;
    for (int k = 0; k < 10; ++k, part *= reflected)
      sum += part * pulse((first - 2.0 * k * soft_height / soft_speed) / slower);
    return sum;
  };
  double largest = 0.0, of_sides = 0.0, of_middle = 0.0, stray = 0.0;
  run_until(simulation, 0.8, [&] {
    const double expected = reference(simulation.time());
    largest = std::max(largest, std::abs(expected));
    for (const double x : {0.0, 15.0, 32.0}) {
      const auto block = 16 + static_cast<std::size_t>(std::min(x / 8.0, 3.0));
      const Vector3 found =
          simulation.blocks()[block].motion_of(simulation.states()[block], {x, 2, 20}).velocity;
      double& error = x == 15.0 ? of_middle : of_sides;
      error = std::max(error, std::abs(found.x() - expected));
      stray = std::max(stray, std::abs(found.z()));
    }
  });
  return {
      check_absolute("error of the velocity in the middle of the top, of the largest", of_middle / largest,
                     0.0, 0.01),
      check_absolute("error of the velocity at the sides of the top, of the largest", of_sides / largest, 0.0,
                     0.01),
      check_absolute("largest vertical velocity of the top, of the largest", stray / largest, 0.0, 0.01),
  };
}

constexpr VerificationCase boundary_case_list[] = {
    {"quiet-pulse", "pulses that leave a column through its quiet base", quiet_pulse},
    {"wave-free-surface", "an upward wave at a quiet base, and the free surface", wave_at_free_surface},
    {"quiet-static", "a column at rest on a quiet base keeps its reaction", static_reaction},
    {"free-field-sides", "two wide layers between free-field sides move like a column", free_field_sides},
};

}  // namespace

std::span<const VerificationCase> boundary_cases() {
  return boundary_case_list;
}

}  // namespace ashlar
