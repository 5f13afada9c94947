// Choices for analysis.accuracy and their estimated errors, for checkpoints and the summary (error_summary.hpp).
#pragma once

#include <map>
#include <vector>

#include "solver/accuracy/motion_accuracy.hpp"

namespace ashlar {

struct AccuracyState {
  std::map<int, int> orders;     ///< of blocks with an automatic order
  double chord_tolerance = 0.0;  ///< m; 0: that of the scene
  int rounds = 0;                ///< analyses that the choice needed
  double order_error = 0.0;      ///< relative, see AccuracyEstimate
  double sub_face_error = 0.0;
  std::vector<double> goals;   ///< of each measure, of both
  int slow_block = -1;         ///< see AccuracyEstimate
  double out_of_reach = 0.0;   ///< see AccuracyEstimate
  MotionAccuracyState motion;  ///< of a run whose step is automatic

  /// Sum of all, relative.
  [[nodiscard]] double estimate() const;
};

}  // namespace ashlar
