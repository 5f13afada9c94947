// Cases of limit analysis: rigid blocks with limits in closed form or from independent linear programmes.
//
// The programmes: blocks of the plane problem, normal force and friction at both ends of each joint, solved by HiGHS.
// For walls, arches and portals they have the same limit as the cones of a scene that is uniform across its plane.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/verify/sliding_wedge.hpp"
#include "apps/program/verify/toppling_columns.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_values.hpp"
#include "apps/program/verify/voussoir_arch.hpp"
#include "solver/statics/limit_analysis.hpp"
#include "solver/statics/support_movement.hpp"

namespace ashlar {
namespace {

using Build = std::function<void(ContactScene&)>;

/// Limit analysis of a scene with rigid blocks. @param multiplied true if its loads get a factor
LimitAnalysis limit_analysis(const JointLaw& law, const Build& add, const Placement& placement,
                             bool multiplied = false) {
  ContactScene scene(placement);
  add(scene);
  *scene.law = law;
  const Simulation simulation = scene.build();
  const std::vector<bool> blocks(simulation.blocks().size(), multiplied);
  return {simulation.rigid_model(1.0, blocks), [](int, int) { return true; }, 1};
}

JointLaw joint(double friction, double cohesion = 0.0) {
  JointLaw law;
  law.friction = friction;
  law.cohesion = cohesion;
  return law;
}

LimitAnswer strength_of(const JointLaw& law, const Build& add, const Placement& placement) {
  return limit_analysis(law, add, placement).strength_factor({0.1, 10.0, 1e-3}, [] { return true; });
}

LimitAnswer load_of(const JointLaw& law, const Build& add, const Placement& placement) {
  return limit_analysis(law, add, placement, true).load_factor({0.01, 100.0, 1e-4}, [] { return true; });
}

/// Middle of a bracket; not a number unless it is narrow enough.
/// Adds both limits of a scene for which they coincide.
void add_both(std::vector<VerificationCheck>& checks, const std::string& what, const LimitAnswer& answer,
              double unit, double reference, double tolerance) {
  checks.push_back(check_relative(what + ", released", unit * middle(answer.released), reference, tolerance));
  checks.push_back(
      check_relative(what + ", associated", unit * middle(answer.associated), reference, tolerance));
}

BlockDefinition box(const Vector3& low, const Vector3& high) {
  return define_block(Polyhedron(make_box(low, high)), common_rock, 1);
}

/// F = (W cos(alpha) tan(phi) + c A) / (W sin(alpha)).
std::vector<VerificationCheck> limit_plane(const Placement& placement) {
  constexpr double height = 0.5, area = 2.0;
  std::vector<VerificationCheck> checks;
  for (const auto& [incline, phi, cohesion] :
       {std::array{30.0, 25.0, 8e3}, {30.0, 40.0, 0.0}, {50.0, 20.0, 2e4}, {40.0, 0.0, 2e4}}) {
    const double alpha = std::atan(tangent_of(incline));
    const Placement lowered{slope(incline)};
    const auto add = [&](ContactScene& scene) {
      scene.add_fixed(placed(Polyhedron(make_box({-6, -2, -1}, {6, 2, 0})), lowered));
      scene.add(placed(box({-1, -0.5, 0}, {1, 0.5, height}), lowered));
    };
    const double weight = area * height * common_rock.density * earth_gravity;
    add_both(checks, fmt::format("factor of safety, alpha {}, phi {}, c {} Pa", incline, phi, cohesion),
             strength_of(joint(tangent_of(phi), cohesion), add, placement), 1.0,
             (weight * std::cos(alpha) * tangent_of(phi) + cohesion * area) / (weight * std::sin(alpha)),
             1e-3);
  }
  return checks;
}

/// F = ((N_A + N_B) tan(phi) + c (A_A + A_B)) / T, released: friction opposes the sliding. Forces in balance may also
/// act normal to the line.
std::vector<VerificationCheck> limit_wedge(const Placement& placement) {
  const SlidingWedge wedge;
  const double weight = wedge.volume() * common_rock.density * earth_gravity;
  std::vector<VerificationCheck> checks;
  for (const auto& [phi, cohesion] : {std::pair{30.0, 2e3}, {20.0, 4e3}, {45.0, 0.0}}) {
    const LimitAnswer answer = strength_of(
        joint(tangent_of(phi), cohesion), [&](ContactScene& scene) { wedge.add_to(scene, common_rock); },
        placement);
    const double reference =
        (wedge.grip * weight * tangent_of(phi) + cohesion * wedge.contact_area()) / (wedge.slip * weight);
    const std::string what = fmt::format("factor of safety, phi {}, c {} Pa", phi, cohesion);
    checks.push_back(check_relative(what + ", released", middle(answer.released), reference, 2e-3));
    checks.push_back(check_absolute(what + ", associated is no less",
                                    middle(answer.associated) >= 0.998 * reference ? 1.0 : 0.0, 1.0, 0.0));
  }
  return checks;
}

/// Columns under the forces of Goodman and Bray's recursion have the limit 38.15 degrees.
std::vector<VerificationCheck> limit_toppling(const Placement& placement) {
  const LimitAnswer answer = strength_of(joint(tangent_of(39.5)), add_toppling_columns, placement);
  return {check_relative("factor of safety, released", middle(answer.released),
                         tangent_of(39.5) / tangent_of(38.15), 5e-3)};
}

/// F = tan(phi) over the least friction: crown and haunch hinge while the springings slide.
std::vector<VerificationCheck> limit_arch_sliding(const Placement& placement) {
  std::vector<VerificationCheck> checks;
  for (const VoussoirArch& arch : {VoussoirArch{8, 0.15}, VoussoirArch{26, 0.15}}) {
    const LimitAnswer answer = strength_of(
        joint(tangent_of(40)), [&](ContactScene& scene) { arch.add_to(scene, common_rock); }, placement);
    add_both(checks, fmt::format("factor of safety, {} voussoirs, t / R = {}", arch.count, arch.ratio),
             answer, 1.0, tangent_of(40) / arch.least_friction(), 2e-3);
  }
  return checks;
}

/// The least t / R of semicircular arches with hinges, from the linear programme.
std::vector<VerificationCheck> limit_arch_thickness(const Placement& placement) {
  std::vector<VerificationCheck> checks;
  for (const auto& [count, least] : {std::pair{8, 0.0999716}, {27, 0.1067209}}) {
    for (const bool released : {false, true}) {
      double low = 0.09, high = 0.12;
      while (high > low * (1.0 + 1e-4)) {
        const double ratio = 0.5 * (low + high);
        const VoussoirArch arch{count, ratio};
        LimitAnalysis analysis = limit_analysis(
            joint(tangent_of(60)), [&](ContactScene& scene) { arch.add_to(scene, common_rock); }, placement);
        const LimitTrial trial = released ? analysis.released({}) : analysis.associated({});
        (trial.outcome == LimitOutcome::stands ? high : low) = ratio;
      }
      checks.push_back(check_relative(
          fmt::format("least t / R of {} voussoirs, {}", count, released ? "released" : "associated"),
          std::sqrt(low * high), least, 1e-3));
    }
  }
  return checks;
}

/// Two posts b x h and a lintel across them, pushed at the lintel's middle. Both posts rotate about their toes, and
/// their heels lift the lintel without rotation, H h = (W_posts + 2 W_lintel) b/2.
std::vector<VerificationCheck> limit_portal(const Placement& placement) {
  constexpr double b = 1.0, h = 4.0, span = 6.0, depth = 1.0;
  const double specific = common_rock.density * earth_gravity;
  const double limit = specific * (2.0 * b * h + 2.0 * span * depth) * b / (2.0 * h);
  const double unit = 0.3 * limit;
  const auto add = [&](ContactScene& scene) {
    scene.add_fixed(Polyhedron(make_box({-3, -1, -1}, {9, 2, 0})));
    scene.add(box({0, 0, 0}, {b, 1, h}));
    scene.add(box({span - b, 0, 0}, {span, 1, h}));
    BlockDefinition lintel = box({0, 0, h}, {span, 1, h + depth});
    lintel.loads.push_back({Vector3(span / 2, 0.5, h + depth / 2), false, {unit, 0, 0}, {}});
    scene.add(std::move(lintel));
  };
  std::vector<VerificationCheck> checks;
  add_both(checks, "load of a portal, N", load_of(joint(0.75), add, placement), unit, limit, 1e-3);
  return checks;
}

/// Running bond of bricks on a fixed floor; odd courses begin and end with half bricks.
struct BondWall {
  int courses;
  int wide;       ///< bricks
  Vector3 brick;  ///< m

