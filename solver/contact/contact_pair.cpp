#include "solver/contact/contact_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/contact/tied_points.hpp"

namespace ashlar {
namespace {

/// Reduced mass of two blocks, kg; fixed blocks have infinite mass.
double reduced_mass(const BlockModel& a, const BlockModel& b) {
  const auto mobility = [](const BlockModel& block) {
    return block.fixed() ? 0.0 : 1.0 / (block.material().density * block.basis().volume());
  };
  const double sum = mobility(a) + mobility(b);
  return sum > 0.0 ? 1.0 / sum : 0.0;
}

}  // namespace

ContactPair::ContactPair(const PairBodies& bodies, const JointLaw& law, ContactPatch patch,
                         std::vector<PointMemory> memory, const PatchStart& start)
    : ContactPair(bodies, law, patch.points, std::move(memory),
                  patch.rows == nullptr ? PairRows(bodies.of_a, bodies.of_b, patch.points)
                                        : PairRows(bodies.of_a, bodies.of_b, patch.points, patch.rows),
                  false) {
  cuts_ = std::move(patch.cuts);
  turning_ = std::move(patch.turning);
  cache_ = std::move(patch.cache);
  kind_.continues = start.continues;
  if (start.continues && !law.has_multipliers()) continue_springs();
  if (start.touch_within > 0.0) touch_within(start.touch_within);
  if (start.frozen) freeze_at_gap(*start.frozen);
  if (!start.moved_in_level.empty()) count_slip(start.moved_in_level);
  if (start.freezes_failure) freeze_failure();
}

ContactPair::ContactPair(const PairBodies& bodies, const std::shared_ptr<const Tie>& tie, double stiffness)
    : ContactPair(bodies, unbreakable_law(stiffness),
                  tie_points(tie_gap(*tie, *bodies.of_a.state, *bodies.of_b.state)),
                  tie_memory(tie_gap(*tie, *bodies.of_a.state, *bodies.of_b.state)), tie) {}

void ContactPair::continue_springs() {
  std::vector<double> rests;
  for (std::size_t k = 0; k < points_.size(); ++k) rests.push_back(points_[k].gap + memory_[k].compression);
  rests_ = std::move(rests);
  // Not the gap less the rest gap: rounding must not change the energy of springs.
  for (std::size_t k = 0; k < points_.size(); ++k)
    start_(0, static_cast<Eigen::Index>(k)) = -memory_[k].compression;
  respond_at_start();
}

ContactPair::ContactPair(const PairBodies& bodies, const JointLaw& law,
                         const std::vector<ContactPoint>& points, std::vector<PointMemory> memory,
                         const std::shared_ptr<const Tie>& tie)
    : ContactPair(bodies, law, points, std::move(memory), PairRows(bodies.of_a, bodies.of_b, points, tie),
                  tie != nullptr) {}

ContactPair::ContactPair(const PairBodies& bodies, const JointLaw& law, std::vector<ContactPoint> points,
                         std::vector<PointMemory> memory, PairRows rows, bool tied)
    : a_(bodies.a),
      b_(bodies.b),
      points_(std::move(points)),
      memory_(std::move(memory)),
      rests_(points_.size(), 0.0),
      reduced_mass_(reduced_mass(*bodies.of_a.model, *bodies.of_b.model)),
      kind_{tied, law.rigid || law.has_multipliers() || tied, law.area_springs, law.dilation,
            law.has_multipliers() ? 0.0 : law.damping},
      start_(3, static_cast<Eigen::Index>(points_.size())),
      rows_(std::move(rows)) {
  kind_.restitution = law.restitution;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    laws_.push_back(point_law(law, points_[k].area, memory_[k].intact, memory_[k].damage));
    if (law.has_multipliers()) {
      const double scale = multiplier_scale(points_[k]);
      const Vector3 shear = scale * memory_[k].shear_multiplier;
      laws_[k].augmented = true;
      laws_[k].normal_multiplier = scale * memory_[k].normal_multiplier;
      laws_[k].shear_multiplier = {points_[k].tangent_1.dot(shear), points_[k].tangent_2.dot(shear)};
    }
    rests_[k] = dilation_before(k);
    start_.col(static_cast<Eigen::Index>(k)) << points_[k].gap - rests_[k],
        points_[k].tangent_1.dot(memory_[k].slip), points_[k].tangent_2.dot(memory_[k].slip);
  }
  respond_at_start();
}

