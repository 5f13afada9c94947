#include "solver/contact/pair_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Rows of a block at the points. @param phi values of its functions there
BlockRows rows_of(const BlockModel& model, const Eigen::MatrixXd& phi) {
  return model.fixed() ? BlockRows() : BlockRows(model.space(), phi);
}

/// Normal and tangents of each point, as columns. @return (3, 3 #points)
Eigen::Matrix3Xd frames_of(const std::vector<ContactPoint>& points) {
  Eigen::Matrix3Xd frames(3, 3 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    frames.middleCols<3>(3 * static_cast<Eigen::Index>(k)) << points[k].normal, points[k].tangent_1,
        points[k].tangent_2;
  }
  return frames;
}

/// Norm of the longest row of a block. @param frames (3, 3 #points)
double longest_row(const BlockRows& rows, const Eigen::Matrix3Xd& frames) {
  double longest = 0.0;
  for (Eigen::Index column = 0; column < frames.cols(); ++column)
    longest = std::max(longest, rows.squared_row(column / 3, frames.col(column)));
  return std::sqrt(longest);
}

std::shared_ptr<const PairRows::Values> completed(PairRows::Values values, const Eigen::Matrix3Xd& frames) {
  values.longest_a = longest_row(values.a, frames);
  values.longest_b = longest_row(values.b, frames);
  return std::make_shared<const PairRows::Values>(std::move(values));
}

bool is_free(const ContactBody& body) {
  return !body.model->fixed() && body.model->space().free();
}

MeanDeformation mean_deformation(const ContactBody& body) {
  const std::shared_ptr<const BlockParts>& parts = body.model->parts();
  return {parts, body.state->position.transpose() * parts->mean_gradients};
}

}  // namespace

std::vector<PointDerivative> derivatives_of(const PairResponse& response) {
  std::vector<PointDerivative> derivatives;
  for (const MeanResponse& mean : response.means) derivatives.push_back({mean.tangent, mean.coupling});
  return derivatives;
}

void MeanDeformation::lever(const Eigen::VectorXd& change, const Eigen::Matrix3d& m,
                            Eigen::VectorXd& result) const {
  const Eigen::MatrixX3d& gradients = parts->mean_gradients;
  const Eigen::Map<const Eigen::MatrixX3d> motion(change.data(), gradients.rows(), 3);
  const Eigen::Matrix3d middle = start + 0.5 * motion.transpose().lazyProduct(gradients);
  const Eigen::Matrix3d inverse = middle.inverse();
  result.resize(gradients.size());
  Eigen::Map<Eigen::MatrixX3d> product(result.data(), gradients.rows(), 3);
  for (Eigen::Index row = 0; row < gradients.rows(); ++row) {
    const Eigen::RowVector3d lever = gradients.row(row) * inverse;
    product.row(row) = lever * m;
  }
}

std::shared_ptr<const PairRows::Values> PairRows::values_of(const BlockModel& a, const BlockModel& b,
                                                            const std::vector<ContactPoint>& points) {
  return completed({rows_of(a, values_at(a, points, true)), rows_of(b, values_at(b, points, false))},
                   frames_of(points));
}

PairRows::PairRows(const ContactBody& a, const ContactBody& b, const std::vector<ContactPoint>& points,
                   std::shared_ptr<const Tie> tie)
    : PairRows(a, b, points,
               tie == nullptr
                   ? values_of(*a.model, *b.model, points)
                   : completed({rows_of(*a.model, tie->a), rows_of(*b.model, tie->b)}, frames_of(points)),
               tie) {}

PairRows::PairRows(const ContactBody& a, const ContactBody& b, const std::vector<ContactPoint>& points,
                   std::shared_ptr<const Values> values)
    : PairRows(a, b, points, std::move(values), nullptr) {}