  /// @param load of a brick of some course, from its low to its high corner
  void add_to(ContactScene& scene,
              const std::function<void(BlockDefinition&, int, const Vector3&, const Vector3&)>& load) const {
    const double length = wide * brick.x();
    scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {length + 1, brick.y() + 1, 0})));
    for (int c = 0; c < courses; ++c) {
      const double shift = c % 2 == 0 ? 0.0 : 0.5;
      for (int k = 0; k < wide + c % 2; ++k) {
        const Vector3 low(std::max(0.0, (k - shift) * brick.x()), 0.0, c * brick.z());
        const Vector3 high(std::min(length, (k + 1 - shift) * brick.x()), brick.y(), (c + 1) * brick.z());
        BlockDefinition block = box(low, high);
        load(block, c, low, high);
        scene.add(std::move(block));
      }
    }
  }
};

/// 33 bricks pushed at the top corner: the top course slides, and with such rough joints steps of the bond overturn
/// (linear programme).
std::vector<VerificationCheck> limit_wall_pushed(const Placement& placement) {
  const BondWall wall{6, 5, {0.5, 0.25, 0.25}};
  const double course = 2.5 * 0.25 * 0.25 * common_rock.density * earth_gravity;
  std::vector<VerificationCheck> checks;
  for (const auto& [friction, limit] : {std::pair{0.75, 0.75 * course}, {5.0, 14093.19}}) {
    const double unit = 0.3 * limit;
    const LimitAnswer answer = load_of(
        joint(friction),
        [&, unit = unit](ContactScene& scene) {
          wall.add_to(scene, [&](BlockDefinition& block, int c, const Vector3& low, const Vector3& high) {
            if (c == wall.courses - 1 && low.x() == 0.0)
              block.loads.push_back({Vector3(0.0, 0.5 * high.y(), high.z()), false, {unit, 0, 0}, {}});
          });
        },
        placement);
    checks.push_back(check_relative(fmt::format("push of a wall of friction {}, N, associated", friction),
                                    unit * middle(answer.associated), limit, 1e-3));
    if (friction < 1.0)
      checks.push_back(check_relative(fmt::format("push of a wall of friction {}, N, released", friction),
                                      unit * middle(answer.released), limit, 1e-3));
  }
  return checks;
}

