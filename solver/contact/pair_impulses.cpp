// The part of ContactPair that stops approaching points at the end of a step (step/accept/velocity_contact.hpp).
#include <algorithm>
#include <limits>

#include "solver/contact/contact_pair.hpp"

namespace ashlar {
namespace {

/// Springs without a bond have finite forces, which are no impulse.
bool has_impulses(const PointLaw& law) {
  return law.augmented || law.tension > 0.0;
}

bool is_held(const PointLaw& law, const PointResponse& point) {
  return point.state != ContactState::open && has_impulses(law) &&
         (point.force[0] > 0.0 || law.tension > 0.0);
}

}  // namespace

bool ContactPair::pushes(const PairResponse& end, const std::vector<PointLaw>& laws) const {
  for (std::size_t k = 0; !tied() && k < points_.size(); ++k) {
    if (is_held(laws[k], end.points[k])) return true;
  }
  return false;
}

PairResponse ContactPair::stopping(const PairResponse& end, const std::vector<PointLaw>& laws,
                                   const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, const Stop& stop,
                                   const std::vector<bool>& let_go) const {
  const auto mobility = [&](Eigen::Index first, Eigen::Index count) {
    return rows_.mobility(first, count, stop.inertia_a, stop.inertia_b);
  };
  const double of_tie = tied() ? mobility(0, 3 * static_cast<Eigen::Index>(points_.size())) : 0.0;
  const Eigen::Matrix3Xd displacement = motion(ya, yb);
  PairResponse result;
  result.points = end.points;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(displacement.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const PointResponse& point = end.points[k];
    MeanResponse mean{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), {}, 0.0};
    const auto stiffness = [&](double mobile) {
      if (mobile <= 0.0) return 0.0;
      const bool whole = tied() || laws[k].tension > 0.0;
      const double share = whole ? 1.0 : point.force[0] / (point.force[0] + stop.allowed_way / mobile);
      return share * stop.stiffness / mobile;
    };
    if (tied()) {
      mean.tangent.diagonal().setConstant(stiffness(of_tie));
    } else if (let_go[k]) {
      mean.force = -end.means[k].force;
    } else if (is_held(laws[k], point)) {
      mean.tangent(0, 0) = stiffness(mobility(3 * column, 1));
      // A sliding point that dilates is stopped in the direction normal to its slope.
      if (point.state == ContactState::sliding && laws[k].dilation.tangent > 0.0) {
        Eigen::Vector3d across(1.0, 0.0, 0.0);
        across.tail<2>() = laws[k].dilation.tangent * point.direction;
        mean.tangent = mean.tangent(0, 0) / across.squaredNorm() * across * across.transpose();
      }
      if (point.state == ContactState::locked)
        mean.tangent.bottomRightCorner<2, 2>().diagonal().setConstant(stiffness(mobility(3 * column + 1, 2)));
    }
    mean.force -= mean.tangent * displacement.col(column);
    forces.segment<3>(3 * column) = mean.force;
    result.means.push_back(mean);
  }
  rows_.set_forces(forces, result);
  return result;
}

void ContactPair::apply_deferred_friction(double step) {
  for (std::size_t k = 0; k < laws_.size(); ++k)
    laws_[k].impulse_force = multiplier_scale(points_[k]) * memory_[k].deferred_friction / step;
}

void ContactPair::remember_impulses(const PairResponse& response, const std::vector<PointLaw>& laws,
                                    const std::vector<Eigen::Vector3d>& impulses, double step,
                                    std::vector<PointMemory>& memory) const {
  for (std::size_t k = 0; k < impulses.size(); ++k) {
    const Eigen::Vector3d& force = response.points[k].force;
    if (response.points[k].state == ContactState::open || !has_impulses(laws[k])) continue;
    if (laws[k].friction_at(force[0]) == 0.0) continue;
    Eigen::Vector2d shear = force.tail<2>();
    // Impulses normal to the slope of a point that dilates include some friction.
    if (response.points[k].state == ContactState::sliding && laws[k].dilation.tangent > 0.0)
      shear += impulses[k].tail<2>();
    const double rubbed = std::max(0.0, shear.norm() - laws[k].cohesion) / laws[k].friction_at(force[0]);
    const double due = force[0] + laws[k].impulse_force + impulses[k][0];
    const double most = response.points[k].state == ContactState::sliding
                            ? std::numeric_limits<double>::infinity()
                            : std::max(impulses[k][0], 0.0);
    const double left = std::min(most, due - rubbed);
    memory[k].deferred_friction = step * left / multiplier_scale(points_[k]);
  }
}

}  // namespace ashlar
