// Cases of the ground: water in joints, and stress that was there before. Scenes are read as users write them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "apps/program/verify/sliding_wedge.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_scenes.hpp"
#include "apps/program/verify/verification_values.hpp"
#include "apps/run/factor_analysis.hpp"

namespace ashlar {
namespace {

constexpr double rock_density = 2600.0;
constexpr double of_water = 9810.0;  // N/m^3

constexpr const char* statics_of_rock = R"([analysis]
type = "static"
[[material]]
name = "rock"
density = 2600
young_modulus = 1e10
poisson_ratio = 0.2
)";

VerificationCheck check_safety(const std::string& what, const std::string& scene, double reference) {
  const FactorBracket bracket = find_factor({}, [&](double factor) {
    TrialFactors factors;
    factors.strength = factor;
    Simulation simulation = simulation_of(scene, factors);
    return run_trial(simulation, factor, 1.0);
  });
  const double found =
      bracket.lower && bracket.upper ? std::sqrt(*bracket.lower * *bracket.upper) : std::nan("");
  return check_relative("factor of safety, " + what, found, reference, 0.01);
}

std::string point_of(const Vector3& p) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", p.x(), p.y(), p.z());
}

std::string hull(const std::string& name, const std::vector<Vector3>& points, const char* keys) {
  std::string corners;
  for (const Vector3& point : points) corners += point_of(point) + ", ";
  return fmt::format("[[block]]\nname = \"{}\"\nhull = {{ points = [{}] }}\n{}\n", name, corners, keys);
}

/// Hull of points (x, z) between two values of y.
std::string prism(const std::string& name, const std::vector<Eigen::Vector2d>& points, double from, double to,
                  const char* keys) {
  std::vector<Vector3> corners;
  for (const Eigen::Vector2d& p : points)
    for (const double y : {from, to}) corners.emplace_back(p.x(), y, p.y());
  return hull(name, corners, keys);
}

constexpr const char* rigid_rock = "material = \"rock\"\norder = 0";

std::string water(const std::string& name, const Vector3& point, const Vector3& normal, double unit_weight,
                  const char* joints, const char* faces) {
  return fmt::format(
      "[[water]]\nname = \"{}\"\nlevel = {{ point = {}, normal = {} }}\nunit_weight = {}\njoints = {}\n"
      "faces = {}\n",
      name, point_of(point), point_of(normal), unit_weight, joints, faces);
}

/// A slope with a vertical tension crack, filled to a height above its base; the pressure below the block falls
/// linearly from there to the toe.
///   F = (c L + (W cos(p) - U - V sin(p)) tan(phi)) / (W sin(p) + V cos(p)),   U = w z L / 2,   V = w z^2 / 2
std::vector<VerificationCheck> tension_crack() {
  const double dip = std::atan(tangent_of(35)), height = 12.0, back = 12.0;
  const double base = back * std::tan(dip), crest = height / tangent_of(60), length = back / std::cos(dip);
  // Below the crest line, less the triangle below the plane.
  const double weight =
      rock_density * earth_gravity * (0.5 * crest * height + (back - crest) * height - 0.5 * back * base);
  std::vector<VerificationCheck> checks;
  for (const auto& [filled, phi, cohesion] :
       {std::array{0.0, 40.0, 0.0}, {0.5, 40.0, 0.0}, {1.0, 35.0, 2e4}}) {
    const double depth = filled * (height - base);
    const double uplift = 0.5 * of_water * depth * length, thrust = 0.5 * of_water * depth * depth;
    const double reference =
        (cohesion * length + (weight * std::cos(dip) - uplift - thrust * std::sin(dip)) * tangent_of(phi)) /
        (weight * std::sin(dip) + thrust * std::cos(dip));
    std::string scene = statics_of_rock;
    scene += fmt::format("[contact]\nfriction_angle = {}\n", phi);
    scene += fmt::format(
        "[[joint]]\nblocks = [\"slope\", \"base\"]\ncohesion = {0}\ncohesion_residual = {0}\n", cohesion);
    scene += "[[joint]]\nblocks = [\"slope\", \"back\"]\nfriction_angle = 0\n";
    scene +=
        prism("base", {{-3, -3 * std::tan(dip)}, {back, base}, {back, -8}, {-3, -8}}, -1, 2, "fixed = true");
    scene += prism("back", {{back, base}, {back + 4, base}, {back + 4, height}, {back, height}}, -1, 2,
                   "fixed = true");
    scene += prism("slope", {{0, 0}, {back, base}, {back, height}, {crest, height}}, 0, 1, rigid_rock);
    if (depth > 0.0) {
      scene += water("crack", {0, 0, base + depth}, Vector3::UnitZ(), of_water, "[\"back\"]", "[]");
      scene += water("plane", Vector3::Zero(), {-(base + depth), 0, back}, of_water, "[\"base\"]", "[]");
    }
    checks.push_back(check_safety(fmt::format("tension crack filled to {}", filled), scene, reference));
  }
  return checks;
}

