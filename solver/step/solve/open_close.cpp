#include "solver/step/solve/open_close.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "solver/step/island/island_tangent.hpp"
#include "solver/step/solve/augmentation.hpp"
#include "solver/step/solve/contact_line.hpp"
#include "solver/step/solve/joint_failure.hpp"
#include "solver/step/solve/last_factor.hpp"
#include "solver/step/solve/predictor.hpp"
#include "solver/step/solve/proximal_guess.hpp"

namespace ashlar {
namespace {

enum class Outcome {
  converged,
  stalled,  ///< states repeat, or the residual does not decrease
  hard,  ///< short steps of the first line searches: a guess by splitting may be better (proximal_guess.hpp)
  singular,  ///< the system could not be factorised
};

class OpenClose {
 public:
  OpenClose(IslandProblem& problem, IslandResult& result)
      : problem_(problem),
        tangent_(problem),
        failure_(problem),
        settings_(problem.settings()),
        result_(result),
        may_split_(!problem.scheme().is_static() && problem.all_pairs() >= many_pairs) {}

  /// Blocks of the pair whose points have changed state most often; -1: none did.
  [[nodiscard]] BlockPair alternating() const {
    const auto most = std::max_element(changes_.begin(), changes_.end());
    if (most == changes_.end() || *most == 0) return {-1, -1};
    const ContactPair& pair = problem_.pair(static_cast<std::size_t>(most - changes_.begin()));
    return {pair.a(), pair.b()};
  }