PairRows::PairRows(const ContactBody& a, const ContactBody& b, const std::vector<ContactPoint>& points,
                   std::shared_ptr<const Values> values, std::shared_ptr<const Tie> tie)
    : values_(std::move(values)),
      frames_(frames_of(points)),
      count_(static_cast<Eigen::Index>(points.size())),
      tie_(std::move(tie)),
      // Forces of a tie are along the gap, so that their couple is negligible.
      free_pair_(tie_ == nullptr && is_free(a) && is_free(b)) {
  if (!free_pair_) return;
  deformation_a_ = mean_deformation(a);
  deformation_b_ = mean_deformation(b);
  // Forces act at the material points. Places of points whose feet are on flat sub-faces differ from these.
  apart_ = values_->a.displacements(a.state->position) - values_->b.displacements(b.state->position);
  for (Eigen::Index k = 0; k < count_; ++k)
    apart_.col(k) = in_frame(points[static_cast<std::size_t>(k)], apart_.col(k));
}

Eigen::Matrix3Xd PairRows::free_motion(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, count_);
  values_->a.add_motion(ya, 1.0, result);
  values_->b.add_motion(yb, -1.0, result);
  for (Eigen::Index k = 0; k < count_; ++k) result.col(k) = (frame(k).transpose() * result.col(k)).eval();
  return result;
}

Eigen::Matrix3Xd PairRows::motion(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  Eigen::Matrix3Xd result = free_motion(ya, yb);
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
  values_ = values_of(*a.model, *b.model, acting);
  frames_ = frames_of(acting);
  prescribe(acting, *a.model, a.prescribed, *b.model, b.prescribed);
  for (std::size_t k = 0; k < acting.size(); ++k) {
    points[k].normal = acting[k].normal;
    points[k].tangent_1 = acting[k].tangent_1;
    points[k].tangent_2 = acting[k].tangent_2;
  }
}

void PairRows::follow(std::vector<ContactPoint>& points, const BlockInStep& a, const BlockInStep& b,
                      const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) {
  const std::vector<ContactPoint> middle =
      moved_to(points, PlacedBlock(*a.model, a.middle), PlacedBlock(*b.model, b.middle));
  const std::vector<ContactPoint> end =
      moved_to(middle, PlacedBlock(*a.model, a.end), PlacedBlock(*b.model, b.end));
  act_at(middle, a, b, points);
  const Eigen::Matrix3Xd displacement = motion(ya, yb);
  bent_.setZero(static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (free_pair_)
      apart_.col(column) =
          in_frame(middle[k], middle[k].place_a - middle[k].place_b) - 0.5 * displacement.col(column);
    if (points[k].source == NormalSource::as_found) continue;
    bent_[column] = end[k].gap - points[k].gap - displacement(0, column);
  }
}

void PairRows::go_to_end(std::vector<ContactPoint>& points, const BlockInStep& a, const BlockInStep& b) {
  act_at(moved_to(points, PlacedBlock(*a.model, a.end), PlacedBlock(*b.model, b.end)), a, b, points);
}

Eigen::Matrix3Xd PairRows::along_axes(const Eigen::VectorXd& forces) const {
  Eigen::Matrix3Xd result(3, count_);
  for (Eigen::Index k = 0; k < count_; ++k) result.col(k).noalias() = frame(k) * forces.segment<3>(3 * k);
  return result;
}

void PairRows::set_forces(const Eigen::VectorXd& forces, PairResponse& response) const {
  const Eigen::Matrix3Xd acting = along_axes(forces);
  const auto set = [&acting](const BlockRows& rows, double sign, Eigen::VectorXd& force) {
    force.setZero(rows.unknowns());
    if (!rows.fixed()) rows.add_force(acting, sign, force);
  };
  set(values_->a, 1.0, response.force_on_a);
  set(values_->b, -1.0, response.force_on_b);
}

void PairRows::set_shifts(const Eigen::Matrix3Xd& motion, const Eigen::VectorXd& ya,
                          const Eigen::VectorXd& yb, const Eigen::VectorXd& forces,
                          PairResponse& response) const {
  if (!free_pair_) return;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();  // r f', less that of normal forces along the normal
  for (Eigen::Index k = 0; k < count_; ++k) {
    Vector3 along = forces.segment<3>(3 * k);
    if (along.isZero(0.0)) continue;
    Vector3 r = apart_.col(k) + 0.5 * motion.col(k);
    const Vector3 across(0.0, r[1], r[2]);
    const double push = std::exchange(along[0], 0.0);
    moment += push * (frame(k) * across) * frame(k).col(0).transpose() +
              (frame(k) * r) * (frame(k) * along).transpose();
  }
  const Eigen::Matrix3d half = -0.5 * moment;
  deformation_a_.lever(ya, half, response.shift_on_a);
  deformation_b_.lever(yb, half, response.shift_on_b);
}

