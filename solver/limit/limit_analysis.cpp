#include "solver/limit/limit_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Bodies are in balance if their acceleration relative to that by their loads alone is at most this.
constexpr double still = 1e-4;
/// Residual of an answer that decides between rest and motion, at most, relative to the loads: larger values mistake its
/// error for motion.
constexpr double deciding_residual = 0.1 * still;
/// Decay rate of slow slip that still counts as motion, relative to the tolerance; on the safe side.
constexpr double margin_share = 0.1;

/// Refinements of parts within a trial.
constexpr int most_refinements = 30;
/// Relative difference of the factors by both bounds of parts up to which one programme refines them.
constexpr double close_factors = 3e-4;

double product(const std::vector<BodyVelocity>& a, const std::vector<BodyVelocity>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
  return sum;
}

/// Outcome that a programme's answer proves.
LimitOutcome outcome_of(const ConeAnswer& answer, const std::vector<BodyVelocity>& load, std::size_t bodies) {
  const double motion = largest_motion(answer.velocity, load, bodies);
  if (!(answer.residual < deciding_residual)) return LimitOutcome::unknown;
  if (motion <= still) return LimitOutcome::stands;
  return product(answer.velocity, answer.velocity) > 2.0 * answer.gap ? LimitOutcome::moves
                                                                      : LimitOutcome::unknown;
}

}  // namespace

LimitAnalysis::LimitAnalysis(RigidModel model, std::vector<bool> reduced, int threads)
    : model_(std::move(model)),
      reduced_(std::move(reduced)),
      pulled_(model_),
      threads_(threads),
      divides_(has_parts(model_)),
      bound_(program_of(model_, threads, FrictionAt::uniform_pressure)),
      program_(program_of(model_, threads)) {}

LimitAnalysis::LimitAnalysis(RigidModel model, const Chosen& reduced, int threads)
    : model_(std::move(model)),
      reduced_(reduced_points(model_, reduced)),
      pulled_(model_),
      threads_(threads),
      divides_(has_parts(model_)),
      bound_(program_of(model_, threads, FrictionAt::uniform_pressure)),
      program_(program_of(model_, threads)) {}

void LimitAnalysis::set_factors(const LimitFactors& factors, std::optional<JointUse> use) {
  for (std::size_t k = 0; k < model_.points.size(); ++k) {
    const ConeStrength strength = strength_of(model_, model_.points[k], reduced_[k] ? factors.strength : 1.0,
                                              use.value_or(pulled_.use_of(k)));
    bound_.set_strength(k, strength);
    program_.set_strength(k, strength);
  }
}

std::vector<BodyVelocity> LimitAnalysis::load(double factor) const {
  std::vector<BodyVelocity> load = model_.steady;
  for (std::size_t b = 0; b < load.size(); ++b) load[b] += factor * model_.multiplied[b];
  return load;
}

std::vector<double> LimitAnalysis::dilation() const {
  std::vector<double> dilation;
  for (std::size_t k = 0; k < model_.points.size(); ++k)
    dilation.push_back(std::min(model_.points[k].law.dilation, program_.points()[k].strength.friction));
  return dilation;
}

double LimitAnalysis::estimate(const LimitTrial& trial) const {
  // Strengths larger in this ratio would dissipate the power of the loads.
  double power = product(load(trial.factors.load), trial.acceleration), dissipated = 0.0;
  for (std::size_t n = 0; n < model_.pairs.size(); ++n) {
    for (std::size_t k = model_.pairs[n].begin; k < model_.pairs[n].end; ++k) {
      const Eigen::Vector3d velocity = program_.relative(n, k, trial.acceleration);
      double lost = -trial.force[k].tail<2>().dot(velocity.tail<2>());
      if (model_.points[k].bar || model_.points[k].part) lost -= trial.force[k][0] * velocity[0];
      (reduced_[k] ? dissipated : power) += reduced_[k] ? lost : -lost;
    }
  }
  return dissipated > 0.0 && power > dissipated ? trial.factors.strength * dissipated / power : 0.0;
}

