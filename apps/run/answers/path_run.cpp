#include "apps/run/answers/path_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/run/answers/block_name.hpp"
#include "apps/run/answers/factor_analysis.hpp"
#include "apps/scene/assemble/joint_selection.hpp"
#include "apps/scene/assemble/limit_choices.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// Allowed displacement by body, m.
std::vector<double> allowed_displacements(const Scene& scene, const Simulation& simulation,
                                          const RigidModel& model) {
  std::vector<double> allowed = displacements_of_rest(simulation.system(), model);
  for (std::size_t b = 0; b < allowed.size(); ++b)
    if (!model.bodies[b].blocks.empty())
      allowed[b] = scene.analysis.allowed_displacement.value_or(allowed[b]);
  return allowed;
}

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace

PathFindings find_path(const Scene& scene, const Simulation& simulation, const LimitBracket& associated,
                       const std::function<bool()>& may_continue) {
  const bool safety = scene.analysis.type == SceneAnalysis::Type::safety;
  RigidModel model = simulation.spring_model(scene.analysis.end_time,
                                             safety ? std::vector<bool>() : multiplied_blocks(scene));
  if (scene.analysis.method == SceneAnalysis::Method::limit) keep_residual_strength(model);
  PathFindings found;
  std::vector<double> allowed = allowed_displacements(scene, simulation, model);
  found.allowed = *std::min_element(allowed.begin(), allowed.end());
  const JointSelection reduced(scene, scene.analysis.safety.of);
  LoadPath path(
      std::move(model),
      [&](int a, int b) {
        return reduced.contains(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
      },
      std::move(allowed));
  const SceneAnalysis::FactorSearch& asked = search_of(scene.analysis);
  const LimitSearch search{asked.lower, asked.upper, asked.tolerance};
  found.answer =
      search_path(path, safety ? Sought::strength : Sought::load, search, associated, may_continue);
  if (found.answer.lower)
    found.rest =
        balanced_forces(path.model(), found.answer.force, path.reduced(), safety ? *found.answer.lower : 1.0);
  if (found.answer.motion) found.motion = limit_motion(path.model(), path.program(), *found.answer.motion);
  return found;
}

std::string onset_in_words(const PathFindings& path, const Simulation& simulation) {
  const PathAnswer& answer = path.answer;
  if (!answer.onset || !answer.lower || answer.onset_joints.empty()) return "";
  if (*answer.onset > 0.99 * *answer.lower) return "";
  const PairKey& first = answer.onset_joints.front();
  return fmt::format("; joints yield from {:.4g} on (first that of {} and {}), by {:.3g} mm at {:.5g}",
                     *answer.onset, block_name(simulation, first[0]), block_name(simulation, first[1]),
                     1e3 * answer.displacement, *answer.lower);
}

void add_path(Json& json, const PathFindings& path, const Simulation& simulation) {
  const PathAnswer& answer = path.answer;
  json["onset"] = or_null(answer.onset);
  json["onset_displacement"] = answer.onset ? Json(answer.onset_displacement) : Json(nullptr);
  json["onset_joints"] = Json::array();
  for (const PairKey& joint : answer.onset_joints)
    json["onset_joints"].push_back({block_name(simulation, joint[0]), block_name(simulation, joint[1])});
  json["displacement"] = answer.lower ? Json(answer.displacement) : Json(nullptr);
  json["allowed_displacement"] = path.allowed;
  json["confirmed"] = answer.lower.has_value();
  json["path_trials"] = Json::array();
  for (const LimitTrial& trial : answer.trials)
    json["path_trials"].push_back({{"factor", trial.factors.strength * trial.factors.load},
                                   {"outcome", to_string(trial.outcome)},
                                   {"iterations", trial.iterations}});
}

}  // namespace ashlar
