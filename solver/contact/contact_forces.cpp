// What a pair's contact points do within a step: forces, tangents, work, and what is remembered of them.
#include <algorithm>
#include <cmath>
#include <limits>

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

/// Norm of the longest row.
double largest_row(const Eigen::MatrixXd& rows) {
  return rows.size() > 0 ? std::sqrt(rows.rowwise().squaredNorm().maxCoeff()) : 0.0;
}

}  // namespace

Eigen::MatrixX3d MeanDeformation::levers(const Eigen::VectorXd& change) const {
  const Eigen::MatrixX3d& gradients = parts->mean_gradients;
  const Eigen::Map<const Eigen::MatrixX3d> motion(change.data(), gradients.rows(), 3);
  const Eigen::Matrix3d middle = start + 0.5 * motion.transpose() * gradients;
  return gradients * middle.inverse();
}

double ContactPair::force_rounding(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                   const std::vector<PointLaw>& laws) const {
  double stiffness = 0.0;
  for (const PointLaw& law : laws)
    stiffness = std::max({stiffness, law.normal_stiffness, law.shear_stiffness});
  const double row_a = largest_row(rows_a_);
  const double row_b = largest_row(rows_b_);
  return 2.0 * std::numeric_limits<double>::epsilon() * stiffness *
         (row_a * row_a * ya.norm() + row_b * row_b * yb.norm());
}

double ContactPair::force_in_doubt(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                   const std::vector<PointLaw>& laws, const PairResponse& response) const {
  const auto in_doubt = [](const PointResponse& point) {
    return point.force[0] == 0.0 && point.tangent(0, 0) > 0.0;
  };
  if (std::none_of(response.points.begin(), response.points.end(), in_doubt)) return 0.0;
  const Eigen::Matrix3Xd place = relative(ya, yb);
  double sum = 0.0;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const double gap = place(0, static_cast<Eigen::Index>(k));
    if (in_doubt(response.points[k]))
      sum += std::max(0.0, laws[k].normal_stiffness * gap - laws[k].normal_multiplier);
  }
  return std::max(largest_row(rows_a_), largest_row(rows_b_)) * sum;
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

double ContactPair::prescribed_work(const PairResponse& response) const {
  double work = 0.0;
  for (Eigen::Index k = 0; k < prescribed_.cols(); ++k)
    work += prescribed_.col(k).dot(response.means[static_cast<std::size_t>(k)].force);
  return work;
}

PairResponse ContactPair::respond(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, bool averaged,
                                  const std::vector<PointLaw>& laws) const {
  const Eigen::Matrix3Xd place = relative(ya, yb);
  PairResponse response;
  Eigen::VectorXd forces(place.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (averaged) {
      const AveragedStep step =
          averaged_step(laws[k], start_responses_[k], start_.col(column), place.col(column));
      response.points.push_back(step.end);
      response.means.push_back(step.mean);
    } else {
      const PointResponse end = point_response(laws[k], place(0, column), place.col(column).tail<2>());
      response.points.push_back(end);
      response.means.push_back(end_response(laws[k], end));
    }
    forces.segment<3>(3 * column) = response.means.back().force;
  }
  set_block_forces(forces, response);
  if (free_pair_) shift_to_common_points(ya, yb, forces, response);
  return response;
}

void ContactPair::shift_to_common_points(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                         const Eigen::VectorXd& forces, PairResponse& response) const {
  const Eigen::Matrix3Xd apart = apart_ + 0.5 * motion(ya, yb);
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();  // r f'
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const ContactPoint& point = points_[k];
    const Vector3 force = forces.segment<3>(3 * column);
    const Vector3 r = apart.col(column);
    const Vector3 along = out_of_frame(point, {0.0, force[1], force[2]});
    moment += force[0] * out_of_frame(point, {0.0, r[1], r[2]}) * point.normal.transpose() +
              out_of_frame(point, r) * along.transpose();
  }
  response.shift_on_a = (-0.5 * deformation_a_.levers(ya) * moment).reshaped();
  response.shift_on_b = (-0.5 * deformation_b_.levers(yb) * moment).reshaped();
}

void ContactPair::set_block_forces(const Eigen::VectorXd& forces, PairResponse& response) const {
  if (rows_a_.cols() > 0) response.force_on_a = rows_a_.transpose() * forces;
  if (rows_b_.cols() > 0) response.force_on_b = -(rows_b_.transpose() * forces);
}