void ContactPair::respond_at_start() {
  start_responses_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto start = start_.col(static_cast<Eigen::Index>(k));
    laws_[k].dilation = {kind_.counts_slip ? kind_.dilation : 0.0};
    start_responses_.push_back(point_response(laws_[k], start[0], start.tail<2>()));
    const bool open = start_responses_.back().state == ContactState::open;
    const bool lands = open && !(kind_.counts_slip && memory_[k].in_level);
    laws_[k].dilation = {kind_.dilation, lands ? start[0] : 0.0};
  }
}

void ContactPair::rest_at(std::vector<double> rests) {
  rests_ = std::move(rests);
  for (std::size_t k = 0; k < points_.size(); ++k)
    start_(0, static_cast<Eigen::Index>(k)) = points_[k].gap - rests_[k];
  respond_at_start();
}

void ContactPair::touch_within(double depth) {
  std::vector<double> rests = rests_;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const double gap = start_(0, static_cast<Eigen::Index>(k));
    if (laws_[k].tension == 0.0 && gap < 0.0 && gap >= -depth) rests[k] = points_[k].gap;
  }
  rest_at(std::move(rests));
}

void ContactPair::freeze_at_gap(double spent) {
  spent_ = spent;
  std::vector<double> rests;
  for (std::size_t k = 0; k < points_.size(); ++k)
    rests.push_back(laws_[k].tension > 0.0 ? points_[k].gap : std::min(dilation_before(k), points_[k].gap));
  rest_at(std::move(rests));
}

void ContactPair::count_slip(const std::vector<Vector3>& moved) {
  kind_.counts_slip = true;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto along = [&](const Vector3& vector) {
      return Eigen::Vector2d(points_[k].tangent_1.dot(vector), points_[k].tangent_2.dot(vector));
    };
    PointMemory& memory = memory_[k];
    if (!memory.in_level) memory.level_slip = -flat(k, along(moved[k]));
    rests_[k] = memory.level_dilation;
    laws_[k].set_damage(memory.level_damage);
    laws_[k].is_static = true;
    start_(0, static_cast<Eigen::Index>(k)) = points_[k].gap - rests_[k];
    start_.col(static_cast<Eigen::Index>(k)).tail<2>() = along(memory.level_slip + moved[k]);
  }
  respond_at_start();
}

Vector3 ContactPair::flat(std::size_t k, const Eigen::Vector2d& along) const {
  return along[0] * points_[k].tangent_1 + along[1] * points_[k].tangent_2;
}

Eigen::Vector2d ContactPair::slid_before(std::size_t k) const {
  const Eigen::Vector2d slip = start_.col(static_cast<Eigen::Index>(k)).tail<2>();
  return kind_.counts_slip ? Eigen::Vector2d(slip - elastic_slip(laws_[k], start_responses_[k], slip))
                           : Eigen::Vector2d::Zero();
}

double ContactPair::depth_found() const {
  double depth = 0.0;
  for (std::size_t k = 0; !tied() && k < points_.size(); ++k) {
    if (laws_[k].tension == 0.0) depth = std::max(depth, std::min(0.0, dilation_before(k)) - points_[k].gap);
  }
  return depth;
}

double ContactPair::depth_of_multipliers() const {
  return !laws_.empty() && laws_.front().augmented ? depth_found() : 0.0;
}

