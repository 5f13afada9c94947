// Cases that other programs have published, with their numbers in
// apps/docs/peer_results.toml: contact that lifts or creeps there, assemblies
// that stand by forces alone, a wall whose reactions are known.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_scenes.hpp"
#include "solver/statics/limit_analysis.hpp"

namespace ashlar {
namespace {

constexpr double gravity = 9.81;

double angle_of(double friction) {
  return std::atan(friction) * 180.0 / std::numbers::pi;
}

int index_of(const Simulation& simulation, const std::string& name) {
  const std::vector<BlockModel>& blocks = simulation.blocks();
  const auto found = std::find_if(blocks.begin(), blocks.end(),
                                  [&](const BlockModel& block) { return block.name() == name; });
  return static_cast<int>(found - blocks.begin());
}

Vector3 place(const Simulation& simulation, int block, const Vector3& point) {
  const auto k = static_cast<std::size_t>(block);
  return simulation.states()[k].position.transpose() * simulation.blocks()[k].basis().values(point);
}

/// A cube of side a on a floor that begins at v along it. Friction stops it
/// after v^2 / (2 mu g). As mu < 1 it does not tip over: its sole stays on the
/// floor.
std::vector<VerificationCheck> sliding_cube() {
  constexpr double a = 0.1, v = 6.0, mu = 0.5;
  std::vector<VerificationCheck> checks;
  for (const auto& [order, step] : {std::pair{0, 5e-3}, {1, 5e-3}, {1, 1e-3}, {2, 1e-3}}) {
    Simulation simulation = simulation_of(fmt::format(R"(
analysis = {{ end_time = 1.5, time_step = {}, sleeping = false }}
contact = {{ friction_angle = {:.17g} }}
material = [{{ name = "m", density = 1000, young_modulus = 1e9, poisson_ratio = 0.2 }}]
block = [
  {{ name = "floor", fixed = true, box = {{ min = [-1, -1, -1], max = [6, 1, 0] }} }},
  {{ name = "cube", material = "m", order = {}, velocity = [{}, 0, 0], box = {{ min = [0, 0, 0], max = [{}, {}, {}] }} }},
])",
                                                      step, angle_of(mu), order, v, a, a, a));
    const int cube = index_of(simulation, "cube");
    const double start = centroid(simulation, cube).x();
    double rise = 0.0;
    while (!simulation.reached(1.5)) {
      take_step(simulation, 1.5);
      for (const double x : {0.0, a})
        for (const double y : {0.0, a}) rise = std::max(rise, place(simulation, cube, {x, y, 0.0}).z());
    }
    const std::string where = fmt::format("order {}, step {} s", order, step);
    checks.push_back(check_relative("stops after, m, " + where, centroid(simulation, cube).x() - start,
                                    v * v / (2.0 * mu * gravity), 1e-4));
    checks.push_back(check_absolute("rise of its sole, m, " + where, rise, 0.0, 1e-6));
  }
  return checks;
}

/// A body of 45 g between two pads that press it by N, of 20 times the friction
/// that it needs: m g = 2 mu N / 20. It does not creep.
std::vector<VerificationCheck> pinched_body() {
  constexpr double mass = 0.045, mu = 0.7, half = 0.004, length = 0.02;
  const double press = 20.0 * mass * gravity / (2.0 * mu);
  std::vector<VerificationCheck> checks;
  for (const int order : {0, 1, 2}) {
    Simulation simulation = simulation_of(fmt::format(
        R"(
analysis = {{ end_time = 2, time_step = 1e-3, initial_state = "static", sleeping = false }}
contact = {{ friction_angle = {:.17g} }}
material = [{{ name = "m", density = {:.17g}, young_modulus = 1e8, poisson_ratio = 0.3 }}]
[[block]]
name = "left"
fixed = true
box = {{ min = [-0.02, -0.02, -0.02], max = [{}, 0.02, 0.02] }}
[[block]]
name = "right"
material = "m"
box = {{ min = [{}, -0.02, -0.02], max = [0.02, 0.02, 0.02] }}
load = [{{ plane = {{ point = [0.02, 0, 0], normal = [1, 0, 0] }}, force = [{:.17g}, 0, 0] }}]
fix = [{{ plane = {{ point = [0.02, 0, 0], normal = [1, 0, 0] }}, components = ["y", "z"] }}]
[[block]]
name = "body"
material = "m"
order = {}
box = {{ min = [{}, {}, -0.01], max = [{}, {}, 0.01] }}
)",
        angle_of(mu), mass / (4.0 * half * half * length), -half, half, -press, order, -half, -half, half,
        half));
    const bool found = simulation.start_from_statics() == StaticStatus::equilibrium;
    checks.push_back(
        check_absolute(fmt::format("equilibrium, order {}", order), found ? 1.0 : 0.0, 1.0, 0.0));
    const int body = index_of(simulation, "body");
    const double start = centroid(simulation, body).z();
    double way = 0.0;
    while (!simulation.reached(2.0)) {
      take_step(simulation, 2.0);
      way = std::max(way, std::abs(centroid(simulation, body).z() - start));
    }
    checks.push_back(check_absolute(fmt::format("creep in 2 s, m, order {}", order), way, 0.0, 1e-9));
  }
  return checks;
}

