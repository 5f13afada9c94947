// Cases of excavations: stress and displacement around a tunnel, and a wedge in its roof that horizontal stress clamps.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/program/verify/kirsch_tunnel.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/scene/build/build_simulation.hpp"

namespace ashlar {
namespace {

/// Errors fall with the order of the blocks and with their number; order 5 has the stress to 2 %.
std::vector<VerificationCheck> kirsch() {
  struct Case {
    double ratio;
    TunnelMesh mesh;
    double of_stress, of_displacement;  ///< allowed
  };
  std::vector<VerificationCheck> checks;
  for (const auto& [ratio, mesh, of_stress, of_displacement] : {Case{0.5, {3, 4, 8}, 0.15, 0.1},
                                                                {0.5, {4, 4, 8}, 0.1, 0.02},
                                                                {0.5, {5, 4, 8}, 0.02, 0.005},
                                                                {0.5, {4, 6, 6}, 0.05, 0.01},
                                                                {1.0, {5, 4, 8}, 0.01, 0.005},
                                                                {1.5, {5, 4, 8}, 0.02, 0.005}}) {
    KirschTunnel tunnel;
    tunnel.ratio = ratio;
    const TunnelErrors errors = errors_at_the_wall(tunnel, mesh);
    const std::string where = fmt::format("K = {}, {} sectors of order {}", ratio, mesh.sectors, mesh.order);
    checks.push_back(check_absolute("equilibrium, " + where, errors.equilibrium ? 1.0 : 0.0, 1.0, 0.0));
    checks.push_back(check_absolute("error of the hoop stress over that of the side wall, " + where,
                                    errors.hoop_stress, 0.0, of_stress));
    checks.push_back(check_absolute("error of the displacement over that of the crown, " + where,
                                    errors.displacement, 0.0, of_displacement));
  }
  return checks;
}

/// A prism with two faces at an angle a from the vertical in the roof of an excavation, clamped by a horizontal force H
/// on each of them (Brady and Brown, Rock Mechanics for Underground Mining, 3rd ed., 8.7). Its joints, of stiffness K_n
/// and K_s in all, begin with N = H cos(a) and S = H sin(a), whose sum is zero. A way u down unloads N and loads S:
///   S = H sin(a) + K_s u cos(a),   N = H cos(a) - K_n u sin(a)
///   P = 2 (S cos(a) - N sin(a)) = 2 u (K_s cos^2(a) + K_n sin^2(a))
/// It slides at S = N tan(phi). Beyond that N and S fall, so that no equilibrium is left:
///   P_l = 2 H (K_s cos^2(a) + K_n sin^2(a)) sin(phi - a) / (K_s cos(a) cos(phi) + K_n sin(a) sin(phi))
struct RoofWedge {
  double angle;         ///< a, deg
  double phi;           ///< deg
  double kn, ks;        ///< Pa/m
  double height = 2;    ///< m
  double stress = 4e5;  ///< horizontal pressure, Pa

