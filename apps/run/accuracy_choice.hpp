// Orders, sub-faces and time step chosen for analysis.accuracy, before a run begins.
//
// A static analysis is repeated on a copy of the blocks, with higher orders and then more sub-faces, until its measures,
// or without measures the energy of its blocks, no longer change by more than the accuracy (static_accuracy.hpp). A
// motion is run in few steps and repeated likewise; its time step is chosen during the run (motion_accuracy.hpp). The
// run then has the chosen orders from its beginning, as if the scene gave them.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "apps/results/folder/accuracy_state.hpp"
#include "apps/scene/assemble/build_simulation.hpp"

namespace ashlar {

/// @param loaded a scene with an accuracy. @param may_continue called between steps: false ends the choice
/// @return empty if it was ended. @throws std::runtime_error if blocks of a chosen order cannot be built
[[nodiscard]] std::optional<AccuracyState> choose_for_accuracy(const LoadedScene& loaded, int threads,
                                                               const std::function<bool()>& may_continue);

/// The scene with the chosen orders and chord tolerance in the place of automatic ones.
[[nodiscard]] std::shared_ptr<const LoadedScene> with_choice(const LoadedScene& loaded,
                                                             const AccuracyState& choice);

/// Of the scene of a run whose step is automatic.
[[nodiscard]] MotionRequest motion_request(const Scene& scene);

}  // namespace ashlar
