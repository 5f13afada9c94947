#include "solver/accuracy/motion_accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/index.hpp"
#include "solver/accuracy/goal_distance.hpp"
#include "solver/run/order_error.hpp"
#include "solver/step/snapshot.hpp"

namespace ashlar {
namespace {

constexpr int test_interval = 32;
/// Of the longest step: a motion that needs shorter ones is not resolved by steps.
constexpr double shortest_step = 0x1p-20;

double energy_of(const BlockModel& block, const BlockState& state) {
  return block.kinetic_energy(state) + (block.rigid() ? 0.0 : block.elastic(state.position).energy);
}

/// Root of the mean square over the block, m.
double mean_length(const BlockModel& block, const Eigen::MatrixX3d& field) {
  return field.norm() / std::sqrt(block.basis().volume());
}

/// Contact state of each pair: numbers of open, locked and sliding points are too fine, as points come and go with the
/// places of blocks; the kinds that a pair has are not.
std::vector<int> contact_marks(const Simulation& simulation) {
  std::vector<int> marks;
  for (const PairRecord& pair : simulation.contacts()) {
    int kinds = 0;
    for (const PointResponse& response : pair.responses)
      if (response.state != ContactState::open) kinds |= 1 << static_cast<int>(response.state);
    if (kinds != 0) marks.insert(marks.end(), {pair.a, pair.b, kinds});
  }
  return marks;
}

/// The end of a step that has been tried.
struct TriedStep {
  std::vector<BlockState> states;
  std::vector<Goal> goals;
  std::vector<int> marks;
};

/// Takes steps of equal length and takes them back. @return empty if one was cut
std::optional<TriedStep> tried(Simulation& simulation, double step, int count, double end_time,
                               const GoalValues& goals) {
  const SimulationSnapshot before = simulation.snapshot();
  const double given = simulation.system().settings().time_step;
  simulation.set_time_step(step);
  bool whole = true;
  for (int k = 0; whole && k < count; ++k) {
    whole = simulation.step(end_time) == StepStatus::accepted;
    // A length may be rounded where times are sums.
    whole = whole && std::abs(simulation.report().step - step) <= 1e-6 * step;
  }
  std::optional<TriedStep> end;
  if (whole) end = TriedStep{simulation.states(), goals(simulation), contact_marks(simulation)};
  simulation.set_time_step(given);
  simulation.restore(before);
  return end;
}

/// Difference of two ends, relative.
double difference(const Simulation& simulation, const MotionScales& scales, const TriedStep& a,
                  const TriedStep& b) {
  double energy = 0.0, displacement = 0.0;
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    if (!simulation.system().moving()[k]) continue;
    const BlockModel& block = simulation.blocks()[k];
    const Eigen::MatrixX3d position = a.states[k].position - b.states[k].position;
    const BlockState motion{a.states[k].position, a.states[k].velocity - b.states[k].velocity};
    energy += block.kinetic_energy(motion);
    if (!block.rigid()) {
      const Eigen::MatrixX3d force =
          block.elastic(a.states[k].position).force - block.elastic(b.states[k].position).force;
      energy += 0.5 * std::abs(force.cwiseProduct(position).sum());
    }
    displacement = std::max(displacement, mean_length(block, position));
  }
  double largest = scales.energy > 0.0 ? std::sqrt(energy / scales.energy) : 0.0;
  if (a.goals.empty() && scales.displacement > 0.0)
    largest = std::max(largest, displacement / scales.displacement);
  for (std::size_t k = 0; k < a.goals.size(); ++k) {
    const double scale = std::max(scales.goals[k], a.goals[k].least);
    if (scale > 0.0) largest = std::max(largest, goal_distance(a.goals[k].values, b.goals[k].values) / scale);
  }
  return largest;
}

int order_of(Integrator integrator) {
  return integrator == Integrator::dda ? 1 : 2;
}

/// Tests steps until one suffices.
void test_step(Simulation& simulation, const MotionRequest& request, const GoalValues& goals,
               MotionAccuracyState& state) {
  const SimulationSettings& settings = simulation.system().settings();
  const double power = std::exp2(order_of(settings.integrator));
  state.since_test = 0;
  for (;;) {
    const double step = settings.time_step;
    if (!(simulation.time() + step <= request.end_time)) return;
    ++state.tests;
    const auto whole = tried(simulation, step, 1, request.end_time, goals);
    const auto halves = tried(simulation, 0.5 * step, 2, request.end_time, goals);
    const bool smooth =
        whole && halves && whole->marks == halves->marks && whole->marks == contact_marks(simulation);
    if (!smooth) return;
    state.local_error = difference(simulation, state.scales, *whole, *halves) * power / (power - 1.0);
    const double allowed = request.accuracy * step / request.end_time;
    if (state.local_error > allowed && step > shortest_step * request.longest_step) {
      simulation.set_time_step(0.5 * step);
      state.time_step = 0.5 * step;
      state.local_error /= 2.0 * power;
      continue;
    }
    // Twice the step has 2^(p + 1) times the error and twice the share.
    constexpr double margin = 0.7;
    if (power * state.local_error > margin * allowed || 2.0 * step > request.longest_step) return;
    simulation.set_time_step(2.0 * step);
    state.time_step = 2.0 * step;
    state.local_error *= 2.0 * power;
    // Soon tested again.
    state.since_test = test_interval - 4;
    return;
  }
}

}  // namespace

