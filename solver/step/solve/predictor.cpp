#include "solver/step/solve/predictor.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace ashlar {
namespace {

/// Evaluates a predictor.
Residual residual_of(IslandProblem& problem, Predictor kind) {
  problem.predict(kind);
  problem.respond();
  return problem.residual();
}

}  // namespace

std::optional<Residual> take_best_predictor(IslandProblem& problem) {
  // Not 1/2 or 1, which occur in symmetric scenes up to rounding.
  constexpr double least_gain = 0.45;
  // The same for the body's own choice, and for the combined guess, which has been evaluated in any case.
  constexpr double least_gain_of_own = 0.9;
  // Relative to the largest force on each body: from a smaller residual Newton's iteration converges as from the best
  // predictor.
  constexpr double little = 0.1;
  if (problem.scheme().is_static() || problem.all_pairs() == 0) {
    problem.predict(Predictor::free_motion);
    problem.respond();
    return std::nullopt;
  }
  Residual at_rest = residual_of(problem, Predictor::at_rest);
  if (at_rest.largest_by_force <= little) return at_rest;
  Evaluation evaluated_at_rest = problem.set_aside();
  Residual best_residual = residual_of(problem, Predictor::free_motion);
  double least = best_residual.sum;
  std::vector<double> shares = best_residual.relative;
  Evaluation best = problem.set_aside();
  std::vector<Eigen::VectorXd> own = best.guess;
  std::vector<Predictor> kinds(own.size(), Predictor::free_motion);
  const auto compare = [&](Predictor kind, Residual residual, Evaluation evaluation) {
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (residual.relative[k] > least_gain_of_own * shares[k]) continue;
      shares[k] = residual.relative[k];
      own[k] = evaluation.guess[k];
      kinds[k] = kind;
    }
    if (!(residual.sum <= least_gain * least)) return;
    least = residual.sum;
    best_residual = std::move(residual);
    best = std::move(evaluation);
  };
  Residual inertial = residual_of(problem, Predictor::inertial);
  compare(Predictor::inertial, std::move(inertial), problem.set_aside());
  compare(Predictor::at_rest, std::move(at_rest), std::move(evaluated_at_rest));
  // Neighbours start as their owners choose. With several processes the choices of all are not compared.
  problem.sums().update_neighbours(own);
  if (problem.sums().shared() ||
      std::adjacent_find(kinds.begin(), kinds.end(), std::not_equal_to<>()) != kinds.end()) {
    problem.set_guess(own);
    problem.respond();
    Residual mixed = problem.residual();
    if (mixed.sum <= least_gain_of_own * least) return mixed;
  }
  problem.take_back(std::move(best));
  return best_residual;
}

}  // namespace ashlar
