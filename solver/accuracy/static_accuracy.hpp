// Orders of blocks and sub-faces chosen for an accuracy, in a static analysis.
//
// The analysis finds an equilibrium with the present orders: a round. Then, in this order,
// - while a goal still changes by more than its accuracy, the blocks whose orders lack the most energy (order_error.hpp)
//   get the next order; without goals, those that lack more than the accuracy allows;
// - once orders suffice, the chord tolerance of curved faces is divided by four until goals change by no more;
// and the analysis goes on from there, with its contacts and their memory: another round. Errors are estimated from the
// changes d of goals over two rounds: with the ratio q of two of them, those that are left add up to d q / (1 - q).
// The energy that a block lacks is the square of its error in the norm of the energy; an error of a displacement is a
// product of two such norms (R. Becker and R. Rannacher, Acta Numerica 10 (2001) 1), so that it is of the size of that
// square.
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
  std::vector<double> lacks;               ///< J by block, as OrderError; negative: not estimated
};

/// Lacks before any estimate: unknown of moving blocks that deform, 0 of others.
[[nodiscard]] std::vector<double> unknown_lacks(const Simulation& simulation);

/// All rounds so far.
struct AccuracyRounds {
  std::vector<AccuracyRound> orders;     ///< with different orders
  std::vector<AccuracyRound> sub_faces;  ///< after those, with smaller and smaller chord tolerances
  bool divides = false;                  ///< true once orders suffice and the chord tolerance changes
  std::vector<int> highest;              ///< blocks whose shape or material allows no higher order
};

/// Estimates, all relative.
struct AccuracyEstimate {
  double order = 0.0;  ///< of the orders of blocks: the largest of the goals, or without goals of the energy
  double sub_faces = 0.0;     ///< of the chord tolerance, likewise; 0: no curved face is in contact
  std::vector<double> goals;  ///< of each goal, of both
  /// The block that hinders convergence: its lack of energy is the largest, and the last higher order has hardly reduced
  /// it. -1: none
  int slow_block = -1;

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
/// @param rounds empty. @param goes_on called before each iteration: false ends it
/// @return status of the last analysis, balancing if it was ended
[[nodiscard]] StaticStatus find_equilibrium(Simulation& simulation, double end_time,
                                            const AccuracyRequest& request, const GoalValues& goals,
                                            AccuracyRounds& rounds, const std::function<bool()>& goes_on);

/// At the end of the last round; infinite without any. @param goals as given to refine()
[[nodiscard]] AccuracyEstimate accuracy_estimate(const std::vector<Goal>& goals,
                                                 const AccuracyRounds& rounds);

}  // namespace ashlar
