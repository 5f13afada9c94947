#include "solver/accuracy/motion_accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "geometry/index.hpp"
#include "solver/accuracy/goal_distance.hpp"
#include "solver/accuracy/island_errors.hpp"
#include "solver/run/order_error.hpp"
#include "solver/step/accept/snapshot.hpp"

namespace ashlar {
namespace {

constexpr int test_interval = 32;           ///< steps
constexpr double tests_of_analysis = 16.0;  ///< at least: few long steps may all be between two tests
/// Of a step: a length that differs by less is the same one, rounded where times are sums.
constexpr double same_length = 1e-6;
/// Of the step in which an impact is placed within the accuracy: the shortest one after an impact. Shorter ones follow a
/// motion whose place is already as uncertain as the impact.
constexpr double shortest_after_impact = 1.0 / 8.0;
/// Halvings after which an error that falls no faster than the step is noise, which does not add up.
constexpr int most_halvings = 4;
/// Of the allowed error: from a smaller one on twice the step is taken. A larger share is taken back by the next test more
/// often. Steps after which the longer one is tested.
constexpr double doubling_margin = 0.7;
constexpr int steps_to_next_test = 4;
/// Of the largest speed: contacts that change at a smaller one are settlements and not impacts.
constexpr double impact_speed_share = 0.1;
/// Steps of a pilot from one estimate of orders to the next, which costs as much as some steps.
constexpr int order_interval = 16;

/// Coarse pilots of rigid blocks: their steps, the difference of their largest values up to which they agree (larger ones
/// hide vibrations), and the steps of a run above which they are used: fewer cost no more than the pilots.
constexpr std::array coarse_steps = {16.0, 32.0};
constexpr double pilots_agree = 0.2, many_steps = 64.0;

/// True after as many steps, or as much time, as there may be between two tests.
bool test_is_due(const MotionAccuracyState& state, double time_step, double end_time) {
  return state.since_test >= test_interval || state.since_test * time_step >= end_time / tests_of_analysis;
}

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
  const double own_step = simulation.system().settings().time_step;
  simulation.set_time_step(step);
  bool whole = true;
  for (int k = 0; whole && k < count; ++k) {
    whole = simulation.step(end_time) == StepStatus::accepted;
    whole = whole && std::abs(simulation.report().step - step) <= same_length * step;
  }
  std::optional<TriedStep> end;
  if (whole) end = TriedStep{simulation.states(), goals(simulation), contact_marks(simulation)};
  simulation.set_time_step(own_step);
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

std::vector<int> all_blocks(std::size_t count) {
  std::vector<int> blocks(count);
  std::iota(blocks.begin(), blocks.end(), 0);
  return blocks;
}

/// Of any block, root of the mean square, m/s.
double largest_speed(const Simulation& simulation) {
  double fastest = 0.0;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k)
    if (simulation.system().moving()[k])
      fastest = std::max(fastest, mean_length(simulation.blocks()[k], simulation.states()[k].velocity));
  return fastest;
}

/// Step in which an impact is placed within the accuracy, s; infinite without impacts.
double impact_step(const MotionRequest& request, const MotionScales& scales) {
  return scales.impact_speed > 0.0 ? request.accuracy * scales.displacement / scales.impact_speed
                                   : std::numeric_limits<double>::infinity();
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
        power_(std::ldexp(1.0, order_of(simulation.system().settings().integrator))),
        longest_(std::min(request.longest_step, impact_step(request, state.scales))),
        shortest_(state.impacts > 0 && state.scales.impact_speed > 0.0
                      ? shortest_after_impact * impact_step(request, state.scales)
                      : 0.0),
        marks_(contact_marks(simulation)),
        islands_(blocks_in_touch(simulation)) {}

  /// Chooses the length of the next step.
  void choose() {
    double step = simulation_.system().settings().time_step;
    while (step > longest_) take(step *= 0.5, state_.local_error);
    const std::optional<double> error = local_error(step);
    if (!error) return;
    state_.local_error = *error;
    if (*error > allowed(step))
      halve(step, *error);
    else
      double_if_enough(step, *error);
    note_bound();
  }

 private:
  /// Of a whole step, relative. Empty: it is cut or longer than what is left, or contacts change.
  std::optional<double> local_error(double step) {
    if (!(simulation_.time() + step <= request_.end_time)) return std::nullopt;
    ++state_.tests;
    const auto whole = tried(simulation_, step, 1, request_.end_time, goals_);
    const auto halves = tried(simulation_, 0.5 * step, 2, request_.end_time, goals_);
    if (!whole || !halves || whole->marks != halves->marks || whole->marks != marks_) return std::nullopt;
    const std::vector<BlockDifference> blocks = block_differences(simulation_, whole->states, halves->states);
    bounding_ = bounding_island(islands_, blocks, state_.scales,
                                order_of(simulation_.system().settings().integrator));
    const double difference = whole->goals.empty()
                                  ? relative_difference(blocks, all_blocks(blocks.size()), state_.scales)
                                  : difference_of_goals(state_.scales, *whole, *halves);
    return difference * power_ / (power_ - 1.0);
  }

  [[nodiscard]] double allowed(double step) const { return request_.accuracy * step / request_.end_time; }

  void note_bound() {
    const double step = simulation_.system().settings().time_step;
    if (bounding_.blocks.empty() || (state_.shortest_step > 0.0 && !(step < state_.shortest_step))) return;
    state_.shortest_step = step;
    state_.bounding = bounding_;
  }

  void take(double step, double error) {
    simulation_.set_time_step(step);
    state_.time_step = step;
    state_.local_error = error;
  }

  void halve(double step, double error) {
    double shorter = step, left = error;
    for (int k = 0; k < most_halvings && left > allowed(shorter) && 0.5 * shorter >= shortest_; ++k) {
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
    if (left > allowed(shorter) && state_.local_error > 0.0 && 0.5 * shorter >= shortest_)
      state_.since_test = test_interval;
  }

  void double_if_enough(double step, double error) {
    // Twice the step has 2^(p + 1) times the error and twice the share.
    if (power_ * error > doubling_margin * allowed(step) || 2.0 * step > longest_) return;
    take(2.0 * step, 2.0 * power_ * error);
    state_.since_test = test_interval - steps_to_next_test;
  }

  Simulation& simulation_;
  const MotionRequest& request_;
  const GoalValues& goals_;
  MotionAccuracyState& state_;
  double power_;     ///< 2^p
  double longest_;   ///< s
  double shortest_;  ///< s
  std::vector<int> marks_;
  std::vector<std::vector<int>> islands_;
  BoundingIsland bounding_;  ///< in the last test
};

/// Largest values of the steps of a pilot.
class PilotRecord {
 public:
  PilotRecord(const Simulation& simulation, const GoalValues& goals)
      : simulation_(simulation), goals_(goals), start_(simulation.states()) {
    run_.round.energies.assign(start_.size(), 0.0);
    run_.round.missing_energy = unknown_energy(simulation);
    note_values();
  }

  /// After a step.
  void note() {
    std::vector<int> marks = contact_marks(simulation_);
    const double speed = largest_speed(simulation_);
    // Contacts of blocks as placed are found in the first step.
    if (any_step_ && marks != marks_) changes_.push_back({run_.round, speed});
    any_step_ = true;
    marks_ = std::move(marks);
    fastest_ = std::max(fastest_, speed);
    note_values();
  }

  [[nodiscard]] PilotRun result() const {
    PilotRun result = run_;
    const auto impact = std::find_if(changes_.begin(), changes_.end(), [this](const Change& change) {
      return change.speed > impact_speed_share * fastest_;
    });
    if (impact == changes_.end()) return result;
    result.round = impact->before;
    result.scales.impact_speed = fastest_;
    return result;
  }

 private:
  /// A step in which contacts changed.
  struct Change {
    AccuracyRound before;
    double speed;  ///< m/s
  };

  void note_values() {
    double sum = 0.0;
    for (std::size_t k = 0; k < start_.size(); ++k) {
      if (!simulation_.system().present(static_cast<int>(k)) || simulation_.blocks()[k].fixed()) continue;
      const BlockState& now = simulation_.states()[k];
      const double energy = energy_of(simulation_.blocks()[k], now);
      run_.round.energies[k] = std::max(run_.round.energies[k], energy);
      sum += energy;
      run_.scales.displacement = std::max(
          run_.scales.displacement, mean_length(simulation_.blocks()[k], now.position - start_[k].position));
    }
    run_.scales.energy = std::max(run_.scales.energy, sum);
    note_goals();
    if (simulation_.steps() % order_interval != 0) return;
    for (const OrderError& error : order_errors(simulation_))
      run_.round.missing_energy[at(error.block)] =
          std::max(run_.round.missing_energy[at(error.block)], error.missing_energy);
  }

  void note_goals() {
    const std::vector<Goal> values = goals_(simulation_);
    run_.scales.goals.resize(values.size(), 0.0);
    run_.scales.rates.resize(values.size(), 0.0);
    run_.round.goals.resize(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      run_.scales.goals[k] = std::max(run_.scales.goals[k], goal_length(values[k].values));
      run_.scales.rates[k] = std::max(run_.scales.rates[k], goal_length(values[k].rates));
      run_.round.goals[k].resize(values[k].values.size(), 0.0);
      for (std::size_t n = 0; n < values[k].values.size(); ++n)
        run_.round.goals[k][n] = std::max(run_.round.goals[k][n], std::abs(values[k].values[n]));
    }
  }

  const Simulation& simulation_;
  const GoalValues& goals_;
  std::vector<BlockState> start_;
  PilotRun run_;
  std::vector<Change> changes_;
  std::vector<int> marks_;
  double fastest_ = 0.0;  ///< m/s
  bool any_step_ = false;
};

/// Runs to the end and takes it back. @return empty if it was ended
std::optional<PilotRun> pilot_in_steps(Simulation& simulation, double end_time, const GoalValues& goals,
                                       const std::function<bool()>& may_continue) {
  const SimulationSnapshot before = simulation.snapshot();
  PilotRecord record(simulation, goals);
  bool goes = true;
  while (!simulation.reached(end_time) && (goes = may_continue())) {
    if (simulation.step(end_time) != StepStatus::accepted) break;
    record.note();
  }
  simulation.restore(before);
  return goes ? std::optional(record.result()) : std::nullopt;
}

/// True if two pilots without impacts have found nearly the same largest values.
bool agree(const MotionScales& a, const MotionScales& b) {
  const auto near = [](double x, double y) { return std::abs(x - y) <= pilots_agree * std::max(x, y); };
  return a.impact_speed == 0.0 && b.impact_speed == 0.0 && near(a.energy, b.energy) &&
         near(a.displacement, b.displacement) &&
         std::equal(a.goals.begin(), a.goals.end(), b.goals.begin(), near) &&
         std::equal(a.rates.begin(), a.rates.end(), b.rates.begin(), near);
}

/// True if moving blocks are rigid, under constant loads: nothing oscillates within a coarse step.
bool moves_plainly(const Simulation& simulation, double end_time) {
  const double now = simulation.time();
  if (simulation.system().settings().gravity_history.changes_between(now, end_time)) return false;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.driven() || block.loads_change_between(now, end_time)) return false;
    if (simulation.system().moving()[k] && !block.rigid()) return false;
  }
  return true;
}

