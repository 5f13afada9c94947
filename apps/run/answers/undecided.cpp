#include "apps/run/answers/undecided.hpp"

#include <fmt/format.h>

#include "apps/run/answers/limit_choice.hpp"
#include "apps/run/answers/limit_run.hpp"
#include "solver/limit/limit_analysis.hpp"

namespace ashlar {
namespace {

/// "at most 0.1", "1.3", "more than 10"
std::string safe_end(const LimitBracket& bracket, const LimitSearch& search) {
  if (!bracket.lower) return fmt::format("at most {}", search.lower);
  if (!bracket.upper) return fmt::format("more than {}", search.upper);
  return fmt::format("{:.3g}", *bracket.lower);
}

}  // namespace

std::string undecided_factors(const Simulation& simulation, double end_time, int threads,
                              const std::function<bool()>& may_continue) {
  if (simulation.shared_blocks() != nullptr || simulation.system().any_incremental() ||
      !lacking_bolt(simulation).empty())
    return "";
  RigidModel model = simulation.level_model(end_time);
  if (loses_strength(model) || model.bodies.empty()) return "";
  LimitAnalysis analysis(
      std::move(model), [](int, int) { return true; }, threads);
  const LimitSearch search;
  const LimitAnswer answer = analysis.strength_factor(search, may_continue);
  if (answer.interrupted || !answer.released.resolved || !answer.associated.resolved) return "";
  std::string motion;
  if (answer.released.motion)
    motion = fmt::format(" ({})", words_of(analysis.motion_of(*answer.released.motion), simulation));
  return fmt::format(
      "rigid blocks have a factor of safety of {} without the stresses of earlier states{}, and of {} with "
      "the most favourable ones",
      safe_end(answer.released, search), motion, safe_end(answer.associated, search));
}

}  // namespace ashlar
