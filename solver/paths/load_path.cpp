#include "solver/paths/load_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Inertia of steps over the stiffness of joints: at first, least and most.
constexpr double first_inertia = 1e-7, least_path_inertia = 1e-14, most_inertia = 1e3;
/// Ratio of inertia after a step that converged, and after one that did not; then so many steps converge first.
constexpr double lighter = 0.1, heavier = 10.0;
/// Relative to the largest load: unbalanced force at rest.
constexpr double unbalanced_at_rest = 1e-6;
constexpr int calm_steps = 4;
constexpr int most_path_steps = 300, most_newton_steps = 1000;
/// Relative to the largest load: the inertia of motion that has no acceleration.
constexpr double slow_motion = 1e-4;
/// Relative to the largest force of a joint: it transmits force.
constexpr double transmits = 1e-2;

std::vector<JointSpring> springs_of(const RigidModel& model) {
  std::vector<JointSpring> points;
  points.reserve(model.points.size());
  for (const RigidPoint& point : model.points)
    points.push_back({point.spring.normal / model.units.force(), point.spring.shear / model.units.force(),
                      point.bar ? 0.0 : point.law.dilation});
  return points;
}

}  // namespace

std::vector<double> displacements_of_rest(const BlockSystem& system, const RigidModel& model) {
  std::vector<double> allowed;
  for (const RigidBody& body : model.bodies) {
    double least = std::numeric_limits<double>::infinity();
    for (const int block : body.blocks)
      least = std::min(least, allowed_displacement_share * system.blocks()[at(block)].size());
    allowed.push_back(least);
  }
  return allowed;
}

LoadPath::LoadPath(RigidModel model, const std::function<bool(int, int)>& reduced,
                   std::vector<double> allowed)
    : model_(std::move(model)),
      reduced_(reduced_points(model_, reduced)),
      allowed_(std::move(allowed)),
      program_(program_of(model_, 1)),
      step_(program_, springs_of(model_)) {}

PathState LoadPath::unloaded() const {
  PathState state;
  for (const RigidPoint& point : model_.points)
    state.force.emplace_back(point.spring.initial / model_.units.force(), 0.0, 0.0);
  state.moved.assign(model_.bodies.size(), BodyVelocity::Zero());
  return state;
}

void LoadPath::set_strengths(double factor, double cap) {
  for (std::size_t k = 0; k < model_.points.size(); ++k) {
    const RigidPoint& point = model_.points[k];
    ConeStrength strength = strength_of(model_, point, reduced_[k] ? factor : 1.0);
    // Points of springs are too few for stress blocks: joints that crush are those of limit analysis.
    if (!point.bar) strength.compression = cap * point.area / model_.units.force();
    if (!point.bar && !(point.area > 0.0)) strength.compression = std::numeric_limits<double>::infinity();
    program_.set_strength(k, strength);
  }
}

double LoadPath::largest_pressure(const PathState& state) const {
  double largest = 0.0;
  for (std::size_t k = 0; k < model_.points.size(); ++k)
    if (!model_.points[k].bar && model_.points[k].area > 0.0)
      largest = std::max(largest, state.force[k][0] * model_.units.force() / model_.points[k].area);
  return largest;
}

PairKey LoadPath::most_pressed(const PathState& state, double pressure) const {
  std::map<PairKey, double> forces;
  for (std::size_t k = 0; k < model_.points.size(); ++k) {
    const RigidPoint& point = model_.points[k];
    const double force = state.force[k][0] * model_.units.force();
    if (!point.bar && point.area > 0.0 && force >= pressure * point.area)
      forces[key_of(point.blocks)] += force;
  }
  const auto most = std::max_element(forces.begin(), forces.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == forces.end() ? PairKey{-1, -1} : most->first;
}

std::vector<BodyVelocity> LoadPath::load(double factor) const {
  std::vector<BodyVelocity> load = model_.steady;
  for (std::size_t b = 0; b < load.size(); ++b) load[b] += factor * model_.multiplied[b];
  return load;
}

double LoadPath::note_displacement(PathState& state) const {
  std::vector<double> squared(model_.bodies.size(), 0.0);
  for (const ConePair& pair : model_.pairs) {
    const auto [a, b] = pair.bodies;
    const auto note = [&](int body, const ConeRows& rows) {
      if (body < 0) return;
      squared[at(body)] = std::max(squared[at(body)], (rows * state.moved[at(body)]).squaredNorm());
    };
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      note(a, program_.points()[k].first);
      note(b, program_.points()[k].second);
    }
  }
  double share = 0.0;
  state.displacement = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    if (model_.bodies[b].blocks.empty()) continue;
    const RigidMotionOf centre = ashlar::motion_of(model_.bodies[b], state.moved[b]);
    const double farthest = std::sqrt(std::max(squared[b], centre.translation.squaredNorm()));
    state.displacement = std::max(state.displacement, farthest);
    share = std::max(share, farthest / allowed_[b]);
  }
  return share;
}

