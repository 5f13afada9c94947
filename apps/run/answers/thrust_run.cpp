#include "apps/run/answers/thrust_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apps/results/text/atomic_file.hpp"
#include "apps/run/answers/block_name.hpp"
#include "apps/run/answers/drawing_view.hpp"
#include "apps/run/answers/limit_run.hpp"
#include "apps/run/answers/movement_run.hpp"
#include "solver/limit/limit_analysis.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

ThrustLine line_of(const RigidModel& model, const ThrustState& state) {
  std::vector<Eigen::Vector3d> in_frames;
  for (std::size_t k = 0; k < state.force.size(); ++k)
    in_frames.emplace_back(model.points[k].frame * state.force[k] / model.units.force());
  return {state.thrust, state.gap, joint_resultants(model, state.force), balanced_forces(model, in_frames)};
}

void add_state(std::vector<ShownState>& states, const SupportPath& path, const std::string& name) {
  if (!path.contacts.empty()) states.push_back({name, path.positions, {path.contacts, {}}});
}

Json to_json(const ThrustLine& line, const Simulation& simulation) {
  const auto array = [](const Vector3& v) { return Json{v.x(), v.y(), v.z()}; };
  Json json = Json::array();
  for (const JointResultant& joint : line.joints)
    json.push_back(
        {{"blocks", Json{block_name(simulation, joint.blocks[0]), block_name(simulation, joint.blocks[1])}},
         {"place", array(joint.place)},
         {"force", array(joint.force)}});
  return json;
}

/// The line of thrust: through each block from joint to joint, via the centroid if it has more than two.
std::string drawn_line(const ThrustLine& line, const Simulation& simulation, const DrawingView& view,
                       const char* colour) {
  std::map<int, std::vector<const JointResultant*>> by_block;
  for (const JointResultant& joint : line.joints)
    for (const int block : joint.blocks)
      if (!simulation.blocks()[static_cast<std::size_t>(block)].fixed()) by_block[block].push_back(&joint);
  std::string text;
  const auto segment = [&](const Vector3& from, const Vector3& to) {
    text += fmt::format("<polyline points=\"{} {}\" stroke=\"{}\" stroke-width=\"2\" fill=\"none\"/>\n",
                        view.at(from), view.at(to), colour);
  };
  for (const auto& [block, joints] : by_block) {
    if (joints.size() == 2) {
      segment(joints[0]->place, joints[1]->place);
      continue;
    }
    Vector3 middle = Vector3::Zero();
    double weight = 0.0;
    for (const JointResultant* joint : joints) {
      middle += joint->force.norm() * joint->place;
      weight += joint->force.norm();
    }
    for (const JointResultant* joint : joints) segment(joint->place, middle / weight);
  }
  return text;
}

}  // namespace

ThrustFindings find_thrust(const Scene& scene, RigidModel model, const Simulation& simulation, int threads,
                           const std::function<bool()>& may_continue) {
  ThrustFindings findings;
  divide_for_thrust(model, scene.analysis.gravity, threads);
  for (const ThrustRange& range : thrust_ranges(model, scene.analysis.gravity, threads)) {
    SupportThrust support{range.support, line_of(model, *range.least), std::nullopt};
    if (range.most) support.most = line_of(model, *range.most);
    findings.supports.push_back(std::move(support));
  }
  LimitAnalysis analysis(
      model, [](int, int) { return false; }, threads);
  const LimitTrial trial = analysis.associated({});
  if (trial.outcome == LimitOutcome::moves) {
    findings.supports.clear();
    findings.motion = analysis.motion_of(trial);
    findings.collapse = words_of(findings.motion, simulation);
  }
  if (findings.supports.empty()) return findings;
  for (const int support : moved_supports(scene, model))
    findings.movements.push_back(find_movement(scene, model, simulation, {support, threads, may_continue}));
  return findings;
}

std::string describe(const ThrustFindings& findings, const Simulation& simulation) {
  if (!findings.collapse.empty()) return "nothing stands: " + findings.collapse;
  if (findings.supports.empty()) return "no thrust was found: forces in balance were not told from others";
  std::string text;
  for (const SupportThrust& support : findings.supports) {
    text += fmt::format("{}thrust on {} ", text.empty() ? "" : "; ", block_name(simulation, support.support));
    text += support.most
                ? fmt::format("between {:.5g} and {:.5g} N", support.least.thrust, support.most->thrust)
                : fmt::format("at least {:.5g} N, without bound above", support.least.thrust);
  }
  for (const SupportMovement& movement : findings.movements) text += "; " + describe(movement, simulation);
  return text;
}

Json thrust_summary(const ThrustFindings& findings, const Simulation& simulation) {
  Json json = Json::array();
  for (const SupportThrust& support : findings.supports) {
    Json one = {{"support", block_name(simulation, support.support)},
                {"least", support.least.thrust},
                {"most", support.most ? Json(support.most->thrust) : Json(nullptr)},
                {"gap", std::max(support.least.gap, support.most ? support.most->gap : 0.0)},
                {"least_line", to_json(support.least, simulation)}};
    one["most_line"] = support.most ? to_json(*support.most, simulation) : Json(nullptr);
    if (!support.least.forces.bars.empty()) {
      one["least_bolts"] = bars_json(support.least.forces.bars, simulation);
      one["most_bolts"] = support.most ? bars_json(support.most->forces.bars, simulation) : Json(nullptr);
    }
    for (const SupportMovement& movement : findings.movements)
      if (movement.support == support.support) one["movement"] = movement_summary(movement, simulation);
    json.push_back(std::move(one));
  }
  return json;
}

std::vector<ShownState> thrust_states(const ThrustFindings& findings, const Simulation& simulation) {
  std::vector<ShownState> states;
  if (!findings.motion.blocks.empty())
    states.push_back({"onset of the motion, enlarged", drawn_motion(findings.motion, simulation), {}});
  for (const SupportThrust& support : findings.supports) {
    const std::string name = block_name(simulation, support.support);
    const auto add = [&](const char* which, const ThrustLine& line) {
      states.push_back({fmt::format("{} thrust on {}, {:.5g} N", which, name, line.thrust), {}, line.forces});
    };
    add("least", support.least);
    if (support.most) add("largest", *support.most);
  }
  for (const SupportMovement& movement : findings.movements) {
    const std::string name = block_name(simulation, movement.support);
    const auto [out, in] = senses_in_words(movement);
    add_state(states, movement.out, fmt::format("{} moved {:.5g} m {}", name, movement.out.lower, out));
    add_state(states, movement.in, fmt::format("{} moved {:.5g} m {}", name, movement.in.lower, in));
  }
  return states;
}

void draw_thrust(const ThrustFindings& findings, const Scene& scene, const Simulation& simulation,
                 const std::filesystem::path& path) {
  if (findings.supports.empty()) return;
  const DrawingView view(scene, simulation);
  std::string text = view.head() + view.blocks(simulation);
  const SupportThrust& support = findings.supports.front();
  text += drawn_line(support.least, simulation, view, "#1f5fa8");
  if (support.most) text += drawn_line(*support.most, simulation, view, "#b3261e");
  std::vector<DrawingView::Note> notes = {
      {"#1f5fa8", fmt::format("least thrust {:.4g} N", support.least.thrust)}};
  if (support.most) notes.push_back({"#b3261e", fmt::format("most {:.4g} N", support.most->thrust)});
  write_file_atomically(path, text + view.foot(notes), Durability::process);
}

}  // namespace ashlar
