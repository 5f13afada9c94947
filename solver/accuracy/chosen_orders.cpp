#include "solver/accuracy/chosen_orders.hpp"

#include <stdexcept>

#include "mechanics/material/poisson_limit.hpp"
#include "mechanics/material/st_venant_kirchhoff.hpp"

namespace ashlar {

bool can_have_order(const BlockModel& block, int order) {
  if (block.fixed() || block.rigid() || block.incremental() != nullptr) return false;
  const int largest = block.tangent_turns() ? largest_chosen_order
                                            : std::min(largest_chosen_order, StVenantKirchhoff::max_order);
  return order >= 1 && order <= largest && block.material().poisson_ratio <= largest_poisson_ratio(order);
}

bool changed_order(Simulation& simulation, int block, int order) {
  try {
    (void)simulation.change_order(block, order);
    return true;
  } catch (const OrderTooHigh&) {
    return false;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace ashlar