  [[nodiscard]] double half_angle() const { return angle * std::numbers::pi / 180.0; }
  /// Of one face, 1 m wide.
  [[nodiscard]] double area() const { return height / std::cos(half_angle()); }
  [[nodiscard]] double stiffness() const {
    const double a = half_angle();
    return 2.0 * area() * (ks * std::pow(std::cos(a), 2) + kn * std::pow(std::sin(a), 2));
  }
  [[nodiscard]] double limit() const {
    const double a = half_angle(), p = phi * std::numbers::pi / 180.0;
    return stress * height * stiffness() * std::sin(p - a) /
           (area() * (ks * std::cos(a) * std::cos(p) + kn * std::sin(a) * std::sin(p)));
  }
  [[nodiscard]] std::string scene(double weight) const;
};

std::string RoofWedge::scene(double weight) const {
  const double half = height * std::tan(half_angle()), far = half + 3.0;
  const auto prism = [&](const char* name, const std::vector<std::array<double, 2>>& outline,
                         const char* keys) {
    std::string points;
    for (const auto& [x, z] : outline)
      for (const int y : {0, 1}) points += fmt::format("[{:.17g}, {}, {:.17g}], ", x, y, z);
    return fmt::format("[[block]]\nname = \"{}\"\nhull = {{ points = [{}] }}\n{}\n", name, points, keys);
  };
  std::string text = fmt::format(
      "[analysis]\ntype = \"static\"\ngravity = [0, 0, -10]\n[contact]\nfriction_angle = {:.17g}\n"
      "augmented = false\nnormal_stiffness = {:.17g}\nshear_stiffness = {:.17g}\n"
      "[[material]]\nname = \"rock\"\ndensity = {:.17g}\nyoung_modulus = 1e13\npoisson_ratio = 0.2\n"
      "[initial_stress]\nstress = [{:.17g}, 0, 0, 0, 0, 0]\n",
      phi, kn, ks, weight / (10.0 * half * height), -stress);
  text += prism("wedge", {{-half, 0}, {half, 0}, {0, height}}, "material = \"rock\"\norder = 1");
  text += prism("left", {{-half, 0}, {0, height}, {-far, height}, {-far, 0}}, "fixed = true");
  text += prism("right", {{half, 0}, {0, height}, {far, height}, {far, 0}}, "fixed = true");
  return text;
}

Simulation simulation_of(const std::string& text) {
  Diagnostics diagnostics;
  const auto loaded = load_scene_text(text, "wedge.toml", {}, diagnostics);
  if (loaded) {
    if (auto built = build_simulation(*loaded, 1, diagnostics)) return std::move(built->simulation);
  }
  std::string faults;
  for (const Diagnostic& fault : diagnostics.sorted()) faults += fault.message + "; ";
  throw std::runtime_error(faults);
}

std::vector<VerificationCheck> roof_wedge() {
  std::vector<VerificationCheck> checks;
  for (const RoofWedge& wedge : {RoofWedge{15, 35, 1e9, 1e8}, {20, 30, 5e8, 5e8}, {25, 40, 2e9, 1e8}}) {
    const std::string where =
        fmt::format("a = {}, phi = {}, kn / ks = {}", wedge.angle, wedge.phi, wedge.kn / wedge.ks);
    for (const auto& [share, expected] : {std::pair(0.5, StaticStatus::equilibrium),
                                          {0.99, StaticStatus::equilibrium},
                                          {1.01, StaticStatus::moving}}) {
      const double weight = share * wedge.limit();
      Simulation simulation = simulation_of(wedge.scene(weight));
      const double before = centroid(simulation, 0).z();
      checks.push_back(check_status(fmt::format("{} of the limit, {}", share, where), simulation, expected));
      if (share != 0.5) continue;
      checks.push_back(check_relative("sinks by, " + where, before - centroid(simulation, 0).z(),
                                      weight / wedge.stiffness(), 0.01));
      const Vector3 force = force_on_a(simulation.contacts().front());
      const double a = wedge.half_angle(), u = weight / wedge.stiffness();
      const double normal =
          wedge.stress * wedge.height * std::cos(a) - wedge.kn * wedge.area() * u * std::sin(a);
      const double shear =
          wedge.stress * wedge.height * std::sin(a) + wedge.ks * wedge.area() * u * std::cos(a);
      checks.push_back(check_relative("horizontal force on a face, " + where, std::abs(force.x()),
                                      normal * std::cos(a) + shear * std::sin(a), 0.01));
    }
  }
  // Steeper than friction: nothing holds it.
  const RoofWedge steep{35, 30, 1e9, 1e8};
  Simulation falls = simulation_of(steep.scene(1e4));
  checks.push_back(check_status("a above phi falls", falls, StaticStatus::moving));
  return checks;
}

constexpr VerificationCase tunnel_case_list[] = {
    {"kirsch", "stress and displacement of the wall of a circular tunnel in tied blocks", kirsch},
    {"roof-wedge", "a wedge in the roof of an excavation, clamped by horizontal stress", roof_wedge},
};

}  // namespace

std::span<const VerificationCase> tunnel_cases() {
  return tunnel_case_list;
}

}  // namespace ashlar
