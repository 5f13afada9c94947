// Cases of bolts and props: forces, displacements and factors of safety by hand. Blocks are rigid, so that only bolts
// give way.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_values.hpp"
#include "apps/run/factor_analysis.hpp"
#include "solver/statics/limit_analysis.hpp"

namespace ashlar {
namespace {

/// A straight bolt from one block into another one; with grout, `joint` is how far from its first end the blocks meet.
Bolt bolt_between(const BoltLaw& law, int first, const Vector3& from, int second, const Vector3& to,
                  double joint) {
  const double length = (to - from).norm();
  std::vector<BoltSpan> spans = {{first, 1, 0.0, joint}, {second, 1, joint, length}};
  if (law.anchorage == BoltAnchorage::ends) spans = {{first, 1, 0.0, 0.0}, {second, 1, length, length}};
  return {"bolt", BoltChain(law, BoltShape(law, from, to, std::move(spans), 0.025), {true, true}), true};
}

BoltLaw grouted(double axial_stiffness, double bond_stiffness) {
  BoltLaw law;
  law.axial_stiffness = axial_stiffness;
  law.bond_stiffness = bond_stiffness;
  return law;
}

BoltLaw at_ends(double axial_stiffness) {
  BoltLaw law;
  law.anchorage = BoltAnchorage::ends;
  law.axial_stiffness = axial_stiffness;
  return law;
}

/// A block of 2 m^3 under a fixed roof that it touches, z = 0, both 2 m high, held by bolts. Blocks 0 and 1.
Simulation under_a_roof(std::vector<Bolt> bolts) {
  ContactScene scene;
  scene.settings.gravity = {0, 0, -earth_gravity};
  choose_as_for_statics(scene, 1.0, common_rock.young_modulus, 0.5);
  scene.add_fixed(Polyhedron(make_box({-2, -2, 0}, {2, 2, 2})));
  scene.add(define_block(Polyhedron(make_box({-0.5, -0.5, -2}, {0.5, 0.5, 0})), common_rock, 0));
  Simulation simulation = scene.build();
  simulation.add_bolts(std::move(bolts));
  return simulation;
}
constexpr double hung_weight = 2.0 * 2500.0 * earth_gravity;

/// The bar in rigid rock, EA w'' = k w: a force T pulls it out by T coth(lambda L) / (EA lambda), lambda^2 = k / EA, on
/// each side of the joint. With the strength of the bond in one block below T / L it slips out.
std::vector<VerificationCheck> pull_out() {
  std::vector<VerificationCheck> checks;
  for (const auto& [ea, k, length] : {std::array{1e8, 1e9, 1.5}, {1e8, 2e7, 1.0}, {3e7, 5e6, 1.8}}) {
    const Vector3 from(0, 0, length), to(0, 0, -length);
    Simulation simulation = under_a_roof({bolt_between(grouted(ea, k), 0, from, 1, to, length)});
    const std::string where = fmt::format("EA {} N, k {} Pa, L {} m", ea, k, length);
    const double before = centroid(simulation, 1).z();
    checks.push_back(check_status("equilibrium, " + where, simulation, StaticStatus::equilibrium));
    const double lambda = std::sqrt(k / ea);
    checks.push_back(check_relative("pulled out by, " + where, before - centroid(simulation, 1).z(),
                                    2.0 * hung_weight / (std::tanh(lambda * length) * ea * lambda), 0.01));
    checks.push_back(check_relative("force at the joint, " + where,
                                    largest_axial_force(simulation.bolts()[0]), hung_weight, 0.01));
    for (const auto& [share, status] :
         {std::pair(1.01, StaticStatus::equilibrium), {0.99, StaticStatus::moving}}) {
      BoltLaw law = grouted(ea, k);
      law.bond_strength = share * hung_weight / length;
      Simulation slipping = under_a_roof({bolt_between(law, 0, from, 1, to, length)});
      checks.push_back(
          check_status(fmt::format("bond of {} times the weight, {}", share, where), slipping, status));
    }
  }
  return checks;
}

/// n equal bars at the corners and edges of a block bear W / n each, and become longer by W L / (n EA).
std::vector<VerificationCheck> hung_block() {
  std::vector<VerificationCheck> checks;
  for (const std::size_t count : {3U, 4U, 6U}) {
    std::vector<Bolt> bolts;
    for (std::size_t k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
      const Vector3 place(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0.0);
      bolts.push_back(
          bolt_between(at_ends(2e7), 0, place + Vector3(0, 0, 1.5), 1, place - Vector3(0, 0, 0.5), 0.0));
    }
    Simulation simulation = under_a_roof(std::move(bolts));
    const double before = centroid(simulation, 1).z();
    checks.push_back(
        check_status(fmt::format("equilibrium, {} bars", count), simulation, StaticStatus::equilibrium));
    const double share = hung_weight / static_cast<double>(count);
    double farthest = share;
    for (const BoltState& bolt : simulation.bolts())
      if (std::abs(bolt.axial[0] - share) >= std::abs(farthest - share)) farthest = bolt.axial[0];
    checks.push_back(
        check_relative(fmt::format("force farthest from W / n, {} bars", count), farthest, share, 0.01));
    checks.push_back(check_relative(fmt::format("sinks by, {} bars", count),
                                    before - centroid(simulation, 1).z(), share * 2.0 / 2e7, 0.01));
  }
  return checks;
}

/// The yield force T of a bolt at an angle beta with the plane, up the slope, acts on a sliding block along the plane
/// by T cos(beta) and on the plane by T sin(beta):
///   F = (W cos(alpha) + T sin(beta)) tan(phi) / (W sin(alpha) - T cos(beta))
std::vector<VerificationCheck> bolted_slope() {
  std::vector<VerificationCheck> checks;
  constexpr double incline = 40.0, phi = 30.0;
  const double weight = 2.0 * common_rock.density * earth_gravity;
  for (const auto& [beta, share] : {std::array{40.0, 0.2}, {70.0, 0.3}, {55.0, 0.15}}) {
    const double alpha = incline * std::numbers::pi / 180.0, angle = beta * std::numbers::pi / 180.0;
    const double force = share * weight;
    const double reference = (weight * std::cos(alpha) + force * std::sin(angle)) * tangent_of(phi) /
                             (weight * std::sin(alpha) - force * std::cos(angle));
    // In axes of the plane: x down the slope, z out of it. Up the slope and into the base is (-cos, 0, -sin).
    const Vector3 along(-std::cos(angle), 0.0, -std::sin(angle));
    const Vector3 at_joint(0.0, 0.0, 0.0);
    BoltLaw law = grouted(1e8, 1e9);
    law.yield_force = force;
    const Vector3 from = at_joint - 0.9 * along, to = at_joint + 1.5 * along;
    const FactorBracket bracket = find_factor({.tolerance = 0.004}, [&](double factor) {
      ContactScene scene;
      scene.settings.gravity = earth_gravity * Vector3(std::sin(alpha), 0.0, -std::cos(alpha));
      choose_as_for_statics(scene, 1.0, common_rock.young_modulus, tangent_of(phi) / factor);
      scene.add_fixed(Polyhedron(make_box({-6, -2, -3}, {6, 2, 0})));
      scene.add(define_block(Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, 1})), common_rock, 1));
      Simulation simulation = scene.build();
      simulation.add_bolts({bolt_between(law, 1, from, 0, to, 0.9)});
      return run_trial(simulation, factor, 1.0);
    });
    const double found =
        bracket.lower && bracket.upper ? std::sqrt(*bracket.lower * *bracket.upper) : std::nan("");
    checks.push_back(check_relative(
        fmt::format("factor of safety, bolt at {} degrees, T = {} W", beta, share), found, reference, 0.01));
  }
  return checks;
}

