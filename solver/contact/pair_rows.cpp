#include "solver/contact/pair_rows.hpp"

#include <cmath>

namespace ashlar {
namespace {

/// Values of a block's functions at its material points. @return (#points, p), empty for fixed blocks
Eigen::MatrixXd values_at(const BlockModel& model, const std::vector<ContactPoint>& points, bool of_a) {
  if (model.fixed()) return {};
  std::vector<Vector3> material;
  material.reserve(points.size());
  for (const ContactPoint& point : points) material.push_back(of_a ? point.material_a : point.material_b);
  return model.basis().values(material);
}

/// Rows that give the motion of a block along the three directions of each contact point.
Eigen::MatrixXd contact_rows(const BlockModel& model, const std::vector<ContactPoint>& points,
                             const Eigen::MatrixXd& phi) {
  if (model.fixed()) return {};
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd rows(3 * count, model.unknowns());
  for (int direction = 0; direction < 3; ++direction) {
    Eigen::MatrixX3d directions(count, 3);
    for (Eigen::Index k = 0; k < count; ++k) {
      const ContactPoint& point = points[static_cast<std::size_t>(k)];
      directions.row(k) = direction == 0 ? point.normal : direction == 1 ? point.tangent_1 : point.tangent_2;
    }
    const Eigen::MatrixXd part = model.space().rows(phi, directions);
    for (Eigen::Index k = 0; k < count; ++k) rows.row(3 * k + direction) = part.row(k);
  }
  return rows;
}

/// Norm of the longest row.
double largest_row(const Eigen::MatrixXd& rows) {
  return rows.size() > 0 ? std::sqrt(rows.rowwise().squaredNorm().maxCoeff()) : 0.0;
}

bool is_free(const ContactBody& body) {
  return !body.model->fixed() && body.model->space().free();
}

MeanDeformation mean_deformation(const ContactBody& body) {
  const std::shared_ptr<const BlockParts>& parts = body.model->parts();
  return {parts, body.state->position.transpose() * parts->mean_gradients};
}

}  // namespace

Eigen::MatrixX3d MeanDeformation::levers(const Eigen::VectorXd& change) const {
  const Eigen::MatrixX3d& gradients = parts->mean_gradients;
  const Eigen::Map<const Eigen::MatrixX3d> motion(change.data(), gradients.rows(), 3);
  const Eigen::Matrix3d middle = start + 0.5 * motion.transpose() * gradients;
  return gradients * middle.inverse();
}

PairRows::PairRows(const ContactBody& a, const ContactBody& b, const std::vector<ContactPoint>& points,
                   const Tie* tie)
    : rows_a_(contact_rows(*a.model, points, tie != nullptr ? tie->a : values_at(*a.model, points, true))),
      rows_b_(contact_rows(*b.model, points, tie != nullptr ? tie->b : values_at(*b.model, points, false))),
      longest_a_(largest_row(rows_a_)),
      longest_b_(largest_row(rows_b_)),
      count_(static_cast<Eigen::Index>(points.size())),
      tie_(tie),
      // The forces of a tie are along the gap, so that they have no couple worth the name.
      free_pair_(tie == nullptr && is_free(a) && is_free(b)) {
  if (!free_pair_) return;
  deformation_a_ = mean_deformation(a);
  deformation_b_ = mean_deformation(b);
  apart_.resize(3, count_);
  // Forces act where the material points are. Places of points whose feet are on flat sub-faces are not there.
  const PlacedBlock placed_a{a.model, &a.state->position};
  const PlacedBlock placed_b{b.model, &b.state->position};
  for (std::size_t k = 0; k < points.size(); ++k)
    apart_.col(static_cast<Eigen::Index>(k)) = in_frame(
        points[k], place_of(placed_a, points[k].material_a) - place_of(placed_b, points[k].material_b));
}

Eigen::Matrix3Xd PairRows::motion(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, count_);
  Eigen::Map<Eigen::VectorXd> flat(result.data(), result.size());
  if (rows_a_.cols() > 0) flat.noalias() += rows_a_ * ya;
  if (rows_b_.cols() > 0) flat.noalias() -= rows_b_ * yb;
  if (prescribed_.size() > 0) result += prescribed_;
  return result;
}

void PairRows::prescribe(const std::vector<ContactPoint>& points, const BlockModel& a,
                         const Eigen::MatrixX3d& change_a, const BlockModel& b,
                         const Eigen::MatrixX3d& change_b) {
  prescribed_.resize(3, 0);
  if (change_a.size() == 0 && change_b.size() == 0) return;
  prescribed_.setZero(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    Vector3 motion = Vector3::Zero();
    const auto row = static_cast<Eigen::Index>(k);
    const auto values = [&](const BlockModel& block, const Vector3& material, bool of_a) -> Eigen::VectorXd {
      if (tie_ != nullptr) return (of_a ? tie_->a : tie_->b).row(row).transpose();
      return block.basis().values(material);
    };
    if (change_a.size() > 0) motion += change_a.transpose() * values(a, points[k].material_a, true);
    if (change_b.size() > 0) motion -= change_b.transpose() * values(b, points[k].material_b, false);
    prescribed_.col(row) = in_frame(points[k], motion);
  }
}

