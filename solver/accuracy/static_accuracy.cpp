#include "solver/accuracy/static_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/index.hpp"
#include "solver/accuracy/chosen_orders.hpp"
#include "solver/accuracy/goal_distance.hpp"
#include "solver/accuracy/order_estimate.hpp"
#include "solver/run/order_error.hpp"

namespace ashlar {
namespace {

constexpr double no_estimate = std::numeric_limits<double>::infinity();

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Of the largest lack: blocks below it hardly change a goal, and keep their order. Larger shares need more rounds, smaller
/// ones raise blocks without effect.
constexpr double least_lack = 0.03;
/// Rounds of sub-faces: 4^4 in the chord are 4^4 times as many of them.
constexpr std::size_t most_sub_face_rounds = 4;
/// Error that the highest order would still have, over the accuracy, above which a choice ends: smaller values give up
/// where the estimate is too large, larger ones try orders that hardly help.
constexpr double out_of_reach = 3.0;

/// Rounds whose lacks come from the next orders; later ones have two changes.
constexpr std::size_t rounds_with_next_orders = 2;

AccuracyRound values_of(const Simulation& simulation, const std::vector<Goal>& goals) {
  AccuracyRound round;
  for (const Goal& goal : goals) round.goals.push_back(goal.values);
  const std::size_t count = simulation.blocks().size();
  round.energies.assign(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (simulation.system().moving()[k] && !block.rigid())
      round.energies[k] = block.elastic(simulation.states()[k].position).energy;
  }
  return round;
}

/// @param earlier rounds of orders
AccuracyRound round_of_orders(const Simulation& simulation, const AccuracyRequest& request,
                              const std::vector<Goal>& goals, const std::vector<AccuracyRound>& earlier) {
  AccuracyRound round = values_of(simulation, goals);
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k)
    round.orders.push_back(request.orders[k] ? simulation.blocks()[k].order() : 0);
  if (!goals.empty())
    for (const BlockState& state : simulation.states()) round.positions.push_back(state.position);
  round.of_changes = !goals.empty() && earlier.size() >= rounds_with_next_orders;
  if (round.of_changes) {
    round.missing_energy = earlier.back().missing_energy;
    take_missing_energy_of_changes(simulation, earlier, round);
  } else {
    round.missing_energy = unknown_energy(simulation);
    for (const OrderError& error : order_errors(simulation))
      round.missing_energy[at(error.block)] = error.missing_energy;
  }
  return round;
}

/// Sub-faces: errors of gaps are proportional to the chord tolerance, which a round divides by this.
constexpr double of_chord = 4.0;

double sub_face_error_of(const AccuracyRounds& rounds, std::size_t index, const Goal& goal) {
  if (rounds.sub_faces.empty()) return 0.0;
  const std::vector<double>& before = rounds.sub_faces.size() > 1
                                          ? rounds.sub_faces[rounds.sub_faces.size() - 2].goals[index]
                                          : rounds.orders.back().goals[index];
  return relative_to(goal_distance(rounds.sub_faces.back().goals[index], before) / (of_chord - 1.0), goal);
}

double sub_face_error_of_energy(const AccuracyRounds& rounds) {
  if (rounds.sub_faces.empty()) return 0.0;
  const AccuracyRound& before =
      rounds.sub_faces.size() > 1 ? rounds.sub_faces[rounds.sub_faces.size() - 2] : rounds.orders.back();
  const double now = sum_of(rounds.sub_faces.back().energies);
  const double change = std::abs(now - sum_of(before.energies)) / (of_chord - 1.0);
  return change > 0.0 ? change / std::max(now, change) : 0.0;
}

/// True if the order of a block is to be chosen, and a higher one is allowed.
bool can_rise(const Simulation& simulation, const AccuracyRequest& request, const AccuracyRounds& rounds,
              int index) {
  const BlockModel& block = simulation.blocks()[at(index)];
  return request.orders[at(index)] && simulation.system().moving()[at(index)] &&
         can_have_order(block, block.order() + 1) &&
         std::find(rounds.highest.begin(), rounds.highest.end(), index) == rounds.highest.end();
}

/// Choice of the orders of the next round.
class OrderChoice {
 public:
  OrderChoice(const Simulation& simulation, const AccuracyRequest& request, const std::vector<Goal>& goals,
              const AccuracyRounds& rounds)
      : request_(request), rounds_(rounds), last_(rounds.orders.back()), has_goals_(!goals.empty()) {
    int deformable = 0;
    for (std::size_t k = 0; k < request.orders.size(); ++k) {
      const BlockModel& block = simulation.blocks()[k];
      if (simulation.system().moving()[k] && !block.rigid()) ++deformable;
      if (can_rise(simulation, request, rounds, static_cast<int>(k)))
        raisable_.push_back(static_cast<int>(k));
    }
    mean_energy_ = sum_of(last_.energies) / std::max(deformable, 1);
    for (std::size_t k = 0; k < goals.size(); ++k)
      goals_met_ = goals_met_ && order_error_of(rounds.orders, k, goals[k]) <= request.accuracy;
    for (const int block : raisable_)
      all_estimated_ = all_estimated_ && last_.missing_energy[at(block)] >= 0.0;
    if (!all_estimated_ && !has_goals_) goals_met_ = energy_is_still();
  }