/// Walls under a horizontal share of their weight: from an independent cone programme, and the linear one.
std::vector<VerificationCheck> limit_wall_capacity(const Placement& placement) {
  std::vector<VerificationCheck> checks;
  for (const auto& [courses, limit] : {std::pair{6, 0.60656}, {12, 0.51934}}) {
    const BondWall wall{courses, std::max(2, courses / 3), {1.0, 0.5, 0.5}};
    const LimitAnswer answer = load_of(
        joint(0.75),
        [&](ContactScene& scene) {
          wall.add_to(scene, [&](BlockDefinition& block, int, const Vector3& low, const Vector3& high) {
            const double weight = (high - low).prod() * common_rock.density * earth_gravity;
            block.loads.push_back({Vector3(0.5 * (low + high)), false, {weight, 0, 0}, {}});
          });
        },
        placement);
    checks.push_back(
        check_relative(fmt::format("horizontal acceleration over g of {} courses, associated", courses),
                       middle(answer.associated), limit, 2e-4));
    checks.push_back(check_absolute(
        fmt::format("{} courses, released ({:.4f}) is no more", courses, middle(answer.released)),
        middle(answer.released) <= limit * 1.0002 ? 1.0 : 0.0, 1.0, 0.0));
  }
  return checks;
}

/// Two blocks side by side between walls, half span L and depth h. They hinge at the lower corners at the walls and
/// at the upper one between them: two bars D^2 = L^2 + h^2 that are aligned when a wall has moved by 2 (D - L). Until
/// then H y = W (L + s/2) / 2 with y^2 = D^2 - (L + s/2)^2.
std::vector<VerificationCheck> limit_support_movement(const Placement& placement) {
  constexpr double half = 2.0, depth = 0.5;
  ContactScene scene(placement);
  scene.add(box({-half, 0, 0}, {0, 1, depth}));
  scene.add(box({0, 0, 0}, {half, 1, depth}));
  scene.add_fixed(Polyhedron(make_box({-half - 1, 0, -1}, {-half, 1, 1})));
  scene.add_fixed(Polyhedron(make_box({half, 0, -1}, {half + 1, 1, 1})));
  *scene.law = joint(1.0);
  const Simulation simulation = scene.build();
  const SupportPath path =
      support_movement({simulation.system(), simulation.states(), simulation.histories()}, 3,
                       {std::nullopt, 1.0, 1e-5})
          .out;
  const double bar = std::hypot(half, depth);
  double error = path.places.size() > 10 ? 0.0 : 1.0;
  for (const MovedPlace& place : path.places) {
    const double reach = half + 0.5 * place.moved, rise = std::sqrt(bar * bar - reach * reach);
    const double thrust = half * depth * common_rock.density * earth_gravity * reach / (2.0 * rise);
    if (rise > 0.1 * depth) error = std::max(error, std::abs(place.thrust / thrust - 1.0));
  }
  return {check_relative("movement of a wall, m", path.lower, 2.0 * (bar - half), 1e-3),
          check_absolute("thrust on the way, over its value", error, 0.0, 1e-3)};
}