/// Uplift falls linearly from the heel to the toe: F = (W - U) tan(phi) / V.
std::vector<VerificationCheck> dam_on_its_base() {
  const double width = 5.0, height = 10.0, level = 9.0, phi = 35.0;
  const double weight = width * height * rock_density * earth_gravity,
               uplift = 0.5 * of_water * level * width, thrust = 0.5 * of_water * level * level;
  std::string scene = statics_of_rock;
  scene += fmt::format("[contact]\nfriction_angle = {}\n", phi);
  scene += prism("ground", {{-5, -2}, {10, -2}, {10, 0}, {-5, 0}}, -1, 2, "fixed = true");
  scene += prism("dam", {{0, 0}, {width, 0}, {width, height}, {0, height}}, 0, 1, rigid_rock);
  // Through the water's edge upstream and the toe.
  scene += water("river", {0, 0, level}, {level, 0, width}, of_water, "[\"*\"]", "[\"dam\"]");
  return {check_safety("dam under water", scene, (weight - uplift) * tangent_of(phi) / thrust)};
}

/// The pressure below each plane takes its force from the normal force there:
///   F = (grip W - U_1 - U_2) tan(phi) / (slip W),   U_i = w A_i (depth of the middle of plane i)
std::vector<VerificationCheck> wedge_under_water() {
  const SlidingWedge wedge;
  const double phi = 50.0, level = 1.2, light = 2000.0;
  std::string scene = statics_of_rock;
  scene += fmt::format("[contact]\nfriction_angle = {}\n", phi);
  double uplift = 0.0;
  int number = 0;
  for (const auto& [n, d] : {std::pair{wedge.n1, wedge.d1}, {wedge.n2, wedge.d2}}) {
    std::vector<Vector3> points;
    for (const double along : {-3.0, 9.0})
      for (const double up : {-0.5, 3.0})
        for (const double depth : {0.0, 1.0}) points.emplace_back(along * wedge.line + up * d - depth * n);
    scene += hull(fmt::format("plane {}", ++number), points, "fixed = true");
    uplift += light * 2.0 * (level - 0.5 * d.z());
  }
  std::vector<Vector3> points;
  double highest = 0.0;
  for (const double along : {-1.0, 1.0}) {
    for (const Vector3& up : {Vector3(Vector3::Zero()), wedge.d1, wedge.d2}) {
      points.emplace_back(along * wedge.line + up);
      highest = std::max(highest, points.back().z());
    }
  }
  scene += hull("wedge", points, rigid_rock);
  // The level is above all of both planes.
  const double top = std::max(level, highest);
  uplift += light * 4.0 * (top - level);
  scene += water("ground water", {0, 0, top}, Vector3::UnitZ(), light, "[\"wedge\"]", "[]");
  const double weight = wedge.volume() * rock_density * earth_gravity;
  return {check_safety("wedge under water", scene,
                       (wedge.grip * weight - uplift) * tangent_of(phi) / (wedge.slip * weight))};
}

