#include "apps/run/answers/limit_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "apps/run/answers/block_name.hpp"
#include "apps/run/answers/crushing_run.hpp"
#include "apps/run/answers/factor_analysis.hpp"
#include "apps/run/answers/path_run.hpp"
#include "apps/scene/assemble/joint_selection.hpp"
#include "geometry/exact/axis_rotation.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "solver/limit/pressure_friction.hpp"
#include "solver/limit/soft_joints.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// Displacement of the farthest block in the drawing, in its sizes.
constexpr double drawn_share = 0.1;

bool is_safety(const SceneAnalysis& analysis) {
  return analysis.type == SceneAnalysis::Type::safety;
}

Json array(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

void add_motion(Json& json, const LimitMotion& motion, const Simulation& simulation) {
  json["mode"] = motion.mode;
  for (const char* key : {"moving", "accelerations", "angular_accelerations", "joints"})
    json[key] = Json::array();
  for (const LimitMotion::Block& block : motion.blocks) {
    json["moving"].push_back(block_name(simulation, block.block));
    json["accelerations"].push_back(array(block.acceleration));
    json["angular_accelerations"].push_back(array(block.angular_acceleration));
  }
  for (const MovingJoint& joint : motion.joints)
    json["joints"].push_back(
        {{"blocks", Json{block_name(simulation, joint.blocks[0]), block_name(simulation, joint.blocks[1])}},
         {"mode", to_string(joint.motion)}});
}

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// "between 1.08 and 1.09"
std::string between(const LimitBracket& bracket) {
  return fmt::format("between {:.5g} and {:.5g}", *bracket.lower, *bracket.upper);
}

/// "block a", "blocks a and b", "blocks a, b, c and 5 more"
std::string names_of(const Simulation& simulation, const std::vector<int>& blocks) {
  constexpr std::size_t most_named = 3;
  std::string text = blocks.size() == 1 ? "block " : "blocks ";
  const std::size_t named = std::min(blocks.size(), most_named);
  for (std::size_t k = 0; k < named; ++k) {
    const bool last = k + 1 == blocks.size();
    text += fmt::format("{}{}", k == 0 ? "" : last ? " and " : ", ", block_name(simulation, blocks[k]));
  }
  if (named < blocks.size()) text += fmt::format(" and {} more", blocks.size() - named);
  return text;
}

/// "factor of safety between 1.4 and 1.41: block a slides": a bracket that is wide or whose upper end is not proved is one
/// on the safe side.
std::string bracket_in_words(const LimitFindings& findings, const SceneAnalysis& analysis,
                             const std::string& motion) {
  const PathAnswer& path = findings.path.answer;
  const char* name = is_safety(analysis) ? "factor of safety" : "load factor";
  if (!path.proven)
    return fmt::format(
        "{} at least {:.5g}: blocks rest there, and at {:.5g} neither rest nor motion was found", name,
        *path.lower, *path.upper);
  const std::string wide = path.resolved
                               ? std::string()
                               : fmt::format(" (not to the tolerance of {})", search_of(analysis).tolerance);
  return fmt::format("{} between {:.5g} and {:.5g}{}: {}", name, *path.lower, *path.upper, wide, motion);
}

std::string factor_in_words(const LimitFindings& findings, const SceneAnalysis& analysis,
                            const Simulation& simulation) {
  const PathAnswer& path = findings.path.answer;
  const LimitBracket& associated = findings.answer.associated;
  const char* name = is_safety(analysis) ? "factor of safety" : "load factor";
  const SceneAnalysis::FactorSearch& search = search_of(analysis);
  const auto known = [](const std::optional<double>& factor) {
    return factor ? fmt::format("{:.5g}", *factor) : std::string("no factor");
  };
  if (!path.resolved && !(path.lower && path.upper))
    return fmt::format(
        "no {} to the tolerance of {}: {} stands, {} moves; analysis.method = \"elastic\" may find it", name,
        search.tolerance, known(path.lower), known(path.upper));
  if (!path.upper)
    return fmt::format("no {} up to {}: nothing moves{}", name, search.upper,
                       is_safety(analysis) ? " with strengths over that" : "");
  const std::string motion = words_of(signed_motion(findings), simulation);
  if (!path.lower)
    return fmt::format(
        "no {} down to {}: {}, {}", name, search.lower, motion,
        is_safety(analysis) ? fmt::format("also with strengths over {}", search.lower) : "under all loads");
  std::string text = bracket_in_words(findings, analysis, motion) + onset_in_words(findings.path, simulation);
  const double apart = 1.0 + 2.0 * search.tolerance;
  const std::optional<double>& released = findings.answer.released.lower;
  if (!released || *released * apart < *path.lower)
    text += fmt::format("; {} if joints do not wedge: {}", known(released),
                        words_of(findings.released, simulation));
  if (!associated.upper)
    return text + fmt::format("; if joints dilate, nothing moves up to {}", search.upper);
  if (associated.lower && *associated.lower > apart * *path.upper)
    text += fmt::format("; {} if joints dilate: {}", between(associated),
                        words_of(findings.associated, simulation));
  return text;
}

/// "; joints are soft: that of floor and stone closes by ..."; empty: none is
std::string soft_joint_in_words(const LimitFindings& findings, const Simulation& simulation) {
  if (!findings.path.answer.lower) return "";
  const std::optional<SoftJoint> joint =
      softest_joint(findings.path.rest.contacts, signed_motion(findings), simulation.system());
  if (!joint) return "";
  return fmt::format(
      "; joints are soft: that of {} and {} closes by {:.3g} mm under its force, and blocks that tip about "
      "its edge move from about {:.2g} % less on; analysis.method = \"elastic\" follows it",
      block_name(simulation, joint->blocks[0]), block_name(simulation, joint->blocks[1]),
      1e3 * joint->closure, 100.0 * joint->share);
}

/// Blocks to be checked by an engineer in addition to the factor.
std::string remarks(const LimitFindings& findings, const Simulation& simulation) {
  std::string text;
  const std::vector<int>& kept = findings.answer.kept_by_others;
  if (findings.has_residual_strength) text += ", by the residual strength of joints";
  if (!kept.empty())
    text += fmt::format("; {} would move below it but for the pressure of other blocks",
                        names_of(simulation, kept));
  if (const std::string crushed = crushing_in_words(findings.crushing, simulation); !crushed.empty())
    text += "; " + crushed;
  return text;
}

Json names_in_json(const std::vector<int>& blocks, const Simulation& simulation) {
  Json json = Json::array();
  for (const int block : blocks) json.push_back(block_name(simulation, block));
  return json;
}

/// Joints that crush have their strength in limit analysis alone: the lesser of both answers stands.
void take_crushing_limit(LimitFindings& findings, LimitAnalysis& analysis, bool safety) {
  const RigidModel& model = analysis.model();
  if (std::none_of(model.points.begin(), model.points.end(), crushes)) return;
  const LimitBracket& limit = findings.answer.released;
  PathAnswer& path = findings.path.answer;
  if (limit.lower && path.lower && *path.lower <= *limit.lower) return;
  path.lower = limit.lower;
  path.upper = limit.upper;
  path.resolved = limit.resolved;
  path.motion.reset();
  findings.path.motion = {};
  findings.path.rest = {};
  path.proven = true;
  if (!limit.lower) return;
  const double factor = *limit.lower;
  const LimitTrial stands =
      analysis.associated(safety ? LimitFactors{factor, 1.0} : LimitFactors{1.0, factor});
  findings.path.rest =
      balanced_forces(analysis.model(), stands.force, analysis.reduced(), stands.factors.strength);
}

}  // namespace

