#include "solver/step/island/contact_table.hpp"

#include <algorithm>

namespace ashlar {

void ContactTable::set(const std::vector<std::vector<PointLaw>>& laws, bool mean) {
  laws_.clear();
  pairs_.clear();
  std::size_t points = 0;
  for (const std::vector<PointLaw>& of_pair : laws) {
    Pair& pair = pairs_.emplace_back(Pair{laws_.size(), points, 0.0});
    points += of_pair.size();
    for (const PointLaw& law : of_pair)
      pair.stiffness = std::max({pair.stiffness, steepest_normal_slope(law), shear_resistance(law)});
    if (!mean && std::all_of(of_pair.begin(), of_pair.end(), is_frequent))
      for (const PointLaw& law : of_pair) laws_.emplace_back(law);
  }
  pairs_.push_back({laws_.size(), points, 0.0});
}

}  // namespace ashlar