LimitTrial LimitAnalysis::balanced(const LimitFactors& factors) {
  LimitTrial trial = decided(FrictionAt::uniform_pressure, factors);
  if (trial.outcome != LimitOutcome::stands) return trial;
  LimitTrial in_corners = decided(FrictionAt::corners, factors);
  in_corners.programmes += trial.programmes;
  in_corners.iterations += trial.iterations;
  return in_corners;
}

LimitTrial LimitAnalysis::associated(const LimitFactors& factors) {
  LimitTrial trial = balanced(factors);
  if (pulled_.empty() || trial.outcome == LimitOutcome::stands) return trial;
  set_factors(factors, JointUse::either);
  const LimitTrial either = balanced_by(bound_, factors);
  trial.programmes += either.programmes;
  trial.iterations += either.iterations;
  const PulledJoints before = pulled_;
  if (either.outcome == LimitOutcome::stands && choose_uses(factors, either.force)) {
    LimitTrial again = balanced(factors);
    again.programmes += trial.programmes;
    again.iterations += trial.iterations;
    if (again.outcome == LimitOutcome::stands) return again;
    // Parts that were divided have other points.
    pulled_ = divides_ ? PulledJoints(model_) : before;
  }
  set_factors(factors);
  return trial;
}

bool LimitAnalysis::choose_uses(const LimitFactors& factors, const std::vector<Eigen::Vector3d>& force) {
  std::vector<double> by_point;
  for (const bool reduced : reduced_) by_point.push_back(reduced ? factors.strength : 1.0);
  return pulled_.choose(model_, force, by_point);
}

/// The programme with pressure at corners of parts.
ConeProgram LimitAnalysis::above(FrictionAt friction, const LimitFactors& factors) const {
  ConeProgram program = program_of(above_.model, threads_, friction);
  for (std::size_t k = 0; k < above_.source.size(); ++k)
    program.set_strength(k, strength_of(above_.model, above_.model.points[k],
                                        reduced_[above_.source[k]] ? factors.strength : 1.0,
                                        pulled_.use_of(above_.source[k])));
  return program;
}

/// Divides parts for velocities of a mechanism. @return false: it needs no division, or there are too many parts
bool LimitAnalysis::divide(FrictionAt friction, const ConeProgram& above,
                           const std::vector<BodyVelocity>& velocity) {
  const std::vector<std::size_t> source =
      refine_parts(model_, strengths_of(program(friction)), corner_velocities(above_, above, velocity));
  if (source.empty()) return false;
  std::vector<bool> reduced;
  for (const std::size_t k : source) reduced.push_back(reduced_[k]);
  reduced_ = std::move(reduced);
  pulled_ = PulledJoints(model_);
  bound_ = program_of(model_, threads_, FrictionAt::uniform_pressure);
  program_ = program_of(model_, threads_);
  above_ = {};
  single_.reset();
  return true;
}

/// A trial that stands with pressure at centroids, or moves with pressure at corners.
LimitTrial LimitAnalysis::decided(FrictionAt friction, const LimitFactors& factors) {
  int programmes = 0, iterations = 0;
  for (int n = 0;; ++n) {
    set_factors(factors);
    LimitTrial trial = balanced_by(program(friction), factors);
    trial.programmes = programmes += trial.programmes;
    trial.iterations = iterations += trial.iterations;
    if (!divides_ || trial.outcome != LimitOutcome::moves) return trial;
    if (above_.corners.empty()) above_ = corner_model(model_);
    ConeProgram stronger = above(friction, factors);
    ConeQuestion asked;
    asked.load = load(factors.load);
    const ConeAnswer answer = stronger.solve(asked);
    trial.programmes = ++programmes;
    trial.iterations = iterations += answer.iterations;
    if (outcome_of(answer, asked.load, stronger.loaded_bodies()) == LimitOutcome::moves) return trial;
    trial.outcome = LimitOutcome::unknown;
    if (n == most_refinements || !divide(friction, stronger, trial.acceleration)) return trial;
  }
}

