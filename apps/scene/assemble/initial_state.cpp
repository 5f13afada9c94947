#include "apps/scene/assemble/initial_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/scene/model/joint_table.hpp"

namespace ashlar {
namespace {

bool has_tie(const Scene& scene, const JointTable& table, std::size_t block) {
  if (std::none_of(scene.joint.begin(), scene.joint.end(),
                   [](const SceneJoint& joint) { return joint.tied.value_or(false); }))
    return false;
  for (std::size_t other = 0; other < scene.block.size(); ++other)
    if (other != block && table.law_between(block, other).tied) return true;
  return false;
}

/// True if a corner's neighbourhood has no positive volume.
bool is_inside_out(const BlockModel& block, const BlockState& state) {
  const auto inverted = [&](int corner) {
    const Vector3& point = block.solid().mesh().points[static_cast<std::size_t>(corner)];
    const Eigen::Matrix3d gradient = state.position.transpose() * block.basis().gradients(point);
    return !(gradient.determinant() > 0.0);
  };
  const std::vector<int>& corners = block.solid().corners();
  return block.incremental() == nullptr && std::any_of(corners.begin(), corners.end(), inverted);
}

}  // namespace

std::vector<std::string> start_in_equilibrium(const Scene& scene, Simulation& simulation,
                                              Diagnostics& diagnostics) {
  const std::vector<int> balanced = simulation.settle_supported_blocks();
  const Place place = scene.places.value("analysis.initial_state");
  std::vector<std::string> as_placed;
  bool any_held = false;
  const JointTable table(scene);
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    const bool is_balanced =
        std::find(balanced.begin(), balanced.end(), static_cast<int>(k)) != balanced.end();
    if (is_balanced && is_inside_out(block, simulation.states()[k])) {
      diagnostics.error(place, fmt::format("initial_state (\"equilibrium\") turns block \"{}\" inside out; "
                                           "reduce its load or raise its stiffness",
                                           block.name()));
    }
    if (block.fixed() || is_balanced) continue;
    as_placed.push_back(block.name());
    if (!block.space().held() || has_tie(scene, table, k)) continue;
    any_held = true;
    diagnostics.warning(place,
                        fmt::format("initial_state (\"equilibrium\") was not found for block \"{}\": it "
                                    "starts as placed; less load or more supports may help",
                                    block.name()));
  }
  if (balanced.empty() && !any_held) {
    diagnostics.warning(place,
                        "initial_state has no effect (\"equilibrium\"): it applies to blocks held by "
                        "their own supports, and there is none; all start as placed");
  }
  return as_placed;
}

StaticStart start_in_statics(Simulation& simulation, const std::function<bool()>& may_continue) {
  switch (simulation.start_from_statics(may_continue)) {
    case StaticStatus::moving:
      return {
          StaticStart::End::answered,
          "note: initial_state (\"static\"): no equilibrium holds all blocks under gravity and the loads at "
          "t = 0; all start as placed"};
    case StaticStatus::equilibrium:
      return {};
    case StaticStatus::balancing:
      return {
          StaticStart::End::interrupted,
          "interrupted in the static analysis before the motion (initial_state = \"static\"): nothing of it "
          "is saved; run the same command again"};
    case StaticStatus::not_converged:
      break;
  }
  std::string why;
  const auto& fault = simulation.fault();
  if (fault && fault->reason == RejectionReason::open_close_not_converged) {
    const auto name = [&](int block) { return simulation.blocks()[static_cast<std::size_t>(block)].name(); };
    why = fmt::format(" (contacts of blocks {} and {} alternate)", name(fault->blocks[0]),
                      name(fault->blocks[1]));
  }
  return {StaticStart::End::failed,
          fmt::format(
              "error: initial_state (\"static\"): the analysis under gravity and the loads at t = 0 did not "
              "converge{}; run the scene with analysis.type = \"static\" to examine it",
              why)};
}

std::string first_names(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 5;
  const std::vector<std::string> first(
      names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), shown)));
  const std::string list = fmt::format("{}", fmt::join(first, ", "));
  return names.size() <= shown ? list : fmt::format("{} and {} more", list, names.size() - shown);
}

}  // namespace ashlar