/// A bolt across a plane without friction: its dowel bears W sin(alpha), by a slip of W sin(alpha) / k.
std::vector<VerificationCheck> dowel() {
  constexpr double alpha = 0.5, stiffness = 2e7;
  const double force = 2.0 * common_rock.density * earth_gravity * std::sin(alpha);
  ContactScene scene;
  scene.settings.gravity = earth_gravity * Vector3(std::sin(alpha), 0.0, -std::cos(alpha));
  choose_as_for_statics(scene, 1.0, common_rock.young_modulus, 0.0);
  scene.add_fixed(Polyhedron(make_box({-6, -2, -3}, {6, 2, 0})));
  scene.add(define_block(Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, 1})), common_rock, 0));
  Simulation simulation = scene.build();
  BoltLaw law = grouted(1e8, 1e9);
  law.shear_stiffness = stiffness;
  simulation.add_bolts({bolt_between(law, 1, {0, 0, 1}, 0, {0, 0, -2}, 1.0)});
  const double before = centroid(simulation, 1).x();
  std::vector<VerificationCheck> checks = {
      check_status("equilibrium", simulation, StaticStatus::equilibrium)};
  checks.push_back(check_relative("shear force", largest_shear_force(simulation.bolts()[0]), force, 0.01));
  checks.push_back(check_relative("slip", centroid(simulation, 1).x() - before, force / stiffness, 0.01));
  return checks;
}