/// A square slab of side a twisted by a couple: mu W times the mean distance of its base from the centre, a/6
/// (sqrt(2) + asinh(1)), for uniform pressure.
std::vector<VerificationCheck> limit_twist(const Placement& placement) {
  constexpr double side = 2.0, depth = 0.3, force = 1000.0;
  const auto add = [&](ContactScene& scene) {
    scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {side + 1, side + 1, 0})));
    BlockDefinition slab = box({0, 0, 0}, {side, side, depth});
    slab.loads.push_back({Vector3(0, side / 2, depth), false, {0, -force, 0}, {}});
    slab.loads.push_back({Vector3(side, side / 2, depth), false, {0, force, 0}, {}});
    scene.add(std::move(slab));
  };
  const double weight = side * side * depth * common_rock.density * earth_gravity;
  const double couple = 0.6 * weight * side / 6.0 * (std::sqrt(2.0) + std::asinh(1.0));
  std::vector<VerificationCheck> checks;
  add_both(checks, "couple on a slab, N m", load_of(joint(0.6), add, placement), force * side, couple, 1e-3);
  return checks;
}

constexpr VerificationCase limit_case_list[] = {
    {"limit-plane", "limit analysis: factor of safety of a block on a plane", limit_plane},
    {"limit-wedge", "limit analysis: factor of safety of a wedge", limit_wedge},
    {"limit-toppling", "limit analysis: factor of safety of toppling columns", limit_toppling},
    {"limit-arch-sliding", "limit analysis: factor of safety of semicircular arches that slide",
     limit_arch_sliding},
    {"limit-arch-thickness", "limit analysis: least thickness of semicircular arches", limit_arch_thickness},
    {"limit-portal", "limit analysis: posts and a lintel that are pushed", limit_portal},
    {"limit-wall-pushed", "limit analysis: a wall of 33 bricks pushed along at its top", limit_wall_pushed},
    {"limit-wall-capacity", "limit analysis: walls under a horizontal body force", limit_wall_capacity},
    {"limit-twist", "limit analysis: a slab twisted by a couple", limit_twist},
    {"limit-support-movement", "limit analysis: a flat arch whose wall moves out", limit_support_movement},
};

}  // namespace

std::span<const VerificationCase> limit_cases() {
  return limit_case_list;
}

}  // namespace ashlar