/// A column of five blocks under its own weight, held at its sides by rollers or by tractions that grow with depth.
/// @param sides keys of each block
std::vector<VerificationCheck> column(const std::string& what, const std::string& sides) {
  constexpr double height = 10.0, k0 = 0.4;
  std::string scene = statics_of_rock;
  scene += fmt::format("[initial_stress]\nk0 = {}\nsurface = {}\n", k0, height);
  scene += "[[block]]\nname = \"ground\"\nbox = { min = [-1, -1, -1], max = [2, 2, 0] }\nfixed = true\n";
  for (int k = 0; k < 5; ++k)
    scene += fmt::format(
        "[[block]]\nname = \"{0}\"\nmaterial = \"rock\"\norder = 2\n"
        "box = {{ min = [0, 0, {1}], max = [1, 1, {2}] }}\n{3}",
        k, 2 * k, 2 * k + 2, sides);
  Simulation simulation = simulation_of(scene);
  std::vector<VerificationCheck> checks = {
      check_status(what + ": in equilibrium", simulation, StaticStatus::equilibrium)};
  double moved = 0.0, vertical = 0.0, across = 0.0;
  const double unit_weight = rock_density * earth_gravity;
  for (int k = 1; k <= 5; ++k) {
    for (const double z : {2.0 * k - 2, 2.0 * k - 1, 2.0 * k}) {
      const auto index = static_cast<std::size_t>(k);
      const PointMotion motion =
          simulation.blocks()[index].motion_of(simulation.states()[index], {0.3, 0.8, z});
      moved = std::max(moved, motion.displacement.norm());
      vertical = std::max(vertical, std::abs(motion.stress(2, 2) + unit_weight * (height - z)));
      across = std::max(across, std::abs(motion.stress(0, 0) + k0 * unit_weight * (height - z)));
    }
  }
  checks.push_back(check_absolute(what + ": largest displacement, m", moved, 0.0, 1e-9));
  checks.push_back(check_absolute(what + ": error of vertical stress over the largest",
                                  vertical / (unit_weight * height), 0.0, 1e-9));
  checks.push_back(check_absolute(what + ": error of horizontal stress over the largest",
                                  across / (unit_weight * height), 0.0, 1e-9));
  return checks;
}

std::vector<VerificationCheck> stress_of_the_ground() {
  std::string rollers, tractions;
  for (const auto& [axis, letter] : {std::pair(0, "x"), std::pair(1, "y")}) {
    for (const double side : {0.0, 1.0}) {
      const std::string plane =
          fmt::format("plane = {{ point = {}, normal = {} }}", point_of(side * Vector3::Unit(axis)),
                      point_of(Vector3::Unit(axis)));
      const std::string fix = fmt::format("[[block.fix]]\n{}\ncomponents = [\"{}\"]\n", plane, letter);
      rollers += fix;
      const double outward = side == 0.0 ? -1.0 : 1.0;
      const std::string size =
          fmt::format("\"= {} * 0.4 * {} * (10 - z)\"", -outward, rock_density * earth_gravity);
      tractions += axis == 1 ? fix : fmt::format("[[block.load]]\n{}\ntraction = [{}, 0, 0]\n", plane, size);
    }
  }
  std::vector<VerificationCheck> checks = column("rollers", rollers);
  for (VerificationCheck& check : column("tractions", tractions)) checks.push_back(std::move(check));
  return checks;
}

constexpr VerificationCase ground_case_list[] = {
    {"water-tension-crack", "factor of safety of a slope with water in its tension crack", tension_crack},
    {"water-dam", "factor of safety of a dam with uplift", dam_on_its_base},
    {"water-wedge", "factor of safety of a wedge under water", wedge_under_water},
    {"initial-stress", "stress of the ground in a column of blocks", stress_of_the_ground},
};

}  // namespace

std::span<const VerificationCase> ground_cases() {
  return ground_case_list;
}

}  // namespace ashlar
