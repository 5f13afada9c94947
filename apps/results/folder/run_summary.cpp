#include "apps/results/folder/run_summary.hpp"

#include <map>

#include "apps/results/folder/identity_json.hpp"
#include "apps/results/folder/program_version.hpp"
#include "apps/results/folder/rank_summary.hpp"
#include "apps/results/folder/support_summary.hpp"
#include "apps/results/system/this_process.hpp"
#include "apps/scene/check/warnings/base_motion.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "solver/state/automatic.hpp"

namespace ashlar {
namespace {

nlohmann::ordered_json counts_of(const BuiltSimulation& built) {
  const Simulation& simulation = built.simulation;
  const SimulationCounts counts = simulation.counts();
  const FinderCounts& finder = counts.finder;
  const auto predicates = static_cast<double>(finder.predicates.filter + finder.predicates.exact);
  return {{"different_blocks", built.different_blocks},
          {"block_pairs_tested", finder.block_pairs_tested},
          {"convex_pairs", finder.convex_pairs},
          {"block_pairs_skipped", finder.block_pairs_skipped},
          {"block_pairs_whose_contacts_lasted", finder.block_pairs_kept},
          {"triangles_near", finder.cells_near},
          {"block_pairs_known_apart", finder.block_pairs_far},
          {"block_pairs_followed_through_a_step", finder.motions_checked},
          {"contacts_added_for_passing", counts.passing_contacts},
          {"islands_put_to_sleep", counts.islands_put_to_sleep},
          {"steps_of_sleeping_blocks", counts.sleeping_block_steps},
          {"changes_of_sub_faces", finder.divisions},
          {"searches_at_the_limit_of_sub_faces", finder.divisions_at_limit},
          {"contact_points", counts.contact_points},
          {"open_close_iterations", counts.open_close_iterations},
          {"open_close_fallbacks", counts.open_close_fallbacks},
          {"predicates_by_filter", finder.predicates.filter},
          {"predicates_exact", finder.predicates.exact},
          {"share_of_exact_predicates",
           predicates > 0.0 ? static_cast<double>(finder.predicates.exact) / predicates : 0.0},
          {"symbolic_factorizations", counts.factors.analyses},
          {"numeric_factorizations", counts.factors.factorizations},
          {"numeric_factorizations_reused", counts.factors.factorizations_reused},
          {"linear_solves", counts.factors.solves},
          {"conjugate_gradient_iterations", counts.factors.gradient_iterations}};
}

nlohmann::ordered_json rejections_of(const Simulation& simulation) {
  std::map<std::string, int> reasons;
  for (const Rejection& rejection : simulation.rejections()) ++reasons[to_string(rejection.reason)];
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  constexpr std::size_t most = 1000;
  for (std::size_t k = 0; k < simulation.rejections().size() && k < most; ++k) {
    const Rejection& rejection = simulation.rejections()[k];
    list.push_back(
        {{"time", rejection.time}, {"step", rejection.step}, {"reason", to_string(rejection.reason)}});
  }
  return {{"count", simulation.rejections().size()}, {"reasons", reasons}, {"first", list}};
}

nlohmann::ordered_json moving_blocks_of(const Simulation& simulation) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const auto array = [](const Vector3& v) { return nlohmann::ordered_json{v.x(), v.y(), v.z()}; };
  for (const MovingBlock& moving : simulation.moving_blocks()) {
    list.push_back({{"block", simulation.blocks()[static_cast<std::size_t>(moving.block)].name()},
                    {"acceleration", array(moving.acceleration)},
                    {"angular_acceleration", array(moving.angular_acceleration)}});
  }
  return list;
}

nlohmann::ordered_json fixed_blocks_of(const Simulation& simulation) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const BlockModel& block : simulation.blocks())
    if (block.fixed()) list.push_back(block.name());
  return list;
}

/// Motion of the base; null if no base is moved.
nlohmann::ordered_json base_of(const Scene& scene) {
  const std::optional<std::size_t> base = moved_base(scene);
  if (!base) return nullptr;
  return scene.block[*base].name;
}

nlohmann::ordered_json json_of(const std::vector<DisplacedBlock>& displaced, const Simulation& simulation) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [block, distance] : displaced) {
    list.push_back(
        {{"block", simulation.blocks()[static_cast<std::size_t>(block)].name()}, {"distance", distance}});
  }
  return list;
}

