// Cases of several blocks at rest on each other: stack of books, toppling columns, arch.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "apps/program/verify/toppling_columns.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/voussoir_arch.hpp"

namespace ashlar {
namespace {

const Material stiff_rock{2500.0, 1e11, 0.2};

/// Four equal blocks, each with an overhang over the one below; in the limit stack, the overhang of the k-th from the
/// top is L/(2k).
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

/// Largest displacement of a centroid in a time.
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

/// @param ratio t / R
Simulation arch(int count, double ratio, const Placement& placement) {
  const Material rock{2500.0, 1e10, 0.2};
  ContactScene scene(placement);
  const double size = VoussoirArch{count, ratio}.add_to(scene, rock);
  choose_as_for_statics(scene, size, rock.young_modulus, tangent_of(60));
  scene.settings.time_step = 5e-3;
  return scene.build();
}

/// Smallest thicknesses of rigid voussoirs. An arch that stands in the static analysis does not move in the following
/// second. An arch that collapses there starts as placed; it has moved millimetres after 1 s, as the driving forces
/// are very small.
std::vector<VerificationCheck> arch_case(const Placement& placement) {
  std::vector<VerificationCheck> checks;
  for (const auto& [count, least] : {std::pair{8, 0.09997}, std::pair{27, 0.10672}}) {
    for (const double share : {1.01, 0.99}) {
      const bool stands = share > 1.0;
      const std::string name = fmt::format("N = {} at {} of the least thickness", count, share);
      Simulation simulation = arch(count, share * least, placement);
      const StaticStatus expected = stands ? StaticStatus::equilibrium : StaticStatus::moving;
      const bool found = simulation.start_from_statics() == expected;
      checks.push_back(check_absolute(fmt::format("{}: {}", name, stands ? "equilibrium" : "moving"),
                                      found ? 1.0 : 0.0, 1.0, 0.0));
      const double way = farthest_in(simulation, 1.0);
      checks.push_back(stands ? check_absolute(fmt::format("{}: way in 1 s, m", name), way, 0.0, 1e-5)
                              : check_absolute(fmt::format("{}: more than 1 mm in 1 s", name),
                                               way > 1e-3 ? 1.0 : 0.0, 1.0, 0.0));
    }
  }
  return checks;
}

/// Walls b x h x 1 on a fixed floor under uniform pressure on one side: with weight W per length they overturn at W b
/// / h^2.
std::vector<VerificationCheck> overturning_case(const Placement& placement) {
  struct Wall {
    double b, h;
    int order;
  };
  const Material rock{2500.0, 1e10, 0.2};
  std::vector<VerificationCheck> checks;
  for (const auto& [b, h, order] : {Wall{1, 4, 1}, Wall{1, 4, 2}, Wall{0.5, 3, 1}, Wall{2, 3, 2}}) {
    for (const double share : {0.998, 1.002}) {
      ContactScene scene(placement);
      scene.add_fixed(Polyhedron(make_box({-b, -1, -1}, {2 * b, 2, 0})));
      BlockDefinition wall = define_block(Polyhedron(make_box({0, 0, 0}, {b, 1, h})), rock, order);
      const double pressure = share * rock.density * 9.81 * b * b / h;
      wall.loads.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}, true, {pressure, 0, 0}, {}});
      scene.add(std::move(wall));
      choose_as_for_statics(scene, std::cbrt(b * h), rock.young_modulus, tangent_of(60));
      Simulation simulation = scene.build();
      const bool stands = share < 1.0;
      checks.push_back(check_status(fmt::format("wall {} x {} of order {} at {} of the pressure: {}", b, h,
                                                order, share, stands ? "equilibrium" : "moving"),
                                    simulation, stands ? StaticStatus::equilibrium : StaticStatus::moving));
    }
  }
  return checks;
}

/// From equilibrium, as the sudden application of the full weight would set the columns in motion.
std::vector<VerificationCheck> goodman_bray(const Placement& placement) {
  ContactScene scene(placement);
  scene.settings.area_springs = false;
  add_toppling_columns(scene);
  const std::shared_ptr<JointLaw> law = scene.law;
  *law = {1e11, 1e11, tangent_of(39.5), 0.0, 0.0, false};
  scene.settings.time_step = 5e-3;
  Simulation simulation = scene.build();
  std::vector<VerificationCheck> checks = {
      check_status("equilibrium at phi 39.5", simulation, StaticStatus::equilibrium)};
  checks.push_back(check_absolute("way in 1 s at phi 39.5, m", farthest_in(simulation, 1.0), 0.0, 1e-4));
  // Driving and friction forces now differ by a few per cent, which moves columns by more than this in 1 s.
  law->friction = tangent_of(36.5);
  simulation.wake();
  const double way = farthest_in(simulation, 1.0);
  checks.push_back(check_absolute("more than 0.1 m in 1 s at phi 36.5", way > 0.1 ? 1.0 : 0.0, 1.0, 0.0));
  return checks;
}

constexpr VerificationCase stack_case_list[] = {
    {"goodman-bray", "toppling columns on a stepped base", goodman_bray},
    {"arch", "semicircular arches of 8 and 27 voussoirs at their least thickness, at rest and in motion",
     arch_case},
    {"overturning-limit", "walls pressed on one side", overturning_case},
    {"book-stack", "four blocks at their largest overhang", book_stack_case},
};

}  // namespace

std::span<const VerificationCase> stack_cases() {
  return stack_case_list;
}

}  // namespace ashlar