ContactPair::Tangent ContactPair::tangent(const PairResponse& response) const {
  std::vector<Eigen::Index> active;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (!response.means[k].tangent.isZero(0.0)) active.push_back(static_cast<Eigen::Index>(k));
  }
  const auto gather = [&](const Eigen::MatrixXd& rows, bool times_tangent) {
    Eigen::MatrixXd result(3 * static_cast<Eigen::Index>(active.size()), rows.cols());
    for (std::size_t n = 0; n < active.size(); ++n) {
      const Eigen::Index k = active[n];
      const auto target = static_cast<Eigen::Index>(3 * n);
      if (times_tangent) {
        result.middleRows<3>(target).noalias() =
            response.means[static_cast<std::size_t>(k)].tangent * rows.middleRows<3>(3 * k);
      } else {
        result.middleRows<3>(target) = rows.middleRows<3>(3 * k);
      }
    }
    return result;
  };
  Tangent tangent;
  Eigen::MatrixXd scaled_b;
  if (rows_b_.cols() > 0) {
    scaled_b = gather(rows_b_, true);
    tangent.bb = gather(rows_b_, false).transpose() * scaled_b;
  }
  if (rows_a_.cols() > 0) {
    const Eigen::MatrixXd plain_a = gather(rows_a_, false);
    tangent.aa = plain_a.transpose() * gather(rows_a_, true);
    if (rows_b_.cols() > 0) tangent.ab = -(plain_a.transpose() * scaled_b);
  }
  return tangent;
}

Eigen::Matrix2Xd ContactPair::sliding_couplings(const PairResponse& response) {
  Eigen::Matrix2Xd result(2, static_cast<Eigen::Index>(response.means.size()));
  for (std::size_t k = 0; k < response.means.size(); ++k)
    result.col(static_cast<Eigen::Index>(k)) = response.means[k].coupling;
  return result;
}

void ContactPair::add_coupling(const Eigen::Matrix2Xd& couplings, const Eigen::VectorXd& da,
                               const Eigen::VectorXd& db, Eigen::Ref<Eigen::VectorXd> to_a,
                               Eigen::Ref<Eigen::VectorXd> to_b) const {
  for (Eigen::Index k = 0; k < couplings.cols(); ++k) {
    if (couplings.col(k).isZero(0.0)) continue;
    double opening = 0.0;
    if (da.size() > 0) opening += rows_a_.row(3 * k).dot(da);
    if (db.size() > 0) opening -= rows_b_.row(3 * k).dot(db);
    const Eigen::Vector2d force = opening * couplings.col(k);
    if (da.size() > 0) to_a += rows_a_.middleRows<2>(3 * k + 1).transpose() * force;
    if (db.size() > 0) to_b -= rows_b_.middleRows<2>(3 * k + 1).transpose() * force;
  }
}

std::vector<double> ContactPair::gaps(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  const Eigen::Matrix3Xd place = relative(ya, yb);
  std::vector<double> result;
  for (Eigen::Index k = 0; k < place.cols(); ++k)
    result.push_back(rests_[static_cast<std::size_t>(k)] + place(0, k));
  return result;
}

std::vector<PointMemory> ContactPair::memory_after(const PairResponse& response,
                                                   const std::vector<PointLaw>& laws,
                                                   const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                                   double tearing_gap) const {
  const Eigen::Matrix3Xd place = relative(ya, yb);
  std::vector<PointMemory> result;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const PointResponse& point = response.points[k];
    const Eigen::Vector2d slip = place.col(static_cast<Eigen::Index>(k)).tail<2>();
    const Eigen::Vector2d elastic = elastic_slip(laws[k], point, slip);
    PointMemory memory;
    memory.slip = flat(k, elastic);
    memory.level_slip = memory_[k].level_slip;
    memory.in_level = counts_slip_ && (memory_[k].in_level || point.state != ContactState::open ||
                                       start_responses_[k].state != ContactState::open);
    memory.compression = -place(0, static_cast<Eigen::Index>(k));
    memory.state = point.state;
    const bool open = point.state == ContactState::open;
    const bool torn = laws_[k].tension > 0.0 ? open || laws[k].tension == 0.0
                                             : open && place(0, static_cast<Eigen::Index>(k)) > tearing_gap;
    const bool sheared = point.state == ContactState::sliding && laws_[k].cohesion > 0.0;
    memory.intact = memory_[k].intact && (holds_bonds_ || (!torn && !sheared));
    if (laws[k].augmented && point.state != ContactState::open) {
      const Eigen::Vector2d shear = point.force.tail<2>();
      const double scale = multiplier_scale(points_[k]);
      memory.normal_multiplier = point.force[0] / scale;
      memory.shear_multiplier = (shear[0] * points_[k].tangent_1 + shear[1] * points_[k].tangent_2) / scale;
    }
    result.push_back(memory);
  }
  return result;
}

double ContactPair::friction_work(const PairResponse& response, const std::vector<PointLaw>& laws,
                                  const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  const Eigen::Matrix3Xd place = relative(ya, yb);
  double work = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const PointResponse& point = response.points[k];
    // Means of points that are open at the end may have rubbed before.
    if (point.state == ContactState::locked) continue;
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::Vector2d slip = place.col(column).tail<2>();
    Eigen::Vector2d elastic = Eigen::Vector2d::Zero();
    if (laws[k].augmented)
      elastic = start_.col(column).tail<2>();
    else if (point.state == ContactState::sliding)
      elastic = elastic_slip(laws[k], point, slip) + slid_before(k);
    work += response.means[k].force.tail<2>().dot(elastic - slip);
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