/// Pilots of few steps, enough for blocks without vibrations and orders. @return the pilots; fewer than two: ended
std::vector<PilotRun> coarse_pilots(Simulation& simulation, double end_time, const GoalValues& goals,
                                    const std::function<bool()>& may_continue) {
  const double own_step = simulation.system().settings().time_step;
  std::vector<PilotRun> pilots;
  for (const double count : coarse_steps) {
    simulation.set_time_step(end_time / count);
    const auto pilot = pilot_in_steps(simulation, end_time, goals, may_continue);
    if (!pilot) break;
    pilots.push_back(*pilot);
  }
  simulation.set_time_step(own_step);
  return pilots;
}

}  // namespace

std::optional<PilotRun> pilot_run(Simulation& simulation, double end_time, const GoalValues& goals,
                                  const std::function<bool()>& may_continue) {
  if (moves_plainly(simulation, end_time) &&
      end_time > many_steps * simulation.system().settings().time_step) {
    const std::vector<PilotRun> coarse = coarse_pilots(simulation, end_time, goals, may_continue);
    if (coarse.size() < 2) return std::nullopt;
    if (agree(coarse.front().scales, coarse.back().scales)) return coarse.back();
  }
  return pilot_in_steps(simulation, end_time, goals, may_continue);
}

void choose_step(Simulation& simulation, const MotionRequest& request, const GoalValues& goals,
                 MotionAccuracyState& state) {
  const std::vector<int> marks = contact_marks(simulation);
  if (simulation.steps() == 0 || marks != state.contact_marks ||
      test_is_due(state, simulation.system().settings().time_step, request.end_time)) {
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
  if (state.scales.displacement > 0.0)
    state.impact_error = std::max(
        state.impact_error, largest_speed(simulation) * simulation.report().step / state.scales.displacement);
}

}  // namespace ashlar
