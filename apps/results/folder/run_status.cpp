#include "apps/results/folder/run_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/scene/build/initial_state.hpp"
#include "solver/state/automatic.hpp"
#include "solver/state/static_state.hpp"

namespace ashlar {

std::vector<DisplacedBlock> displaced_blocks(const Simulation& simulation) {
  std::vector<DisplacedBlock> result;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.fixed() || block.driven()) continue;
    const double distance =
        mean_motion(block, simulation.states()[k].position - block.initial_state().position);
    if (distance > displaced_share * block_size(block)) result.push_back({static_cast<int>(k), distance});
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

std::string describe_motion(const Simulation& simulation) {
  std::string text = "no equilibrium:";
  const char* separator = " ";
  constexpr std::size_t most_shown = 5;
  const std::vector<MovingBlock> blocks = simulation.moving_blocks();
  for (std::size_t k = 0; k < std::min(blocks.size(), most_shown); ++k) {
    const MovingBlock& moving = blocks[k];
    const auto& [x, y, z] =
        std::array{moving.acceleration.x(), moving.acceleration.y(), moving.acceleration.z()};
    text += fmt::format("{}block {} moves, acceleration [{:.4g}, {:.4g}, {:.4g}] m/s^2", separator,
                        simulation.blocks()[static_cast<std::size_t>(moving.block)].name(), x, y, z);
    separator = "; ";
  }
  if (blocks.size() > most_shown) text += fmt::format("; {} more blocks move", blocks.size() - most_shown);
  return text;
}

std::string describe_displaced(const Simulation& simulation) {
  std::vector<std::string> names;
  for (const auto& [block, distance] : displaced_blocks(simulation)) {
    names.push_back(fmt::format("block {} by {:.3g} m",
                                simulation.blocks()[static_cast<std::size_t>(block)].name(), distance));
  }
  return names.empty()
             ? ""
             : fmt::format("equilibrium, but far from where they were placed: {}", first_names(names));
}

std::string description_of(const StateFault& fault, const Simulation& simulation) {
  const auto name = [&](int block) { return simulation.blocks()[static_cast<std::size_t>(block)].name(); };
  if (fault.reason == RejectionReason::open_close_not_settled)
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