  /// Blocks that get the next order; empty: orders suffice, or cannot be raised.
  [[nodiscard]] std::vector<int> blocks() const {
    double largest = 0.0;
    for (const int block : raisable_) largest = std::max(largest, last_.missing_energy[at(block)]);
    std::vector<int> chosen;
    for (const int block : raisable_) {
      const double lack = last_.missing_energy[at(block)];
      const bool rises = has_goals_ || lack < 0.0
                             ? !goals_met_ && (lack < 0.0 || (lack > 0.0 && lack >= least_lack * largest))
                             : lack > request_.accuracy * std::max(last_.energies[at(block)], mean_energy_);
      if (rises) chosen.push_back(block);
    }
    return chosen;
  }

 private:
  /// True if two more orders have hardly changed the energy: one may change nothing, as an even function has no odd part.
  [[nodiscard]] bool energy_is_still() const {
    const std::vector<AccuracyRound>& all = rounds_.orders;
    if (all.size() < 3) return false;
    const double now = sum_of(last_.energies);
    for (const std::size_t back : {2U, 3U})
      if (!(std::abs(sum_of(all[all.size() - back].energies) - now) <= request_.accuracy * now)) return false;
    return true;
  }

  const AccuracyRequest& request_;
  const AccuracyRounds& rounds_;
  const AccuracyRound& last_;
  std::vector<int> raisable_;
  double mean_energy_ = 0.0;  ///< J, of the blocks that deform
  bool has_goals_;
  bool goals_met_ = true;
  bool all_estimated_ = true;
};

/// @return true if a block has a higher order now
bool raise(Simulation& simulation, const std::vector<int>& blocks, AccuracyRounds& rounds) {
  bool raised = false;
  for (const int block : blocks) {
    if (changed_order(simulation, block, simulation.blocks()[at(block)].order() + 1))
      raised = true;
    else
      rounds.highest.push_back(block);
  }
  return raised;
}

/// Contacts of blocks with very different orders may alternate for ever.
bool raise_all(Simulation& simulation, const AccuracyRequest& request, AccuracyRounds& rounds) {
  std::vector<int> blocks;
  for (int block = 0; block < static_cast<int>(request.orders.size()); ++block)
    if (can_rise(simulation, request, rounds, block)) blocks.push_back(block);
  return raise(simulation, blocks, rounds);
}

/// True if a curved face is in contact.
bool has_curved_contacts(const Simulation& simulation) {
  return std::any_of(simulation.contacts().begin(), simulation.contacts().end(), [&](const PairRecord& pair) {
    const std::vector<BlockSurface>& surfaces = simulation.finder().surfaces();
    return !pair.points.empty() && (surfaces[at(pair.a)].curves() || surfaces[at(pair.b)].curves());
  });
}

/// The last chord tolerance suffices, or more sub-faces are of no use.
bool sub_faces_suffice(const AccuracyRequest& request, const std::vector<Goal>& goals,
                       const AccuracyRounds& rounds) {
  if (rounds.sub_faces.size() >= most_sub_face_rounds) return true;
  for (std::size_t k = 0; k < goals.size(); ++k)
    if (sub_face_error_of(rounds, k, goals[k]) > request.accuracy) return false;
  return !goals.empty() || sub_face_error_of_energy(rounds) <= request.accuracy;
}

/// Errors that the highest order would still have where changes fall slowly: ends the choice if they are far above the
/// accuracy. @return the largest of them, or 0
double error_out_of_reach(const AccuracyRequest& request, const std::vector<Goal>& goals,
                          const std::vector<AccuracyRound>& rounds) {
  double largest = 0.0;
  for (std::size_t k = 0; k < goals.size(); ++k)
    largest = std::max(largest, slow_error_at(rounds, k, goals[k], largest_chosen_order));
  return largest > out_of_reach * request.accuracy ? largest : 0.0;
}

}  // namespace

