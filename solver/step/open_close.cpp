#include "solver/step/open_close.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "solver/step/first_guess.hpp"
#include "solver/step/island_tangent.hpp"

namespace ashlar {
namespace {

enum class Outcome {
  settled,
  stalled,   ///< states came back, or what is left does not fall
  singular,  ///< the system could not be factorised
};

class OpenClose {
 public:
  OpenClose(IslandProblem& problem, const SimulationSettings& settings, IslandResult& result)
      : problem_(problem), tangent_(problem), settings_(settings), result_(result) {}

  Outcome run() {
    bond();
    known_balance_ = take_best_guess(problem_);
    for (int rounds = 0, evaluations = 0;;) {
      Outcome outcome = newton(settings_.iteration.newton_iterations, false);
      if (outcome == Outcome::stalled) {
        ++result_.fallbacks;
        outcome = minimise();
      }
      if (outcome != Outcome::settled) return outcome;
      if (!break_joints()) {
        if (settings_.augmented && (stiffen() || lower_multipliers())) {
          if (++rounds > settings_.multipliers.rounds) return Outcome::stalled;
        } else if (evaluations < settings_.iteration.contact_evaluations && follow()) {
          ++evaluations;
        } else {
          if (factorized_) polish();
          return outcome;
        }
      }
      respond();
    }
  }

 private:
  /// What a settled step may still lack is as good as random: steps would hand it on, and motions that
  /// nothing damps make more of it. The last factor takes most of it away.
  void polish() {
    const Eigen::VectorXd change = tangent_.solve(next_balance().left, true);
    Evaluation settled = problem_.set_aside();
    problem_.apply(change, 1.0);
    respond();
    if (!problem_.balance().settled()) problem_.take_back(std::move(settled));
  }

  /// Takes rows of contact points to where they act. @return whether any were elsewhere
  bool follow() {
    return followed_ = !problem_.scheme().from_rest && problem_.follow_contacts(settings_.followed_gap());
  }

  /// Joints with tensile strength do not break, and those with cohesion do not lose it, before what pulls at
  /// them is balanced.
  void bond() {
    for (auto& laws : problem_.laws()) {
      strengths_.emplace_back();
      for (PointLaw& law : laws) {
        strengths_.back().push_back(law.tension);
        if (law.tension > 0.0)
          law.tension = std::numeric_limits<double>::infinity();
        else if (law.cohesion > 0.0)
          law.bridged = true;
      }
    }
  }

  /// Breaks the joints with at least half of the largest overstress, or where none is overstressed those that
  /// have opened; false if there are none.
  bool break_joints() {
    double most = 0.0;
    const auto excess = [&](std::size_t pair, std::size_t point) {
      return std::isinf(problem_.laws()[pair][point].tension)
                 ? -problem_.responses()[pair].points[point].force[0] - strengths_[pair][point]
                 : 0.0;
    };
    for (std::size_t pair = 0; pair < strengths_.size(); ++pair) {
      for (std::size_t k = 0; k < strengths_[pair].size(); ++k) most = std::max(most, excess(pair, k));
    }
    if (!(most > 0.0)) return open_joints();
    for (std::size_t pair = 0; pair < strengths_.size(); ++pair) {
      for (std::size_t k = 0; k < strengths_[pair].size(); ++k) {
        if (excess(pair, k) < 0.5 * most) continue;
        open(problem_.laws()[pair][k]);
      }
    }
    return true;
  }

  /// A point fails by opening. Its residual cohesion acts from the next step on where it is closed then: in this one
  /// its shear force would jump with each change of state.
  static void open(PointLaw& law) {
    law.fail();
    law.cohesion = 0.0;
  }

  /// Points with cohesion that have opened by more than rounding may make fail. @return whether there are any
  bool open_joints() {
    bool opened = false;
    for (std::size_t pair = 0; pair < problem_.pairs(); ++pair) {
      std::vector<PointLaw>& laws = problem_.laws()[pair];
      if (std::none_of(laws.begin(), laws.end(), [](const PointLaw& law) { return law.bridged; })) continue;
      const std::vector<double> gaps = problem_.gaps(pair);
      for (std::size_t k = 0; k < laws.size(); ++k) {
        PointLaw& law = laws[k];
        if (!law.bridged || problem_.responses()[pair].points[k].tangent(0, 0) > 0.0 ||
            gaps[k] - problem_.pair(pair).dilation_before(k) <= settings_.tearing_gap())
          continue;
        law.bridged = false;
        open(law);
        opened = true;
      }
    }
    return opened;
  }

