// The guess that an open-close iteration starts from.
#pragma once

#include <optional>

#include "solver/step/island_equations.hpp"

namespace ashlar {

/// Takes the guess that lacks least balance in sum (Balance::sum), one for all bodies or for each its own: blocks at
/// rest on others stay, those that slide coast, those that meet nothing fall. Responses are its own then.
/// @return its balance; none where there is no choice
[[nodiscard]] std::optional<Balance> take_best_guess(IslandProblem& problem);

}  // namespace ashlar