std::vector<double> unknown_energy(const Simulation& simulation) {
  std::vector<double> missing_energy;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k)
    missing_energy.push_back(simulation.system().moving()[k] && !simulation.blocks()[k].rigid() ? -1.0 : 0.0);
  return missing_energy;
}

bool raise_orders(Simulation& simulation, const AccuracyRequest& request, const std::vector<Goal>& goals,
                  AccuracyRounds& rounds) {
  // A block that cannot be raised may leave others that can.
  for (;;) {
    const std::vector<int> blocks = OrderChoice(simulation, request, goals, rounds).blocks();
    if (blocks.empty()) return false;
    if (raise(simulation, blocks, rounds)) return true;
  }
}

bool refine(Simulation& simulation, const AccuracyRequest& request, const std::vector<Goal>& goals,
            AccuracyRounds& rounds) {
  if (rounds.divides) {
    rounds.sub_faces.push_back(values_of(simulation, goals));
    if (sub_faces_suffice(request, goals, rounds)) return false;
  } else {
    rounds.orders.push_back(round_of_orders(simulation, request, goals, rounds.orders));
    rounds.out_of_reach = error_out_of_reach(request, goals, rounds.orders);
    if (rounds.out_of_reach == 0.0 && raise_orders(simulation, request, goals, rounds)) return true;
    if (!request.sub_faces || !has_curved_contacts(simulation)) return false;
    rounds.divides = true;
  }
  simulation.set_chord_tolerance(simulation.system().settings().search.chord_tolerance / of_chord);
  return true;
}

StaticStatus find_equilibrium(Simulation& simulation, double end_time, const AccuracyRequest& request,
                              const GoalValues& goals, AccuracyRounds& rounds,
                              const std::function<bool()>& may_continue) {
  for (;;) {
    StaticStatus status = StaticStatus::balancing;
    while (status == StaticStatus::balancing) {
      if (!may_continue()) return status;
      status = simulation.static_step(end_time);
    }
    const bool goes = status == StaticStatus::equilibrium
                          ? refine(simulation, request, goals(simulation), rounds)
                          : status == StaticStatus::not_converged && raise_all(simulation, request, rounds);
    if (!goes) return status;
  }
}

AccuracyEstimate accuracy_estimate(const std::vector<Goal>& goals, const AccuracyRounds& rounds) {
  AccuracyEstimate estimate;
  if (rounds.orders.empty()) {
    estimate.order = no_estimate;
    estimate.goals.assign(goals.size(), no_estimate);
    return estimate;
  }
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const double order = order_error_of(rounds.orders, k, goals[k]);
    const double sub_faces = sub_face_error_of(rounds, k, goals[k]);
    estimate.goals.push_back(order + sub_faces);
    estimate.order = std::max(estimate.order, order);
    estimate.sub_faces = std::max(estimate.sub_faces, sub_faces);
  }
  if (goals.empty()) {
    estimate.order = error_of_energy(rounds.orders.back());
    estimate.sub_faces = sub_face_error_of_energy(rounds);
  }
  estimate.slow_block = slow_block_of(rounds.orders);
  estimate.out_of_reach = rounds.out_of_reach;
  return estimate;
}

}  // namespace ashlar
