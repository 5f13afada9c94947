#include "solver/contact/contact_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Coefficients of the gap of two tied blocks. @return (r, 3)
Eigen::MatrixX3d tie_gap(const Tie& tie, const BlockState& a, const BlockState& b) {
  return tie.a * a.position - tie.b * b.position;
}

std::vector<ContactPoint> tie_points(const Eigen::MatrixX3d& gap) {
  std::vector<ContactPoint> points(static_cast<std::size_t>(gap.rows()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    ContactPoint& point = points[k];
    point.type = ContactPointType::face_face;
    point.normal = Vector3::UnitX();
    point.tangent_1 = Vector3::UnitY();
    point.tangent_2 = Vector3::UnitZ();
    point.place_a = gap.row(static_cast<Eigen::Index>(k));
    point.place_b.setZero();
    point.gap = point.place_a.x();
    point.area = 1.0;
  }
  return points;
}

std::vector<PointMemory> tie_memory(const Eigen::MatrixX3d& gap) {
  std::vector<PointMemory> memory(static_cast<std::size_t>(gap.rows()));
  for (std::size_t k = 0; k < memory.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    memory[k].slip = {0.0, gap(row, 1), gap(row, 2)};
    memory[k].state = ContactState::locked;
    memory[k].intact = true;
  }
  return memory;
}

/// Springs in all directions that nothing breaks.
JointLaw tie_law(double stiffness) {
  JointLaw law;
  law.normal_stiffness = law.shear_stiffness = stiffness;
  // Far from any force, and its differences are numbers.
  law.cohesion = 1e100;
  law.tensile_strength = std::numeric_limits<double>::infinity();
  return law;
}

bool is_free(const ContactBody& body) {
  return !body.model->fixed() && body.model->space().free();
}

MeanDeformation mean_deformation(const ContactBody& body) {
  const std::shared_ptr<const BlockParts>& parts = body.model->parts();
  return {parts, body.state->position.transpose() * parts->mean_gradients};
}

}  // namespace

ContactPair::ContactPair(int a, int b, const ContactBody& body_a, const ContactBody& body_b,
                         const JointLaw& law, const std::vector<ContactPoint>& points,
                         std::vector<PointMemory> memory, std::vector<PressureCut> cuts)
    : ContactPair(a, b, body_a, body_b, law, points, std::move(memory),
                  values_at(*body_a.model, points, true), values_at(*body_b.model, points, false), nullptr) {
  cuts_ = std::move(cuts);
}

ContactPair::ContactPair(int a, int b, const ContactBody& body_a, const ContactBody& body_b, const Tie& tie,
                         double stiffness)
    : ContactPair(a, b, body_a, body_b, tie_law(stiffness),
                  tie_points(tie_gap(tie, *body_a.state, *body_b.state)),
                  tie_memory(tie_gap(tie, *body_a.state, *body_b.state)), tie.a, tie.b, &tie) {}

ContactPair::ContactPair(int a, int b, const ContactBody& body_a, const ContactBody& body_b,
                         const JointLaw& law, std::vector<ContactPoint> points,
                         std::vector<PointMemory> memory, const Eigen::MatrixXd& phi_a,
                         const Eigen::MatrixXd& phi_b, const Tie* tie)
    : a_(a),
      b_(b),
      points_(std::move(points)),
      memory_(std::move(memory)),
      rests_(points_.size(), 0.0),
      start_(3, static_cast<Eigen::Index>(points_.size())),
      rows_a_(contact_rows(*body_a.model, points_, phi_a)),
      rows_b_(contact_rows(*body_b.model, points_, phi_b)),
      tie_(tie),
      rigid_(law.rigid || law.augmented || tie != nullptr),
      area_springs_(law.area_springs),
      // The forces of a tie are along the gap, so that they have no couple worth the name.
      free_pair_(tie == nullptr && is_free(body_a) && is_free(body_b)) {
  if (free_pair_) {
    deformation_a_ = mean_deformation(body_a);
    deformation_b_ = mean_deformation(body_b);
    apart_.resize(3, start_.cols());
    for (std::size_t k = 0; k < points_.size(); ++k)
      apart_.col(static_cast<Eigen::Index>(k)) =
          in_frame(points_[k], points_[k].place_a - points_[k].place_b);
  }
  for (std::size_t k = 0; k < points_.size(); ++k) {
    laws_.push_back(point_law(law, points_[k].area, memory_[k].intact));
    if (law.augmented) {
      const double scale = multiplier_scale(points_[k]);
      const Vector3 shear = scale * memory_[k].shear_multiplier;
      laws_[k].augmented = true;
      laws_[k].normal_multiplier = scale * memory_[k].normal_multiplier;
      laws_[k].shear_multiplier = {points_[k].tangent_1.dot(shear), points_[k].tangent_2.dot(shear)};
    }
    start_.col(static_cast<Eigen::Index>(k)) << points_[k].gap, points_[k].tangent_1.dot(memory_[k].slip),
        points_[k].tangent_2.dot(memory_[k].slip);
  }
  respond_at_start();
}

