#include "apps/results/folder/accuracy_state.hpp"

#include <algorithm>

namespace ashlar {

double AccuracyState::estimate() const {
  return (goals.empty() ? order_error + sub_face_error : *std::max_element(goals.begin(), goals.end())) +
         motion.error + motion.noise;
}

}  // namespace ashlar
