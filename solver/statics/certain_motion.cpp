#include "solver/statics/certain_motion.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/state/static_state.hpp"
#include "solver/step/island/bolts_of_run.hpp"

namespace ashlar {
namespace {

/// Allowed approach of two touching blocks relative to the displacement of the slower one. Their joint motion costs
/// at most this share of their residuals.
constexpr double meeting_share = 0.1;

/// Residual of a block, N m^-3/2. @return (p, 3)
Eigen::MatrixX3d residual_of(const TimeScheme& scheme, const BodyStep& body) {
  return body.model->material().density * scheme.inertia * body.model->space().expand(body.change);
}

class MotionExtrapolation {
 public:
  MotionExtrapolation(const BlockSystem& system, RunState& state, const StepProblem& problem, double far)
      : system_(system),
        state_(state),
        problem_(problem),
        far_(far),
        goes_(system.blocks().size(), false),
        displacements_(goes_.size(), 0.0) {
    const std::vector<bool> held = system.held_without_contacts();
    for (std::size_t k = 0; k < goes_.size(); ++k) {
      if (!system.moving()[k]) continue;
      const BodyStep& body = problem.bodies[k];
      displacements_[k] = mean_motion(*body.model, body.motion()) / body.model->size();
      goes_[k] = system.owns(static_cast<int>(k)) && !held[k] && residual_is_constant(k);
    }
    exclude_bolted();
    if (any_of_run(system, any())) goes_ = any_of_run(system, goes_);
    stopped_.assign(goes_.size(), false);
  }

  /// The same on all processes.
  [[nodiscard]] bool any() const { return std::find(goes_.begin(), goes_.end(), true) != goes_.end(); }

  /// Excludes blocks that others would stop, and then those stopped by the excluded ones.
  void exclude_stopped() {
    for (bool all = false; !all && any();) {
      all = true;
      const double share = path_factor();
      for (const ContactPair& pair : problem_.pairs) {
        if (pair.tied() || !(goes(pair.a()) || goes(pair.b())) || !meet(pair, share)) continue;
        all = false;
        exclude({pair.a(), pair.b()});
      }
      all = agree(all);
    }
  }

  /// As StepExchange::travel_beyond. Collective.
  [[nodiscard]] double travel_beyond(const ContactFinder& finder) const {
    const double share = path_factor();
    return system_.exchange().travel_beyond(system_, finder, [&](int block) {
      return Eigen::MatrixX3d((goes(block) ? share : 1.0) * problem_.bodies[at(block)].motion());
    });
  }

  /// Excludes blocks whose features would pass each other on the extrapolated path without a known contact.
  /// @return true if there are any
  [[nodiscard]] bool exclude_passing(StepContacts& contacts) {
    std::vector<BlockState> after = states_after(system_, state_, problem_);
    const double share = path_factor();
    for (std::size_t k = 0; k < goes_.size(); ++k)
      if (goes_[k] && system_.moving()[k]) after[k].position += share * problem_.bodies[k].motion();
    bool none = true;
    for (const PassingBlocks& passing : contacts.check_motion(system_, state_, after, problem_.found)) {
      if (!system_.owns_pair(passing.blocks[0], passing.blocks[1])) continue;
      none = none && !goes(passing.blocks[0]) && !goes(passing.blocks[1]);
      exclude(passing.blocks);
    }
    return !agree(none);
  }

  /// Includes the motion of blocks that move along with the certain ones, or yield to them.
  [[nodiscard]] CertainMotion result() const {
    CertainMotion motion;
    if (!any()) return motion;
    const double share = path_factor();
    for (const double of_iteration : displacements_) motion.displacements.push_back(share * of_iteration);
    return motion;
  }

 private:
  /// A slack bolt may become taut on the way: blocks of islands with bolts do not go.
  void exclude_bolted() {
    if (system_.bolts().empty()) return;
    std::map<int, int> first;  // of the joined island
    if (problem_.shared >= 0)
      first = system_.exchange().first_blocks(system_, problem_.islands[at(problem_.shared)], problem_.pairs);
    const auto name_of = [&](std::size_t island, int block) {
      return static_cast<int>(island) == problem_.shared ? first.at(block)
                                                         : problem_.islands[island].bodies.front();
    };
    std::vector<bool> bolted(goes_.size(), false);  // by name of an island
    for (std::size_t n = 0; n < problem_.islands.size(); ++n)
      for (const StepBolt* bolt : problem_.islands[n].bolts)
        bolted[at(name_of(n, moving_block(system_, *bolt)))] = true;
    bolted = any_of_run(system_, bolted);
    for (std::size_t n = 0; n < problem_.islands.size(); ++n)
      for (const int block : problem_.islands[n].bodies)
        if (bolted[at(name_of(n, block))]) goes_[at(block)] = false;
  }

