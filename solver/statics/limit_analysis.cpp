#include "solver/statics/limit_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "geometry/index.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

/// Bodies that accelerate by no more than this part of what their loads alone would do are in balance.
constexpr double still = 1e-4;
/// Of the fastest body: others move with it.
constexpr double moves_along = 1e-3;

/// Between steps of the fixed point, relative to the motion: one that repeats itself so well is a motion.
constexpr double repeats = 3e-3;
/// What the gap of its programmes may be, over the square of the motion.
constexpr double enough = 1e-5;
constexpr double near_enough = 0.1;  ///< where rounding ends them before
constexpr int most_shifts = 45;
constexpr int times_at_rest = 3, most_vague = 2, times_fast = 20;
constexpr double times_rest = 10.0;  ///< motion beyond this multiple of rest is no doubt one

double product(const std::vector<BodyVelocity>& a, const std::vector<BodyVelocity>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
  return sum;
}

double distance(const std::vector<BodyVelocity>& a, const std::vector<BodyVelocity>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]).squaredNorm();
  return std::sqrt(sum);
}

/// Shifts one after the other. Their direction is that of the last motion. Their size is looked for by secants: slow
/// motion grows or dies away from one programme to the next by a factor that is nearly 1 near the limit, and that falls
/// as inertia takes a larger part in it.
class ShiftSequence {
 public:
  /// @param first what the first programme is asked with
  explicit ShiftSequence(Eigen::VectorXd first) : asked_(std::move(first)) {}

  [[nodiscard]] const Eigen::VectorXd& asked() const { return asked_; }
  /// How much the shifts that a programme found are off those that it was asked with.
  [[nodiscard]] double off() const { return off_; }
  /// Whether motion has grown in the same direction a few times, or has kept its size though details of it change.
  [[nodiscard]] bool goes_on() const { return growing_ >= 3 || (lasting_ >= 5 && off_ < 0.05); }

  /// Asks with less, after a programme without motion.
  void shrink() {
    asked_ *= 0.3;
    known_ = false;
  }

  /// @param found of the motion of the programme that was asked with asked()
  void add(const Eigen::VectorXd& found) {
    constexpr double most_on = 2.0;  // of the logarithm
    constexpr double clearly = 2e-3, settled = 0.1, alike = 0.01;
    constexpr int followed = 4;
    const double before = asked_.norm(), after = found.norm();
    if (!(before > 0.0) || !(after > 0.0)) {
      off_ = before > 0.0 || after > 0.0 ? 1.0 : 0.0;
      asked_ = found;
      return;
    }
    off_ = (found - asked_).norm() / after;
    const double size = std::log(before), growth = std::log(after / before);
    const double turned = (found / after - asked_ / before).norm();
    growing_ = growth > clearly && turned < settled ? growing_ + 1 : 0;
    double on = growth;
    if (known_) {
      const double slope = (growth - last_growth_) / (size - last_size_);
      on = slope < 0.0 && std::isfinite(slope) ? -growth / slope : std::copysign(most_on, growth);
    }
    if (std::abs(on) < std::abs(growth) || turned > settled) on = growth;
    // A direction that goes to and fro is followed by less.
    lasting_ = std::abs(after / last_after_ - 1.0) < alike ? lasting_ + 1 : 0;
    last_after_ = after;
    if (turned > settled) ++turning_;
    if (turning_ > followed) {
      known_ = false;
      const double share = turning_ > 4 * followed ? 0.25 : 0.5;
      asked_ += share * (found - asked_);
      return;
    }
    known_ = true;
    last_size_ = size;
    last_growth_ = growth;
    asked_ = std::exp(std::clamp(on, -most_on, most_on)) * before / after * found;
  }

 private:
  Eigen::VectorXd asked_;
  double off_ = 1.0;
  bool known_ = false;
  double last_size_ = 0.0, last_growth_ = 0.0;
  int growing_ = 0;
  int turning_ = 0;  ///< times the direction has turned
  double last_after_ = 1.0;
  int lasting_ = 0;
};

/// Looks for the limit of trials that stand below and move above it.
class Bracketing {
 public:
  Bracketing(const LimitSearch& search, LimitBracket& bracket) : search_(search), bracket_(bracket) {}