std::string words_of(const LimitMotion& motion, const Simulation& simulation) {
  if (motion.blocks.empty()) return "nothing moves";
  const auto fastest = std::max_element(
      motion.blocks.begin(), motion.blocks.end(),
      [](const auto& x, const auto& y) { return x.acceleration.norm() < y.acceleration.norm(); });
  const std::string first = block_name(simulation, fastest->block);
  if (motion.blocks.size() == 1) return fmt::format("block {} {}", first, motion.mode);
  return fmt::format("{} blocks move, block {} fastest: it {}", motion.blocks.size(), first, motion.mode);
}

const LimitMotion& signed_motion(const LimitFindings& findings) {
  return findings.path.motion.blocks.empty() ? findings.released : findings.path.motion;
}

namespace {

/// @param reduced by point: its strength is divided by a factor of safety
LimitFindings limits_of(const Scene& scene, RigidModel model, const std::vector<bool>& reduced,
                        const Simulation& simulation, int threads,
                        const std::function<bool()>& may_continue) {
  LimitFindings findings;
  findings.has_residual_strength = model.has_residual_strength;
  LimitAnalysis analysis(std::move(model), reduced, threads);
  const SceneAnalysis::FactorSearch& asked = search_of(scene.analysis);
  const LimitSearch search{asked.lower, asked.upper, asked.tolerance};
  const auto motion_of_path = [&](const LimitBracket& bracket) {
    findings.path = find_path(scene, simulation, bracket, may_continue);
    std::optional<LimitTrial> motion = findings.path.answer.motion;
    // Points of the path are others than those of programmes.
    if (motion) motion->force.clear();
    return motion;
  };
  findings.answer = is_safety(scene.analysis) ? analysis.strength_factor(search, may_continue, motion_of_path)
                                              : analysis.load_factor(search, may_continue, motion_of_path);
  const std::optional<LimitTrial>& released = findings.answer.released.motion;
  const std::optional<LimitTrial>& associated = findings.answer.associated.motion;
  if (associated) findings.associated = analysis.motion_of(*associated);
  // If nothing moves below the associated limit, its motion is both.
  if (released)
    findings.released = released->force.empty() ? findings.path.motion
                        : released->released    ? analysis.motion_of(*released)
                                                : findings.associated;
  take_crushing_limit(findings, analysis, is_safety(scene.analysis));
  findings.answer.interrupted = findings.answer.interrupted || findings.path.answer.interrupted;
  if (!findings.answer.interrupted)
    findings.crushing = find_crushing(analysis, findings.path.answer, scene.analysis, threads);
  return findings;
}

/// Searches with the friction that joints have under the forces at the limit of the search before, and change of it at which they
/// end.
constexpr int most_searches = 8;
constexpr double same_friction = 1e-3;

}  // namespace

