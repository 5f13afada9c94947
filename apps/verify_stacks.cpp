// Cases of several blocks at rest on each other: stack of books, toppling columns, arch.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "apps/verification_contacts.hpp"

namespace ashlar {
namespace {

const Material stiff_rock{2500.0, 1e11, 0.2};

/// Four equal blocks, each farther out than the one below; in the stack that just holds, the k-th from the
/// top is L/(2k) farther out than the one below it.
Simulation book_stack(double share, const Placement& placement) {
  ContactScene scene(placement);
  scene.settings.area_springs = false;
  *scene.law = {1e8, 1e8, tangent_of(40), 0.0, 0.0, false};
  scene.add_fixed(Polyhedron(make_box({-2, -1, -1}, {0, 2, 0})));
  double x = 0.0;
  for (int k = 4; k >= 1; --k) {
    x += share / (2.0 * k);
    const double z = 0.2 * (4 - k);
    scene.add(define_block(Polyhedron(make_box({x - 1.0, 0, z}, {x, 0.5, z + 0.2})), stiff_rock, 1));
  }
  return scene.build();
}

std::vector<VerificationCheck> book_stack_case(const Placement& placement) {
  Simulation holds = book_stack(0.99, placement);
  Simulation falls = book_stack(1.01, placement);
  return {check_status("holds at 0.99 of the overhang", holds, StaticStatus::equilibrium),
          check_status("falls at 1.01", falls, StaticStatus::moving)};
}

/// Half circle of `count` equal voussoirs of thickness t about the mean radius 1, on two fixed blocks. The
/// least thickness is one of rigid joints: a hinge that turns by theta presses a strip of sqrt(2 N/(k
/// theta)), with N about 2.5 kN/m, and lies a third of it inside. With k = 1e14 Pa/m a turn of 2e-4, which
/// hardly changes the arch, keeps that below 2e-4 m, a sixth of what 1 % of the thickness leaves.
Simulation arch(int count, double t, const Placement& placement) {
  ContactScene scene(placement);
  *scene.law = {1e14, 1e14, tangent_of(60), 0.0, 0.0, true};
  const auto joint = [&](int k, std::vector<Vector3>& points) {
    const double angle = std::numbers::pi * k / count;
    for (const double radius : {1.0 - 0.5 * t, 1.0 + 0.5 * t}) {
      for (const double y : {0.0, 0.2})
        points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
  };
  for (int k = 0; k < count; ++k) {
    std::vector<Vector3> points;
    joint(k, points);
    joint(k + 1, points);
    scene.add(define_block(hull_of(points), stiff_rock, 1));
  }
  for (const double side : {-1.0, 1.0})
    scene.add_fixed(Polyhedron(make_box({side - 0.3, -0.2, -0.3}, {side + 0.3, 0.4, 0})));
  return scene.build();
}

std::vector<VerificationCheck> arch_case(const Placement& placement) {
  constexpr double least = 0.10678;
  Simulation stands = arch(27, 1.01 * least, placement);
  Simulation falls = arch(27, 0.99 * least, placement);
  return {check_status("stands at 1.01 of the least thickness", stands, StaticStatus::equilibrium),
          check_status("falls at 0.99", falls, StaticStatus::moving)};
}

/// Goodman and Bray's columns: 16 columns on a stepped base that dips 30 degrees. In the frame of the base,
/// column n = 1 to 16 from the toe stands on [10 (n-1), 10 n], each step 1 m higher; heights grow by 4 m up
/// to the tenth column and fall by 6.2 m beyond.
ContactScene columns(const Placement& placement) {
  ContactScene scene(placement);
  scene.settings.area_springs = false;
  // A face that rises towards positive x'.
  const Placement raised{slope(-30)};
  double height = 0.0;
  for (int n = 1; n <= 16; ++n) {
    height += n <= 10 ? 4.0 : -6.2;
    const double x = 10.0 * (n - 1), base = n - 1.0;
    scene.add_fixed(placed(Polyhedron(make_box({x, -5, base - 5}, {x + 10, 15, base})), raised));
    scene.add(define_block(placed(Polyhedron(make_box({x, 0, base}, {x + 10, 10, base + height})), raised),
                           {25e3 / 9.81, 1e10, 0.2}, 1));
  }
  return scene;
}

/// Largest way of a centroid in a time.
double farthest_in(Simulation& simulation, double time) {
  std::vector<Vector3> start;
  start.reserve(simulation.blocks().size());
  for (int k = 0; k < static_cast<int>(simulation.blocks().size()); ++k)
    start.push_back(centroid(simulation, k));
  run_until(simulation, simulation.time() + time);
  double farthest = 0.0;
  for (std::size_t k = 0; k < start.size(); ++k)
    farthest = std::max(farthest, (centroid(simulation, static_cast<int>(k)) - start[k]).norm());
  return farthest;
}

/// From equilibrium, as the full weight put on at once would set the columns in motion.
std::vector<VerificationCheck> goodman_bray(const Placement& placement) {
  ContactScene scene = columns(placement);
  const std::shared_ptr<JointLaw> law = scene.law;
  *law = {1e11, 1e11, tangent_of(39.5), 0.0, 0.0, false};
  scene.settings.time_step = 5e-3;
  Simulation simulation = scene.build();
  std::vector<VerificationCheck> checks = {
      check_status("equilibrium at phi 39.5", simulation, StaticStatus::equilibrium)};
  checks.push_back(check_absolute("way in 1 s at phi 39.5, m", farthest_in(simulation, 1.0), 0.0, 1e-4));
  // Driving and friction forces now differ by some percent, which moves columns by more than this in 1 s.
  law->friction = tangent_of(36.5);
  const double way = farthest_in(simulation, 1.0);
  checks.push_back(check_absolute("more than 0.1 m in 1 s at phi 36.5", way > 0.1 ? 1.0 : 0.0, 1.0, 0.0));
  return checks;
}

constexpr VerificationCase cases[] = {
    {"goodman-bray", "toppling columns on a stepped base", goodman_bray},
    {"arch", "semicircular arch of 27 voussoirs at its least thickness", arch_case},
    {"book-stack", "four blocks at their largest overhang", book_stack_case},
};

}  // namespace

std::span<const VerificationCase> stack_cases() {
  return cases;
}

}  // namespace ashlar
