// A case that another program has published, with its numbers in apps/docs/peer_results.toml: a wall whose reactions are
// known. It stays here because each force is a sum over some twenty pairs of blocks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/verify/verification_contacts.hpp"
#include "apps/program/verify/verification_scenes.hpp"

namespace ashlar {
namespace {

constexpr double gravity = 9.81;

double angle_of(double friction) {
  return std::atan(friction) * 180.0 / std::numbers::pi;
}

/// Force below each course of a wall: the weight above it.
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
    {"wall-courses", "force below each course of a wall", wall_courses},
};

}  // namespace

std::span<const VerificationCase> peer_cases() {
  return peer_case_list;
}

}  // namespace ashlar
