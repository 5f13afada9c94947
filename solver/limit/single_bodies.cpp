#include "solver/limit/single_bodies.hpp"

#include <algorithm>

#include "geometry/index.hpp"
#include "solver/limit/held_bodies.hpp"
#include "solver/limit/limit_analysis.hpp"

namespace ashlar {
namespace {

/// Sets of bodies from which slow slip starts: more find rarer motions, and each costs up to 60 programmes (slow_slip.cpp).
constexpr int most_sets = 4;

std::unique_ptr<LimitAnalysis> with_others_held(const RigidModel& model, const std::vector<bool>& reduced,
                                                std::size_t body) {
  std::vector<bool> free(model.bodies.size(), false);
  free[body] = true;
  HeldModel held = with_held_bodies(model, free, reduced);
  auto analysis = std::make_unique<LimitAnalysis>(std::move(held.model), std::move(held.reduced), 1);
  analysis->keep_parts();
  return analysis;
}

}  // namespace

SingleBodies::SingleBodies(const RigidModel& model, const std::vector<bool>& reduced)
    : neighbours_(model.bodies.size()), stands_(model.bodies.size(), {0.0, 0.0}) {
  for (const ConePair& pair : model.pairs) {
    const auto [a, b] = pair.bodies;
    if (a < 0 || b < 0) continue;
    neighbours_[at(a)].push_back(b);
    neighbours_[at(b)].push_back(a);
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    mass_.push_back(model.bodies[b].mass);
    const bool is_bar = model.bodies[b].blocks.empty();
    single_.push_back(is_bar ? nullptr : with_others_held(model, reduced, b));
  }
}

SingleBodies::~SingleBodies() = default;
SingleBodies::SingleBodies(SingleBodies&&) noexcept = default;
SingleBodies& SingleBodies::operator=(SingleBodies&&) noexcept = default;

std::vector<BodyVelocity> SingleBodies::motions(const LimitFactors& factors, double tolerance) {
  std::vector<BodyVelocity> velocity(single_.size(), BodyVelocity::Zero());
  for (std::size_t b = 0; b < single_.size(); ++b) {
    if (single_[b] == nullptr) continue;
    // A body that stood with less strength stands with more.
    LimitFactors& stands = stands_[b];
    if (factors.load == stands.load && factors.strength <= stands.strength) continue;
    const LimitTrial trial = single_[b]->released(factors, tolerance);
    if (trial.outcome == LimitOutcome::moves) velocity[b] = trial.acceleration.front();
    if (trial.outcome == LimitOutcome::stands) stands = factors;
  }
  return velocity;
}

std::vector<std::vector<BodyVelocity>> SingleBodies::sets(const LimitFactors& factors, double tolerance) {
  const std::vector<BodyVelocity> velocity = motions(factors, tolerance);
  std::vector<std::size_t> order;
  for (std::size_t b = 0; b < velocity.size(); ++b)
    if (velocity[b].squaredNorm() > 0.0) order.push_back(b);
  const auto speed = [&](std::size_t b) { return velocity[b].squaredNorm() / mass_[b]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t x, std::size_t y) { return speed(x) > speed(y); });
  std::vector<std::vector<BodyVelocity>> sets;
  while (!order.empty() && static_cast<int>(sets.size()) < most_sets) {
    sets.emplace_back(velocity.size(), BodyVelocity::Zero());
    std::vector<BodyVelocity>& set = sets.back();
    std::vector<std::size_t> left;
    for (const std::size_t b : order) {
      const bool beside = std::any_of(neighbours_[b].begin(), neighbours_[b].end(),
                                      [&](int other) { return set[at(other)].squaredNorm() > 0.0; });
      if (beside) {
        left.push_back(b);
      } else {
        set[b] = velocity[b];
      }
    }
    order = std::move(left);
  }
  return sets;
}

}  // namespace ashlar