ContactPair ContactPair::projected(double depth) const {
  ContactPair pair = *this;
  pair.start_.setZero();
  pair.rows_.prescribe_nothing();
  pair.kind_.dilation = 0.0;
  const JointLaw bond = unbreakable_law(1.0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    PointLaw& law = pair.laws_[k];
    const bool bonded = tied() || law.tension > 0.0;
    const bool is_spring = !law.augmented;
    law = {law.normal_stiffness, bonded ? law.shear_stiffness : 0.0, 0.0, bonded ? bond.cohesion : 0.0,
           bonded ? bond.tensile_strength : 0.0};
    law.augmented = !tied();
    if (bonded) continue;
    // After dilation, or closure, the surface is at the height where the point touches. Springs stay compressed.
    const double rest = dilation_before(k);
    const double gap = points_[k].gap;
    const double lowest = std::min(0.0, is_spring ? std::min(rest, gap) : rest);
    const double surface = std::clamp(gap, lowest, std::max(0.0, rest));
    pair.rests_[k] = surface - depth;
    pair.start_(0, static_cast<Eigen::Index>(k)) = gap - surface + depth;
  }
  pair.respond_at_start();
  return pair;
}

Eigen::Matrix3Xd ContactPair::after(const Eigen::Matrix3Xd& moved) const {
  Eigen::Matrix3Xd result = start_ + moved;
  if (rows_.bent().size() > 0) result.row(0) += rows_.bent();
  return result;
}

void ContactPair::begin_step(const BlockModel& a, const BlockModel& b, const StepActions& actions) {
  rows_.prescribe(points_, a, actions.prescribed_a, b, actions.prescribed_b);
  if (!(actions.step > 0.0)) return;
  if (actions.defers_friction && !tied()) apply_deferred_friction(actions.step);
  damp(actions.step);
}

void ContactPair::follow(const BlockInStep& a, const BlockInStep& b, const Eigen::VectorXd& ya,
                         const Eigen::VectorXd& yb) {
  rows_.follow(points_, a, b, ya, yb);
}

ContactPair ContactPair::at_end(const BlockInStep& a, const BlockInStep& b) const {
  ContactPair pair = *this;
  pair.rows_.go_to_end(pair.points_, a, b);
  return pair;
}

double ContactPair::force_rounding(double stiffness, double change_a, double change_b) const {
  const double row_a = rows_.longest_of_a();
  const double row_b = rows_.longest_of_b();
  return 2.0 * std::numeric_limits<double>::epsilon() * stiffness *
         (row_a * row_a * change_a + row_b * row_b * change_b);
}

double ContactPair::force_in_doubt(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                   const std::vector<PointLaw>& laws, const PairResponse& response) const {
  const auto within_rounding = [](const PointResponse& point) {
    return point.force[0] == 0.0 && point.tangent(0, 0) > 0.0;
  };
  if (std::none_of(response.points.begin(), response.points.end(), within_rounding)) return 0.0;
  const Eigen::Matrix3Xd place = places(ya, yb);
  double sum = 0.0;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const double gap = place(0, static_cast<Eigen::Index>(k));
    if (within_rounding(response.points[k]))
      sum += std::max(0.0, -trial_normal(laws[k], gap - response.points[k].dilation));
  }
  return std::max(rows_.longest_of_a(), rows_.longest_of_b()) * sum;
}

AveragedStep ContactPair::respond(std::size_t point, const Eigen::Vector3d& place, bool averaged,
                                  const PointLaw& law) const {
  if (averaged)
    return averaged_step(law, start_responses_[point], start_.col(static_cast<Eigen::Index>(point)), place);
  const PointResponse end = point_response(law, place[0], place.tail<2>());
  return {end, end_response(law, end, place[0])};
}

void ContactPair::respond(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, bool averaged,
                          const std::vector<PointLaw>& laws, PairResponse& response) const {
  const Eigen::Matrix3Xd moved = motion(ya, yb);
  const Eigen::Matrix3Xd place = after(moved);
  response.points.clear();
  response.means.clear();
  response.points.reserve(points_.size());
  response.means.reserve(points_.size());
  Eigen::VectorXd forces(place.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const AveragedStep step = respond(k, place.col(column), averaged, laws[k]);
    response.points.push_back(step.end);
    response.means.push_back(step.mean);
    forces.segment<3>(3 * column) = step.mean.force;
  }
  rows_.set_forces(forces, response);
  rows_.set_shifts(moved, ya, yb, forces, response);
}