/// A block between two fixed ones in the plane of x and z, 1 m wide.
struct HeldBlock {
  using Outline = std::vector<std::array<double, 2>>;
  static constexpr double mu = 0.84;
  Outline block, left, right;

  [[nodiscard]] std::string scene(int order) const {
    const auto prism = [](const char* name, const Outline& outline, const std::string& keys) {
      std::string points;
      for (const auto& [x, z] : outline)
        for (const int y : {0, 1}) points += fmt::format("[{:.17g}, {}, {:.17g}], ", x, y, z);
      return fmt::format("[[block]]\nname = \"{}\"\nhull = {{ points = [{}] }}\n{}\n", name, points, keys);
    };
    return fmt::format(
               "analysis = {{ type = \"static\" }}\ncontact = {{ "
               "friction_angle = {:.17g} }}\n"
               "material = [{{ name = \"m\", density = 1000, "
               "young_modulus = 1e10, poisson_ratio = 0.2 }}]\n",
               angle_of(mu)) +
           prism("block", block, fmt::format("material = \"m\"\norder = {}", order)) +
           prism("left", left, "fixed = true") + prism("right", right, "fixed = true");
  }
  [[nodiscard]] LimitAnswer limits() const {
    const Simulation simulation = simulation_of(scene(0));
    const std::vector<bool> loads(simulation.blocks().size(), false);
    LimitAnalysis analysis(
        simulation.rigid_model(1.0, loads), [](int, int) { return true; }, 1);
    return analysis.strength_factor({0.05, 10.0, 1e-4}, [] { return true; });
  }
};

/// Walls that lean by an angle from the vertical, apart at their tops if it is
/// positive, and a block that fits.
HeldBlock between_walls(double lean) {
  const double t = tangent_of(std::abs(lean)) * (lean < 0.0 ? -1.0 : 1.0);
  const auto x = [t](double z) { return 0.9 + t * z; };
  HeldBlock held{{}, {}, {}};
  held.block = {{-x(-0.4), -0.4}, {x(-0.4), -0.4}, {x(0.4), 0.4}, {-x(0.4), 0.4}};
  held.left = {{-x(-1), -1}, {-x(1), 1}, {-x(1) - 0.3, 1}, {-x(-1) - 0.3, -1}};
  held.right = {{x(-1), -1}, {x(1), 1}, {x(1) + 0.3, 1}, {x(-1) + 0.3, -1}};
  return held;
}

/// A wedge in a groove whose sides rise at an angle, laid on its side: one side
/// of the groove is below it, at 90 degrees less the angle. @param half half of
/// the width, m. @param length m, of the part beyond the groove
HeldBlock lying_wedge(double half, double rise, double length) {
  const double depth = half * tangent_of(rise);
  return {{{0, 0}, {depth, half}, {depth + length, half}, {depth + length, -half}, {depth, -half}},
          {{0, 0}, {depth, half}, {-0.5, half}, {-0.5, 0}},
          {{0, 0}, {depth, -half}, {-0.5, -half}, {-0.5, 0}}};
}

/// Result of a search for a factor: the middle of its bracket, or the limit of
/// the search that nothing reaches.
double factor_of(const LimitBracket& bracket) {
  if (bracket.lower && bracket.upper) return std::sqrt(*bracket.lower * *bracket.upper);
  return bracket.lower.value_or(0.0);
}