  /// @param guess of the limit; 0: none
  void run(double guess, const std::function<std::optional<LimitTrial>(double)>& attempt) {
    constexpr int most_trials = 60, most_unknown = 6;
    double next = guess > 0.0 ? below(guess) : std::clamp(1.0, search_.lower, search_.upper);
    estimate_ = guess;
    int unknown = 0;
    for (int n = 0; n < most_trials && next > 0.0; ++n) {
      std::optional<LimitTrial> trial = attempt(next);
      if (!trial) return;
      if (trial->outcome == LimitOutcome::unknown) {
        if (++unknown > most_unknown) return;
        // Rounding is another one beside it.
        next = std::clamp(next * (1.0 - 0.1 * search_.tolerance * std::pow(4.0, unknown - 1)), search_.lower,
                          search_.upper);
        continue;
      }
      note(next, std::move(*trial));
      next = next_factor();
    }
  }

 private:
  [[nodiscard]] double below(double limit) const {
    return std::clamp(limit * (1.0 - 0.3 * search_.tolerance), search_.lower, search_.upper);
  }

  void note(double factor, LimitTrial trial) {
    const bool stands = trial.outcome == LimitOutcome::stands;
    if (!stands) estimate_ = trial.estimate;
    last_stands_ = stands;
    std::optional<double>& end = stands ? bracket_.lower : bracket_.upper;
    std::optional<LimitTrial>& kept = stands ? bracket_.rest : bracket_.motion;
    if (end && (stands ? factor <= *end : factor >= *end)) return;
    end = factor;
    kept = std::move(trial);
  }

  /// @return 0: the bracket is as narrow as it is to be
  double next_factor() {
    const auto& [low, high] = std::pair(bracket_.lower, bracket_.upper);
    if (!high) {
      bracket_.resolved = *low >= search_.upper;
      if (bracket_.resolved) return 0.0;
      const double above = std::exchange(estimate_, 0.0) * (1.0 + 0.5 * search_.tolerance);
      return std::min(above > *low ? above : 2.0 * *low, search_.upper);
    }
    bracket_.resolved = low ? *high <= *low * (1.0 + search_.tolerance) : *high <= search_.lower;
    if (bracket_.resolved) return 0.0;
    const double least = low ? *low : search_.lower;
    const double near = last_stands_ ? estimate_ * (1.0 + 0.5 * search_.tolerance) : below(estimate_);
    const bool inside =
        near > least * (1.0 + 0.2 * search_.tolerance) && near < *high / (1.0 + 0.2 * search_.tolerance);
    if (estimate_ > 0.0 && inside) {
      if (last_stands_) estimate_ = 0.0;
      return near;
    }
    return low ? std::sqrt(*low * *high) : std::max(0.5 * *high, search_.lower);
  }

  const LimitSearch& search_;
  LimitBracket& bracket_;
  double estimate_ = 0.0;
  bool last_stands_ = false;
};

}  // namespace

LimitAnalysis::LimitAnalysis(RigidModel model, const Chosen& reduced, int threads)
    : model_(std::move(model)), program_(program_of(model_, threads)) {
  for (const RigidPoint& point : model_.points) reduced_.push_back(reduced(point.blocks[0], point.blocks[1]));
}

void LimitAnalysis::set_factors(const LimitFactors& factors) {
  for (std::size_t k = 0; k < model_.points.size(); ++k)
    program_.set_strength(k, strength_of(model_, model_.points[k], reduced_[k] ? factors.strength : 1.0));
}

ConeQuestion LimitAnalysis::question(double load) const {
  ConeQuestion question;
  question.load = model_.steady;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) question.load[b] += load * model_.multiplied[b];
  return question;
}

double LimitAnalysis::fastest(const std::vector<BodyVelocity>& acceleration, double load) const {
  // Bodies without loads of their own are moved by others.
  constexpr double least_load = 1e-3;
  double most = 0.0, largest = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b)
    largest = std::max(largest, (model_.steady[b] + load * model_.multiplied[b]).norm());
  if (largest == 0.0) return 0.0;
  for (std::size_t b = 0; b < acceleration.size(); ++b) {
    const double own = (model_.steady[b] + load * model_.multiplied[b]).norm();
    most = std::max(most, acceleration[b].norm() / std::max(own, least_load * largest));
  }
  return most;
}

