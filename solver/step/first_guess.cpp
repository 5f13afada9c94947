#include "solver/step/first_guess.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace ashlar {

std::optional<Balance> take_best_guess(IslandProblem& problem) {
  // Not 1/2 or 1, which symmetric scenes have but for rounding.
  constexpr double least_gain = 0.45;
  constexpr double least_gain_of_one = 0.9;
  problem.predict(FirstGuess::falling);
  problem.respond();
  if (problem.scheme().from_rest || problem.pairs() == 0) return std::nullopt;
  Balance best_balance = problem.balance();
  double least = best_balance.worst;
  std::vector<double> shares = best_balance.shares;
  Evaluation best = problem.set_aside();
  std::vector<Eigen::VectorXd> own = best.guess;
  std::vector<FirstGuess> kinds(own.size(), FirstGuess::falling);
  const auto compare = [&](Balance balance) {
    if (!(balance.worst <= least_gain * least)) return;
    least = balance.worst;
    best_balance = std::move(balance);
    best = problem.set_aside();
  };
  for (const FirstGuess kind : {FirstGuess::coasting, FirstGuess::staying}) {
    problem.predict(kind);
    problem.respond();
    Balance balance = problem.balance();
    const std::vector<Eigen::VectorXd> guess = problem.guess();
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (balance.shares[k] > least_gain_of_one * shares[k]) continue;
      shares[k] = balance.shares[k];
      own[k] = guess[k];
      kinds[k] = kind;
    }
    compare(std::move(balance));
  }
  if (std::adjacent_find(kinds.begin(), kinds.end(), std::not_equal_to<>()) != kinds.end()) {
    problem.set_guess(own);
    problem.respond();
    compare(problem.balance());
  }
  problem.take_back(std::move(best));
  return best_balance;
}

}  // namespace ashlar