LimitTrial LimitAnalysis::balanced_by(ConeProgram& program, const LimitFactors& factors) const {
  ConeQuestion asked;
  asked.load = load(factors.load);
  ConeAnswer answer = program.solve(asked);
  LimitTrial trial;
  trial.factors = factors;
  trial.programmes = 1;
  trial.iterations = answer.iterations;
  trial.outcome = outcome_of(answer, asked.load, program.loaded_bodies());
  trial.balanced = trial.outcome == LimitOutcome::stands;
  if (trial.outcome == LimitOutcome::moves) {
    // Power of forces within the reduced strengths: z . x of the cones is the remaining strength.
    double strength_power = 0.0;
    for (std::size_t k = 0; k < model_.points.size(); ++k) {
      if (!reduced_[k]) continue;
      const ConeStrength& s = program.points()[k].strength;
      strength_power += answer.opening[k][0] * (s.friction * answer.force[k][0] + s.cohesion) +
                        answer.opening[k][1] * s.tension;
      if (s.crushes()) strength_power += answer.opening[k][2] * s.compression;
    }
    const double square = product(answer.velocity, answer.velocity);
    if (strength_power > 0.0) trial.estimate = factors.strength / (1.0 + square / strength_power);
  }
  trial.acceleration = std::move(answer.velocity);
  trial.force = std::move(answer.force);
  return trial;
}

std::vector<BodyVelocity> LimitAnalysis::without_friction(const LimitFactors& factors, LimitTrial& trial) {
  for (std::size_t k = 0; k < model_.points.size(); ++k) {
    ConeStrength strength = program_.points()[k].strength;
    strength.friction = 0.0;
    program_.set_strength(k, strength);
  }
  ConeQuestion asked;
  asked.load = load(factors.load);
  ConeAnswer answer = program_.solve(asked);
  set_factors(factors);
  ++trial.programmes;
  trial.iterations += answer.iterations;
  return std::move(answer.velocity);
}

SingleBodies& LimitAnalysis::single() {
  if (!single_) single_.emplace(model_, reduced_);
  return *single_;
}

LimitTrial LimitAnalysis::released(const LimitFactors& factors, double tolerance, const LimitTrial* known,
                                   bool balanced) {
  // Forces in balance must exist for the structure to stand, and slow slip needs them.
  LimitTrial trial;
  if (balanced) {
    set_factors(factors);
    trial.factors = factors;
    trial.balanced = true;
    trial.outcome = LimitOutcome::stands;
  } else {
    trial = associated(factors);
  }
  trial.released = true;
  const std::vector<BodyVelocity> loads = load(factors.load);
  const std::vector<double> dilates = dilation();
  const auto moves = [&](ReleasedMotion motion, bool slow) {
    trial.programmes += motion.programmes;
    trial.iterations += motion.iterations;
    // Motion from rest that does not converge is inconclusive; slow slip is tried as well.
    if (slow && motion.outcome == LimitOutcome::unknown) trial.outcome = LimitOutcome::unknown;
    if (motion.outcome != LimitOutcome::moves) return false;
    trial.outcome = LimitOutcome::moves;
    trial.slow = slow;
    trial.acceleration = std::move(motion.velocity);
    trial.force = std::move(motion.force);
    trial.estimate = estimate(trial);
    return true;
  };
  if (trial.outcome != LimitOutcome::stands) {
    if (trial.outcome == LimitOutcome::moves)
      moves(motion_from_rest(program_, dilates, loads, trial.force), false);
    return trial;
  }
  const auto slips = [&](const std::vector<BodyVelocity>& start) {
    if (product(start, start) == 0.0 ||
        !moves(slow_slip(program_, dilates, loads, start, margin_share * tolerance), true))
      return false;
    // Slip may lead to a motion that exists below the factor at which slip begins to grow. If inertia finds none, the
    // motion is hardly faster than rest.
    if (!moves(motion_of_slip(program_, dilates, loads, trial.acceleration), false)) {
      const double size = still / largest_motion(trial.acceleration, loads, program_.loaded_bodies());
      for (BodyVelocity& velocity : trial.acceleration) velocity *= size;
    }
    return true;
  };
  // Multiplied loads are applied after the others and slowly: there is no motion from zero contact forces under them.
  if (!multiplies_loads(model_)) {
    const bool follows = known != nullptr && !known->slow;
    std::vector<Eigen::Vector3d> force = follows ? known->force : std::vector<Eigen::Vector3d>();
    if (force.size() != model_.points.size()) force.clear();
    if (moves(motion_from_rest(program_, dilates, loads, std::move(force)), false)) return trial;
  }
  if (known != nullptr && slips(known->acceleration)) return trial;
  if (slips(without_friction(factors, trial)) || model_.bodies.size() < 2) return trial;
  for (const std::vector<BodyVelocity>& start : single().sets(factors, tolerance))
    if (slips(start)) break;
  return trial;
}

