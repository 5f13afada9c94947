#include "solver/paths/pushed_blocks.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "mechanics/contact/contact_kinematics.hpp"
#include "solver/limit/released_motion.hpp"
#include "solver/paths/yielding_support.hpp"

namespace ashlar {
namespace {

constexpr int most_gap_closings = 30;
/// Programmes by which c is adapted to a mechanism, and the ratio of way and length that needs none.
constexpr int most_adaptations = 4;
constexpr double alike_travels = 1.25;
/// Push while gaps are closed, of `closed` and of the gap.
constexpr double push_of_closed = 0.1, push_of_gap = 1e-2;
/// Ratio of steps that are tried from the blocks as placed: larger ones may miss the length of a short gap.
constexpr double shorter_first_step = 0.25;
/// Angle below which quotients of sines are their limits, rad: the error is its square.
constexpr double small_screw = 1e-4;

/// Search for a multiplier that balances blocks (falls_at_failure): sections, range over the largest multiplier of the path,
/// and the acceleration of blocks that fall, over that by the loads. Smaller ones may be errors of the programme.
constexpr int most_sections = 14;
constexpr double golden_section = 0.6180339887498949, multiplier_range = 3.0, falling_motion = 0.02;

double sum_of_norms(const std::vector<BodyVelocity>& loads) {
  double sum = 0.0;
  for (const BodyVelocity& load : loads) sum += load.norm();
  return sum;
}

/// Displacement of a body's centre by a constant twist. @param translation m, of the centre at the start
/// @param rotation rad
Vector3 travel_along_screw(const Vector3& translation, const Vector3& rotation) {
  const double angle = rotation.norm();
  double first = 0.5, second = 1.0 / 6.0;
  if (angle >= small_screw) {
    const double chord = correctly_rounded::sin(0.5 * angle) / angle;
    first = 2.0 * chord * chord;
    second = (angle - correctly_rounded::sin(angle)) / (angle * angle * angle);
  }
  const Vector3 across = rotation.cross(translation);
  return translation + first * across + second * rotation.cross(across);
}

/// The motion of bodies whose twist is that of the middle of a step: hinges on bodies at rest stay in place exactly, others
/// to third order of the rotation. @param first m, motion by which the middle was reached; @param middle m, motion there
std::vector<BodyVelocity> along_screws(const RigidModel& model, const std::vector<BodyVelocity>& first,
                                       const std::vector<BodyVelocity>& middle) {
  std::vector<BodyVelocity> travel;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const RigidBody& body = model.bodies[b];
    const RigidMotionOf motion = motion_of(body, middle[b]);
    // The twist at the centre as it is at the start.
    const Vector3 start =
        motion.translation - motion.rotation.cross(0.5 * motion_of(body, first[b]).translation);
    BodyVelocity screw;
    screw << travel_along_screw(start, motion.rotation), motion.rotation;
    travel.emplace_back(body.motion.fullPivLu().solve(screw));
  }
  return travel;
}

/// Largest opening of points under pressure in a motion, m. @param travel m
double opening_of_push(const PushedPlace& from, const std::vector<BodyVelocity>& travel,
                       const std::vector<Eigen::Vector3d>& force) {
  double largest = 0.0, opened = 0.0;
  for (const Eigen::Vector3d& f : force) largest = std::max(largest, f[0]);
  const std::vector<ConePair>& pairs = from.program->pairs();
  for (std::size_t n = 0; n < pairs.size(); ++n)
    for (std::size_t k = pairs[n].begin; k < pairs[n].end; ++k)
      if (force[k][0] > point_bears * largest)
        opened = std::max(opened, from.program->relative(n, k, travel)[0]);
  return opened;
}

/// The unit vector of a direction.
Vector3 unit_of(const Vector3& direction) {
  if (!(direction.norm() > 0.0)) throw std::invalid_argument("the direction of a pushover is zero");
  return direction.normalized();
}

}  // namespace

