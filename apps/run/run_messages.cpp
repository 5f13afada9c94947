#include "apps/run/run_messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "apps/results/folder/identity_json.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/scene_difference.hpp"
#include "apps/scene/build/initial_state.hpp"
#include "apps/scene/read/scene_json.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {

std::string changes_since(const std::filesystem::path& folder, const Scene& scene,
                          const SceneIdentity& identity) {
  constexpr std::size_t most_shown = 5;
  nlohmann::ordered_json summary;
  try {
    summary = parse_json(whole_file(folder / "summary.json"));
  } catch (const std::runtime_error&) {
    return {};
  }
  if (!summary.is_object() || !summary.contains("scene")) return {};
  std::vector<std::string> keys = scene_differences(summary["scene"], to_json(scene));
  if (summary.contains("identity"))
    for (std::string& file : changed_files(summary["identity"], identity)) keys.push_back(std::move(file));
  if (keys.empty()) return {};
  const std::size_t hidden = keys.size() - std::min(keys.size(), most_shown);
  keys.resize(keys.size() - hidden);
  return fmt::format("; changed: {}{}", fmt::join(keys, ", "),
                     hidden > 0 ? fmt::format(" and {} more", hidden) : "");
}

void tell_choices(const BuiltSimulation& built, std::ostream& err) {
  for (const AutomaticChoice& choice : built.choices) {
    const auto* number = std::get_if<double>(&choice.value);
    const std::string value = number ? fmt::format("{:.4g} {}", *number, choice.unit)
                                     : fmt::format("{}", std::get<bool>(choice.value));
    err << fmt::format("chosen: {} = {}\n", choice.key, value);
  }
  if (!built.as_placed.empty())
    err << fmt::format("not settled: {} (initial_state settles blocks that their own supports hold)\n",
                       first_names(built.as_placed));
}

void tell_answers(const Simulation& simulation, const LargestValues& largest, std::ostream& err) {
  std::vector<std::string> parts;
  const auto add = [&](const char* what, const std::optional<PlacedValue>& value, double unit,
                       const char* name) {
    if (!value) return;
    parts.push_back(fmt::format("{} {:.4g} {} (block {})", what, value->value / unit, name,
                                simulation.blocks()[static_cast<std::size_t>(value->block)].name()));
  };
  add("displacement", largest.displacement, 1e-3, "mm");
  add("compression", largest.compression, 1e6, "MPa");
  add("tension", largest.tension, 1e6, "MPa");
  if (!parts.empty()) err << fmt::format("largest: {}\n", fmt::join(parts, ", "));
  const BrokenJoints broken = broken_joints(simulation);
  if (broken.pairs > 0)
    err << fmt::format("broken: {:.4g} of {:.4g} m^2 of joints with strength, between {} pairs of blocks\n",
                       broken.area, broken.of_area, broken.pairs);
}

void warn_of_depth(const Simulation& simulation, std::ostream& err) {
  constexpr double ordinary = 0.01;
  const DeepestPoint& deepest = simulation.deepest();
  if (!(deepest.share > ordinary)) return;
  const auto name = [&](int block) { return simulation.blocks()[static_cast<std::size_t>(block)].name(); };
  err << fmt::format(
      "ashlar: warning: block {} was {:.3g} m deep in block {} at t = {:.6g} s, {:.2g} of the smaller "
      "block's size; up to {} is ordinary: a larger contact.normal_stiffness or augmented = true keeps them "
      "apart\n",
      name(deepest.blocks[0]), deepest.depth, name(deepest.blocks[1]), deepest.time, deepest.share, ordinary);
}

void warn_of_friction(const Simulation& simulation, std::ostream& err) {
  constexpr double ordinary = 0.02;
  const double excess = simulation.sliding_friction().excess();
  if (!(std::abs(excess) > ordinary)) return;
  err << fmt::format(
      "ashlar: warning: where blocks slid on multipliers, {:.3g} of the friction has acted that "
      "Coulomb's law makes of their normal forces, as they part and meet again from step to step: a larger "
      "time_step, or "
      "augmented = false, whose friction is exact\n",
      1.0 + excess);
}

void warn_of_hops(const Simulation& simulation, std::ostream& err) {
  constexpr double ordinary = 0.02;
  const double share = simulation.dilating_slip().flown_share();
  if (!(share > ordinary)) return;
  err << fmt::format(
      "ashlar: warning: {:.3g} of the slip of joints that dilate took place in flight, where nothing "
      "dilates: blocks that "
      "slide so fast hop; a smaller time_step or [[joint]] damping keeps them on their joints\n",
      share);
}

void tell_end(const RunEnd& end, const std::filesystem::path& folder, bool quiet, std::ostream& err) {
  const auto& [status, message, unsaved] = end;
  if (!unsaved.empty()) {
    err << fmt::format("ashlar: error: {}; the last state could not be saved: {}\n", message, unsaved);
    return;
  }
  switch (status) {
    case RunStatus::failed:
      err << fmt::format("ashlar: error: {}; the last accepted state is in {}\n", message, folder.string());
      break;
    case RunStatus::not_converged:
      err << fmt::format("ashlar: error: {}; the last state is in {}\n", message, folder.string());
      break;
    case RunStatus::interrupted:
      err << fmt::format("ashlar: {}; the state is saved in {}, the same command with --resume goes on\n",
                         message, folder.string());
      break;
    case RunStatus::moving:
      if (!quiet) err << message << '\n';
      break;
    case RunStatus::equilibrium:
      if (!quiet) err << (message.empty() ? "equilibrium" : message) << '\n';
      break;
    case RunStatus::completed:
      if (!quiet && !message.empty()) err << message << '\n';
      break;
  }
}

}  // namespace ashlar
