#include "solver/statics/straight_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/index.hpp"
#include "solver/state/automatic.hpp"
#include "solver/state/static_state.hpp"

namespace ashlar {
namespace {

/// Allowed approach of two touching blocks relative to the displacement of the slower one. Their joint motion costs
/// at most this share of their residuals.
constexpr double meeting_share = 0.1;

/// Residual of a block, N m^-3/2. @return (p, 3)
Eigen::MatrixX3d residual_of(const TimeScheme& scheme, const BodyStep& body) {
  return body.model->material().density * scheme.inertia * body.model->space().expand(body.change);
}

class WayOn {
 public:
  WayOn(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem, double far)
      : run_(run), problem_(problem), far_(far), goes_(run.blocks().size(), false), ways_(goes_.size(), 0.0) {
    const std::vector<bool> held = run.system.held_without_contacts();
    for (std::size_t k = 0; k < goes_.size(); ++k) {
      if (!run.system.moving()[k]) continue;
      const BodyStep& body = problem.bodies[k];
      ways_[k] = mean_motion(*body.model, body.motion()) / block_size(*body.model);
      goes_[k] = !held[k] && lacks_the_same(scheme, k);
    }
    // A slack bolt may become taut on the way.
    for (const Island& island : problem.islands)
      if (!island.bolts.empty())
        for (const int block : island.bodies) goes_[at(block)] = false;
  }

  [[nodiscard]] bool any() const { return std::find(goes_.begin(), goes_.end(), true) != goes_.end(); }

  /// Excludes blocks that others would stop, and then those stopped by the excluded ones.
  void leave_out_stopped() {
    for (bool all = false; !all && any();) {
      all = true;
      const double share = times();
      for (const ContactPair& pair : problem_.pairs) {
        if (pair.tied() || !(goes(pair.a()) || goes(pair.b())) || !meet(pair, share)) continue;
        all = false;
        leave_out({pair.a(), pair.b()});
      }
    }
  }

  /// Excludes blocks whose features would pass each other on the extrapolated path without a known contact.
  /// @return true if there are any
  [[nodiscard]] bool leave_out_passing(const std::vector<FoundContacts>& found) {
    std::vector<BlockState> after = states_after(run_.system, run_.state, problem_);
    for (std::size_t k = 0; k < goes_.size(); ++k)
      if (goes_[k]) after[k].position += times() * problem_.bodies[k].motion();
    bool any = false;
    for (const PassingBlocks& passing : run_.contacts.check_motion(run_.system, run_.state, after, found)) {
      any = any || goes(passing.blocks[0]) || goes(passing.blocks[1]);
      leave_out(passing.blocks);
    }
    return any;
  }

  /// Includes the motion of blocks that move along with the certain ones, or yield to them.
  [[nodiscard]] StraightWay result() const {
    StraightWay way;
    if (!any()) return way;
    for (const double of_iteration : ways_) way.travels.push_back(times() * of_iteration);
    return way;
  }

 private:
  [[nodiscard]] bool goes(int block) const { return goes_[at(block)]; }
  void leave_out(const PairKey& pair) {
    for (const int block : pair) goes_[at(block)] = false;
  }

  /// True if the residual changes so little in the iteration that it would not vanish on the way to `far`.
  [[nodiscard]] bool lacks_the_same(const TimeScheme& scheme, std::size_t k) const {
    const StaticProgress& progress = run_.state.statics.progress;
    const BodyStep& body = problem_.bodies[k];
    if (progress.residuals.empty() || body.prescribed.size() > 0) return false;
    const Eigen::MatrixX3d lacking = residual_of(scheme, body);
    const double norm = lacking.norm();
    if (!(norm > run_.settings().statics.tolerance * body.largest_force + body.roundoff_force)) return false;
    return (lacking - progress.residuals[k]).norm() * far_ <= ways_[k] * norm;
  }

  /// Factor that extrapolates the displacements of the iteration until the fastest block has gone `far`.
  [[nodiscard]] double times() const {
    double longest = 0.0;
    for (std::size_t k = 0; k < goes_.size(); ++k)
      if (goes_[k]) longest = std::max(longest, ways_[k]);
    return far_ / longest;
  }

  /// Change of the unknowns; zero for blocks without certain motion.
  [[nodiscard]] Eigen::VectorXd change(int block) const {
    const Eigen::VectorXd& change = problem_.bodies[at(block)].change;
    return goes(block) ? change : Eigen::VectorXd(Eigen::VectorXd::Zero(change.size()));
  }

  /// True if two blocks would stop each other.
  [[nodiscard]] bool meet(const ContactPair& pair, double share) const {
    double way = std::numeric_limits<double>::infinity();
    for (const int block : {pair.a(), pair.b()})
      if (goes(block)) way = std::min(way, ways_[at(block)] * block_size(run_.blocks()[at(block)]));
    const std::vector<double> gaps =
        pair.gaps(problem_.bodies[at(pair.a())].change, problem_.bodies[at(pair.b())].change);
    const Eigen::Matrix3Xd moved = pair.motion(change(pair.a()), change(pair.b()));
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const double nearer = -share * moved(0, static_cast<Eigen::Index>(k));
      if (nearer - std::max(0.0, gaps[k]) > meeting_share * share * way) return true;
    }
    return false;
  }

  const RunContext& run_;
  const StepProblem& problem_;
  double far_;
  std::vector<bool> goes_;
  std::vector<double> ways_;  ///< displacements in the iteration, in block sizes
};

}  // namespace

StraightWay straight_way(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem,
                         const std::vector<FoundContacts>& found, double far) {
  WayOn way(run, scheme, problem, far);
  do {
    way.leave_out_stopped();
  } while (way.any() && way.leave_out_passing(found));
  return way.result();
}

void note_way_on(const RunContext& run, const StraightWay& way) {
  StaticState& statics = run.state.statics;
  if (way.travels.empty()) return;
  statics.moving = true;
  for (std::size_t k = 0; k < way.travels.size(); ++k)
    statics.progress.travels[k] = std::max(statics.progress.travels[k], way.travels[k]);
}

void note_lacking(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem) {
  std::vector<Eigen::MatrixX3d>& lacking = run.state.statics.progress.residuals;
  lacking.resize(run.blocks().size());
  for (std::size_t k = 0; k < lacking.size(); ++k)
    if (run.system.moving()[k]) lacking[k] = residual_of(scheme, problem.bodies[k]);
}

}  // namespace ashlar
