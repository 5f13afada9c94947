#include "apps/run/answers/factor_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <set>

#include "apps/results/folder/run_status.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// Mode of most of the area of a pair's contact points.
const char* mode_of(const PairRecord& record) {
  std::array<double, 3> area = {};
  for (std::size_t k = 0; k < record.points.size(); ++k)
    area[static_cast<std::size_t>(record.responses[k].state)] += record.points[k].area;
  // A joint that transmits force at an edge is not open, however much of its area is.
  const double open = area[static_cast<std::size_t>(ContactState::open)];
  const double sticks = area[static_cast<std::size_t>(ContactState::locked)];
  const double slides = area[static_cast<std::size_t>(ContactState::sliding)];
  if (!(slides > 0.0) && !(sticks > 0.0)) return "opens";
  if (open > slides + sticks) return "opens";
  return slides >= sticks ? "slides" : "sticks";
}

/// Each process knows the present positions of its own blocks.
bool any_displaced(const Simulation& simulation) {
  const std::vector<DisplacedBlock> displaced = displaced_blocks(simulation);
  return any_of_run(simulation.system(),
                    std::any_of(displaced.begin(), displaced.end(), [&](const DisplacedBlock& block) {
                      return simulation.system().owns(block.block);
                    }));
}

}  // namespace

bool seeks_factor(const SceneAnalysis& analysis) {
  return analysis.type == SceneAnalysis::Type::safety || analysis.type == SceneAnalysis::Type::capacity;
}

const SceneAnalysis::FactorSearch& search_of(const SceneAnalysis& analysis) {
  return analysis.type == SceneAnalysis::Type::safety ? analysis.safety : analysis.capacity;
}

const char* factor_name(const SceneAnalysis& analysis) {
  return analysis.type == SceneAnalysis::Type::safety ? "factor_of_safety" : "load_factor";
}

TrialFactors trial_factors(const SceneAnalysis& analysis, double factor) {
  return analysis.type == SceneAnalysis::Type::safety ? TrialFactors{factor, 1.0} : TrialFactors{1.0, factor};
}

StaticStatus trial_step(Simulation& simulation, double end_time) {
  const StaticStatus status = simulation.static_step(end_time, displaced_share);
  return status == StaticStatus::balancing && any_displaced(simulation) ? StaticStatus::moving : status;
}

StaticStatus attempted_step(Simulation& simulation, double end_time) {
  try {
    return trial_step(simulation, end_time);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    if (simulation.shared_blocks() != nullptr) throw;
    return StaticStatus::not_converged;
  }
}

TrialOutcome outcome_of(StaticStatus status, const Simulation& simulation) {
  switch (status) {
    case StaticStatus::equilibrium:
      return any_displaced(simulation) ? TrialOutcome::moves : TrialOutcome::stands;
    case StaticStatus::moving:
      return TrialOutcome::moves;
    case StaticStatus::balancing:
    case StaticStatus::not_converged:
      break;
  }
  return TrialOutcome::unknown;
}

FactorTrial run_trial(Simulation& simulation, double factor, double end_time) {
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = attempted_step(simulation, end_time);
  return {factor, outcome_of(status, simulation), simulation.steps()};
}

double shown_factor(const FactorBracket& bracket, const SceneAnalysis::FactorSearch& search) {
  if (bracket.upper) return *bracket.upper;
  if (bracket.lower) return *bracket.lower;
  return std::clamp(1.0, search.lower, search.upper);
}

Json trials_json(const std::vector<FactorTrial>& trials) {
  Json json = Json::array();
  for (const FactorTrial& trial : trials)
    json.push_back(
        {{"factor", trial.factor}, {"outcome", to_string(trial.outcome)}, {"iterations", trial.iterations}});
  return json;
}

std::string bracket_so_far(const FactorBracket& bracket) {
  const auto known = [](const std::optional<double>& factor, const char* outcome, const char* none) {
    return factor ? fmt::format("{:.5g} {}", *factor, outcome) : std::string(none);
  };
  return fmt::format("{}, {}", known(bracket.lower, "stands", "no factor is known to stand"),
                     known(bracket.upper, "moves", "none to move"));
}

std::string describe(const FactorBracket& bracket, const SceneAnalysis& analysis) {
  const bool safety = analysis.type == SceneAnalysis::Type::safety;
  const char* name = safety ? "factor of safety" : "load factor";
  const SceneAnalysis::FactorSearch& search = search_of(analysis);
  if (!bracket.resolved && bracket.lower && bracket.upper)
    return fmt::format(
        "{} at least {:.5g}, at most {:.5g}: of what lies between static analyses found neither equilibrium "
        "nor "
        "motion",
        name, *bracket.lower, *bracket.upper);
  if (!bracket.resolved)
    return fmt::format(
        "no {} to the tolerance of {}: {} stands, {} moves, and of what lies between static analyses found "
        "neither equilibrium nor motion",
        name, search.tolerance, bracket.lower ? fmt::format("{:.5g}", *bracket.lower) : "no factor",
        bracket.upper ? fmt::format("{:.5g}", *bracket.upper) : "no factor");
  if (!bracket.upper)
    return fmt::format("no {} up to {}: nothing moves{}", name, search.upper,
                       safety ? ", however little strength is left" : "");
  if (!bracket.lower)
    return fmt::format("no {} down to {}: blocks move{}", name, search.lower,
                       safety ? " at all strengths" : " under all loads");
  return fmt::format("{} between {:.5g} and {:.5g}", name, *bracket.lower, *bracket.upper);
}

Json factor_summary(const FactorBracket& bracket, const Simulation& simulation) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  const auto name = [&](int block) { return simulation.blocks()[static_cast<std::size_t>(block)].name(); };
  const auto array = [](const Vector3& v) { return Json{v.x(), v.y(), v.z()}; };
  Json json = {{"method", "elastic"}, {"lower", number(bracket.lower)}, {"upper", number(bracket.upper)}};
  json["moving"] = Json::array();
  json["accelerations"] = Json::array();
  json["angular_accelerations"] = Json::array();
  std::set<int> moving;
  for (const MovingBlock& block : simulation.moving_blocks()) {
    moving.insert(block.block);
    json["moving"].push_back(name(block.block));
    json["accelerations"].push_back(array(block.acceleration));
    json["angular_accelerations"].push_back(array(block.angular_acceleration));
  }
  if (moving.empty()) {
    // Blocks that came to rest elsewhere.
    for (const DisplacedBlock& block : displaced_blocks(simulation)) {
      moving.insert(block.block);
      json["moving"].push_back(name(block.block));
    }
  }
  json["joints"] = Json::array();
  for (const PairRecord& record : simulation.contacts())
    if (!record.points.empty() && (moving.contains(record.a) || moving.contains(record.b)))
      json["joints"].push_back({{"blocks", Json{name(record.a), name(record.b)}}, {"mode", mode_of(record)}});
  json["trials"] = trials_json(bracket.trials);
  return json;
}

}  // namespace ashlar