nlohmann::ordered_json names_of_pair(const BlockPair& blocks, const Simulation& simulation) {
  const auto name = [&](int block) { return simulation.blocks()[static_cast<std::size_t>(block)].name(); };
  return {name(blocks[0]), name(blocks[1])};
}

nlohmann::ordered_json json_of(const DeepestPoint& deepest, const Simulation& simulation) {
  const Vector3& place = deepest.place;
  return {{"value", deepest.depth},
          {"of_smaller_block", deepest.share},
          {"blocks", names_of_pair(deepest.blocks, simulation)},
          {"time", deepest.time},
          {"place", nlohmann::ordered_json{place.x(), place.y(), place.z()}}};
}

/// Pairs of blocks with an initial overlap beyond rounding error.
nlohmann::ordered_json known_overlaps_of(const BuiltSimulation& built) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const KnownOverlap& known : built.overlaps) {
    if (known.rounding) continue;
    list.push_back({{"blocks", names_of_pair(known.blocks, built.simulation)},
                    {"depth", known.overlap.depth},
                    {"exact", known.overlap.exact}});
  }
  return list;
}

/// Null if there is none.
nlohmann::ordered_json json_of(const std::optional<PlacedValue>& largest, const Simulation& simulation) {
  if (!largest) return nullptr;
  const Vector3& place = largest->place;
  return {{"value", largest->value},
          {"block", simulation.blocks()[static_cast<std::size_t>(largest->block)].name()},
          {"place", nlohmann::ordered_json{place.x(), place.y(), place.z()}}};
}

nlohmann::ordered_json json_of(const std::vector<FinishedStage>& stages, const Scene& scene) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const auto& [status, message, steps, time] = stages[k];
    nlohmann::ordered_json stage = {{"name", scene.stage[k].name}, {"status", status}};
    if (!message.empty()) stage["message"] = message;
    stage["steps"] = steps;
    stage["time"] = time;
    list.push_back(std::move(stage));
  }
  return list;
}

/// Adds to each `place` in a value, also of nested ones.
void move_places(nlohmann::ordered_json& json, const Vector3& shift) {
  for (auto& [key, value] : json.items()) {
    if (key == "place" && value.is_array() && value.size() == 3) {
      for (int axis = 0; axis < 3; ++axis) {
        auto& coordinate = value.at(static_cast<std::size_t>(axis));
        coordinate = coordinate.get<double>() + shift[axis];
      }
    } else if (value.is_structured()) {
      move_places(value, shift);
    }
  }
}

/// Adds the extremes of the last state.
void add_largest(nlohmann::ordered_json& summary, const LargestValues& largest,
                 const Simulation& simulation) {
  summary["largest_displacement"] = json_of(largest.displacement, simulation);
  summary["largest_compression"] = json_of(largest.compression, simulation);
  summary["largest_tension"] = json_of(largest.tension, simulation);
  summary["largest_strain"] = json_of(largest.strain, simulation);
}

/// Values that were chosen automatically.
nlohmann::ordered_json json_of(const std::vector<AutomaticChoice>& choices) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const AutomaticChoice& choice : choices) {
    nlohmann::ordered_json value;
    std::visit([&](const auto& chosen) { value = chosen; }, choice.value);
    list.push_back({{"key", choice.key}, {"value", value}, {"unit", choice.unit}});
    if (!choice.reason.empty()) list.back()["reason"] = choice.reason;
  }
  return list;
}

void add_contact_tallies(nlohmann::ordered_json& summary, const Simulation& simulation) {
  if (const FrictionTally& tally = simulation.sliding_friction(); tally.due > 0.0)
    summary["sliding_friction"] = {{"coulomb", tally.due}, {"acted", tally.acted}};
  if (const DilatingSlip& slip = simulation.dilating_slip(); slip.all > 0.0)
    summary["dilating_slip"] = {{"all", slip.all}, {"in_flight", slip.in_flight}};
  if (const MostClosed& most = simulation.most_closed(); most.share > 0.0)
    summary["most_closed"] = {
        {"of_maximum", most.share}, {"blocks", names_of_pair(most.blocks, simulation)}, {"time", most.time}};
  if (const ImpactTally& impacts = simulation.impacts(); impacts.count > 0)
    summary["impacts"] = {{"count", impacts.count},
                          {"inaccurate", impacts.inaccurate},
                          {"unlike_restitution", impacts.unlike},
                          {"largest_residual", impacts.residual},
                          {"largest_residual_time", impacts.time}};
}

}  // namespace