/// Forces in equilibrium exist wherever friction exceeds the angle between a
/// wall and the vertical. Walls that are vertical, or nearer at their tops, do
/// not press on a block that fits between them: it falls. A wedge on its side
/// slides down the face below it.
std::vector<VerificationCheck> forces_alone() {
  struct Case {
    const char* what;
    HeldBlock held;
    bool stands;
    double forces;    ///< factor of safety by forces alone; 10: the largest tried
    double released;  ///< with motion; 0: none
  };
  const double flat = HeldBlock::mu / tangent_of(30), steep = HeldBlock::mu / tangent_of(60);
  std::vector<VerificationCheck> checks;
  for (const auto& [what, held, stands, forces, released] :
       {Case{"vertical walls", between_walls(0), false, 10.0, 0.0},
        Case{"walls nearer at their tops", between_walls(-30), false, flat, 0.0},
        Case{"walls nearer at their feet", between_walls(30), true, 10.0, 10.0},
        Case{"wedge on a face of 30 degrees", lying_wedge(0.6, 60, 1.2607695), true, flat, flat},
        Case{"wedge on a face of 60 degrees", lying_wedge(1.0, 30, 0.0607695), false, steep, steep}}) {
    for (const int order : {0, 1}) {
      Simulation simulation = simulation_of(held.scene(order));
      checks.push_back(check_status(fmt::format("{}, order {}: {}", what, order, stands ? "stands" : "falls"),
                                    simulation, stands ? StaticStatus::equilibrium : StaticStatus::moving));
    }
    const LimitAnswer answer = held.limits();
    checks.push_back(check_absolute(fmt::format("{}: factor of safety by forces alone", what),
                                    factor_of(answer.associated), forces, 2e-3 * forces));
    checks.push_back(check_absolute(fmt::format("{}: factor of safety", what), factor_of(answer.released),
                                    released, 2e-3 * released));
  }
  return checks;
}

/// Ten courses of bricks, 2 m long; four bricks of the lowest course are fixed,
/// the others rest on the ground. Each course bears the weight above it.
std::vector<VerificationCheck> wall_courses() {
  constexpr double density = 2500.0, height = 0.05;
  std::vector<VerificationCheck> checks;
  for (const int order : {0, 1}) {
    Simulation simulation = simulation_of(fmt::format(
        R"(
analysis = {{ type = "static" }}
contact = {{ friction_angle = {:.17g} }}
material = [{{ name = "brick", density = {}, young_modulus = 1e10, poisson_ratio = 0.2 }}]
block = [{{ name = "ground", fixed = true, box = {{ min = [-1, -1, -0.1], max = [3, 1, 0] }} }}]
joint = [{{ blocks = ["ground", "*"], friction_angle = {:.17g} }}]
masonry = [{{ name = "wall", kind = "wall", material = "brick", order = {}, length = 2, height = 0.5, brick = [0.2, 0.1, {}] }}]
assign = [{{ blocks = ["wall.1", "wall.2", "wall.9", "wall.10"], fixed = true }}]
)",
        angle_of(0.36), density, angle_of(0.95), order, height));
    checks.push_back(
        check_status(fmt::format("order {}: equilibrium", order), simulation, StaticStatus::equilibrium));
    std::vector<double> borne(10, 0.0);
    const auto course = [&](int block) {
      return static_cast<std::size_t>(std::max(0.0, centroid(simulation, block).z() / height));
    };
    for (const PairRecord& pair : simulation.contacts()) {
      const std::size_t a = course(pair.a), b = course(pair.b);
      if (a != b) borne[std::max(a, b)] += (a > b ? 1.0 : -1.0) * force_on_a(pair).z();
    }
    for (std::size_t k = 1; k < borne.size(); ++k)
      checks.push_back(check_relative(
          fmt::format("force below course {}, N, order {}", k + 1, order), borne[k],
          static_cast<double>(10 - k) * 2.0 * 0.1 * height * density * gravity, order == 0 ? 1e-9 : 1e-6));
  }
  return checks;
}

constexpr VerificationCase peer_case_list[] = {
    {"sliding-cube", "a cube that slides to a stop does not rise", sliding_cube},
    {"pinched-body", "a body held by two pads does not creep", pinched_body},
    {"forces-alone", "blocks that stand by forces alone, and fall", forces_alone},
    {"wall-courses", "force below each course of a wall", wall_courses},
};

}  // namespace

std::span<const VerificationCase> peer_cases() {
  return peer_case_list;
}

}  // namespace ashlar
