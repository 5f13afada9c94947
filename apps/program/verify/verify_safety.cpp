// Cases of strength reduction: blocks whose factor of safety is known in closed form from limit equilibrium.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "apps/program/verify/sliding_wedge.hpp"
#include "apps/program/verify/toppling_columns.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_values.hpp"
#include "apps/program/verify/voussoir_arch.hpp"
#include "apps/run/factor_analysis.hpp"

namespace ashlar {
namespace {

/// A joint whose cohesion does not depend on slip. @param cohesion Pa
JointLaw plastic_joint(double friction, double cohesion) {
  JointLaw law;
  law.friction = friction;
  law.cohesion = cohesion;
  law.residual = {friction, cohesion, 0.0};
  return law;
}

/// The bracket of a scene's factor of safety, with automatic settings.
/// @param size of the smallest block, m. @param add adds the blocks to a scene
FactorBracket safety_of(const JointLaw& strength, double size, const std::function<void(ContactScene&)>& add,
                        const Placement& placement) {
  return find_factor({}, [&](double factor) {
    ContactScene scene(placement);
    add(scene);
    choose_as_for_statics(scene, size, common_rock.young_modulus, strength.friction / factor);
    scene.law->cohesion = strength.cohesion / factor;
    if (strength.residual)
      scene.law->residual = {strength.residual->friction / factor, strength.residual->cohesion / factor,
                             strength.residual->tensile_strength / factor};
    Simulation simulation = scene.build();
    return run_trial(simulation, factor, 1.0);
  });
}

/// Middle of a bracket within 1 % of a factor.
VerificationCheck check_factor(const std::string& what, const FactorBracket& bracket, double reference) {
  const double found =
      bracket.lower && bracket.upper ? std::sqrt(*bracket.lower * *bracket.upper) : std::nan("");
  return check_relative("factor of safety, " + what, found, reference, 0.01);
}

/// F = (W cos(alpha) tan(phi) + c A) / (W sin(alpha)), if the whole base is in compression: the weight acts in its
/// middle third, height tan(alpha) <= length / 3.
std::vector<VerificationCheck> plane_slide_safety(const Placement& placement) {
  constexpr double height = 0.5;
  std::vector<VerificationCheck> checks;
  for (const auto& [incline, phi, cohesion] :
       {std::array{30.0, 25.0, 8e3}, {30.0, 40.0, 0.0}, {50.0, 20.0, 2e4}}) {
    const double alpha = std::atan(tangent_of(incline));
    const Placement lowered{slope(incline)};
    const auto add = [&](ContactScene& scene) {
      scene.add_fixed(placed(Polyhedron(make_box({-6, -2, -1}, {6, 2, 0})), lowered));
      scene.add(define_block(placed(Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, height})), lowered),
                             common_rock, 1));
    };
    const double weight = 2.0 * height * common_rock.density * earth_gravity, area = 2.0;
    const double reference =
        (weight * std::cos(alpha) * tangent_of(phi) + cohesion * area) / (weight * std::sin(alpha));
    checks.push_back(check_factor(fmt::format("alpha {}, phi {}, c {} Pa", incline, phi, cohesion),
                                  safety_of(plastic_joint(tangent_of(phi), cohesion), 1.0, add, placement),
                                  reference));
  }
  return checks;
}

/// F = ((N_A + N_B) tan(phi) + c (A_A + A_B)) / T.
std::vector<VerificationCheck> wedge_safety(const Placement& placement) {
  const SlidingWedge wedge;
  const double weight = wedge.volume() * common_rock.density * earth_gravity;
  std::vector<VerificationCheck> checks;
  for (const auto& [phi, cohesion] : {std::array{30.0, 2e3}, {20.0, 4e3}, {45.0, 0.0}}) {
    const double reference =
        (wedge.grip * weight * tangent_of(phi) + cohesion * wedge.contact_area()) / (wedge.slip * weight);
    checks.push_back(
        check_factor(fmt::format("phi {}, c {} Pa", phi, cohesion),
                     safety_of(
                         plastic_joint(tangent_of(phi), cohesion), std::cbrt(wedge.volume()),
                         [&](ContactScene& scene) { wedge.add_to(scene, common_rock); }, placement),
                     reference));
  }
  return checks;
}

/// The columns stand at a friction angle of 39.5 degrees and topple at 36.5.
std::vector<VerificationCheck> toppling_safety(const Placement& placement) {
  JointLaw law;
  law.friction = tangent_of(39.5);
  const FactorBracket bracket = safety_of(law, std::cbrt(400.0), add_toppling_columns, placement);
  const double lower = bracket.lower.value_or(std::nan("")), upper = bracket.upper.value_or(std::nan(""));
  const double most = tangent_of(39.5) / tangent_of(36.5);
  return {check_absolute(fmt::format("factor of safety ({:.4f} to {:.4f}) is at least 1", lower, upper),
                         lower >= 1.0 ? 1.0 : 0.0, 1.0, 0.0),
          check_absolute(fmt::format("and at most {:.4f}", most), upper <= most ? 1.0 : 0.0, 1.0, 0.0)};
}

/// F = tan(phi) over the least friction of rigid voussoirs: crown and haunch hinge while the springings slide.
std::vector<VerificationCheck> arch_safety(const Placement& placement) {
  std::vector<VerificationCheck> checks;
  for (const VoussoirArch& arch : {VoussoirArch{8, 0.15}, VoussoirArch{26, 0.15}}) {
    JointLaw law;
    law.friction = tangent_of(40);
    const double size = std::cbrt(arch.ratio * VoussoirArch::mean_radius * VoussoirArch::depth *
                                  std::numbers::pi * VoussoirArch::mean_radius / arch.count);
    checks.push_back(
        check_factor(fmt::format("{} voussoirs, t / R = {}", arch.count, arch.ratio),
                     safety_of(
                         law, size, [&](ContactScene& scene) { arch.add_to(scene, common_rock); }, placement),
                     law.friction / arch.least_friction()));
  }
  return checks;
}

constexpr VerificationCase safety_case_list[] = {
    {"plane-slide-safety", "factor of safety of a block on a plane", plane_slide_safety},
    {"wedge-safety", "factor of safety of a wedge", wedge_safety},
    {"arch-safety", "factor of safety of semicircular arches that slide", arch_safety},
    {"toppling-safety", "factor of safety of toppling columns", toppling_safety},
};

}  // namespace

std::span<const VerificationCase> safety_cases() {
  return safety_case_list;
}

}  // namespace ashlar