std::optional<PilotRun> pilot_run(Simulation& simulation, double end_time, const GoalValues& goals,
                                  const std::function<bool()>& goes_on) {
  constexpr int order_interval = 16;  // an estimate costs as much as some steps
  const SimulationSnapshot before = simulation.snapshot();
  const std::vector<BlockState> start = simulation.states();
  PilotRun run;
  run.round.energies.assign(start.size(), 0.0);
  run.round.lacks.assign(start.size(), -1.0);
  const auto note = [&] {
    double sum = 0.0;
    for (std::size_t k = 0; k < start.size(); ++k) {
      if (!simulation.system().present(static_cast<int>(k)) || simulation.blocks()[k].fixed()) continue;
      const BlockState& now = simulation.states()[k];
      const double energy = energy_of(simulation.blocks()[k], now);
      run.round.energies[k] = std::max(run.round.energies[k], energy);
      sum += energy;
      run.scales.displacement = std::max(
          run.scales.displacement, mean_length(simulation.blocks()[k], now.position - start[k].position));
    }
    run.scales.energy = std::max(run.scales.energy, sum);
    const std::vector<Goal> values = goals(simulation);
    run.scales.goals.resize(values.size(), 0.0);
    run.round.goals.resize(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      run.scales.goals[k] = std::max(run.scales.goals[k], goal_length(values[k].values));
      run.round.goals[k].resize(values[k].values.size(), 0.0);
      for (std::size_t n = 0; n < values[k].values.size(); ++n)
        run.round.goals[k][n] = std::max(run.round.goals[k][n], std::abs(values[k].values[n]));
    }
    if (simulation.steps() % order_interval != 0) return;
    for (const OrderError& error : order_errors(simulation))
      run.round.lacks[at(error.block)] = std::max(run.round.lacks[at(error.block)], error.lacks);
  };
  note();
  bool goes = true;
  while (!simulation.reached(end_time) && (goes = goes_on())) {
    if (simulation.step(end_time) != StepStatus::accepted) break;
    note();
  }
  simulation.restore(before);
  return goes ? std::optional(std::move(run)) : std::nullopt;
}

void choose_step(Simulation& simulation, const MotionRequest& request, const GoalValues& goals,
                 MotionAccuracyState& state) {
  const std::vector<int> marks = contact_marks(simulation);
  if (simulation.steps() == 0 || marks != state.contact_marks || state.since_test >= test_interval)
    test_step(simulation, request, goals, state);
  state.contact_marks = marks;
}

void note_step(const Simulation& simulation, MotionAccuracyState& state) {
  ++state.since_test;
  const double share = simulation.report().step / simulation.system().settings().time_step;
  state.error += state.local_error * std::min(share, 1.0);
  if (contact_marks(simulation) == state.contact_marks) return;
  ++state.impacts;
  double fastest = 0.0;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k)
    if (simulation.system().moving()[k])
      fastest = std::max(fastest, mean_length(simulation.blocks()[k], simulation.states()[k].velocity));
  if (state.scales.displacement > 0.0)
    state.impact_error =
        std::max(state.impact_error, fastest * simulation.report().step / state.scales.displacement);
}

}  // namespace ashlar