  [[nodiscard]] bool goes(int block) const { return goes_[at(block)]; }
  void exclude(const PairKey& pair) {
    for (const int block : pair) {
      goes_[at(block)] = false;
      stopped_[at(block)] = true;
    }
  }

  /// Excludes the blocks that any process has excluded. @return true if nothing was excluded on any
  bool agree(bool none) {
    if (system_.exchange().alone()) return none;
    if (all_of_run(system_, none)) return true;
    stopped_ = any_of_run(system_, stopped_);
    for (std::size_t k = 0; k < goes_.size(); ++k) goes_[k] = goes_[k] && !stopped_[k];
    return false;
  }

  /// True if the residual changes so little in the iteration that it would not vanish on the way to `far`.
  [[nodiscard]] bool residual_is_constant(std::size_t k) const {
    const StaticProgress& progress = state_.statics.progress;
    const BodyStep& body = problem_.bodies[k];
    if (progress.residuals.empty() || body.prescribed.size() > 0) return false;
    const Eigen::MatrixX3d residual = residual_of(problem_.scheme, body);
    const double norm = residual.norm();
    if (!(norm > system_.settings().statics.tolerance * body.largest_force + body.roundoff_force))
      return false;
    return (residual - progress.residuals[k]).norm() * far_ <= displacements_[k] * norm;
  }

  /// Factor that extrapolates the displacements of the iteration until the fastest block has gone `far`. Collective.
  [[nodiscard]] double path_factor() const {
    double longest = 0.0;
    for (std::size_t k = 0; k < goes_.size(); ++k)
      if (goes_[k]) longest = std::max(longest, displacements_[k]);
    return far_ / most_of_run(system_, longest);
  }

  /// Change of the unknowns; zero for blocks without certain motion.
  [[nodiscard]] Eigen::VectorXd change(int block) const {
    const Eigen::VectorXd& change = problem_.bodies[at(block)].change;
    return goes(block) ? change : Eigen::VectorXd(Eigen::VectorXd::Zero(change.size()));
  }

  /// True if two blocks would stop each other.
  [[nodiscard]] bool meet(const ContactPair& pair, double share) const {
    double travel = std::numeric_limits<double>::infinity();
    for (const int block : {pair.a(), pair.b()})
      if (goes(block))
        travel = std::min(travel, displacements_[at(block)] * system_.blocks()[at(block)].size());
    const std::vector<double> gaps =
        pair.gaps(problem_.bodies[at(pair.a())].change, problem_.bodies[at(pair.b())].change);
    const Eigen::Matrix3Xd moved = pair.motion(change(pair.a()), change(pair.b()));
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const double nearer = -share * moved(0, static_cast<Eigen::Index>(k));
      if (nearer - std::max(0.0, gaps[k]) > meeting_share * share * travel) return true;
    }
    return false;
  }

  const BlockSystem& system_;
  RunState& state_;  ///< its log counts the work
  const StepProblem& problem_;
  double far_;
  std::vector<bool> goes_;     ///< by block, the same on all processes
  std::vector<bool> stopped_;  ///< by block: excluded by this process
  std::vector<double>
      displacements_;  ///< displacements in the iteration, in block sizes; 0 of blocks elsewhere
};

}  // namespace

FollowedMotion follow_motion(const BlockSystem& system, RunState& state, StepContacts& contacts,
                             const StepProblem& problem, double far) {
  MotionExtrapolation path(system, state, problem, far);
  do {
    path.exclude_stopped();
    if (path.any()) {
      if (const double travel = path.travel_beyond(contacts.finder()); travel > 0.0) return {{}, {}, travel};
    }
  } while (path.any() && path.exclude_passing(contacts));
  // The contact finder keeps the motion that it has checked last.
  const std::vector<BlockState> after = states_after(system, state, problem);
  FollowedMotion followed{path.result(), contacts.check_motion(system, state, after, problem.found)};
  std::erase_if(followed.passing,
                [&](const PassingBlocks& pair) { return !system.owns_pair(pair.blocks[0], pair.blocks[1]); });
  return followed;
}

void note_certain_motion(StaticState& statics, const CertainMotion& motion) {
  if (motion.displacements.empty()) return;
  statics.moving = true;
  for (std::size_t k = 0; k < motion.displacements.size(); ++k)
    statics.progress.displacements[k] = std::max(statics.progress.displacements[k], motion.displacements[k]);
}

void note_residuals(const BlockSystem& system, const StepProblem& problem, StaticState& statics) {
  std::vector<Eigen::MatrixX3d>& residuals = statics.progress.residuals;
  residuals.resize(system.blocks().size());
  for (std::size_t k = 0; k < residuals.size(); ++k)
    if (system.moving()[k]) residuals[k] = residual_of(problem.scheme, problem.bodies[k]);
}

}  // namespace ashlar