double PairRows::prescribed_work(const PairResponse& response) const {
  double work = 0.0;
  for (Eigen::Index k = 0; k < prescribed_.cols(); ++k)
    work += prescribed_.col(k).dot(response.means[static_cast<std::size_t>(k)].force);
  return work;
}

void PairRows::act_at(const std::vector<ContactPoint>& acting, const BlockInStep& a, const BlockInStep& b,
                      std::vector<ContactPoint>& points) {
  rows_a_ = contact_rows(*a.model, acting, values_at(*a.model, acting, true));
  rows_b_ = contact_rows(*b.model, acting, values_at(*b.model, acting, false));
  longest_a_ = largest_row(rows_a_);
  longest_b_ = largest_row(rows_b_);
  prescribe(acting, *a.model, a.prescribed, *b.model, b.prescribed);
  for (std::size_t k = 0; k < acting.size(); ++k) {
    points[k].normal = acting[k].normal;
    points[k].tangent_1 = acting[k].tangent_1;
    points[k].tangent_2 = acting[k].tangent_2;
  }
}

void PairRows::follow(std::vector<ContactPoint>& points, const BlockInStep& a, const BlockInStep& b,
                      const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) {
  std::vector<ContactPoint> middle;
  middle.reserve(points.size());
  for (const ContactPoint& point : points)
    middle.push_back(moved_to(point, {a.model, &a.middle}, {b.model, &b.middle}));
  act_at(middle, a, b, points);
  const Eigen::Matrix3Xd way = motion(ya, yb);
  bent_.setZero(static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (free_pair_)
      apart_.col(column) = in_frame(middle[k], middle[k].place_a - middle[k].place_b) - 0.5 * way.col(column);
    if (points[k].source == NormalSource::as_found) continue;
    const ContactPoint end = moved_to(middle[k], {a.model, &a.end}, {b.model, &b.end});
    bent_[column] = end.gap - points[k].gap - way(0, column);
  }
}

void PairRows::go_to_end(std::vector<ContactPoint>& points, const BlockInStep& a, const BlockInStep& b) {
  std::vector<ContactPoint> end;
  end.reserve(points.size());
  for (const ContactPoint& point : points)
    end.push_back(moved_to(point, {a.model, &a.end}, {b.model, &b.end}));
  act_at(end, a, b, points);
}

void PairRows::set_forces(const Eigen::VectorXd& forces, PairResponse& response) const {
  if (rows_a_.cols() > 0) response.force_on_a = rows_a_.transpose() * forces;
  if (rows_b_.cols() > 0) response.force_on_b = -(rows_b_.transpose() * forces);
}

void PairRows::set_shifts(const std::vector<ContactPoint>& points, const Eigen::VectorXd& ya,
                          const Eigen::VectorXd& yb, const Eigen::VectorXd& forces,
                          PairResponse& response) const {
  if (!free_pair_) return;
  const Eigen::Matrix3Xd apart = apart_ + 0.5 * motion(ya, yb);
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();  // r f'
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const ContactPoint& point = points[k];
    const Vector3 force = forces.segment<3>(3 * column);
    const Vector3 r = apart.col(column);
    const Vector3 along = out_of_frame(point, {0.0, force[1], force[2]});
    moment += force[0] * out_of_frame(point, {0.0, r[1], r[2]}) * point.normal.transpose() +
              out_of_frame(point, r) * along.transpose();
  }
  response.shift_on_a = (-0.5 * deformation_a_.levers(ya) * moment).reshaped();
  response.shift_on_b = (-0.5 * deformation_b_.levers(yb) * moment).reshaped();
}

PairTangent PairRows::tangent(const PairResponse& response) const {
  std::vector<Eigen::Index> active;
  for (std::size_t k = 0; k < response.means.size(); ++k) {
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
  PairTangent tangent;
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

void PairRows::add_coupling(const Eigen::Matrix2Xd& couplings, const Eigen::VectorXd& da,
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

double PairRows::mobility(Eigen::Index first, Eigen::Index count, double inertia_a, double inertia_b) const {
  const auto part = [&](const Eigen::MatrixXd& rows, double inertia) {
    return rows.cols() > 0 ? rows.middleRows(first, count).squaredNorm() / inertia : 0.0;
  };
  return (part(rows_a_, inertia_a) + part(rows_b_, inertia_b)) / static_cast<double>(count);
}

}  // namespace ashlar