  /// How far a point is from where multipliers alone would hold it, as a share of what it may give way by:
  /// settings.multipliers.share of the tolerance, and of a point that goes deeper as much less as the depth
  /// where it was found leaves.
  double given_way(const PointLaw& law, const PointResponse& point, double gap) const {
    constexpr double least = 0.01;  // of what a point at the surface may give way by
    if (!law.augmented || point.state == ContactState::open) return 0.0;
    const double allowed = settings_.multipliers.share * settings_.multipliers.penetration_tolerance;
    const double left = std::clamp(1.0 + gap / settings_.multipliers.tolerated_depth(), least, 1.0);
    double most = 0.0;
    const auto look_at = [&most](double force, double stiffness, double way) {
      if (stiffness > 0.0) most = std::max(most, force / (stiffness * way));
    };
    const double change = point.force[0] - law.normal_multiplier;
    look_at(std::abs(change), law.normal_stiffness, change > 0.0 ? left * allowed : allowed);
    look_at((law.shear_multiplier - point.force.tail<2>()).norm(), law.shear_stiffness, allowed);
    return most;
  }

  /// Makes springs beside multipliers as stiff as the step's change of forces asks for. @return whether any
  /// were too soft
  bool stiffen() {
    constexpr double margin = 4.0;  // forces grow when springs do
    constexpr double most = 1e4;    // at once
    bool stiffer = false;
    for (std::size_t pair = 0; pair < problem_.pairs(); ++pair) {
      for (std::size_t k = 0; k < problem_.laws()[pair].size(); ++k) {
        PointLaw& law = problem_.laws()[pair][k];
        const double gap = problem_.pair(pair).points()[k].gap - problem_.pair(pair).dilation_before(k);
        const double found = given_way(law, problem_.responses()[pair].points[k], gap);
        if (found <= 1.0) continue;
        stiffer = true;
        const double factor = std::min(margin * found, most);
        law.normal_stiffness *= factor;
        law.shear_stiffness *= factor;
      }
    }
    return stiffer;
  }

  /// Where a pair gives its blocks more than it has taken from them, points whose force falls in the step
  /// start it from less force than they end it with: then they take. Forces that hardly fall hardly change,
  /// so that rounding says nothing. @return whether any was lowered
  bool lower_multipliers() {
    if (problem_.scheme().from_rest) return false;
    const double accuracy = settings_.multipliers.accuracy * settings_.multipliers.penetration_tolerance;
    bool lowered = false;
    beyond_ *= 2.0;  // 1 the first time
    for (std::size_t pair = 0; pair < problem_.pairs(); ++pair) {
      std::vector<PointLaw>& laws = problem_.laws()[pair];
      if (laws.empty() || !laws.front().augmented) continue;
      const std::vector<PointResponse>& points = problem_.responses()[pair].points;
      double force = 0.0;
      for (const PointResponse& point : points) force += std::max(0.0, point.force[0]);
      if (!(problem_.given(pair) - problem_.pair(pair).taken() > accuracy * force)) continue;
      for (std::size_t k = 0; k < laws.size(); ++k) {
        const Eigen::Vector2d shear = points[k].force.tail<2>();
        const double fall = std::max(0.0, laws[k].normal_multiplier - points[k].force[0]);
        const double along = std::max(0.0, shear.dot(laws[k].shear_multiplier - shear));
        lowered = lowered || fall > 0.0 || along > 0.0;
        laws[k].normal_multiplier = std::max(0.0, laws[k].normal_multiplier - (1.0 + beyond_) * fall);
        if (along > 0.0) laws[k].shear_multiplier -= (1.0 + beyond_) * along / shear.squaredNorm() * shear;
      }
    }
    return lowered;
  }

  /// That of the present guess, found anew unless it is known.
  [[nodiscard]] Balance next_balance() {
    if (!known_balance_) return problem_.balance();
    Balance balance = std::move(*known_balance_);
    known_balance_.reset();
    problem_.recall(balance);
    return balance;
  }