void push_masses(RigidModel& model, const Vector3& acceleration) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const RigidBody& body = model.bodies[b];
    BodyVelocity wrench = BodyVelocity::Zero();
    if (!body.blocks.empty()) wrench.head<3>() = body.mass * acceleration;
    model.multiplied[b] = body.motion.transpose() * wrench / model.units.force();
  }
}

PushedBlocks::PushedBlocks(const PlacedScene& scene, const PushoverSearch& search, const PathLengths& lengths)
    : direction_(unit_of(search.direction)),
      multiplied_(search.multiplied),
      gravity_(scene.system.settings().gravity_at(scene.end_time).norm()),
      lengths_(lengths),
      threads_(scene.threads),
      blocks_(scene, lengths.reach) {}

RigidModel PushedBlocks::model_of(const FollowedPlace& placement) const {
  RigidModel model = blocks_.model_of(placement, multiplied_);
  if (multiplied_.empty()) push_masses(model, gravity_ * direction_);
  return model;
}

std::optional<ConeAnswer> PushedBlocks::pushed(ConeProgram& program, const RigidModel& model,
                                               const RigidModel& gaps_of, double length) {
  ConeQuestion question;
  question.load = model.steady;
  question.grows = times(1.0 / rate_, model.multiplied);
  question.most = most_ * rate_;
  question.shift = gaps_over(gaps_of, length);
  ConeAnswer answer = program.solve(question);
  ++programmes_;
  if (!is_balanced(answer)) {
    failure_ = PushFailure::undetermined;
    return std::nullopt;
  }
  if (boundless(question, answer)) {
    failure_ = PushFailure::jammed;
    return std::nullopt;
  }
  return answer;
}

std::optional<ConeAnswer> PushedBlocks::pushed_by(PushedPlace& from, double length) {
  for (int n = 0;; ++n) {
    std::optional<ConeAnswer> answer = pushed(*from.program, from.model, from.model, length);
    if (!answer) return std::nullopt;
    const double travel = blocks_.largest_travel(from.model, answer->velocity);
    if (n == most_adaptations || (travel < alike_travels && alike_travels * travel > 1.0)) return answer;
    rate_ /= travel;
  }
}

std::optional<PushedPlace> PushedBlocks::start() {
  PushedPlace placed;
  placed.placement = blocks_.as_placed();
  placed.model = model_of(placed.placement);
  placed.program.emplace(program_of(placed.model, threads_));
  const double steady = sum_of_norms(placed.model.steady), pushed = sum_of_norms(placed.model.multiplied);
  if (!(pushed > 0.0)) throw std::invalid_argument("the pushed loads move no block");
  most_ = unbounded_over_loads * std::max(steady, pushed) / pushed;
  if (cannot_balance(*placed.program, placed.model.steady)) {
    failure_ = PushFailure::unbalanced;
    return std::nullopt;
  }
  // A gap may be shorter than a step.
  for (double length = lengths_.longest_step; length >= lengths_.closed; length *= shorter_first_step) {
    rate_ = pushed;
    if (pushed_by(placed, length)) return equilibrium_from(std::move(placed.placement), lengths_.reach);
  }
  return std::nullopt;
}

std::optional<PushedPlace> PushedBlocks::advanced(PushedPlace& from, double length) {
  last_travel_ = 0.0;
  failed_.reset();
  const std::optional<ConeAnswer> ahead = pushed_by(from, length);
  if (!ahead) return std::nullopt;
  const std::vector<BodyVelocity> first = times(length, ahead->velocity);
  const RigidModel middle = midway(from.model, *from.program, first);
  ConeProgram program = program_of(middle, threads_);
  const std::optional<ConeAnswer> at_middle = pushed(program, middle, from.model, length);
  // If there is none, the first directions are used, and remaining gaps are closed later.
  const std::vector<BodyVelocity> none(first.size(), BodyVelocity::Zero());
  const std::vector<BodyVelocity> travel =
      at_middle ? along_screws(from.model, first, times(length, at_middle->velocity))
                : along_screws(from.model, none, first);
  const double opened = std::max(0.0, opening_of_push(from, first, ahead->force));
  last_travel_ = blocks_.largest_travel(from.model, travel);
  if (!(last_travel_ <= lengths_.farthest)) {
    failure_ = PushFailure::far;
    return std::nullopt;
  }
  FollowedPlace next = from.placement;
  blocks_.move(from.model, travel, next);
  return equilibrium_from(std::move(next), lengths_.farthest - last_travel_, opened);
}

