// The part of ContactPair about energy: spring energy, work of contacts, dissipation by friction.
#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/contact/contact_pair.hpp"

namespace ashlar {
namespace {

SpringEnergy sum_of(const std::vector<PointResponse>& points) {
  SpringEnergy sum;
  for (const PointResponse& point : points) {
    sum.normal += point.normal_energy;
    sum.shear += point.shear_energy;
  }
  return sum;
}

}  // namespace

bool ContactPair::can_be_bounded() const {
  return !tied() && std::none_of(laws_.begin(), laws_.end(),
                                 [](const PointLaw& law) { return law.augmented || law.tension > 0.0; });
}

void ContactPair::hold_at_most(const SpringEnergy& held) {
  if (!can_be_bounded()) return;
  std::vector<NormalSpring> springs;
  std::vector<double> gaps, remembered;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    springs.push_back(laws_[k].normal_spring());
    gaps.push_back(points_[k].gap - dilation_before(k));
    remembered.push_back(std::min(0.0, gaps.back() + memory_[k].compression));
  }
  std::vector<double> rests = rest_gaps(springs, gaps, remembered, held.normal);
  for (std::size_t k = 0; k < points_.size(); ++k) rests[k] += dilation_before(k);
  rest_at(std::move(rests));
  // Removes slip beyond the friction bound first: the comparison of energies below must not depend on its rounding
  // errors.
  double shear = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    auto slip = start_.col(static_cast<Eigen::Index>(k)).tail<2>();
    slip = borne_slip(laws_[k], start_responses_[k].force[0], slip);
    shear += 0.5 * laws_[k].shear_stiffness * slip.squaredNorm();
  }
  if (shear > held.shear) start_.bottomRows<2>() *= std::sqrt(held.shear / shear);
  respond_at_start();
  // Includes points that are open only within rounding error.
  for (std::size_t k = 0; k < points_.size(); ++k)
    start_responses_[k].shear_energy =
        0.5 * laws_[k].shear_stiffness * start_.col(static_cast<Eigen::Index>(k)).tail<2>().squaredNorm();
}

double ContactPair::work(const PairResponse& response, const Eigen::VectorXd& ya,
                         const Eigen::VectorXd& yb) const {
  return (ya.size() > 0 ? ya.dot(response.total_on_a()) : 0.0) +
         (yb.size() > 0 ? yb.dot(response.total_on_b()) : 0.0) + prescribed_work(response);
}

double ContactPair::spring_work(const PairResponse& response, const Eigen::VectorXd& ya,
                                const Eigen::VectorXd& yb) const {
  return (ya.size() > 0 ? ya.dot(response.force_on_a) : 0.0) +
         (yb.size() > 0 ? yb.dot(response.force_on_b) : 0.0) + prescribed_work(response);
}

double ContactPair::friction_work(const PairResponse& response, const std::vector<PointLaw>& laws,
                                  const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  const Eigen::Matrix3Xd place = places(ya, yb);
  double work = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const PointResponse& point = response.points[k];
    // Points that are open at the end may have slid before: their mean counts.
    if (point.state == ContactState::locked) continue;
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::Vector2d slip = place.col(column).tail<2>();
    Eigen::Vector2d elastic = Eigen::Vector2d::Zero();
    if (laws[k].augmented)
      elastic = start_.col(column).tail<2>();
    else if (point.state == ContactState::sliding)
      elastic = elastic_slip(laws[k], point, slip) + slid_before(k);
    work += response.means[k].force.tail<2>().dot(elastic - slip);
    if (point.dilation > 0.0)
      work -= response.means[k].force[0] * (point.dilation - start_responses_[k].dilation);
  }
  return work;
}

double ContactPair::start_energy() const {
  return start_energies().total();
}

SpringEnergy ContactPair::start_energies() const {
  return sum_of(start_responses_);
}

SpringEnergy ContactPair::energies(const PairResponse& response) {
  return sum_of(response.points);
}

}  // namespace ashlar
