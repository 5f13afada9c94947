#include "solver/shared/agreement.hpp"

namespace ashlar {

std::vector<bool> any_of_run(const BlockSystem& system, const std::vector<bool>& flags) {
  if (system.share() == nullptr || flags.empty()) return flags;
  std::vector<double> values;
  values.reserve(flags.size());
  for (const bool flag : flags) values.push_back(flag ? 1.0 : 0.0);
  std::vector<bool> any;
  for (const double value : max_of_ranks(system.share()->ranks(), values)) any.push_back(value > 0.0);
  return any;
}

}  // namespace ashlar
