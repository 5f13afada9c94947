#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"
#include "solver/limit/released_motion.hpp"

namespace ashlar {
namespace {

constexpr int most_slip_programmes = 60;
/// Differences of successive directions of slip: converged, and nearly converged.
constexpr double same = 1e-3, alike = 0.1;
/// Relative to the growth: remaining change that leaves its sign certain.
constexpr double clearly = 0.2;
/// Ratio of successive changes of the growth below which they are extrapolated: the sum of a slower series is too
/// uncertain.
constexpr double slowest_series = 0.95;
/// Repeated decay at this rate ends at rest.
constexpr double fast_decay = -0.5;
constexpr int fast_decays = 3;
/// Relative to the initial slip: slip has vanished.
constexpr double no_slip = 1e-4;

/// Accelerations that slip leads to: size of the first motion relative to that by the loads, in which inertia becomes
/// relevant (larger: beside the slip, smaller: more programmes), the change of shifts in a programme that has converged,
/// and the largest number of programmes.
constexpr double first_motion = 0.1, shifts_converged = 0.05;
constexpr int most_shift_programmes = 12;

/// Shifts that limit the opening of joints to their dilation. @return by point
Eigen::VectorXd shifts_of(const ConeProgram& program, const std::vector<double>& dilation,
                          const std::vector<BodyVelocity>& velocity) {
  Eigen::VectorXd shift(static_cast<Eigen::Index>(dilation.size()));
  for (std::size_t pair = 0; pair < program.pairs().size(); ++pair) {
    for (std::size_t k = program.pairs()[pair].begin; k < program.pairs()[pair].end; ++k) {
      const double excess = program.points()[k].strength.friction - dilation[k];
      shift[static_cast<Eigen::Index>(k)] = excess * program.relative(pair, k, velocity).tail<2>().norm();
    }
  }
  return shift;
}

/// Growth of slip from programme to programme, and its limit.
class Growth {
 public:
  void add(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
    const double last = growth_, last_change = change_;
    growth_ = correctly_rounded::log(after.norm() / before.norm());
    turned_ = (after / after.norm() - before / before.norm()).norm();
    change_ = growth_ - last;
    // Geometrically decreasing changes have a finite sum.
    const double ratio = count_ > 1 ? change_ / last_change : 0.0;
    limit_ = ratio > 0.0 && ratio < slowest_series ? growth_ + change_ * ratio / (1.0 - ratio) : growth_;
    decays_ = growth_ < fast_decay ? decays_ + 1 : 0;
    total_ += growth_;
    ++count_;
  }

  /// True if slip comes to rest, whatever its direction.
  [[nodiscard]] bool ends() const {
    return decays_ >= fast_decays || total_ < correctly_rounded::log(no_slip);
  }
  [[nodiscard]] double limit() const { return limit_; }
  [[nodiscard]] bool converged(double margin) const {
    if (count_ < 3) return false;
    const double allowed = std::max(margin, clearly * std::abs(growth_));
    return turned_ < same || (turned_ < alike && std::abs(limit_ - growth_) < allowed);
  }

 private:
  double growth_ = 0.0, change_ = 0.0, limit_ = 0.0, turned_ = 0.0, total_ = 0.0;
  int count_ = 0, decays_ = 0;
};

ConeAnswer asked(ConeProgram& program, const ConeQuestion& question, ReleasedMotion& found) {
  ConeAnswer answer = program.solve(question);
  ++found.programmes;
  found.iterations += answer.iterations;
  return answer;
}

}  // namespace

ReleasedMotion slow_slip(ConeProgram& program, const std::vector<double>& dilation,
                         const std::vector<BodyVelocity>& load, const std::vector<BodyVelocity>& start,
                         double margin) {
  ReleasedMotion found;
  ConeQuestion question;
  question.load = load;
  question.balanced = true;
  Eigen::VectorXd shift = shifts_of(program, dilation, start);
  Growth growth;
  if (shift.size() == 0 || !(shift.maxCoeff() > 0.0)) {
    found.outcome = LimitOutcome::stands;
    return found;
  }
  for (int n = 0; n < most_slip_programmes; ++n) {
    shift /= shift.maxCoeff();
    question.shift.assign(shift.begin(), shift.end());
    ConeAnswer answer = asked(program, question, found);
    found.velocity = std::move(answer.velocity);
    found.force = std::move(answer.force);
    Eigen::VectorXd next = shifts_of(program, dilation, found.velocity);
    growth.add(shift, next);
    if (growth.ends() || growth.converged(margin)) {
      const bool grows = !growth.ends() && growth.limit() > -margin;
      found.outcome = grows ? LimitOutcome::moves : LimitOutcome::stands;
      return found;
    }
    shift = std::move(next);
  }
  return found;
}

ReleasedMotion motion_of_slip(ConeProgram& program, const std::vector<double>& dilation,
                              const std::vector<BodyVelocity>& load, const std::vector<BodyVelocity>& slip) {
  ReleasedMotion found;
  ConeQuestion question;
  question.load = load;
  question.gap = gap_of_motion;
  const double motion = largest_motion(slip, load, program.loaded_bodies());
  if (!(motion > 0.0)) return found;
  Eigen::VectorXd shift = first_motion / motion * shifts_of(program, dilation, slip);
  std::vector<Eigen::Vector3d> force;
  for (int n = 0; n < most_shift_programmes; ++n) {
    question.shift.assign(shift.begin(), shift.end());
    ConeAnswer answer = asked(program, question, found);
    force = std::move(answer.force);
    Eigen::VectorXd next = shifts_of(program, dilation, answer.velocity);
    const bool converged = (next - shift).norm() <= shifts_converged * next.norm();
    shift = std::move(next);
    if (converged) break;
  }
  ReleasedMotion polished = motion_from_rest(program, dilation, load, std::move(force));
  polished.programmes += found.programmes;
  polished.iterations += found.iterations;
  return polished;
}

}  // namespace ashlar