std::optional<PushedPlace> PushedBlocks::equilibrium_from(FollowedPlace placement, double travel,
                                                          double opened) {
  double gap = opened;
  for (int n = 0; n < most_gap_closings; ++n) {
    PushedPlace place;
    place.placement = std::move(placement);
    place.model = model_of(place.placement);
    place.program.emplace(program_of(place.model, threads_));
    const double push = std::max(push_of_closed * lengths_.closed, push_of_gap * gap);
    std::optional<ConeAnswer> answer = pushed(*place.program, place.model, place.model, push);
    if (!answer) {
      if (failure_ == PushFailure::undetermined) failed_ = std::move(place);
      return std::nullopt;
    }
    const std::vector<BodyVelocity> motion = times(push, answer->velocity);
    const double farthest = blocks_.largest_travel(place.model, motion);
    // The multiplier belongs to the placement: a motion this small is not made.
    if (farthest <= lengths_.closed) {
      place.multiplier = answer->factor / rate_;
      place.velocity = std::move(answer->velocity);
      place.force = std::move(answer->force);
      return place;
    }
    travel -= farthest;
    last_travel_ += farthest;
    if (!(travel >= 0.0)) {
      failure_ = PushFailure::far;
      return std::nullopt;
    }
    placement = std::move(place.placement);
    blocks_.move(place.model, motion, placement);
    gap = std::max(push, push_of_gap * farthest);
    // Gaps are closed by now: another mechanism moves blocks farther.
    if (n > 2) rate_ *= push / farthest;
  }
  failure_ = PushFailure::undetermined;
  return std::nullopt;
}

bool PushedBlocks::falls_at_failure(double size) {
  // The squared acceleration by Gauss's principle is convex in the multiplier: golden section.
  if (!failed_) return false;
  const auto motion = [&](double multiplier) {
    ConeQuestion question;
    question.load = failed_->model.steady;
    for (std::size_t b = 0; b < question.load.size(); ++b)
      question.load[b] += multiplier * failed_->model.multiplied[b];
    question.gap = gap_of_motion;
    const ConeAnswer answer = failed_->program->solve(question);
    ++programmes_;
    if (answer.status != ConeStatus::solved) return 0.0;
    return largest_motion(answer.velocity, question.load, failed_->program->loaded_bodies());
  };
  double low = -multiplier_range * size, high = multiplier_range * size;
  double left = high - golden_section * (high - low), right = low + golden_section * (high - low);
  double at_left = motion(left), at_right = motion(right);
  for (int n = 0; n < most_sections; ++n) {
    if (std::min(at_left, at_right) <= falling_motion) return false;
    if (at_left < at_right) {
      high = right;
      right = std::exchange(left, right - golden_section * (right - low));
      at_right = std::exchange(at_left, motion(left));
    } else {
      low = left;
      left = std::exchange(right, left + golden_section * (high - left));
      at_left = std::exchange(at_right, motion(right));
    }
  }
  return true;
}

Vector3 velocity_at(const RigidModel& model, const std::vector<BodyVelocity>& velocity, int block,
                    const Vector3& place) {
  const int body = model.body_of[at(block)];
  if (body < 0) return Vector3::Zero();
  const RigidMotionOf motion = motion_of(model.bodies[at(body)], velocity[at(body)]);
  return motion.translation + motion.rotation.cross(place - model.bodies[at(body)].middle);
}

}  // namespace ashlar
