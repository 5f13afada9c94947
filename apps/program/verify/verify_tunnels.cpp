// Stress and displacement around a tunnel in rings of sectors, whose corners are made by code.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/program/verify/kirsch_tunnel.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/scene/assemble/build_simulation.hpp"

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

constexpr VerificationCase tunnel_case_list[] = {
    {"kirsch", "stress and displacement of the wall of a circular tunnel in tied blocks", kirsch},
};

}  // namespace

std::span<const VerificationCase> tunnel_cases() {
  return tunnel_case_list;
}

}  // namespace ashlar
