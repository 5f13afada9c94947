#include "solver/step/island/island_sums.hpp"

#include <algorithm>

namespace ashlar {

const IslandSums& IslandSums::of_one_process() {
  static const IslandSums one;
  return one;
}

double IslandSums::sum(double value) const {
  return shared() ? sum(std::vector{value})[0] : value;
}

double IslandSums::largest(double value) const {
  return shared() ? largest(std::vector{value})[0] : value;
}

bool IslandSums::any(bool value) const {
  return shared() ? largest(value ? 1.0 : 0.0) > 0.0 : value;
}

double IslandSums::dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const {
  return shared() ? dot(Eigen::Ref<const Eigen::MatrixXd>(x), y)[0] : x.dot(y);
}

StateComparison compare_states(const IslandSums& sums, const std::vector<ContactState>& states,
                               const std::vector<std::vector<ContactState>>& seen) {
  if (seen.empty()) return {false, false};
  if (!sums.shared())
    return {states == seen.back(), std::find(seen.begin(), seen.end(), states) != seen.end()};
  std::vector<double> differ;
  for (const std::vector<ContactState>& earlier : seen) differ.push_back(states == earlier ? 0.0 : 1.0);
  differ = sums.largest(differ);
  return {differ.back() == 0.0, std::find(differ.begin(), differ.end(), 0.0) != differ.end()};
}

}  // namespace ashlar
