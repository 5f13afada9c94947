#include "solver/paths/pushover_activation.hpp"

#include <algorithm>
#include <utility>

#include "solver/paths/path_search.hpp"
#include "solver/paths/pushed_blocks.hpp"

namespace ashlar {
namespace {

/// Least multiplier of the search, of that of the limit: blocks that move below it have none.
constexpr double least_share_of_limit = 1e-3;

}  // namespace

std::optional<PushoverActivation> pushover_activation(const PlacedScene& scene, const PushoverSearch& search,
                                                      double limit) {
  RunState placed;
  placed.states = scene.states;
  for (const auto& [blocks, history] : scene.histories) placed.pairs[blocks].overlap = history.overlap;
  RigidModel model =
      rigid_model(scene.system, placed, scene.end_time, search.multiplied, RigidPointKind::springs);
  keep_residual_strength(model);
  if (search.multiplied.empty())
    push_masses(model,
                scene.system.settings().gravity_at(scene.end_time).norm() * search.direction.normalized());
  std::vector<double> allowed = displacements_of_rest(scene.system, model);
  LoadPath path(
      std::move(model), [](int, int) { return false; }, std::move(allowed));
  const LimitBracket associated{limit, limit * (1.0 + activation_tolerance), true, std::nullopt};
  const PathAnswer answer =
      search_path(path, Sought::load, {least_share_of_limit * limit, limit, activation_tolerance}, associated,
                  search.may_continue);
  if (answer.interrupted) return std::nullopt;
  const double rest = answer.lower.value_or(0.0);
  if (rest >= limit * (1.0 - 2.0 * activation_tolerance)) return PushoverActivation{limit, true};
  return PushoverActivation{rest, false};
}

}  // namespace ashlar