LimitFindings find_limits(const Scene& scene, RigidModel model, const Simulation& simulation, int threads,
                          const std::function<bool()>& may_continue) {
  const JointSelection selection(scene, scene.analysis.safety.of);
  const std::vector<bool> reduced = reduced_points(model, [&](int a, int b) {
    return selection.contains(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  });
  for (int n = 1;; ++n) {
    LimitFindings findings = limits_of(scene, model, reduced, simulation, threads, may_continue);
    const std::optional<double>& stands = findings.answer.released.lower;
    if (!has_pressure_friction(model) || findings.answer.interrupted || !stands) return findings;
    const LimitFactors limit =
        is_safety(scene.analysis) ? LimitFactors{*stands, 1.0} : LimitFactors{1.0, *stands};
    if (set_pressure_friction(model, limit, reduced) <= same_friction) return findings;
    if (n < most_searches) continue;
    // The friction is not yet that of the limit.
    findings.answer.released.resolved = findings.answer.associated.resolved = false;
    findings.path.answer.resolved = false;
    return findings;
  }
}

Json bars_json(const std::vector<BarForce>& forces, const Simulation& simulation) {
  std::map<int, std::array<double, 2>> by_bolt;
  for (const BarForce& bar : forces) {
    auto& [axial, shear] = by_bolt.try_emplace(bar.of.bolt, std::array{0.0, 0.0}).first->second;
    if (bar.of.part == BarPart::axial && std::abs(bar.force) > std::abs(axial)) axial = bar.force;
    if (bar.of.part == BarPart::dowel) shear = std::max(shear, bar.force);
  }
  Json json = Json::array();
  for (const auto& [bolt, largest] : by_bolt)
    json.push_back({{"name", simulation.system().bolts()[static_cast<std::size_t>(bolt)].name},
                    {"axial_force", largest[0]},
                    {"shear_force", largest[1]}});
  return json;
}

std::string describe(const LimitFindings& findings, const SceneAnalysis& analysis,
                     const Simulation& simulation) {
  return factor_in_words(findings, analysis, simulation) + soft_joint_in_words(findings, simulation) +
         remarks(findings, simulation);
}

Json limit_summary(const LimitFindings& findings, const Simulation& simulation) {
  const LimitBracket& released = findings.answer.released;
  const LimitBracket& associated = findings.answer.associated;
  const PathAnswer& path = findings.path.answer;
  Json json = {{"method", "limit"},
               {"strength", findings.has_residual_strength ? "residual" : "full"},
               {"lower", number(path.lower)},
               {"upper", number(path.upper)},
               {"proven", path.proven},
               {"released", number(released.lower)},
               {"associated", number(associated.lower)}};
  json["gap"] = path.lower && path.upper ? Json(*path.upper / *path.lower - 1.0) : Json(nullptr);
  add_path(json, findings.path, simulation);
  add_motion(json, signed_motion(findings), simulation);
  const std::vector<BarForce>& bars = path.lower ? findings.path.rest.bars : signed_motion(findings).bars;
  if (!bars.empty()) json["bolts"] = bars_json(bars, simulation);
  json["kept_by_others"] = names_in_json(findings.answer.kept_by_others, simulation);
  json["least_strength"] = least_strength_json(findings.crushing, simulation);
  json["associated_bracket"] = {number(associated.lower), number(associated.upper)};
  // The limit of the path is mostly the associated one: its motion is not told twice.
  const bool same = path.lower == associated.lower && path.upper == associated.upper;
  json["associated_motion"] = same ? Json(nullptr) : Json::object();
  if (!same) add_motion(json["associated_motion"], findings.associated, simulation);
  json["trials"] = Json::array();
  for (const LimitTrial& trial : findings.answer.trials)
    json["trials"].push_back({{"factor", trial.factors.strength * trial.factors.load},
                              {"law", trial.released ? "released" : "associated"},
                              {"outcome", to_string(trial.outcome)},
                              {"iterations", trial.iterations}});
  return json;
}

std::vector<Eigen::MatrixX3d> drawn_motion(const LimitMotion& motion, const Simulation& simulation) {
  double most = 0.0;
  for (const LimitMotion::Block& block : motion.blocks) {
    const double size = simulation.blocks()[static_cast<std::size_t>(block.block)].size();
    most = std::max({most, block.acceleration.norm() / size, block.angular_acceleration.norm()});
  }
  std::vector<Eigen::MatrixX3d> positions;
  for (const BlockState& state : simulation.states()) positions.push_back(state.position);
  if (most == 0.0) return positions;
  const double share = drawn_share / most;
  for (const LimitMotion::Block& block : motion.blocks) {
    Eigen::MatrixX3d& position = positions[static_cast<std::size_t>(block.block)];
    const BlockModel& model = simulation.blocks()[static_cast<std::size_t>(block.block)];
    const Eigen::VectorXd one = constant_function(position.rows(), model.basis().volume());
    const Eigen::Matrix3d turn = rotation_matrix(share * block.angular_acceleration);
    position = (position - one * block.about.transpose()) * turn.transpose() +
               one * (block.about + share * block.acceleration).transpose();
  }
  return positions;
}

std::vector<ShownState> limit_states(const LimitFindings& findings, const SceneAnalysis& analysis,
                                     const Simulation& simulation) {
  const PathAnswer& path = findings.path.answer;
  const char* name = is_safety(analysis) ? "factor of safety" : "load factor";
  std::vector<ShownState> states;
  if (path.lower)
    states.push_back({fmt::format("at rest under {} {:.5g}", name, *path.lower), {}, findings.path.rest});
  const LimitMotion& motion = signed_motion(findings);
  if (motion.blocks.empty()) return states;
  std::vector<Eigen::MatrixX3d> positions = drawn_motion(motion, simulation);
  BalancedForces forces =
      path.lower ? carried(findings.path.rest, positions, simulation) : BalancedForces{{}, motion.bars};
  const std::string where =
      path.upper ? fmt::format("beyond {} {:.5g}", name, path.lower.value_or(*path.upper)) : "found";
  states.push_back(
      {fmt::format("{} {}, enlarged",
                   path.upper && !path.proven ? "a motion that may begin" : "onset of the motion", where),
       std::move(positions), std::move(forces)});
  return states;
}

}  // namespace ashlar