double LimitAnalysis::estimate(const LimitFactors& factors, const std::vector<BodyVelocity>& acceleration,
                               const std::vector<Eigen::Vector3d>& force) const {
  // The power of the loads would be dissipated by strengths that are larger in this ratio.
  double power = product(question(factors.load).load, acceleration), dissipated = 0.0;
  for (std::size_t n = 0; n < model_.pairs.size(); ++n) {
    for (std::size_t k = model_.pairs[n].begin; k < model_.pairs[n].end; ++k) {
      const double lost = -force[k].tail<2>().dot(program_.relative(n, k, acceleration).tail<2>());
      (reduced_[k] ? dissipated : power) += reduced_[k] ? lost : -lost;
    }
  }
  return dissipated > 0.0 && power > dissipated ? factors.strength * dissipated / power : 0.0;
}

LimitTrial LimitAnalysis::associated(const LimitFactors& factors) {
  set_factors(factors);
  const ConeQuestion asked = question(factors.load);
  ConeAnswer found = program_.solve(asked);
  LimitTrial trial;
  trial.factors = factors;
  trial.programmes = 1;
  trial.iterations = found.iterations;
  const double motion = fastest(found.velocity, factors.load);
  const double square = product(found.velocity, found.velocity);
  if (found.lacking < 0.1 * still && motion <= still) {
    trial.outcome = LimitOutcome::stands;
  } else if (motion > still && square > 2.0 * found.gap && found.lacking < 0.1 * still) {
    trial.outcome = LimitOutcome::moves;
    // Power of forces within the strengths that reduction takes: z . x of the cones is what is left of them.
    double strength_power = 0.0;
    for (std::size_t k = 0; k < model_.points.size(); ++k) {
      if (!reduced_[k]) continue;
      const ConeStrength& s = program_.points()[k].strength;
      strength_power += found.opening[k][0] * (s.friction * found.force[k][0] + s.cohesion) +
                        found.opening[k][1] * s.tension;
    }
    if (strength_power > 0.0) trial.estimate = factors.strength / (1.0 + square / strength_power);
  }
  trial.acceleration = std::move(found.velocity);
  trial.force = std::move(found.force);
  return trial;
}

std::vector<BodyVelocity> LimitAnalysis::without_friction(const LimitFactors& factors, LimitTrial& trial) {
  for (std::size_t k = 0; k < model_.points.size(); ++k) {
    ConeStrength strength = strength_of(model_, model_.points[k], reduced_[k] ? factors.strength : 1.0);
    strength.friction = 0.0;
    program_.set_strength(k, strength);
  }
  ConeAnswer found = program_.solve(question(factors.load));
  ++trial.programmes;
  trial.iterations += found.iterations;
  return std::move(found.velocity);
}

LimitOutcome LimitAnalysis::follow(const std::vector<BodyVelocity>& start, double at_rest,
                                   LimitTrial& trial) {
  set_factors(trial.factors);
  std::vector<double> kept_open(model_.points.size());
  for (std::size_t k = 0; k < model_.points.size(); ++k) {
    const double friction = program_.points()[k].strength.friction;
    kept_open[k] = friction - std::min(model_.points[k].law.dilation, friction);
  }
  const auto shifts = [&](const std::vector<BodyVelocity>& velocity) {
    Eigen::VectorXd shift(static_cast<Eigen::Index>(model_.points.size()));
    for (std::size_t pair = 0; pair < model_.pairs.size(); ++pair)
      for (std::size_t k = model_.pairs[pair].begin; k < model_.pairs[pair].end; ++k)
        shift[static_cast<Eigen::Index>(k)] =
            kept_open[k] * program_.relative(pair, k, velocity).tail<2>().norm();
    return shift;
  };
  ConeQuestion asked = question(trial.factors.load);
  const double square = product(asked.load, asked.load);
  if (square == 0.0) return LimitOutcome::stands;
  ShiftSequence sequence(shifts(start));
  double motion = product(start, start);
  int vague = 0, rested = 0, fast = 0;
  for (int n = 0; n < most_shifts; ++n) {
    asked.shift.assign(sequence.asked().begin(), sequence.asked().end());
    asked.gap = enough * motion / square;
    ConeAnswer found = program_.solve(asked);
    motion = product(found.velocity, found.velocity);
    ++trial.programmes;
    trial.iterations += found.iterations;
    trial.acceleration = std::move(found.velocity);
    trial.force = std::move(found.force);
    if (found.lacking < still && fastest(trial.acceleration, trial.factors.load) <= at_rest) {
      // One programme may have been asked with shifts that lead nowhere: smaller ones have to agree.
      if (++rested >= times_at_rest) return LimitOutcome::stands;
      sequence.shrink();
      continue;
    }
    rested = 0;
    if (found.gap > near_enough * motion) {
      // The gap that was allowed was that of a faster motion.
      if (++vague > most_vague) break;
      continue;
    }
    vague = 0;
    fast = fastest(trial.acceleration, trial.factors.load) > times_rest * at_rest ? fast + 1 : 0;
    sequence.add(shifts(trial.acceleration));
    if (getenv("LOUD"))
      fprintf(stderr, "rel F %.5f n %d motion %.2e off %.2e it %d\n", trial.factors.strength, n,
              fastest(trial.acceleration, trial.factors.load), sequence.off(), int(found.iterations));
    if (sequence.off() <= repeats || sequence.goes_on()) return LimitOutcome::moves;
  }
  // A motion that goes on and on is one, though its details do not settle.
  return vague <= most_vague && fast >= times_fast ? LimitOutcome::moves : LimitOutcome::unknown;
}

