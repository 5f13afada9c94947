#include "apps/results/folder/run_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/scene/assemble/initial_state.hpp"
#include "solver/state/static_state.hpp"

namespace ashlar {

/// "[0, 0, -9.81]": components below 1e-9 of the vector are rounding errors, written as 0.
static std::string without_noise(const Vector3& vector) {
  constexpr double noise = 1e-9;
  std::array<double, 3> shown = {};
  for (int k = 0; k < 3; ++k)
    shown.at(static_cast<std::size_t>(k)) = std::abs(vector[k]) > noise * vector.norm() ? vector[k] : 0.0;
  return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", shown[0], shown[1], shown[2]);
}

/// Of the fastest block's acceleration: others below it yield, they are no part of the mechanism.
constexpr double yielding_share = 0.01;

std::vector<DisplacedBlock> displaced_blocks(const Simulation& simulation) {
  std::vector<DisplacedBlock> result;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.fixed() || block.driven()) continue;
    const double distance =
        mean_motion(block, simulation.states()[k].position - block.initial_state().position);
    if (distance > displaced_share * block.size()) result.push_back({static_cast<int>(k), distance});
  }
  return result;
}

std::string to_string(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::equilibrium:
      return "equilibrium";
    case RunStatus::moving:
      return "moving";
    case RunStatus::not_converged:
      return "not converged";
  }
  return "unknown";
}

std::string motion_in_words(const Simulation& simulation) {
  std::vector<MovingBlock> moving = simulation.moving_blocks();
  if (moving.empty()) return "";
  const auto name = [&](const MovingBlock& one) {
    return simulation.blocks()[static_cast<std::size_t>(one.block)].name();
  };
  const MovingBlock fastest =
      *std::max_element(moving.begin(), moving.end(), [](const MovingBlock& a, const MovingBlock& b) {
        return a.acceleration.norm() < b.acceleration.norm();
      });
  const std::string acceleration = fmt::format("acceleration {} m/s^2", without_noise(fastest.acceleration));
  // Blocks beside a mechanism yield where it leaves.
  const std::size_t all = moving.size();
  std::erase_if(moving, [least = yielding_share * fastest.acceleration.norm()](const MovingBlock& one) {
    return one.acceleration.norm() < least;
  });
  const std::string others =
      moving.size() == all ? ""
                           : fmt::format("; {} yield{} at less than {:.0f} % of it", all - moving.size(),
                                         all - moving.size() == 1 ? "s" : "", 100.0 * yielding_share);
  if (moving.size() == 1) return fmt::format("block {} moves, {}{}", name(fastest), acceleration, others);
  std::size_t movable = 0;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k)
    if (!simulation.blocks()[k].fixed() && simulation.system().present(static_cast<int>(k))) ++movable;
  std::vector<std::string> names;
  names.reserve(moving.size());
  for (const MovingBlock& one : moving) names.push_back(name(one));
  return fmt::format("{} of {} blocks move: {}; block {} fastest, {}{}", moving.size(), movable,
                     first_names(names), name(fastest), acceleration, others);
}

std::string describe_motion(const Simulation& simulation) {
  return "no equilibrium: " + motion_in_words(simulation);
}

std::string describe_displaced(const Simulation& simulation) {
  std::vector<std::string> names;
  for (const auto& [block, distance] : displaced_blocks(simulation)) {
    names.push_back(fmt::format("block {} by {:.3g} m",
                                simulation.blocks()[static_cast<std::size_t>(block)].name(), distance));
  }
  if (simulation.rests_rigidly())
    return "equilibrium of rigid blocks, loaded slowly: the iteration for blocks that deform did not "
           "converge; forces of "
           "joints are those of rigid blocks on springs, and blocks have no stress";
  return names.empty()
             ? ""
             : fmt::format("equilibrium, but far from where they were placed: {}", first_names(names));
}

std::string description_of(const StateFault& fault, const Simulation& simulation) {
  const auto name = [&](int block) { return simulation.blocks()[static_cast<std::size_t>(block)].name(); };
  if (fault.reason == RejectionReason::open_close_not_converged)
    return fmt::format("contacts of blocks {} and {} alternate", name(fault.blocks[0]),
                       name(fault.blocks[1]));
  if (fault.reason != RejectionReason::too_deep) return fmt::format("block {}", name(fault.blocks[0]));
  return fmt::format(
      "block {} in block {} by {:.4g} m at [{:.6g}, {:.6g}, {:.6g}], at most {:.4g} m is allowed",
      name(fault.blocks[0]), name(fault.blocks[1]), fault.depth, fault.place.x(), fault.place.y(),
      fault.place.z(), fault.allowed);
}

std::string reason_of(const Rejection& rejection, const Simulation& simulation) {
  const auto& fault = simulation.fault();
  if (!fault || fault->reason != rejection.reason) return to_string(rejection.reason);
  return fmt::format("{}: {}", to_string(fault->reason), description_of(*fault, simulation));
}

}  // namespace ashlar
