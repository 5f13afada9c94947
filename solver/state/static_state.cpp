#include "solver/state/static_state.hpp"

#include <cmath>

namespace ashlar {

double mean_motion(const BlockModel& block, const Eigen::MatrixX3d& change) {
  return change.norm() / std::sqrt(block.basis().volume());
}

}  // namespace ashlar