PathTrial LoadPath::to(const PathState& start, const LimitFactors& factors, double cap) {
  set_strengths(factors.strength, cap);
  const std::vector<BodyVelocity> loads = load(factors.load);
  double largest = 0.0;
  for (const BodyVelocity& own : loads) largest = std::max(largest, own.norm());
  PathTrial trial;
  trial.end = start;
  const double stiffness = step_.stiffness();
  double inertia = first_inertia;
  int calm = 0;  // steps to take before a longer one is tried
  for (int n = 0; n < most_path_steps && trial.iterations < most_newton_steps; ++n) {
    SpringSolution next = step_.solve(trial.end.force, loads, inertia * stiffness);
    trial.iterations += std::max(next.iterations, 1);
    if (!next.converged) {
      inertia *= heavier;
      calm = calm_steps;
      if (inertia > most_inertia) return trial;
      continue;
    }
    double unbalanced = 0.0;
    for (std::size_t b = 0; b < next.moved.size(); ++b) {
      trial.end.moved[b] += next.moved[b];
      unbalanced = std::max(unbalanced, inertia * stiffness * next.moved[b].norm());
    }
    trial.end.force = std::move(next.force);
    trial.states = std::move(next.states);
    if (note_displacement(trial.end) > 1.0) {
      trial.outcome = LimitOutcome::moves;
      trial.travel = std::move(next.moved);
      return trial;
    }
    if (unbalanced <= unbalanced_at_rest * largest) {
      trial.outcome = LimitOutcome::stands;
      return trial;
    }
    if (--calm <= 0) inertia = std::max(inertia * lighter, least_path_inertia);
  }
  return trial;
}

std::vector<PairKey> LoadPath::yielding_joints(const PathState& rest, const PathTrial& trial) const {
  struct Joint {
    double force = 0.0;
    bool sticks = false;
  };
  std::map<PairKey, Joint> joints;
  double largest = 0.0;
  for (std::size_t k = 0; k < model_.points.size(); ++k) {
    if (model_.points[k].bar) continue;
    Joint& joint = joints[key_of(model_.points[k].blocks)];
    joint.force += rest.force[k].norm();
    largest = std::max(largest, joint.force);
    // A joint without any shear strength slides from the start.
    const bool slides = trial.states[k] == SpringState::slides && program_.points()[k].strength.shear();
    joint.sticks = joint.sticks || (trial.states[k] != SpringState::open && !slides);
  }
  std::vector<PairKey> yielding;
  for (const auto& [blocks, joint] : joints)
    if (joint.force > transmits * largest && !joint.sticks) yielding.push_back(blocks);
  return yielding;
}

LimitTrial LoadPath::motion_of(const PathTrial& trial, const LimitFactors& factors) {
  set_strengths(factors.strength, std::numeric_limits<double>::infinity());
  const std::vector<BodyVelocity> loads = load(factors.load);
  std::vector<double> dilation;
  for (std::size_t k = 0; k < model_.points.size(); ++k)
    dilation.push_back(std::min(model_.points[k].law.dilation, program_.points()[k].strength.friction));
  LimitTrial shown;
  shown.factors = factors;
  shown.released = true;
  shown.outcome = LimitOutcome::moves;
  ReleasedMotion motion = motion_from_rest(program_, dilation, loads, trial.end.force);
  if (motion.outcome == LimitOutcome::moves) {
    shown.acceleration = std::move(motion.velocity);
    shown.force = std::move(motion.force);
    return shown;
  }
  shown.slow = true;
  shown.acceleration = trial.travel;
  shown.force = trial.end.force;
  const double motion_size = largest_motion(trial.travel, loads, program_.loaded_bodies());
  if (motion_size > 0.0)
    for (BodyVelocity& velocity : shown.acceleration) velocity *= slow_motion / motion_size;
  return shown;
}

}  // namespace ashlar