void add_origin(nlohmann::ordered_json& summary, const Vector3& origin) {
  if (origin.isZero(0.0)) return;
  for (auto& [key, value] : summary.items())
    if (key != "scene" && value.is_structured()) move_places(value, origin);
  summary["origin"] = {origin.x(), origin.y(), origin.z()};
}

BrokenJoints broken_joints(const Simulation& simulation) {
  BrokenJoints broken;
  for (const auto& [blocks, pair] : simulation.histories()) {
    if (pair.broken > 0.0) ++broken.pairs;
    broken.area += pair.broken;
    broken.of_area += pair.bonded;
  }
  return broken;
}

nlohmann::ordered_json run_summary(const Scene& scene, const SceneIdentity& identity,
                                   const BuiltSimulation& built, const RunOutcome& outcome) {
  const auto& [status, message, seconds, frames, largest, stages, ranks] = outcome;
  const Simulation& simulation = built.simulation;
  nlohmann::ordered_json summary = nlohmann::ordered_json::object();
  summary["status"] = to_string(status);
  if (!message.empty()) summary["message"] = message;
  summary["title"] = scene.title;
  if (status == RunStatus::moving) summary["moving"] = moving_blocks_of(simulation);
  if (status == RunStatus::equilibrium)
    summary["displaced"] = json_of(displaced_blocks(simulation), simulation);
  summary["steps"] = simulation.steps();
  summary["time"] = simulation.time();
  summary["rejected_steps"] = rejections_of(simulation);
  summary["unknowns"] = simulation.unknowns();
  summary["blocks"] = simulation.blocks().size();
  summary["fixed"] = fixed_blocks_of(simulation);
  summary["base"] = base_of(scene);
  summary["frames"] = frames;
  const PhaseSeconds& phases = simulation.seconds();
  summary["wall_seconds"] = {{"total", seconds.total},
                             {"setup", seconds.setup},
                             {"contact_search", phases.contact_search},
                             {"contact_points", phases.contact_points},
                             {"solve", phases.solve},
                             {"motion_check", phases.motion_check},
                             {"depth_audit", phases.depth_audit},
                             {"output", seconds.output}};
  if (!ranks.empty()) add_ranks(summary, ranks);
  summary["peak_memory_bytes"] = peak_memory_bytes();
  summary["penetration_max"] = simulation.deepest().depth;
  summary["contact_depth_max"] = simulation.largest_penetration();
  if (const DeepestPoint& deepest = simulation.deepest(); deepest.depth > 0.0)
    summary["deepest"] = json_of(deepest, simulation);
  if (!built.overlaps.empty()) summary["known_overlaps"] = known_overlaps_of(built);
  add_largest(summary, largest, simulation);
  const BrokenJoints broken = ranks.empty() ? broken_joints(simulation) : broken_joints(ranks);
  summary["broken"] = {{"pairs", broken.pairs}, {"area", broken.area}, {"of_area", broken.of_area}};
  if (!simulation.bolts().empty()) summary["support"] = support_summary(simulation);
  add_contact_tallies(summary, simulation);
  summary["energy_redetection"] = {{"gained", simulation.ledger().redetection_gained},
                                   {"lost", simulation.ledger().redetection_lost}};
  summary["energy_residual"] = simulation.ledger().residual;
  summary["energy_residual_of_a_step_max"] = simulation.largest_step_residual();
  summary["energy_max"] = simulation.largest_energy();
  summary["counts"] = counts_of(built);
  summary["automatic"] = json_of(built.choices);
  nlohmann::ordered_json versions = nlohmann::ordered_json::object();
  versions["ashlar"] = program_version();
  for (const auto& [name, version] : tool_versions()) versions[name] = version;
  summary["versions"] = versions;
  summary["identity"] = to_json(identity);
  summary["scene"] = to_json(scene);
  if (!stages.empty()) summary["stages"] = json_of(stages, scene);
  return summary;
}

}  // namespace ashlar
