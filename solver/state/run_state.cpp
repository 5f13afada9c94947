#include "solver/state/run_state.hpp"

namespace ashlar {

std::string to_string(RejectionReason reason) {
  switch (reason) {
    case RejectionReason::open_close_not_converged:
      return "open-close iteration did not converge";
    case RejectionReason::not_positive_definite:
      return "system not positive definite";
    case RejectionReason::passing:
      return "blocks would have passed through each other";
    case RejectionReason::no_shape:
      return "an incremental block would have turned inside out";
    case RejectionReason::not_finite:
      return "a block's state would not have been finite";
    case RejectionReason::inside_out:
      return "a block would have turned inside out";
    case RejectionReason::too_deep:
      return "penetration would have exceeded the allowed depth";
  }
  return "unknown";
}

Vector3 force_on_a(const PairRecord& record) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < record.points.size(); ++k) {
    const ContactPoint& point = record.points[k];
    const Eigen::Vector3d& force = record.responses[k].force;
    sum += force[0] * point.normal + force[1] * point.tangent_1 + force[2] * point.tangent_2;
  }
  return sum;
}

void count_states(const std::vector<PointResponse>& points, StepReport& report) {
  for (const PointResponse& point : points) {
    ++(point.state == ContactState::open     ? report.open
       : point.state == ContactState::locked ? report.locked
                                             : report.sliding);
  }
}

}  // namespace ashlar