void ContactPair::respond_at_start() {
  start_responses_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto start = start_.col(static_cast<Eigen::Index>(k));
    start_responses_.push_back(point_response(laws_[k], start[0], start.tail<2>()));
  }
}

bool ContactPair::can_be_bounded() const {
  return !tied() && std::none_of(laws_.begin(), laws_.end(),
                                 [](const PointLaw& law) { return law.augmented || law.tension > 0.0; });
}

void ContactPair::rest_at(std::vector<double> rests) {
  rests_ = std::move(rests);
  for (std::size_t k = 0; k < points_.size(); ++k)
    start_(0, static_cast<Eigen::Index>(k)) = points_[k].gap - rests_[k];
  respond_at_start();
}

void ContactPair::hold_where_found(double taken) {
  taken_ = taken;
  std::vector<double> rests;
  for (std::size_t k = 0; k < points_.size(); ++k)
    rests.push_back(laws_[k].tension > 0.0 ? points_[k].gap : std::min(0.0, points_[k].gap));
  rest_at(std::move(rests));
}

void ContactPair::count_slip(const std::vector<Vector3>& moved) {
  counts_slip_ = true;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto along = [&](const Vector3& vector) {
      return Eigen::Vector2d(points_[k].tangent_1.dot(vector), points_[k].tangent_2.dot(vector));
    };
    PointMemory& memory = memory_[k];
    if (!memory.in_level) memory.level_slip = -flat(k, along(moved[k]));
    start_.col(static_cast<Eigen::Index>(k)).tail<2>() = along(memory.level_slip + moved[k]);
  }
  respond_at_start();
}

Vector3 ContactPair::flat(std::size_t k, const Eigen::Vector2d& along) const {
  return along[0] * points_[k].tangent_1 + along[1] * points_[k].tangent_2;
}

Eigen::Vector2d ContactPair::slid_before(std::size_t k) const {
  const Eigen::Vector2d slip = start_.col(static_cast<Eigen::Index>(k)).tail<2>();
  return counts_slip_ ? Eigen::Vector2d(slip - elastic_slip(laws_[k], start_responses_[k], slip))
                      : Eigen::Vector2d::Zero();
}

bool ContactPair::bonded() const {
  return !tied() && std::any_of(laws_.begin(), laws_.end(),
                                [](const PointLaw& law) { return law.cohesion > 0.0 || law.tension > 0.0; });
}

void ContactPair::hold_bonds() {
  holds_bonds_ = true;
  const JointLaw bond = tie_law(1.0);
  for (PointLaw& law : laws_) {
    if (tied() || (law.cohesion == 0.0 && law.tension == 0.0)) continue;
    law.cohesion = bond.cohesion;
    if (law.tension > 0.0) law.tension = bond.tensile_strength;
  }
  respond_at_start();
}

double ContactPair::depth_found() const {
  double depth = 0.0;
  for (std::size_t k = 0; !tied() && k < points_.size(); ++k) {
    if (laws_[k].tension == 0.0) depth = std::max(depth, -points_[k].gap);
  }
  return depth;
}

ContactPair ContactPair::moved_apart(double depth) const {
  ContactPair pair = *this;
  pair.start_.setZero();
  pair.prescribed_.resize(3, 0);
  const JointLaw bond = tie_law(1.0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    PointLaw& law = pair.laws_[k];
    const bool bonded = tied() || law.tension > 0.0;
    law = {law.normal_stiffness, bonded ? law.shear_stiffness : 0.0, 0.0, bonded ? bond.cohesion : 0.0,
           bonded ? bond.tensile_strength : 0.0};
    law.augmented = !tied();
    if (bonded) continue;
    pair.rests_[k] = -depth;
    pair.start_(0, static_cast<Eigen::Index>(k)) = points_[k].gap + depth;
  }
  pair.respond_at_start();
  return pair;
}

