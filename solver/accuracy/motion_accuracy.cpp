#include "solver/accuracy/motion_accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/index.hpp"
#include "solver/accuracy/goal_distance.hpp"
#include "solver/run/order_error.hpp"
#include "solver/step/snapshot.hpp"

namespace ashlar {
namespace {

constexpr int test_interval = 32;  ///< steps

double energy_of(const BlockModel& block, const BlockState& state) {
  return block.kinetic_energy(state) + (block.rigid() ? 0.0 : block.elastic(state.position).energy);
}

/// Root of the mean square over the block, m.
double mean_length(const BlockModel& block, const Eigen::MatrixX3d& field) {
  return field.norm() / std::sqrt(block.basis().volume());
}

/// Pairs that touch. Points come and go, stick and slide with the places of blocks, hardly any step without.
std::vector<int> contact_marks(const Simulation& simulation) {
  std::vector<int> marks;
  for (const PairRecord& pair : simulation.contacts()) {
    const bool touches =
        std::any_of(pair.responses.begin(), pair.responses.end(),
                    [](const PointResponse& response) { return response.state != ContactState::open; });
    if (touches) marks.insert(marks.end(), {pair.a, pair.b});
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

/// Difference of two ends in the goals and their rates, relative.
double difference_of_goals(const MotionScales& scales, const TriedStep& a, const TriedStep& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.goals.size(); ++k) {
    const double scale = std::max(scales.goals[k], a.goals[k].least);
    double sum = scale > 0.0 ? goal_distance(a.goals[k].values, b.goals[k].values) / scale : 0.0;
    if (scales.rates[k] > 0.0) sum += goal_distance(a.goals[k].rates, b.goals[k].rates) / scales.rates[k];
    largest = std::max(largest, sum);
  }
  return largest;
}

/// Difference of two ends in energy and displacement, relative.
double difference_of_blocks(const Simulation& simulation, const MotionScales& scales, const TriedStep& a,
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
  const double of_energy = scales.energy > 0.0 ? std::sqrt(energy / scales.energy) : 0.0;
  return scales.displacement > 0.0 ? std::max(of_energy, displacement / scales.displacement) : of_energy;
}

int order_of(Integrator integrator) {
  return integrator == Integrator::dda ? 1 : 2;
}

/// Tests of steps that begin at the present state.
class StepTests {
 public:
  StepTests(Simulation& simulation, const MotionRequest& request, const GoalValues& goals,
            MotionAccuracyState& state)
      : simulation_(simulation),
        request_(request),
        goals_(goals),
        state_(state),
        power_(std::exp2(order_of(simulation.system().settings().integrator))),
        marks_(contact_marks(simulation)) {}

  /// Chooses the length of the next step.
  void choose() {
    const double step = simulation_.system().settings().time_step;
    const std::optional<double> error = local_error(step);
    if (!error) return;
    state_.local_error = *error;
    if (*error > allowed(step))
      halve(step, *error);
    else
      double_if_enough(step, *error);
  }

 private:
  /// Of a whole step, relative. Empty: it is cut or longer than what is left, or contacts change.
  std::optional<double> local_error(double step) {
    if (!(simulation_.time() + step <= request_.end_time)) return std::nullopt;
    ++state_.tests;
    const auto whole = tried(simulation_, step, 1, request_.end_time, goals_);
    const auto halves = tried(simulation_, 0.5 * step, 2, request_.end_time, goals_);
    if (!whole || !halves || whole->marks != halves->marks || whole->marks != marks_) return std::nullopt;
    const double difference = whole->goals.empty()
                                  ? difference_of_blocks(simulation_, state_.scales, *whole, *halves)
                                  : difference_of_goals(state_.scales, *whole, *halves);
    return difference * power_ / (power_ - 1.0);
  }

  [[nodiscard]] double allowed(double step) const { return request_.accuracy * step / request_.end_time; }

  void take(double step, double error) {
    simulation_.set_time_step(step);
    state_.time_step = step;
    state_.local_error = error;
  }

  void halve(double step, double error) {
    constexpr int most_halvings = 4;
    double shorter = step, left = error;
    for (int k = 0; k < most_halvings && left > allowed(shorter); ++k) {
      const std::optional<double> next = local_error(0.5 * shorter);
      if (!next) break;
      shorter *= 0.5;
      left = *next;
    }
    // An error that falls no faster than the step never comes below its share: the tolerance of contact and rounding,
    // which do not add up.
    if (shorter < step && left * step >= error * shorter) {
      state_.noise = std::max(state_.noise, error);
      state_.local_error = 0.0;
    } else if (shorter < step) {
      take(shorter, left);
    }
    if (left > allowed(shorter) && state_.local_error > 0.0) state_.since_test = test_interval;
  }

  void double_if_enough(double step, double error) {
    // Twice the step has 2^(p + 1) times the error and twice the share.
    constexpr double margin = 0.7;
    constexpr int soon = 4;
    if (power_ * error > margin * allowed(step) || 2.0 * step > request_.longest_step) return;
    take(2.0 * step, 2.0 * power_ * error);
    state_.since_test = test_interval - soon;
  }

  Simulation& simulation_;
  const MotionRequest& request_;
  const GoalValues& goals_;
  MotionAccuracyState& state_;
  double power_;  ///< 2^p
  std::vector<int> marks_;
};

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
    run.scales.rates.resize(values.size(), 0.0);
    run.round.goals.resize(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      run.scales.goals[k] = std::max(run.scales.goals[k], goal_length(values[k].values));
      run.scales.rates[k] = std::max(run.scales.rates[k], goal_length(values[k].rates));
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
  if (simulation.steps() == 0 || marks != state.contact_marks || state.since_test >= test_interval) {
    state.since_test = 0;
    StepTests(simulation, request, goals, state).choose();
  }
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
