#include "solver/bolts/bolt.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {
namespace {

bool any(const std::vector<int>& flags) {
  return std::any_of(flags.begin(), flags.end(), [](int flag) { return flag != 0; });
}

}  // namespace

const char* to_string(BoltCondition condition) {
  switch (condition) {
    case BoltCondition::absent:
      return "absent";
    case BoltCondition::elastic:
      return "elastic";
    case BoltCondition::slipped:
      return "slipped";
    case BoltCondition::yielded:
      return "yielded";
    case BoltCondition::ruptured:
      return "ruptured";
  }
  return "";
}

BoltCondition condition_of(const Bolt& bolt, const BoltState& state) {
  if (!state.installed()) return BoltCondition::absent;
  const BoltMemory& memory = state.reached;
  if (any(memory.ruptured)) return BoltCondition::ruptured;
  if (bolt.chain.has_yielded(memory)) return BoltCondition::yielded;
  return any(memory.sheared) ? BoltCondition::slipped : BoltCondition::elastic;
}

double largest_axial_force(const BoltState& state) {
  double largest = 0.0;
  for (const double force : state.axial)
    if (std::abs(force) > std::abs(largest)) largest = force;
  return largest;
}

double largest_shear_force(const BoltState& state) {
  double largest = 0.0;
  for (std::size_t n = 0; n + 1 < state.dowels.size(); n += 2)
    largest = std::max(largest, Eigen::Vector2d(state.dowels[n], state.dowels[n + 1]).norm());
  return largest;
}

void take_forces(const BoltResponse& response, BoltState& state) {
  state.stored = response.stored;
  state.dissipated = response.dissipated;
  state.axial.clear();
  state.bond.clear();
  state.dowels.clear();
  for (const SpringPoint& spring : response.bar) state.axial.push_back(spring.force);
  for (const SpringPoint& spring : response.bond) state.bond.push_back(spring.force);
  for (const Eigen::Vector2d& dowel : response.dowels)
    state.dowels.insert(state.dowels.end(), {dowel[0], dowel[1]});
}

}  // namespace ashlar