  /// Contact and elastic responses at a guess that has changed.
  void respond() {
    known_balance_.reset();
    problem_.respond();
  }

  /// @param closing goes on only while what is left falls, and counts what it does as part of a fallback
  Outcome newton(int most, bool closing) {
    std::vector<std::vector<ContactState>> seen;
    least_ = std::numeric_limits<double>::infinity();
    int without_gain = 0;
    bool last_factor = false;  // was used once more
    // Rows that were taken anew hardly differ: the last factor will do while it takes nine tenths each time.
    constexpr double most_of_it = 0.1;
    // Where states are as they were, what a system has taken so much of it will take so much of again.
    constexpr double nearly_all = 1e-2;
    double before = 0.0;
    double last =
        std::exchange(followed_, false) && factorized_ ? std::numeric_limits<double>::infinity() : 0.0;
    for (int k = 1; k <= most; ++k) {
      ++result_.iterations;
      Balance balance = next_balance();
      // From rest, the first guess lacks no more than the last iteration's bound of rounding errors, which is
      // wide.
      if (balance.settled() &&
          (balance.left.size() == 0 || !(problem_.scheme().from_rest && result_.iterations == 1))) {
        known_balance_ = std::move(balance);
        return Outcome::settled;
      }
      // Slip that turns round leaves the states as they are.
      without_gain = balance.worst < 0.5 * least_ ? 0 : without_gain + 1;
      if (!std::isfinite(balance.worst) || without_gain > (closing ? 0 : settings_.iteration.newton_patience))
        return Outcome::stalled;
      if (balance.worst < least_) {
        least_ = balance.worst;
        if (!closing) best_ = problem_.guess();
      }
      std::vector<ContactState> states = problem_.states();
      const bool as_before = !seen.empty() && states == seen.back();
      if (!as_before && std::find(seen.begin(), seen.end(), states) != seen.end()) return Outcome::stalled;
      seen.push_back(std::move(states));
      // The last system will do for what is left.
      const bool falls = balance.worst < most_of_it * last;
      last = falls ? balance.worst : 0.0;
      const double worst_before = std::exchange(before, balance.worst);
      const bool contracts = as_before && balance.worst < nearly_all * worst_before;
      const bool nearly = falls || contracts ||
                          (as_before && !last_factor && balance.worst <= settings_.iteration.nearly_settled);
      last_factor = nearly;
      factorized_ = true;
      if (!nearly && tangent_.update_factor() != FactorStatus::success) return Outcome::singular;
      const Eigen::VectorXd change = tangent_.solve(balance.left, true);
      if (closing) {
        problem_.apply(change, 1.0);
        respond();
      } else {
        search(change, balance.left.dot(change), settings_.iteration.newton_overshoot, 1.0);
      }
    }
    return Outcome::stalled;
  }

  /// Bounds of the shear forces that the last responses imply.
  [[nodiscard]] std::vector<double> bounds() {
    std::vector<double> result;
    for (std::size_t pair = 0; pair < problem_.pairs(); ++pair) {
      for (const MeanResponse& mean : problem_.responses()[pair].means) result.push_back(mean.limit);
    }
    return result;
  }

  void hold(const std::vector<double>& limits) {
    std::size_t n = 0;
    for (auto& laws : problem_.laws()) {
      for (PointLaw& law : laws) law.held_limit = limits[n++];
    }
    respond();
  }

  void release() {
    for (auto& laws : problem_.laws()) {
      for (PointLaw& law : laws) law.held_limit = -1.0;
    }
    respond();
  }

  Outcome minimise() {
    problem_.set_guess(best_);
    respond();
    std::vector<double> limits = bounds();
    Eigen::VectorXd last_change;
    for (int pass = 0; pass < settings_.iteration.fallback_passes; ++pass) {
      hold(limits);
      // A minimum need not be met better than its bounds are known; newton() sees to the rest.
      const double target = std::max(1.0, settings_.iteration.minimiser_share * least_);
      if (const Outcome inner = minimise_held(target); inner != Outcome::settled) return inner;
      release();
      const std::vector<Eigen::VectorXd> guess = problem_.guess();
      const std::vector<double> next = bounds();
      const Outcome finished = newton(settings_.iteration.newton_iterations, true);
      if (finished == Outcome::settled) return finished;
      problem_.set_guess(guess);
      Eigen::Map<Eigen::VectorXd> held(limits.data(), static_cast<Eigen::Index>(limits.size()));
      const Eigen::VectorXd change = Eigen::Map<const Eigen::VectorXd>(next.data(), held.size()) - held;
      const double share =
          pass < settings_.iteration.plain_passes || pass % 3 != 2 ? 1.0 : way_on(change, last_change);
      held = (held + share * change).cwiseMax(0.0);
      last_change = change;
    }
    return Outcome::stalled;
  }

