#include "solver/step/first_guess.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace ashlar {
namespace {

/// Evaluates a guess.
Balance try_guess(IslandProblem& problem, FirstGuess kind) {
  problem.predict(kind);
  problem.respond();
  return problem.balance();
}

}  // namespace

std::optional<Balance> take_best_guess(IslandProblem& problem) {
  // Not 1/2 or 1, which symmetric scenes have but for rounding.
  constexpr double least_gain = 0.45;
  // The same for a body's own choice, and for the guess that these choices make, which has been evaluated in any case.
  constexpr double least_gain_of_own = 0.9;
  // Of the largest force on each body: where it lacks no more, Newton's iteration goes from there as from the best guess.
  constexpr double little = 0.1;
  if (problem.scheme().from_rest || problem.pairs() == 0) {
    problem.predict(FirstGuess::falling);
    problem.respond();
    return std::nullopt;
  }
  Balance staying = try_guess(problem, FirstGuess::staying);
  if (staying.largest_part <= little) return staying;
  Evaluation stayed = problem.set_aside();
  Balance best_balance = try_guess(problem, FirstGuess::falling);
  double least = best_balance.sum;
  std::vector<double> shares = best_balance.shares;
  Evaluation best = problem.set_aside();
  std::vector<Eigen::VectorXd> own = best.guess;
  std::vector<FirstGuess> kinds(own.size(), FirstGuess::falling);
  const auto compare = [&](FirstGuess kind, Balance balance, Evaluation evaluation) {
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (balance.shares[k] > least_gain_of_own * shares[k]) continue;
      shares[k] = balance.shares[k];
      own[k] = evaluation.guess[k];
      kinds[k] = kind;
    }
    if (!(balance.sum <= least_gain * least)) return;
    least = balance.sum;
    best_balance = std::move(balance);
    best = std::move(evaluation);
  };
  Balance coasting = try_guess(problem, FirstGuess::coasting);
  compare(FirstGuess::coasting, std::move(coasting), problem.set_aside());
  compare(FirstGuess::staying, std::move(staying), std::move(stayed));
  if (std::adjacent_find(kinds.begin(), kinds.end(), std::not_equal_to<>()) != kinds.end()) {
    problem.set_guess(own);
    problem.respond();
    Balance mixed = problem.balance();
    if (mixed.sum <= least_gain_of_own * least) return mixed;
  }
  problem.take_back(std::move(best));
  return best_balance;
}

}  // namespace ashlar
