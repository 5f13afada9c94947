// The predictor of an open-close iteration: the motion that it starts from.
#pragma once

#include <optional>

#include "solver/step/island_equations.hpp"

namespace ashlar {

/// Takes the predictor with the smallest total residual (Residual::sum), one for all bodies or for each its own: at rest
/// for blocks that lie on others, inertial for those that slide, free motion for those that meet nothing. Responses are
/// its own then. @return its residual; empty where there is no choice
[[nodiscard]] std::optional<Residual> take_best_predictor(IslandProblem& problem);

}  // namespace ashlar