PointStiffnesses PairRows::stiffnesses(std::span<const PointDerivative> derivatives) const {
  PointStiffnesses result(9, count_);
  for (Eigen::Index k = 0; k < count_; ++k) {
    const Eigen::Matrix3d& tangent = derivatives[static_cast<std::size_t>(k)].tangent;
    const Eigen::Matrix3d along_axes = frame(k) * tangent * frame(k).transpose();
    result.col(k) = along_axes.reshaped();
  }
  return result;
}

PointStiffnesses PairRows::couplings(std::span<const PointDerivative> derivatives) const {
  const auto coupled = [](const PointDerivative& point) { return !point.coupling.force.isZero(0.0); };
  if (std::none_of(derivatives.begin(), derivatives.end(), coupled)) return {};
  PointStiffnesses result(9, count_);
  for (Eigen::Index k = 0; k < count_; ++k) {
    const Coupling& coupling = derivatives[static_cast<std::size_t>(k)].coupling;
    const Eigen::Matrix3d along_axes = frame(k) * coupling.force * (frame(k) * coupling.by).transpose();
    result.col(k) = along_axes.reshaped();
  }
  return result;
}

void PairRows::add_product(const PointStiffnesses& stiffnesses, const Eigen::VectorXd& da,
                           const Eigen::VectorXd& db, Eigen::VectorXd& on_a, Eigen::VectorXd& on_b) const {
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, count_);
  if (da.size() > 0) values_->a.add_motion(da, 1.0, moved);
  if (db.size() > 0) values_->b.add_motion(db, -1.0, moved);
  for (Eigen::Index k = 0; k < count_; ++k) {
    const Vector3 force = Eigen::Map<const Eigen::Matrix3d>(stiffnesses.col(k).data()) * moved.col(k);
    moved.col(k) = force;
  }
  if (on_a.size() > 0) values_->a.add_force(moved, 1.0, on_a);
  if (on_b.size() > 0) values_->b.add_force(moved, -1.0, on_b);
}

PairTangent PairRows::tangent(std::span<const PointDerivative> derivatives) const {
  std::vector<Eigen::Index> active;
  for (std::size_t k = 0; k < derivatives.size(); ++k) {
    if (!derivatives[k].tangent.isZero(0.0)) active.push_back(static_cast<Eigen::Index>(k));
  }
  const PointStiffnesses stiffnesses = this->stiffnesses(derivatives)(Eigen::all, active);
  const bool all = static_cast<Eigen::Index>(active.size()) == count_;
  const BlockRows some_a = all || values_->a.fixed() ? BlockRows() : values_->a.at_points(active);
  const BlockRows some_b = all || values_->b.fixed() ? BlockRows() : values_->b.at_points(active);
  const BlockRows& of_a = all ? values_->a : some_a;
  const BlockRows& of_b = all ? values_->b : some_b;
  PairTangent tangent;
  if (!values_->a.fixed()) tangent.aa = of_a.tangent(stiffnesses, of_a);
  if (!values_->b.fixed()) tangent.bb = of_b.tangent(stiffnesses, of_b);
  if (!values_->a.fixed() && !values_->b.fixed()) tangent.ab = -of_a.tangent(stiffnesses, of_b);
  return tangent;
}

double PairRows::mobility(Eigen::Index first, Eigen::Index count, double inertia_a, double inertia_b) const {
  double sum = 0.0;
  for (Eigen::Index row = first; row < first + count; ++row) {
    const Vector3 direction = frames_.col(row);
    if (!values_->a.fixed()) sum += values_->a.squared_row(row / 3, direction) / inertia_a;
    if (!values_->b.fixed()) sum += values_->b.squared_row(row / 3, direction) / inertia_b;
  }
  return sum / static_cast<double>(count);
}

}  // namespace ashlar
