// The predictor of an open-close iteration: the motion that it starts from.
#pragma once

#include <optional>

#include "solver/step/island/island_equations.hpp"

namespace ashlar {

/// Applies the predictor with the smallest total residual (Residual::sum), either one for all bodies or the best one
/// of each body: at rest for blocks that lie on others, inertial for blocks that slide, free motion for blocks
/// without contact. The responses are updated. @return its residual; empty if there is no choice
[[nodiscard]] std::optional<Residual> take_best_predictor(IslandProblem& problem);

}  // namespace ashlar