double LimitAnalysis::most_balanced(const ConeQuestion& question) {
  set_factors({});
  // Parts are divided for the other loads first.
  if (divides_ && associated({1.0, 0.0}).outcome != LimitOutcome::stands) return 0.0;
  double stands = question.most;
  for (const FrictionAt friction : {FrictionAt::uniform_pressure, FrictionAt::corners})
    stands = std::min(stands, most_that_stands(friction, question.most));
  return stands;
}

double LimitAnalysis::most_that_stands(FrictionAt friction, double most) {
  ConeQuestion asked;
  asked.load = load(0.0);
  asked.grows = model_.multiplied;
  asked.most = most;
  const auto is_found = [](const ConeAnswer& answer) {
    return answer.status == ConeStatus::solved && answer.residual < still;
  };
  for (int n = 0;; ++n) {
    set_factors({});
    const ConeAnswer answer = program(friction).solve(asked);
    if (!is_found(answer)) return 0.0;
    if (!divides_ || n == most_refinements) return answer.factor;
    if (above_.corners.empty()) above_ = corner_model(model_);
    ConeProgram stronger = above(friction, {});
    const ConeAnswer bound = stronger.solve(asked);
    if (!is_found(bound) || bound.factor <= answer.factor * (1.0 + close_factors)) return answer.factor;
    if (!divide(friction, stronger, answer.velocity)) return answer.factor;
  }
}

double LimitAnalysis::most_that_stands(double most) {
  ConeQuestion asked;
  asked.load = load(0.0);
  asked.grows = model_.multiplied;
  asked.most = most;
  const double stands = most_balanced(asked);
  if (pulled_.empty() || stands >= most) return stands;
  set_factors({}, JointUse::either);
  const ConeAnswer either = bound_.solve(asked);
  const PulledJoints before = pulled_;
  if (either.status != ConeStatus::solved || !choose_uses({}, either.force)) return stands;
  const double again = most_balanced(asked);
  if (again < stands) pulled_ = divides_ ? PulledJoints(model_) : before;
  return std::max(stands, again);
}

std::vector<int> LimitAnalysis::moving_alone(const LimitFactors& factors, double tolerance) {
  std::vector<int> blocks;
  if (model_.bodies.size() < 2) return blocks;
  const std::vector<BodyVelocity> alone = single().motions(factors, tolerance);
  for (std::size_t b = 0; b < alone.size(); ++b)
    if (alone[b].squaredNorm() > 0.0)
      blocks.insert(blocks.end(), model_.bodies[b].blocks.begin(), model_.bodies[b].blocks.end());
  return blocks;
}

LimitMotion LimitAnalysis::motion_of(const LimitTrial& of) {
  LimitTrial trial = of;
  if (trial.force.size() != model_.points.size()) {
    // Parts have been divided since.
    set_factors(trial.factors);
    trial.force = balanced_by(program_, trial.factors).force;
  }
  if (trial.released) return limit_motion(model_, program_, trial);
  // An associated motion opens joints by their friction angle.
  set_factors(trial.factors);
  ReleasedMotion motion = motion_from_rest(program_, dilation(), load(trial.factors.load), trial.force);
  if (motion.outcome != LimitOutcome::moves) return limit_motion(model_, program_, trial);
  LimitTrial shown = trial;
  shown.acceleration = std::move(motion.velocity);
  shown.force = std::move(motion.force);
  return limit_motion(model_, program_, shown);
}

}  // namespace ashlar
