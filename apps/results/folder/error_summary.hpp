// `error` of summary.json: estimated error of the orders of blocks at the end of a run, or that of a run with an accuracy.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/results/folder/accuracy_state.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/accuracy/goal_error.hpp"
#include "solver/run/order_error.hpp"

namespace ashlar {

/// Largest estimate without a warning, for blocks whose order was raised.
inline constexpr double ordinary_order_error = 0.1;

/// estimate: of the estimated blocks together, in the norm of the strain energy; by: { order }; blocks: at most 10 with the
/// largest lacks of energy, { block, order, estimate }, without those whose estimate is 0; blocks_estimated: number of
/// blocks; blocks_in_all: with those that were left out. Neither estimate nor by if none was estimated.
[[nodiscard]] nlohmann::ordered_json error_summary(const Simulation& simulation, const OrderErrors& errors);

/// Adds `measures`: the relative error of each by the orders of blocks. @param errors by measure
void add_measure_errors(const Scene& scene, const std::vector<GoalError>& errors,
                        nlohmann::ordered_json& summary);

/// The block to be refined first, if all blocks of order 2 and more together have more than ordinary_order_error; those
/// of order 1 are chosen for their motion, not for their stress.
[[nodiscard]] std::optional<OrderError> coarse_block(const Simulation& simulation,
                                                     const std::vector<OrderError>& errors);

/// `error` of summary.json: accuracy, estimate, by { order, sub_faces, step }, measures, orders { order: blocks },
/// skipped (blocks whose chosen order is below the largest one), advice.
[[nodiscard]] nlohmann::ordered_json accuracy_summary(const Scene& scene, const Simulation& simulation,
                                                      const AccuracyState& state);

/// How to come closer to the accuracy; empty: it is met.
[[nodiscard]] std::string accuracy_advice(const Scene& scene, const Simulation& simulation,
                                          const AccuracyState& state);

}  // namespace ashlar