std::vector<BodyVelocity> LimitAnalysis::alone(const LimitFactors& factors, double tolerance) {
  std::vector<BodyVelocity> velocity(model_.bodies.size(), BodyVelocity::Zero());
  if (model_.bodies.size() < 2) return velocity;
  if (alone_.empty())
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) alone_.push_back(with_others_held(b));
  for (std::size_t b = 0; b < alone_.size(); ++b) {
    LimitTrial trial = alone_[b]->released(factors, tolerance);
    if (trial.outcome == LimitOutcome::moves) velocity[b] = trial.acceleration.front();
  }
  return velocity;
}

std::vector<std::vector<BodyVelocity>> LimitAnalysis::apart(std::vector<BodyVelocity> velocity) const {
  constexpr int most_sets = 4;
  std::vector<std::vector<int>> neighbours(velocity.size());
  for (const ConePair& pair : model_.pairs) {
    const auto [a, b] = pair.bodies;
    if (a < 0 || b < 0) continue;
    neighbours[at(a)].push_back(b);
    neighbours[at(b)].push_back(a);
  }
  std::vector<std::size_t> order;
  for (std::size_t b = 0; b < velocity.size(); ++b)
    if (velocity[b].squaredNorm() > 0.0) order.push_back(b);
  const auto speed = [&](std::size_t b) { return velocity[b].squaredNorm() / model_.bodies[b].mass; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t x, std::size_t y) { return speed(x) > speed(y); });
  std::vector<std::vector<BodyVelocity>> sets;
  while (!order.empty() && static_cast<int>(sets.size()) < most_sets) {
    sets.emplace_back(velocity.size(), BodyVelocity::Zero());
    std::vector<BodyVelocity>& set = sets.back();
    std::vector<std::size_t> left;
    for (const std::size_t b : order) {
      const bool beside = std::any_of(neighbours[b].begin(), neighbours[b].end(),
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

std::unique_ptr<LimitAnalysis> LimitAnalysis::with_others_held(std::size_t body) const {
  RigidModel held;
  held.units = model_.units;
  held.bodies = {model_.bodies[body]};
  held.steady = {model_.steady[body]};
  held.multiplied = {model_.multiplied[body]};
  held.body_of.assign(model_.body_of.size(), -1);
  for (const int block : model_.bodies[body].blocks) held.body_of[at(block)] = 0;
  std::vector<bool> reduced;
  ConePair fixed{{0, -1}, 0, 0};
  for (const ConePair& pair : model_.pairs) {
    const bool first = pair.bodies[0] == static_cast<int>(body);
    if (!first && pair.bodies[1] != static_cast<int>(body)) continue;
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      RigidPoint point = model_.points[k];
      if (!first) {
        std::swap(point.blocks[0], point.blocks[1]);
        point.frame.topRows<2>() *= -1.0;
      }
      held.points.push_back(std::move(point));
      reduced.push_back(reduced_[k]);
    }
  }
  fixed.end = held.points.size();
  if (fixed.end > 0) held.pairs = {fixed};
  auto analysis = std::make_unique<LimitAnalysis>(
      std::move(held), [](int, int) { return true; }, 1);
  analysis->reduced_ = std::move(reduced);
  return analysis;
}

LimitTrial LimitAnalysis::released(const LimitFactors& factors, double tolerance, const LimitTrial* known) {
  // A motion dies away from one shift to the next: slowly where the factor is near the limit.
  const double at_rest = std::clamp(0.5 * tolerance, 5.0 * still, 10.0 * still);
  LimitTrial trial;
  trial.factors = factors;
  trial.released = true;
  // Motion may be found from a known one, from that without friction, in which nothing is wedged, and from those of
  // bodies that move while all others are held.
  trial.outcome = known != nullptr ? follow(known->acceleration, at_rest, trial) : LimitOutcome::stands;
  const auto also_from = [&](const std::vector<BodyVelocity>& start) {
    if (trial.outcome == LimitOutcome::moves || product(start, start) == 0.0) return;
    const LimitOutcome other = follow(start, at_rest, trial);
    if (other != LimitOutcome::stands) trial.outcome = other;
  };
  also_from(without_friction(factors, trial));
  if (trial.outcome != LimitOutcome::moves)
    for (const std::vector<BodyVelocity>& start : apart(alone(factors, tolerance))) also_from(start);
  if (trial.outcome == LimitOutcome::stands) {
    // Slow motion is no motion only where there are forces that hold it.
    LimitTrial held = associated(factors);
    held.programmes += trial.programmes;
    held.iterations += trial.iterations;
    held.released = true;
    return held;
  }
  if (trial.outcome == LimitOutcome::moves)
    trial.estimate = estimate(factors, trial.acceleration, trial.force);
  return trial;
}

LimitTrial LimitAnalysis::with_bounds(const LimitFactors& factors, std::vector<double>& normal) {
  // The share of friction that follows the normal force at once; the rest is that of the programme before.
  constexpr double first_share = 0.3, least_share = 0.005, share_falls = 0.6, taken_over = 0.7;
  LimitTrial trial;
  trial.factors = factors;
  trial.released = true;
  const ConeQuestion asked = question(factors.load);
  std::vector<BodyVelocity> before;
  int stood = 0;
  double share = first_share;
  for (int n = 0; n < most_shifts; ++n) {
    for (std::size_t k = 0; k < model_.points.size(); ++k) {
      ConeStrength strength = strength_of(model_, model_.points[k], reduced_[k] ? factors.strength : 1.0);
      const double dilating = std::min(model_.points[k].law.dilation, strength.friction);
      const double at_once = dilating + share * (strength.friction - dilating);
      strength.cohesion += (strength.friction - at_once) * std::max(normal[k], 0.0);
      strength.friction = at_once;
      program_.set_strength(k, strength);
    }
    ConeAnswer found = program_.solve(asked);
    ++trial.programmes;
    trial.iterations += found.iterations;
    if (found.status != ConeStatus::solved) break;
    double change = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < normal.size(); ++k) {
      const double next = std::max(found.force[k][0], 0.0);
      change = std::max(change, std::abs(next - normal[k]));
      largest = std::max(largest, next);
      normal[k] += taken_over * (next - normal[k]);
    }
    const double motion = fastest(found.velocity, factors.load);
    stood = motion <= still ? stood + 1 : 0;
    const double size = std::sqrt(product(found.velocity, found.velocity));
    const bool repeated = !before.empty() && distance(found.velocity, before) <= repeats * size;
    before = found.velocity;
    trial.acceleration = std::move(found.velocity);
    trial.force = std::move(found.force);
    if (stood >= 2 && share <= least_share) trial.outcome = LimitOutcome::stands;
    if (stood == 0 && repeated && share <= least_share && change <= 10.0 * repeats * largest)
      trial.outcome = LimitOutcome::moves;
    if (trial.outcome != LimitOutcome::unknown) break;
    share = std::max(share * share_falls, least_share);
  }
  return trial;
}

LimitTrial LimitAnalysis::released_after_steady(const LimitFactors& factors, double tolerance,
                                                const LimitTrial* known) {
  int programmes = 0, iterations = 0;
  if (!steady_normal_) {
    steady_normal_.emplace(model_.points.size(), 0.0);
    const LimitTrial steady = with_bounds({factors.strength, 0.0}, *steady_normal_);
    programmes = steady.programmes;
    iterations = steady.iterations;
    // Where the others alone are in motion already, all act at once.
    if (steady.outcome != LimitOutcome::stands) steady_normal_->assign(model_.points.size(), 0.0);
  }
  std::vector<double> normal = *steady_normal_;
  LimitTrial trial = with_bounds(factors, normal);
  // All loads at once move no less.
  if (trial.outcome == LimitOutcome::unknown) trial = released(factors, tolerance, known);
  trial.programmes += programmes;
  trial.iterations += iterations;
  return trial;
}

double LimitAnalysis::most_that_stands(const LimitSearch& search) {
  set_factors({});
  ConeQuestion asked = question(0.0);
  asked.grows = model_.multiplied;
  asked.most = search.upper;
  const ConeAnswer found = program_.solve(asked);
  return found.status == ConeStatus::solved && found.lacking < still ? found.factor : 0.0;
}

LimitAnswer LimitAnalysis::answer(Sought sought, const LimitSearch& search,
                                  const std::function<bool()>& goes_on) {
  LimitAnswer answer;
  const auto factors = [&](double factor) {
    return sought == Sought::strength ? LimitFactors{factor, 1.0} : LimitFactors{1.0, factor};
  };
  const auto attempt = [&](bool released) {
    return [&, released](double factor) -> std::optional<LimitTrial> {
      if (!goes_on()) {
        answer.interrupted = true;
        return std::nullopt;
      }
      const std::optional<LimitTrial>& motion = answer.released.motion;
      const LimitTrial* known = motion && motion->released ? &*motion : nullptr;
      LimitTrial trial = !released ? associated(factors(factor))
                         : sought == Sought::strength
                             ? this->released(factors(factor), search.tolerance, known)
                             : released_after_steady(factors(factor), search.tolerance, known);
      answer.trials.push_back({trial.factors,
                               released,
                               trial.outcome,
                               {},
                               {},
                               trial.estimate,
                               trial.programmes,
                               trial.iterations});
      if (sought == Sought::load) trial.estimate = 0.0;
      return trial;
    };
  };
  const double guess = sought == Sought::load ? most_that_stands(search) : 0.0;
  Bracketing(search, answer.associated).run(guess, attempt(false));
  if (answer.interrupted) return answer;
  // A released motion may exist below: at the largest factor that stands, and down from there.
  LimitBracket& released = answer.released;
  if (answer.associated.upper) {
    released.upper = answer.associated.upper;
    released.motion = answer.associated.motion;
  }
  const double start = answer.associated.lower.value_or(0.0);
  if (start == 0.0) {
    released.resolved = answer.associated.resolved;
  } else {
    Bracketing(search, released).run(start / (1.0 - 0.3 * search.tolerance), attempt(true));
  }
  // Shown is a motion without dilation.
  if (!answer.interrupted && released.upper && !released.motion->released) {
    LimitTrial shown = this->released(factors(*released.upper), search.tolerance);
    if (shown.outcome == LimitOutcome::moves) released.motion = std::move(shown);
  }
  return answer;
}

LimitAnswer LimitAnalysis::strength_factor(const LimitSearch& search, const std::function<bool()>& goes_on) {
  return answer(Sought::strength, search, goes_on);
}

LimitAnswer LimitAnalysis::load_factor(const LimitSearch& search, const std::function<bool()>& goes_on) {
  return answer(Sought::load, search, goes_on);
}

LimitMotion LimitAnalysis::motion_of(const LimitTrial& trial) const {
  LimitMotion motion;
  double largest = 0.0;
  std::size_t leader = 0;
  const auto speed = [&](std::size_t b) {
    return trial.acceleration[b].norm() / std::sqrt(model_.bodies[b].mass / model_.units.mass);
  };
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    if (speed(b) <= largest) continue;
    largest = speed(b);
    leader = b;
  }
  if (largest == 0.0) return motion;
  std::vector<bool> moves(model_.bodies.size());
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    moves[b] = speed(b) > moves_along * largest;
    if (!moves[b]) continue;
    const RigidMotionOf rigid =
        ashlar::motion_of(model_.bodies[b], model_.units.acceleration * trial.acceleration[b]);
    for (const int block : model_.bodies[b].blocks)
      motion.blocks.push_back({block, model_.bodies[b].middle, rigid.translation, rigid.rotation});
  }
  std::sort(motion.blocks.begin(), motion.blocks.end(),
            [](const LimitMotion::Block& x, const LimitMotion::Block& y) { return x.block < y.block; });
  struct Seen {
    double normal = 0.0, slid = 0.0, opened = 0.0;
    Vector3 direction = Vector3::Zero();
  };
  std::map<std::array<int, 2>, Seen> seen;
  for (std::size_t n = 0; n < model_.pairs.size(); ++n) {
    const auto [a, b] = model_.pairs[n].bodies;
    if (!(a >= 0 && moves[at(a)]) && !(b >= 0 && moves[at(b)])) continue;
    for (std::size_t k = model_.pairs[n].begin; k < model_.pairs[n].end; ++k) {
      const RigidPoint& point = model_.points[k];
      Seen& joint =
          seen[{std::min(point.blocks[0], point.blocks[1]), std::max(point.blocks[0], point.blocks[1])}];
      const Eigen::Vector3d y = program_.relative(n, k, trial.acceleration);
      joint.normal += std::max(trial.force[k][0], 0.0);
      joint.slid = std::max(joint.slid, y.tail<2>().norm());
      joint.opened = std::max(joint.opened, y[0]);
      joint.direction += point.frame.row(0).transpose();
    }
  }
  double weight = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b)
    if (moves[b])
      weight = std::max(weight, (model_.steady[b] + trial.factors.load * model_.multiplied[b]).norm());
  // What sticks to the fastest body moves as one with it.
  UnionFind together(model_.bodies.size());
  for (const auto& [blocks, joint] : seen) {
    const bool bears = joint.normal > 1e-3 * weight;
    const bool slides = joint.slid > 0.05 * largest;
    const bool opens = !bears && (slides || joint.opened > 0.05 * largest);
    const JointMotion how = opens ? JointMotion::opens : slides ? JointMotion::slides : JointMotion::sticks;
    motion.joints.push_back({blocks, how});
    const int a = model_.body_of[at(blocks[0])], b = model_.body_of[at(blocks[1])];
    if (a >= 0 && b >= 0 && how == JointMotion::sticks) together.unite(a, b);
  }
  const auto leads = [&](int block) {
    const int own = model_.body_of[at(block)];
    return own >= 0 && together.find(own) == together.find(static_cast<int>(leader));
  };
  std::vector<Vector3> planes;
  for (const MovingJoint& joint : motion.joints) {
    if (joint.motion != JointMotion::slides || leads(joint.blocks[0]) == leads(joint.blocks[1])) continue;
    const Vector3 normal = seen[joint.blocks].direction.normalized();
    const bool known = std::any_of(planes.begin(), planes.end(),
                                   [&](const Vector3& plane) { return std::abs(plane.dot(normal)) > 0.999; });
    if (!known) planes.push_back(normal);
  }
  const RigidBody& body = model_.bodies[leader];
  const RigidMotionOf rigid = ashlar::motion_of(body, trial.acceleration[leader]);
  double reach = 0.0;
  for (std::size_t n = 0; n < model_.pairs.size(); ++n) {
    const auto [a, b] = model_.pairs[n].bodies;
    if (a != static_cast<int>(leader) && b != static_cast<int>(leader)) continue;
    for (std::size_t k = model_.pairs[n].begin; k < model_.pairs[n].end; ++k)
      reach = std::max(reach, (model_.points[k].place - body.middle).norm());
  }
  const bool turns = rigid.rotation.norm() * reach > 0.1 * rigid.translation.norm();
  if (turns) {
    motion.mode = planes.empty() ? "topples" : "topples and slides";
  } else if (planes.empty()) {
    motion.mode = "falls";
  } else if (planes.size() == 1) {
    motion.mode = "slides on one plane";
  } else {
    motion.mode = planes.size() == 2 ? "slides along two planes" : "slides on several planes";
  }
  return motion;
}

const char* to_string(JointMotion motion) {
  switch (motion) {
    case JointMotion::sticks:
      return "sticks";
    case JointMotion::slides:
      return "slides";
    case JointMotion::opens:
      return "opens";
  }
  return "";
}

const char* to_string(LimitOutcome outcome) {
  switch (outcome) {
    case LimitOutcome::stands:
      return "stands";
    case LimitOutcome::moves:
      return "moves";
    case LimitOutcome::unknown:
      return "unknown";
  }
  return "";
}

}  // namespace ashlar
