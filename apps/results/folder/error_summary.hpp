// `error` of summary.json: estimated error of the orders of blocks at the end of a run.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "solver/run/order_error.hpp"

namespace ashlar {

/// Largest estimate without a warning, for blocks whose order was raised.
inline constexpr double ordinary_order_error = 0.1;

/// estimate: of all blocks, in the norm of the strain energy; by: { order }; blocks: at most 10 with the largest lacks
/// of energy, { block, order, estimate }, without those whose estimate is 0.
[[nodiscard]] nlohmann::ordered_json error_summary(const Simulation& simulation,
                                                   const std::vector<OrderError>& errors);

/// The block to be refined first, if all blocks of order 2 and more together have more than ordinary_order_error; those
/// of order 1 are chosen for their motion, not for their stress.
[[nodiscard]] std::optional<OrderError> coarse_block(const Simulation& simulation,
                                                     const std::vector<OrderError>& errors);

}  // namespace ashlar