void ContactPair::hold_at_most(const SpringEnergy& held) {
  if (!can_be_bounded()) return;
  std::vector<double> stiffnesses, gaps, remembered;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    stiffnesses.push_back(laws_[k].normal_stiffness);
    gaps.push_back(points_[k].gap);
    remembered.push_back(std::min(0.0, points_[k].gap + memory_[k].compression));
  }
  rest_at(rest_gaps(stiffnesses, gaps, remembered, held.normal));
  // What friction does not bear is cut off in any case: where that is what makes the energies equal, their
  // rounding must not choose.
  double shear = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    auto slip = start_.col(static_cast<Eigen::Index>(k)).tail<2>();
    slip = borne_slip(laws_[k], start_responses_[k].force[0], slip);
    shear += 0.5 * laws_[k].shear_stiffness * slip.squaredNorm();
  }
  if (shear > held.shear) start_.bottomRows<2>() *= std::sqrt(held.shear / shear);
  respond_at_start();
  // Also of points that are open to rounding only.
  for (std::size_t k = 0; k < points_.size(); ++k)
    start_responses_[k].shear_energy =
        0.5 * laws_[k].shear_stiffness * start_.col(static_cast<Eigen::Index>(k)).tail<2>().squaredNorm();
}

Eigen::Matrix3Xd ContactPair::motion(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, start_.cols());
  Eigen::Map<Eigen::VectorXd> flat(result.data(), result.size());
  if (rows_a_.cols() > 0) flat.noalias() += rows_a_ * ya;
  if (rows_b_.cols() > 0) flat.noalias() -= rows_b_ * yb;
  if (prescribed_.size() > 0) result += prescribed_;
  return result;
}

Eigen::Matrix3Xd ContactPair::relative(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  Eigen::Matrix3Xd result = start_ + motion(ya, yb);
  if (bent_.size() > 0) result.row(0) += bent_;
  return result;
}

void ContactPair::prescribe(const BlockModel& a, const Eigen::MatrixX3d& change_a, const BlockModel& b,
                            const Eigen::MatrixX3d& change_b) {
  set_prescribed(points_, a, change_a, b, change_b);
}

void ContactPair::set_prescribed(const std::vector<ContactPoint>& acting, const BlockModel& a,
                                 const Eigen::MatrixX3d& change_a, const BlockModel& b,
                                 const Eigen::MatrixX3d& change_b) {
  prescribed_.resize(3, 0);
  if (change_a.size() == 0 && change_b.size() == 0) return;
  prescribed_.setZero(3, start_.cols());
  for (std::size_t k = 0; k < acting.size(); ++k) {
    Vector3 motion = Vector3::Zero();
    const auto row = static_cast<Eigen::Index>(k);
    const auto values = [&](const BlockModel& block, const Vector3& material, bool of_a) -> Eigen::VectorXd {
      if (tied()) return (of_a ? tie_->a : tie_->b).row(row).transpose();
      return block.basis().values(material);
    };
    if (change_a.size() > 0) motion += change_a.transpose() * values(a, acting[k].material_a, true);
    if (change_b.size() > 0) motion -= change_b.transpose() * values(b, acting[k].material_b, false);
    prescribed_.col(row) = in_frame(acting[k], motion);
  }
}

void ContactPair::act_at(const std::vector<ContactPoint>& acting, const BlockInStep& a,
                         const BlockInStep& b) {
  rows_a_ = contact_rows(*a.model, acting, values_at(*a.model, acting, true));
  rows_b_ = contact_rows(*b.model, acting, values_at(*b.model, acting, false));
  set_prescribed(acting, *a.model, a.prescribed, *b.model, b.prescribed);
  for (std::size_t k = 0; k < acting.size(); ++k) {
    points_[k].normal = acting[k].normal;
    points_[k].tangent_1 = acting[k].tangent_1;
    points_[k].tangent_2 = acting[k].tangent_2;
  }
}

void ContactPair::follow(const BlockInStep& a, const BlockInStep& b, const Eigen::VectorXd& ya,
                         const Eigen::VectorXd& yb) {
  std::vector<ContactPoint> middle;
  middle.reserve(points_.size());
  for (const ContactPoint& point : points_)
    middle.push_back(moved_to(point, {a.model, &a.middle}, {b.model, &b.middle}));
  act_at(middle, a, b);
  const Eigen::Matrix3Xd way = motion(ya, yb);
  bent_.setZero(static_cast<Eigen::Index>(points_.size()));
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (free_pair_)
      apart_.col(column) = in_frame(middle[k], middle[k].place_a - middle[k].place_b) - 0.5 * way.col(column);
    if (points_[k].source == NormalSource::as_found) continue;
    const ContactPoint end = moved_to(middle[k], {a.model, &a.end}, {b.model, &b.end});
    bent_[column] = end.gap - points_[k].gap - way(0, column);
  }
}

ContactPair ContactPair::at_end(const BlockInStep& a, const BlockInStep& b) const {
  ContactPair pair = *this;
  std::vector<ContactPoint> end;
  end.reserve(points_.size());
  for (const ContactPoint& point : points_)
    end.push_back(moved_to(point, {a.model, &a.end}, {b.model, &b.end}));
  pair.act_at(end, a, b);
  return pair;
}

}  // namespace ashlar