/// A block on a plane without friction, pushed by P against three struts: the middle one yields at Y, the others of
/// stiffness k / 2 each bear the rest, by a way of (P - Y) / k.
std::vector<VerificationCheck> yielding_prop() {
  constexpr double push = 3e5, yield = 1e5, stiffness = 4e7;
  ContactScene scene;
  scene.settings.gravity = {0, 0, -earth_gravity};
  choose_as_for_statics(scene, 1.0, common_rock.young_modulus, 0.0);
  scene.add_fixed(Polyhedron(make_box({-4, -2, -1}, {6, 2, 0})));
  BlockDefinition block = define_block(Polyhedron(make_box({-1, -1, 0}, {1, 1, 1})), common_rock, 0);
  block.loads.push_back({Vector3(-1, 0, 0.5), false, Vector3(push, 0, 0), {}});
  scene.add(std::move(block));
  scene.add_fixed(Polyhedron(make_box({4, -2, 0}, {6, 2, 1})));
  Simulation simulation = scene.build();
  std::vector<Bolt> props;
  for (const double y : {-0.6, 0.0, 0.6}) {
    BoltLaw law = at_ends((y == 0.0 ? 5e7 : 0.5 * stiffness) * 3.0);
    law.tension = false;
    if (y == 0.0) law.yield_force = yield;
    props.push_back(bolt_between(law, 1, {1, y, 0.5}, 2, {4, y, 0.5}, 0.0));
  }
  simulation.add_bolts(std::move(props));
  const double before = centroid(simulation, 1).x();
  std::vector<VerificationCheck> checks = {
      check_status("equilibrium", simulation, StaticStatus::equilibrium)};
  checks.push_back(
      check_relative("force of the yielding prop", -simulation.bolts()[1].axial[0], yield, 0.01));
  checks.push_back(
      check_relative("force of another one", -simulation.bolts()[0].axial[0], 0.5 * (push - yield), 0.01));
  checks.push_back(
      check_relative("way", centroid(simulation, 1).x() - before, (push - yield) / stiffness, 0.01));
  return checks;
}

/// Both limits of a scene with bolts. @param multiplied true if loads get the factor, false: strengths over it
void add_limits(std::vector<VerificationCheck>& checks, const std::string& what, const Simulation& simulation,
                bool multiplied, double reference) {
  const std::vector<bool> blocks(simulation.blocks().size(), multiplied);
  LimitAnalysis analysis(
      simulation.rigid_model(1.0, blocks), [](int, int) { return true; }, 1);
  const LimitSearch search{0.01 * reference, 100.0 * reference, 5e-4};
  const auto goes_on = [] { return true; };
  const LimitAnswer answer =
      multiplied ? analysis.load_factor(search, goes_on) : analysis.strength_factor(search, goes_on);
  checks.push_back(check_relative(what + ", released", middle(answer.released), reference, 1e-3));
  checks.push_back(check_relative(what + ", associated", middle(answer.associated), reference, 1e-3));
}

/// The slope of bolted_slope(), by limit analysis.
std::vector<VerificationCheck> limit_of_a_bolted_slope() {
  std::vector<VerificationCheck> checks;
  constexpr double incline = 40.0, phi = 30.0;
  const double weight = 2.0 * common_rock.density * earth_gravity, alpha = incline * std::numbers::pi / 180.0;
  for (const auto& [beta, share] : {std::array{40.0, 0.2}, {70.0, 0.3}, {55.0, 0.15}}) {
    const double angle = beta * std::numbers::pi / 180.0, force = share * weight;
    ContactScene scene;
    scene.settings.gravity = earth_gravity * Vector3(std::sin(alpha), 0.0, -std::cos(alpha));
    choose_as_for_statics(scene, 1.0, common_rock.young_modulus, tangent_of(phi));
    scene.add_fixed(Polyhedron(make_box({-6, -2, -3}, {6, 2, 0})));
    scene.add(define_block(Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, 1})), common_rock, 0));
    Simulation simulation = scene.build();
    const Vector3 along(-std::cos(angle), 0.0, -std::sin(angle));
    BoltLaw law = grouted(1e8, 1e9);
    law.yield_force = force;
    simulation.add_bolts({bolt_between(law, 1, -0.9 * along, 0, 1.5 * along, 0.9)});
    add_limits(checks, fmt::format("factor of safety, bolt at {} degrees, T = {} W", beta, share), simulation,
               false,
               (weight * std::cos(alpha) + force * std::sin(angle)) * tangent_of(phi) /
                   (weight * std::sin(alpha) - force * std::cos(angle)));
  }
  return checks;
}