  /// Where a repetition whose changes shrink, grow or turn round by a factor leads, in units of the last one.
  /// Forces are bounded: what grows meets another solution ahead.
  static double way_on(const Eigen::VectorXd& change, const Eigen::VectorXd& last_change) {
    constexpr double farthest = 10.0;
    const double last = last_change.squaredNorm();
    const double factor = last > 0.0 ? change.dot(last_change) / last : 0.0;
    return 1.0 / std::max(1.0 / farthest, 1.0 - factor);
  }

  /// The minimum with the present bounds held. @param target of Balance::worst
  Outcome minimise_held(double target) {
    for (int k = 0; k < settings_.iteration.minimiser_iterations; ++k) {
      ++result_.iterations;
      const Balance balance = next_balance();
      if (balance.worst <= target) return Outcome::settled;
      if (!std::isfinite(balance.worst)) return Outcome::stalled;
      if (tangent_.factorize() != FactorStatus::success) return Outcome::singular;
      const Eigen::VectorXd change = tangent_.solve(balance.left, false);
      search(change, balance.left.dot(change), settings_.iteration.line_search_tolerance, 16.0);
    }
    return Outcome::stalled;
  }

  /// Moves along a direction: by all of it, or to about where the forces do no more work along it, which for
  /// forces with a potential is the minimum on this line.
  /// @param work_at_start of the forces per share; none is searched for if it is not positive
  /// @param tolerance of the work, as a share of it; @param farthest share that is looked at, >= 1
  void search(const Eigen::VectorXd& change, double work_at_start, double tolerance, double farthest) {
    double at = 0.0;
    const auto work = [&](double share) {
      problem_.apply(change, share - at);
      at = share;
      respond();
      known_balance_ = problem_.balance();
      return known_balance_->left.dot(change);
    };
    double low = 0.0;
    double work_low = work_at_start;
    double high = 1.0;
    double work_high = work(high);
    const double enough = tolerance * work_at_start;
    if (!(work_at_start > 0.0)) return;
    while (work_high > enough && high < farthest) {
      low = high;
      work_low = work_high;
      high *= 2.0;
      work_high = work(high);
    }
    double found = work_high;
    for (int k = 0; k < settings_.iteration.line_search_steps && std::abs(found) > enough && work_high < 0.0;
         ++k) {
      // False position, and every third time the middle: the work has kinks.
      const double share =
          k % 3 == 2 ? 0.5 * (low + high) : low + (high - low) * work_low / (work_low - work_high);
      found = work(share);
      (found > 0.0 ? low : high) = share;
      (found > 0.0 ? work_low : work_high) = found;
    }
  }

  IslandProblem& problem_;
  IslandTangent tangent_;
  const SimulationSettings& settings_;
  IslandResult& result_;
  std::vector<std::vector<double>> strengths_;  ///< tensile strength of each point, N
  double beyond_ = 0.5;      ///< multiples of a fall of force that multipliers are lowered below it
  bool factorized_ = false;  ///< by newton()
  bool followed_ = false;    ///< rows were taken anew since newton() was called
  std::optional<Balance> known_balance_;  ///< of the present guess, where it was found before it is asked for
  double least_ = 0.0;                    ///< Balance::worst of the last newton() at its best
  std::vector<Eigen::VectorXd> best_;     ///< the guess that was the best of the first newton()
};

}  // namespace

void iterate_open_close(IslandProblem& problem, const SimulationSettings& settings, IslandResult& result) {
  const Outcome outcome = OpenClose(problem, settings, result).run();
  problem.hand_over(result);
  result.status = outcome == Outcome::settled    ? IslandStatus::settled
                  : outcome == Outcome::singular ? IslandStatus::not_positive_definite
                                                 : IslandStatus::not_settled;
}

}  // namespace ashlar