double ContactPair::press(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                          std::span<const FrequentLaw> laws, std::span<ContactState> states,
                          Eigen::Ref<Eigen::Matrix3Xd> places, PairResponse& response) const {
  const Eigen::Matrix3Xd moved = motion(ya, yb);
  places = start_ + moved;
  if (rows_.bent().size() > 0) places.row(0) += rows_.bent();
  response.points.clear();
  response.means.clear();
  Eigen::VectorXd forces(places.size());
  double in_doubt = 0.0;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const PointForce at = point_force(laws[k], places(0, column), places.col(column).tail<2>());
    states[k] = at.state;
    forces.segment<3>(3 * column) = at.force;
    if (!at.parted && at.force[0] == 0.0 && laws[k].normal_stiffness > 0.0)
      in_doubt += std::max(0.0, -at.normal);
  }
  rows_.set_forces(forces, response);
  rows_.set_shifts(moved, ya, yb, forces, response);
  return std::max(rows_.longest_of_a(), rows_.longest_of_b()) * in_doubt;
}

std::vector<double> ContactPair::gaps(const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) const {
  const Eigen::Matrix3Xd place = places(ya, yb);
  std::vector<double> result;
  for (Eigen::Index k = 0; k < place.cols(); ++k)
    result.push_back(rests_[static_cast<std::size_t>(k)] + place(0, k));
  return result;
}

std::vector<PointMemory> ContactPair::memory_after(const PairResponse& response,
                                                   const std::vector<PointLaw>& laws,
                                                   const Eigen::VectorXd& ya, const Eigen::VectorXd& yb,
                                                   double tearing_gap) const {
  const Eigen::Matrix3Xd place = places(ya, yb);
  std::vector<PointMemory> result;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const PointResponse& point = response.points[k];
    const Eigen::Vector2d slip = place.col(static_cast<Eigen::Index>(k)).tail<2>();
    const Eigen::Vector2d elastic = elastic_slip(laws[k], point, slip);
    PointMemory memory;
    memory.slip = flat(k, elastic);
    memory.level_slip = memory_[k].level_slip;
    memory.in_level = kind_.counts_slip && (memory_[k].in_level || point.state != ContactState::open ||
                                            start_responses_[k].state != ContactState::open);
    memory.level_dilation = memory_[k].level_dilation;
    memory.dilation = dilation_before(k) + point.dilation;
    const double gap = place(0, static_cast<Eigen::Index>(k)) - point.dilation;
    memory.compression = -gap;
    memory.state = point.state;
    const bool open = point.state == ContactState::open;
    const bool torn =
        laws_[k].tension > 0.0 ? open || laws[k].tension < laws_[k].tension : open && gap > tearing_gap;
    const bool sheared = point.state == ContactState::sliding && laws_[k].weakens_by_sliding();
    const bool softens = laws_[k].bond.softens();
    memory.level_damage = memory_[k].level_damage;
    memory.damage = damage_after(laws_[k], laws[k], point,
                                 kind_.counts_slip ? memory_[k].level_damage : memory_[k].damage);
    const bool fails = softens ? memory.damage >= 1.0 : torn || sheared;
    memory.intact = memory_[k].intact && (kind_.freezes_failure || !fails);
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

ContactPair ContactPair::at_rigid_onset(const PairResponse& response, const std::vector<PointLaw>& laws,
                                        double reach) const {
  ContactPair pair = *this;
  pair.rows_.prescribe_nothing();
  pair.start_.setZero();
  for (std::size_t k = 0; !tied() && k < points_.size(); ++k) {
    PointLaw& law = pair.laws_[k];
    const PointResponse& point = response.points[k];
    const bool open = point.state == ContactState::open;
    if (open && points_[k].gap > reach)
      pair.start_(0, static_cast<Eigen::Index>(k)) = std::numeric_limits<double>::infinity();
    law.tension = open ? 0.0 : laws[k].tension;
    law.cohesion = open ? 0.0 : laws[k].cohesion;
    law.bond = {};
    law.augmented = true;
    law.normal_multiplier = point.force[0];
    law.shear_multiplier = point.force.tail<2>();
  }
  pair.respond_at_start();
  return pair;
}

}  // namespace ashlar