  Outcome run() {
    known_residual_ = take_best_predictor(problem_);
    for (int rounds = 0, evaluations = 0;;) {
      Outcome outcome = newton(settings_.iteration.newton_iterations, false);
      if (outcome == Outcome::hard) {
        may_split_ = false;
        if (take_proximal_guess(problem_, tangent_)) known_residual_.reset();
        outcome = newton(settings_.iteration.newton_iterations, false);
      }
      if (outcome == Outcome::stalled) {
        ++result_.fallbacks;
        outcome = minimise();
      }
      if (outcome != Outcome::converged) return outcome;
      if (!failure_.break_joints(problem_)) {
        if (settings_.augmented && augmentation_.adjust(problem_)) {
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
  /// The residual of a converged step is nearly random. Later steps inherit it, and undamped motions amplify it. One
  /// more solution with the last factor removes most of it.
  void polish() {
    const Residual residual = next_residual();
    const Eigen::VectorXd change = tangent_.solve(residual.force, true);
    Evaluation before = problem_.set_aside();
    problem_.apply(change, 1.0);
    respond();
    if (problem_.residual().converged()) return;
    problem_.take_back(std::move(before));
    problem_.recall(residual);
  }

  /// Updates rows of contact points to where they act. @return true if any has changed
  bool follow() {
    const bool here = !problem_.scheme().is_static() && problem_.follow_contacts(settings_.followed_gap());
    return followed_ = problem_.sums().any(here);
  }

  /// Residual of the present guess, evaluated unless it is known.
  [[nodiscard]] Residual next_residual() {
    if (!known_residual_) return problem_.residual();
    Residual residual = std::move(*known_residual_);
    known_residual_.reset();
    problem_.recall(residual);
    return residual;
  }

  /// Contact and elastic responses at a changed guess.
  void respond() {
    known_residual_.reset();
    problem_.respond();
  }

  /// Keeps the guess with the least residual.
  void note_guess(const Residual& residual, bool closing) {
    if (residual.largest < least_) {
      least_ = residual.largest;
      if (!closing) best_ = problem_.guess();
    }
    if (problem_.scheme().is_static() && residual.sum < nearest_.sum)
      nearest_ = {residual.sum, residual.largest_by_force, problem_.guess()};
  }

  /// @param closing continues only while the residual decreases, as part of a fallback
  Outcome newton(int most, bool closing) {
    std::vector<std::vector<ContactState>> seen;
    if (!closing) nearest_ = {};
    least_ = std::numeric_limits<double>::infinity();
    double last_gain = least_;
    int without_gain = 0;
    LastFactor last_factor(std::exchange(followed_, false) && factorized_);
    for (int k = 1; k <= most; ++k) {
      ++result_.iterations;
      Residual residual = next_residual();
      // From rest, the residual of the initial guess is within the last iteration's bound of rounding errors, which
      // is wide.
      const bool no_bodies = residual.force.size() == 0 && !problem_.sums().shared();
      if (residual.converged() &&
          (no_bodies || !(problem_.scheme().is_static() && result_.iterations == 1))) {
        known_residual_ = std::move(residual);
        return Outcome::converged;
      }
      // Reversed slip leaves the states unchanged.
      const bool halved = residual.sum < 0.5 * last_gain;
      without_gain = halved ? 0 : without_gain + 1;
      if (halved) last_gain = residual.sum;
      if (!std::isfinite(residual.largest) ||
          without_gain > (closing ? 0 : settings_.iteration.newton_patience))
        return Outcome::stalled;
      note_guess(residual, closing);
      std::vector<ContactState> states = problem_.states();
      const auto [as_before, repeated] = compare_states(problem_.sums(), states, seen);
      if (!as_before && repeated) {
        note_changes(seen.back(), states);
        return Outcome::stalled;
      }
      if (!seen.empty()) note_changes(seen.back(), states);
      seen.push_back(std::move(states));
      const bool reused =
          last_factor.is_good_enough(residual.largest, as_before, settings_.iteration.nearly_converged);
      factorized_ = true;
      if (!reused && tangent_.update_factor() != FactorStatus::success) return Outcome::singular;
      const Eigen::VectorXd change = tangent_.solve(residual.force, true);
      if (closing) {
        problem_.apply(change, 1.0);
        respond();
      } else {
        const double share =
            search(change, problem_.dot(residual.force, change), settings_.iteration.newton_overshoot, 1.0);
        if (may_split_ && k <= hard_iterations && share < hard_share) return Outcome::hard;
      }
    }
    return Outcome::stalled;
  }

  /// Counts the points of each pair whose state has changed.
  void note_changes(const std::vector<ContactState>& before, const std::vector<ContactState>& states) {
    changes_.resize(problem_.pairs(), 0);
    if (before.size() != states.size()) return;
    std::size_t n = 0;
    for (std::size_t k = 0; k < changes_.size(); ++k)
      for (std::size_t point = 0; point < problem_.laws()[k].size(); ++point, ++n)
        changes_[k] += before[n] == states[n] ? 0 : 1;
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
    for (auto& laws : problem_.changing_laws()) {
      for (PointLaw& law : laws) law.held_limit = limits[n++];
    }
    respond();
  }

  void release() {
    for (auto& laws : problem_.changing_laws()) {
      for (PointLaw& law : laws) law.held_limit = -1.0;
    }
    respond();
  }

  /// Accepts the guess of smallest residual for an iteration of a static analysis. The next iteration continues from
  /// it.
  /// @return false unless its residual is small enough
  bool take_nearest() {
    if (nearest_.largest_by_force > settings_.statics.unconverged_share) return false;
    problem_.set_guess(nearest_.guess);
    respond();
    known_residual_ = problem_.residual();
    return true;
  }

  Outcome minimise() {
    problem_.set_guess(best_);
    respond();
    std::vector<double> limits = bounds();
    Eigen::VectorXd last_change;
    for (int pass = 0; pass < settings_.iteration.fallback_passes; ++pass) {
      hold(limits);
      // The minimum need not be more accurate than its bounds; newton() does the rest.
      const double target = std::max(1.0, settings_.iteration.minimiser_share * least_);
      if (const Outcome inner = minimise_held(target); inner != Outcome::converged) return inner;
      release();
      const std::vector<Eigen::VectorXd> guess = problem_.guess();
      const std::vector<double> next = bounds();
      const Outcome finished = newton(settings_.iteration.newton_iterations, true);
      if (finished == Outcome::converged) return finished;
      if (pass + 1 >= settings_.iteration.plain_passes && take_nearest()) return Outcome::converged;
      problem_.set_guess(guess);
      Eigen::Map<Eigen::VectorXd> held(limits.data(), static_cast<Eigen::Index>(limits.size()));
      const Eigen::VectorXd change = Eigen::Map<const Eigen::VectorXd>(next.data(), held.size()) - held;
      const double share =
          pass < settings_.iteration.plain_passes || pass % 3 != 2 ? 1.0 : share_on(change, last_change);
      held = (held + share * change).cwiseMax(0.0);
      last_change = change;
    }
    return Outcome::stalled;
  }

  /// Extrapolated limit of a repetition whose changes shrink, grow or alternate by a factor, in units of the last
  /// one. Forces are bounded: a growing change meets another solution ahead.
  [[nodiscard]] double share_on(const Eigen::VectorXd& change, const Eigen::VectorXd& last_change) const {
    constexpr double farthest = 10.0;
    const double last = product_of_bounds(last_change, last_change);
    const double factor = last > 0.0 ? product_of_bounds(change, last_change) / last : 0.0;
    return 1.0 / std::max(1.0 / farthest, 1.0 - factor);
  }

  /// Inner product of values of all points.
  [[nodiscard]] double product_of_bounds(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const {
    if (!problem_.sums().shared()) return x.dot(y);
    double sum = 0.0;
    Eigen::Index start = 0;
    for (std::size_t pair = 0; pair < problem_.pairs(); ++pair) {
      const auto points = static_cast<Eigen::Index>(problem_.laws()[pair].size());
      if (problem_.sums().owns_pair(pair)) sum += x.segment(start, points).dot(y.segment(start, points));
      start += points;
    }
    return problem_.sums().sum(sum);
  }

  /// The minimum with the present bounds held. @param target of Residual::largest
  Outcome minimise_held(double target) {
    for (int k = 0; k < settings_.iteration.minimiser_iterations; ++k) {
      ++result_.iterations;
      const Residual residual = next_residual();
      if (residual.largest <= target) return Outcome::converged;
      if (!std::isfinite(residual.largest)) return Outcome::stalled;
      if (tangent_.factorize() != FactorStatus::success) return Outcome::singular;
      const Eigen::VectorXd change = tangent_.solve(residual.force, false);
      search(change, problem_.dot(residual.force, change), settings_.iteration.line_search_tolerance, 16.0);
    }
    return Outcome::stalled;
  }

  /// A guess on a line: its share of the change, and the work per share.
  struct OnLine {
    double share;
    double work;      ///< of all forces, J
    double contacts;  ///< of the contact forces, J
  };

  /// Moves along a direction: by all of it, or to about where the forces do no more work along it, which for forces
  /// with a potential is the minimum on this line. Apart from contacts, work is nearly affine in the share. Once it
  /// is known at two guesses, contacts alone determine where to evaluate all forces next (contact_line.hpp).
  /// @param work_at_start of the forces per share; no search if it is not positive
  /// @param tolerance of the work, relative. @param farthest largest share searched, >= 1
  /// @return share of the change that was made
  double search(const Eigen::VectorXd& change, double work_at_start, double tolerance, double farthest) {
    double at = 0.0;
    const auto work = [&](double share) {
      problem_.apply(change, share - at);
      at = share;
      respond();
      known_residual_ = problem_.residual();
      return problem_.dot(known_residual_->force, change);
    };
    const double work_at_end = work(1.0);
    const double enough = tolerance * work_at_start;
    if (!(work_at_start > 0.0) || std::abs(work_at_end) <= enough) return at;
    if (work_at_end > 0.0 && farthest <= 1.0) return at;
    std::optional<ContactLine> line;  // With few contacts, evaluation of all forces is as fast.
    if (problem_.all_pairs() >= many_pairs) line.emplace(problem_, change, 1.0);
    const auto contacts = [&line](double share) { return line ? line->work(share) : 0.0; };
    OnLine low{0.0, work_at_start, contacts(0.0)};
    OnLine high{1.0, work_at_end, contacts(1.0)};
    while (high.work > enough && high.share < farthest) {
      low = high;
      high = {2.0 * high.share, work(2.0 * high.share), contacts(2.0 * high.share)};
    }
    double found = high.work;
    for (int k = 0; k < settings_.iteration.line_search_steps && std::abs(found) > enough && high.work < 0.0;
         ++k) {
      const double share = line ? root_between(low, high, *line, 0.5 * enough) : next_share(low, high, k);
      found = work(share);
      (found > 0.0 ? low : high) = {share, found, contacts(share)};
    }
    return at;
  }

  /// Next share between two guesses with work of opposite sign: false position, and every third time the middle, as
  /// the work has kinks.
  [[nodiscard]] static double next_share(const OnLine& low, const OnLine& high, int k) {
    return k % 3 == 2 ? 0.5 * (low.share + high.share)
                      : low.share + (high.share - low.share) * low.work / (low.work - high.work);
  }

  /// Zero of the work between two guesses on a line, the first with positive and the second with negative work,
  /// assuming that all but the contact work is affine in between. @param enough of the work, J
  [[nodiscard]] double root_between(const OnLine& first, const OnLine& second, const ContactLine& line,
                                    double enough) const {
    const double rest = first.work - first.contacts;
    const double slope = (second.work - second.contacts - rest) / (second.share - first.share);
    OnLine low = first;
    OnLine high = second;
    for (int k = 0;; ++k) {
      const double share = next_share(low, high, k);
      const double contacts = line.work(share);
      const double found = contacts + rest + slope * (share - first.share);
      if (k >= settings_.iteration.line_search_steps || !(std::abs(found) > enough)) return share;
      (found > 0.0 ? low : high) = {share, found, contacts};
    }
  }

  // notes/hard_steps.md
  static constexpr int hard_iterations = 2;
  static constexpr double hard_share = 0.2;
  static constexpr std::size_t many_pairs = 32;

  IslandProblem& problem_;
  IslandTangent tangent_;
  JointFailure failure_;
  Augmentation augmentation_;
  const SimulationSettings& settings_;
  IslandResult& result_;
  bool may_split_;                          ///< use of proximal splitting, once in a dynamic step
  bool factorized_ = false;                 ///< by newton()
  bool followed_ = false;                   ///< rows were updated since newton() was called
  std::optional<Residual> known_residual_;  ///< of the present guess, if computed in advance
  double least_ = 0.0;                      ///< smallest Residual::largest of the last newton()
  std::vector<int> changes_;                ///< by pair: changes of state of its points between guesses
  std::vector<Eigen::VectorXd> best_;       ///< best guess of the first newton()
  struct {
    double sum = std::numeric_limits<double>::infinity();
    double largest_by_force = std::numeric_limits<double>::infinity();
    std::vector<Eigen::VectorXd> guess;
  } nearest_;  ///< in statics: at the smallest Residual::sum since the last newton() that was not closing
               ///< began
};

}  // namespace

void iterate_open_close(IslandProblem& problem, IslandResult& result) {
  OpenClose iteration(problem, result);
  const Outcome outcome = iteration.run();
  if (outcome != Outcome::converged) result.alternating = iteration.alternating();
  problem.hand_over(result);
  result.status = outcome == Outcome::converged  ? IslandStatus::converged
                  : outcome == Outcome::singular ? IslandStatus::not_positive_definite
                                                 : IslandStatus::not_converged;
}

}  // namespace ashlar
