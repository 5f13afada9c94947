#include "apps/run/run_messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "apps/results/folder/error_summary.hpp"
#include "apps/results/folder/run_summary.hpp"
#include "apps/run/answers/crushing_run.hpp"
#include "apps/run/contact_resolution.hpp"
#include "apps/scene/assemble/initial_state.hpp"
#include "apps/scene/check/warnings/soft_blocks.hpp"
#include "solver/state/automatic.hpp"

namespace ashlar {
namespace {

/// Names of blocks by their numbers.
auto names_in(const Simulation& simulation) {
  return [&simulation](int block) { return simulation.blocks()[static_cast<std::size_t>(block)].name(); };
}

/// Prints the largest displacement and stresses, and failed joints: one line.
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

/// Why two blocks are deep in each other, or what keeps them apart.
const char* reason_of_depth(const JointLaw& law) {
  if (law.crushes()) return "their joint crushes, and what it has crushed counts";
  if (law.has_multipliers()) return "a smaller time_step keeps them apart";
  return "a larger contact.normal_stiffness or augmented = true keeps them apart";
}

/// Warns of blocks that penetrate deeper than rigid contact would allow.
void warn_of_depth(const Simulation& simulation, std::ostream& err) {
  constexpr double ordinary = 0.01;
  const DeepestPoint& deepest = simulation.deepest();
  if (!(deepest.share > ordinary)) return;
  const auto name = names_in(simulation);
  err << fmt::format(
      "ashlar: warning: block {} was {:.3g} m deep in block {} at t = {:.6g} s, {:.2g} of the smaller "
      "block's size; up to {} is ordinary: {}\n",
      name(deepest.blocks[0]), deepest.depth, name(deepest.blocks[1]), deepest.time, deepest.share, ordinary,
      reason_of_depth(simulation.system().law(deepest.blocks[0], deepest.blocks[1])));
}

/// Warns of strains beyond those of linear elasticity, whatever causes them.
void warn_of_strain(const Simulation& simulation, const LargestValues& largest, std::ostream& err) {
  if (!largest.strain || !(largest.strain->value > largest_ordinary_strain)) return;
  const BlockModel& block = simulation.blocks()[static_cast<std::size_t>(largest.strain->block)];
  err << fmt::format(
      "ashlar: warning: block {} is strained by {:.3g} at the end, up to {} is ordinary: elasticity "
      "is wrong by about its strain; check loads, and the young_modulus of {:.3g} Pa\n",
      block.name(), largest.strain->value, largest_ordinary_strain, block.material().young_modulus);
}

/// Warns of sub-faces in contact that are too coarse for the curved faces that they stand for.
void warn_of_chords(const Simulation& simulation, std::ostream& err) {
  // Twice the automatic tolerance: faces bend further within a step.
  constexpr double ordinary = 2.0 * AutomaticRatios{}.chord_tolerance;
  const std::optional<ChordError> error = largest_chord_error(simulation);
  if (!error || !(error->share > ordinary)) return;
  const auto name = names_in(simulation);
  err << fmt::format(
      "ashlar: warning: where block {} presses block {}, its curved face is {:.3g} m from the flat "
      "sub-faces in contact, {:.2g} of the smaller block's size; up to {} is ordinary: a smaller "
      "contact.chord_tolerance divides it further\n",
      name(error->block), name(error->other), error->distance, error->share, ordinary);
}

/// Warns of sliding blocks whose friction differed from Coulomb's law: multipliers stop impacts by impulses without
/// friction, which the next steps make up for only if blocks stay in contact.
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

/// Warns of impacts whose velocities are not quite those of the law.
void warn_of_impacts(const Simulation& simulation, std::ostream& err) {
  constexpr double ordinary = 1e-4;  // of the fastest velocity: less than restitution and friction are known
  const ImpactTally& impacts = simulation.impacts();
  if (!(impacts.residual > ordinary)) return;
  err << fmt::format(
      "ashlar: warning: velocities after the impact at t = {:.6g} s differ by {:.2g} of the fastest from "
      "those of "
      "restitution and friction ({} of {} impacts by more than 1e-6): no energy was gained\n",
      impacts.time, impacts.residual, impacts.inaccurate, impacts.count);
}

/// Tells of impacts for which one coefficient of restitution is not enough.
void warn_of_unlike_restitution(const Simulation& simulation, std::ostream& err) {
  const ImpactTally& impacts = simulation.impacts();
  if (impacts.unlike == 0) return;
  err << fmt::format(
      "ashlar: warning: {} of {} impacts closed joints of different restitution at the same moment, for "
      "which there is no "
      "common law: each joint rebounded by its own coefficient, by less where energy would have been "
      "gained\n",
      impacts.unlike, impacts.count);
}

/// Warns of dilating joints that slid without contact, and so without dilation.
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

/// Warns of joints closed beyond the curve of their closure, where the tangent replaces it.
void warn_of_closure(const Simulation& simulation, std::ostream& err) {
  const MostClosed& most = simulation.most_closed();
  if (!(most.share > NormalSpring::end_of_curve)) return;
  const auto name = names_in(simulation);
  err << fmt::format(
      "ashlar: warning: the joint of blocks {} and {} was closed by {:.4g} of its maximum_closure at t = "
      "{:.6g} s: beyond {} of it a joint is linear, softer than its curve; check normal_stiffness and "
      "maximum_closure\n",
      name(most.blocks[0]), name(most.blocks[1]), most.share, most.time, NormalSpring::end_of_curve);
}

/// Warns of blocks that turn so far in a step that dda takes spin from them.
void warn_of_turns(const Simulation& simulation, std::ostream& err) {
  constexpr double ordinary = 0.05;
  const LargestTurn& turn = simulation.largest_turn();
  if (!(turn.angle > ordinary)) return;
  err << fmt::format(
      "ashlar: warning: block {} turned by {:.2g} rad in the step to t = {:.6g} s: beyond {} rad a step "
      "changes its spin, "
      "use a smaller time_step\n",
      simulation.blocks()[static_cast<std::size_t>(turn.block)].name(), turn.angle, turn.time, ordinary);
}

/// Tells of steps that were shortened as average-acceleration and generalized-alpha would have added energy.
void warn_of_short_steps(const Simulation& simulation, std::ostream& err) {
  const LargestTurn& turn = simulation.largest_turn();
  if (turn.limited == 0) return;
  err << fmt::format(
      "ashlar: warning: {} of {} steps were shortened so that no block turns by more than 0.03 rad in one, "
      "beyond "
      "which this integrator adds energy: integrator = \"dda\" needs no such steps\n",
      turn.limited, simulation.steps());
}

/// Warns of energy that the integrator has added: average-acceleration and generalized-alpha do where stiff blocks spin.
void warn_of_energy(const Simulation& simulation, std::ostream& err) {
  constexpr double ordinary = 0.01;
  const double added = -simulation.ledger().numerical, largest = simulation.largest_energy();
  if (!(added > ordinary * largest)) return;
  err << fmt::format(
      "ashlar: warning: the integrator has added {:.3g} J, {:.2g} of the largest energy of the run: "
      "integrator = \"dda\" "
      "or a smaller time_step\n",
      added, added / largest);
}

/// Warns of measures that change much with higher orders, if the order of a block was raised: blocks of order 1 are
/// chosen for their motion.
void warn_of_measures(const Run& run, std::ostream& err) {
  const std::vector<BlockModel>& blocks = run.simulation().blocks();
  if (std::none_of(blocks.begin(), blocks.end(),
                   [](const BlockModel& block) { return !block.fixed() && block.order() > 1; }))
    return;
  for (std::size_t k = 0; k < run.measure_errors().size(); ++k) {
    const double error = run.measure_errors()[k].relative;
    if (!(error > ordinary_order_error)) continue;
    err << fmt::format(
        "ashlar: warning: the estimated error of measure {} by the orders of blocks is {:.0f} %: use higher "
        "orders, smaller tied blocks, or analysis.accuracy, which chooses orders\n",
        run.scene().measure[k].name, 100.0 * error);
  }
}

/// Warns of orders too low for the deformation of their blocks in equilibrium. In motion the estimate is that of one
/// moment, which an impact makes large; it is in the summary.
void warn_of_order(const Run& run, std::ostream& err) {
  const Simulation& simulation = run.simulation();
  if (run.accuracy() != nullptr) {
    if (run.status() != RunStatus::equilibrium && run.status() != RunStatus::completed) return;
    if (const std::string advice = accuracy_advice(run.whole(), simulation, *run.accuracy()); !advice.empty())
      err << fmt::format(
          "ashlar: warning: the estimated error is {:.2g}, more than the accuracy of {:.2g}: {}\n",
          run.accuracy()->estimate(), *run.whole().analysis.accuracy, advice);
    return;
  }
  if (run.status() != RunStatus::equilibrium) return;
  warn_of_measures(run, err);
  const std::vector<OrderError> errors = run.summary_order_errors().errors;
  const std::optional<OrderError> coarse = coarse_block(simulation, errors);
  if (!coarse) return;
  const BlockModel& block = simulation.blocks()[static_cast<std::size_t>(coarse->block)];
  std::string remedy = "raise its order, or tie smaller blocks";
  if (const std::optional<SmallContact> patch = unresolved_contact(simulation, coarse->block))
    remedy = fmt::format(
        "its contact with block {} is {:.3g} m wide, less than the {:.3g} m that this order resolves: tie "
        "smaller blocks, small ones there",
        simulation.blocks()[static_cast<std::size_t>(patch->other)].name(), patch->width, patch->resolved);
  err << fmt::format(
      "ashlar: warning: the estimated error of deformation is {:.0f} % (in the norm of the strain energy), "
      "largest in block {} of order {}: {}\n",
      100.0 * coarse->relative(), block.name(), block.order(), remedy);
}

/// Warns of a factor that needs strong joints.
void warn_of_strength(const Run& run, std::ostream& err) {
  const std::optional<LimitFindings>& limits = run.answer().limits;
  if (!limits || run.answer().bracket) return;
  const std::string warning = strength_warning(limits->crushing, run.simulation());
  if (!warning.empty()) err << fmt::format("ashlar: warning: {}\n", warning);
}

/// Prints how a run ended; nothing for a completed one. @param quiet only errors and interrupts
void tell_end(const Run& run, const std::filesystem::path& folder, bool quiet, std::ostream& err) {
  const std::string& message = run.message();
  if (!run.unsaved().empty()) {
    err << fmt::format("ashlar: error: {}; the last state could not be saved: {}\n", message, run.unsaved());
    return;
  }
  switch (run.status().value_or(RunStatus::interrupted)) {
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
      if (!quiet) err << (message.empty() ? "stands: static equilibrium" : message) << '\n';
      break;
    case RunStatus::completed:
      if (!quiet && !message.empty()) err << message << '\n';
      break;
  }
}

}  // namespace

void tell_choices(const BuiltSimulation& built, std::ostream& err) {
  for (const AutomaticChoice& choice : built.choices) {
    const auto* number = std::get_if<double>(&choice.value);
    const auto* word = std::get_if<std::string>(&choice.value);
    std::string value = word != nullptr ? fmt::format("\"{}\"", *word)
                        : number        ? fmt::format("{:.4g} {}", *number, choice.unit)
                                        : fmt::format("{}", std::get<bool>(choice.value));
    if (!choice.reason.empty()) {
      if (value.back() == ' ') value.pop_back();
      value += ": " + choice.reason;
    }
    err << fmt::format("chosen: {} = {}\n", choice.key, value);
  }
  if (!built.as_placed.empty())
    err << fmt::format("not settled: {} (initial_state settles blocks that their own supports hold)\n",
                       first_names(built.as_placed));
}

void tell_results(const Run& run, const std::filesystem::path& folder, bool quiet, std::ostream& err) {
  tell_end(run, folder, quiet, err);
  const Simulation& simulation = run.simulation();
  if (!run.answer().shows_states()) {
    const LargestValues largest = run.largest();
    if (!quiet) tell_answers(simulation, largest, err);
    warn_of_strain(simulation, largest, err);
    warn_of_chords(simulation, err);
  }
  warn_of_depth(simulation, err);
  warn_of_friction(simulation, err);
  warn_of_hops(simulation, err);
  warn_of_closure(simulation, err);
  warn_of_short_steps(simulation, err);
  warn_of_impacts(simulation, err);
  warn_of_unlike_restitution(simulation, err);
  warn_of_turns(simulation, err);
  if (!is_static(run.whole().analysis)) warn_of_energy(simulation, err);
  warn_of_order(run, err);
  warn_of_strength(run, err);
}

}  // namespace ashlar
