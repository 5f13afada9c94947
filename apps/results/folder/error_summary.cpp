#include "apps/results/folder/error_summary.hpp"

#include <algorithm>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

std::vector<OrderError> worst_first(std::vector<OrderError> errors) {
  std::stable_sort(errors.begin(), errors.end(),
                   [](const OrderError& a, const OrderError& b) { return a.lacks > b.lacks; });
  return errors;
}

}  // namespace

nlohmann::ordered_json error_summary(const Simulation& simulation, const std::vector<OrderError>& errors) {
  constexpr std::size_t most = 10;
  Json blocks = Json::array();
  for (const OrderError& error : worst_first(errors)) {
    if (error.lacks == 0.0 || blocks.size() == most) break;
    const BlockModel& block = simulation.blocks()[at(error.block)];
    blocks.push_back({{"block", block.name()}, {"order", block.order()}, {"estimate", error.relative()}});
  }
  const double estimate = relative_error(errors);
  return {{"estimate", estimate}, {"by", {{"order", estimate}}}, {"blocks", std::move(blocks)}};
}

std::optional<OrderError> coarse_block(const Simulation& simulation, const std::vector<OrderError>& errors) {
  std::vector<OrderError> raised;
  for (const OrderError& error : errors)
    if (simulation.blocks()[at(error.block)].order() > 1) raised.push_back(error);
  if (!(relative_error(raised) > ordinary_order_error)) return std::nullopt;
  return worst_first(std::move(raised)).front();
}

}  // namespace ashlar
