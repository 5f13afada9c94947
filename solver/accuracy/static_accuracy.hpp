// Orders of blocks and sub-faces chosen for an accuracy, in a static analysis.
//
// The analysis finds an equilibrium with the present orders: a round. Then, in this order,
// - while a goal still changes by more than its accuracy, the blocks that lack the most energy get the next order;
//   without goals, those that lack more than the accuracy allows;
// - once orders suffice, the chord tolerance of curved faces is divided by four until goals change by no more;
// and the analysis goes on from there, with its contacts and their memory: another round. Errors are estimated from the
// changes of goals over two rounds (order_estimate.hpp). In the first two rounds, and without goals, a block's lack
// of energy comes from its next two orders (order_error.hpp); later it is the energy of what its last two orders have
// changed, which needs no block of a higher order.
//
// If even the highest order of a block is far from the accuracy, as the changes fall algebraically, the choice ends
// early.
//
// Notes: notes/accuracy.md.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// A result whose error is to be small: a number or the components of a vector.
struct Goal {
  std::string name;
  std::vector<double> values;
  /// >= 0, in the same unit: errors are relative to the length of `values`, or to this if it is larger
  double least = 0.0;
  /// Their rates in a motion, for time steps; empty: they have none
  std::vector<double> rates = {};
};

struct AccuracyRequest {
  double accuracy = 0.0;     ///< 0 to 1, relative
  std::vector<bool> orders;  ///< by block: true if its order is to be chosen
  bool sub_faces = false;    ///< true if the chord tolerance is to be chosen
};

/// An equilibrium, or the largest values of a motion, with given orders and sub-faces.
struct AccuracyRound {
  std::vector<std::vector<double>> goals;  ///< values
  std::vector<double> energies;            ///< by block, J: of strain, in a motion with that of motion
  std::vector<double> missing_energy;      ///< J by block, as OrderError; negative: not estimated
  /// By block: order if it is chosen, otherwise 0; empty: unknown
  std::vector<int> orders = {};
  std::vector<Eigen::MatrixX3d> positions = {};  ///< by block, BlockState::position, (p, 3); empty: unknown
  bool of_changes = false;  ///< true: lacks are what the last orders have changed, not those of the next
};

/// Lacks before any estimate: unknown of moving blocks that deform, 0 of others.
[[nodiscard]] std::vector<double> unknown_energy(const Simulation& simulation);

/// All rounds so far.
struct AccuracyRounds {
  std::vector<AccuracyRound> orders;     ///< with different orders
  std::vector<AccuracyRound> sub_faces;  ///< after those, with smaller and smaller chord tolerances
  bool divides = false;                  ///< true once orders suffice and the chord tolerance changes
  std::vector<int> highest;              ///< blocks whose shape or material allows no higher order
  double out_of_reach = 0.0;             ///< see AccuracyEstimate
};

/// Estimates, all relative.
struct AccuracyEstimate {
  double order = 0.0;  ///< of the orders of blocks: the largest of the goals, or without goals of the energy
  double sub_faces = 0.0;     ///< of the chord tolerance, likewise; 0: no curved face is in contact
  std::vector<double> goals;  ///< of each goal, of both
  /// The block that hinders convergence: its lack of energy is the largest, and the last higher order has hardly reduced
  /// it. -1: none
  int slow_block = -1;
  /// > 0: the choice has ended early, as the highest order would still have about this error
  double out_of_reach = 0.0;

  [[nodiscard]] double largest() const { return order > sub_faces ? order : sub_faces; }
};

/// Raises orders where the last round needs it. @param goals of the last round, the same ones in all rounds
/// @return true if blocks have higher orders now; false: orders suffice, or cannot be raised
[[nodiscard]] bool raise_orders(Simulation& simulation, const AccuracyRequest& request,
                                const std::vector<Goal>& goals, AccuracyRounds& rounds);

/// After an equilibrium of a static analysis, which is another round: raises orders or divides sub-faces where the
/// accuracy needs it. @param goals of this equilibrium
/// @return true if the analysis has to go on, with changed blocks; false: it has ended
[[nodiscard]] bool refine(Simulation& simulation, const AccuracyRequest& request,
                          const std::vector<Goal>& goals, AccuracyRounds& rounds);

/// Values of the goals at present, always the same ones; may be empty.
using GoalValues = std::function<std::vector<Goal>(const Simulation&)>;

/// Equilibria, each refine()d, until the accuracy is reached or an analysis finds none. Where an analysis does not
/// converge, all blocks get the next order.
/// @param rounds empty. @param may_continue called before each iteration: false ends it
/// @return status of the last analysis, balancing if it was ended
[[nodiscard]] StaticStatus find_equilibrium(Simulation& simulation, double end_time,
                                            const AccuracyRequest& request, const GoalValues& goals,
                                            AccuracyRounds& rounds,
                                            const std::function<bool()>& may_continue);

/// At the end of the last round; infinite without any. @param goals as given to refine()
[[nodiscard]] AccuracyEstimate accuracy_estimate(const std::vector<Goal>& goals,
                                                 const AccuracyRounds& rounds);

}  // namespace ashlar