/// A pyramid under a roof is pulled off by P = n T - W from n bolts of strength T, of steel or of grout.
std::vector<VerificationCheck> bolted_wedge() {
  std::vector<VerificationCheck> checks;
  constexpr double strength = 6e4, length = 0.5;
  const double weight = 4.0 / 3.0 * common_rock.density * earth_gravity;
  for (const int count : {3, 5}) {
    for (const bool steel : {true, false}) {
      ContactScene scene;
      scene.settings.gravity = {0, 0, -earth_gravity};
      choose_as_for_statics(scene, 1.0, common_rock.young_modulus, 0.5);
      scene.add_fixed(Polyhedron(make_box({-3, -3, 0}, {3, 3, 2})));
      BlockDefinition wedge =
          define_block(hull_of({{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {0, 0, -1}}), common_rock, 0);
      wedge.loads.push_back({Vector3(0, 0, -1), false, Vector3(0, 0, -1e3), {}});
      scene.add(std::move(wedge));
      Simulation simulation = scene.build();
      BoltLaw law = grouted(1e8, 1e9);
      (steel ? law.yield_force : law.bond_strength) = steel ? strength : strength / length;
      std::vector<Bolt> bolts;
      for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        const Vector3 place(0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.0);
        bolts.push_back(
            bolt_between(law, 0, place + Vector3(0, 0, 0.8), 1, place - Vector3(0, 0, length), 0.8));
      }
      simulation.add_bolts(std::move(bolts));
      add_limits(
          checks,
          fmt::format("pull on a wedge with {} bolts, kN, limited by {}", count, steel ? "steel" : "grout"),
          simulation, true, (count * strength - weight) / 1e3);
    }
  }
  return checks;
}

/// A block on a prop of strength Y resists P = Y - W.
std::vector<VerificationCheck> prop_limit() {
  std::vector<VerificationCheck> checks;
  for (const double yield : {1e5, 3e5}) {
    ContactScene scene;
    scene.settings.gravity = {0, 0, -earth_gravity};
    choose_as_for_statics(scene, 1.0, common_rock.young_modulus, 0.5);
    scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {2, 2, 0})));
    BlockDefinition block =
        define_block(Polyhedron(make_box({-0.5, -0.5, 2}, {0.5, 0.5, 4})), common_rock, 0);
    block.loads.push_back({Vector3(0, 0, 4), false, Vector3(0, 0, -1e3), {}});
    scene.add(std::move(block));
    Simulation simulation = scene.build();
    BoltLaw law = at_ends(1e8);
    law.yield_force = yield;
    law.tension = false;
    simulation.add_bolts({bolt_between(law, 0, {0, 0, 0}, 1, {0, 0, 2}, 0.0)});
    add_limits(checks, fmt::format("load on a prop of {} N, kN", yield), simulation, true,
               (yield - hung_weight) / 1e3);
  }
  return checks;
}

constexpr VerificationCase bolt_case_list[] = {
    {"bolt-pull-out", "a block under a roof hangs on one grouted bolt, until its bond slips", pull_out},
    {"bolt-hung-block", "a block hangs on n bars", hung_block},
    {"bolt-slope", "factor of safety of a block on a slope with a yielding bolt", bolted_slope},
    {"bolt-dowel", "a bolt across a plane without friction", dowel},
    {"bolt-limit-slope", "limit analysis of a block on a slope with a bolt", limit_of_a_bolted_slope},
    {"bolt-limit-wedge", "limit analysis of a wedge under a roof on n bolts", bolted_wedge},
    {"prop-limit", "limit analysis of a block on a prop", prop_limit},
    {"prop-yield", "a block pushed against three struts, of which one yields", yielding_prop},
};

}  // namespace

std::span<const VerificationCase> bolt_cases() {
  return bolt_case_list;
}

}  // namespace ashlar
