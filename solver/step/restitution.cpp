#include "solver/step/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

#include "geometry/index.hpp"
#include "geometry/union_find.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "solver/step/impact.hpp"

namespace ashlar {
namespace {

/// Limits of an impact.
struct ImpactLimits {
  double gap;    ///< largest of points that are about to touch, m
  double speed;  ///< that gravity gives in a step, m/s
};

ImpactLimits limits_of(const SimulationSettings& settings, double time) {
  return {settings.search.passing_share * settings.contact_distance,
          settings.gravity_at(time).norm() * settings.time_step};
}

/// Rigid motions that the supports of a block leave, orthonormal. @return (unknowns, at most 6)
Eigen::MatrixXd rigid_modes(const BlockModel& block, const BlockState& state) {
  const Eigen::MatrixXd fields = rigid_fields(state.position);
  Eigen::MatrixXd modes(block.unknowns(), fields.cols());
  for (Eigen::Index k = 0; k < fields.cols(); ++k)
    modes.col(k) = block.space().restrict(Eigen::MatrixX3d(fields.col(k).reshaped(fields.rows() / 3, 3)));
  if (!block.supported()) return modes;
  // Motions that lose nothing by the restriction.
  constexpr double whole = 1.0 - 1e-9;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(modes.transpose() * modes);
  const Eigen::Index lost = (parts.eigenvalues().array() < whole).count();
  return modes * parts.eigenvectors().rightCols(modes.cols() - lost);
}

/// Rigid motions and velocities of the blocks of a run, computed on first use.
class RigidMotions {
 public:
  RigidMotions(const BlockSystem& system, const std::vector<BlockState>& states)
      : system_(system), states_(states) {}

  [[nodiscard]] bool moves(int block) const { return system_.moving()[at(block)]; }
  const Eigen::MatrixXd& modes(int block) {
    const auto [found, is_new] = modes_.emplace(block, Eigen::MatrixXd());
    if (is_new) found->second = rigid_modes(system_.blocks()[at(block)], states_[at(block)]);
    return found->second;
  }
  /// Rigid part of the velocity of the unknowns; zero of a block that does not move.
  Eigen::VectorXd velocity(int block) {
    const BlockModel& model = system_.blocks()[at(block)];
    if (!moves(block)) return Eigen::VectorXd::Zero(model.unknowns());
    const Eigen::MatrixXd& rigid = modes(block);
    return rigid * (rigid.transpose() * model.space().restrict(states_[at(block)].velocity));
  }
  /// Velocity by moving supports, (p, 3); empty: none.
  [[nodiscard]] Eigen::MatrixX3d driven_velocity(int block) const {
    const BlockModel& model = system_.blocks()[at(block)];
    if (!model.driven()) return {};
    const Eigen::MatrixX3d& velocity = states_[at(block)].velocity;
    return model.fixed()
               ? velocity
               : Eigen::MatrixX3d(velocity - model.space().expand(model.space().restrict(velocity)));
  }
  /// Relative velocities of a pair's points along normals and tangents, m/s. @return (3, #points)
  Eigen::Matrix3Xd at_points(const ContactPair& pair) {
    PairRows rows = pair.rows();
    rows.prescribe(pair.points(), system_.blocks()[at(pair.a())], driven_velocity(pair.a()),
                   system_.blocks()[at(pair.b())], driven_velocity(pair.b()));
    return rows.motion(velocity(pair.a()), velocity(pair.b()));
  }
  /// Accelerations of a pair's points by gravity and loads, along their normals, m/s^2.
  [[nodiscard]] Eigen::RowVectorXd accelerations(const ContactPair& pair, const StepProblem& problem) const {
    const auto of = [&](int block) -> Eigen::VectorXd {
      const BlockModel& model = system_.blocks()[at(block)];
      if (!moves(block)) return Eigen::VectorXd::Zero(model.unknowns());
      return problem.bodies[at(block)].external_force / model.material().density;
    };
    return pair.rows().free_motion(of(pair.a()), of(pair.b())).row(0);
  }

 private:
  const BlockSystem& system_;
  const std::vector<BlockState>& states_;
  std::map<int, Eigen::MatrixXd> modes_;
};

/// When a point is about to touch on free motion, and how fast.
struct FirstTouch {
  double time;   ///< s
  double speed;  ///< of approach, m/s
};

/// Solves  gap + u t + a t^2/2 = 0  for the first t > 0. Empty: never
std::optional<FirstTouch> touch_of(double gap, double velocity, double acceleration) {
  const double square = velocity * velocity - 2.0 * acceleration * gap;
  if (!(square >= 0.0)) return std::nullopt;
  const double speed = std::sqrt(square);
  if (!(speed - velocity > 0.0)) return std::nullopt;
  return FirstTouch{2.0 * gap / (speed - velocity), speed};
}

/// Time of the first impact of a pair in a solved step, s; infinity: none.
double first_impact(const StepProblem& problem, double step, const ContactPair& pair,
                    const ImpactLimits& limits, RigidMotions& motions) {
  const auto [touching, fast] = limits;
  double first = std::numeric_limits<double>::infinity();
  const Eigen::RowVectorXd end =
      pair.places(problem.bodies[at(pair.a())].change, problem.bodies[at(pair.b())].change).row(0);
  if (!(end.minCoeff() <= 0.0)) return first;
  Eigen::RowVectorXd velocities, rates;
  for (Eigen::Index k = 0; k < end.size(); ++k) {
    const double gap = pair.start_gap(static_cast<std::size_t>(k));
    if (end[k] > 0.0 || gap <= touching || pair.holds(static_cast<std::size_t>(k))) continue;
    if (velocities.size() == 0) {
      velocities = motions.at_points(pair).row(0);
      rates = motions.accelerations(pair, problem);
    }
    const double way = gap - 0.5 * touching;
    const FirstTouch straight{step * way / (gap - end[k]), (gap - end[k]) / step};
    const FirstTouch touch = touch_of(way, velocities[k], rates[k]).value_or(straight);
    if (touch.speed > fast) first = std::min(first, touch.time);
  }
  return first;
}

/// An impact at one moment: the points of blocks that touch each other, directly or not.
class ImpactOfBlocks {
 public:
  ImpactOfBlocks(const BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs)
      : system_(system),
        state_(state),
        limits_(limits_of(system.settings(), state.time())),
        pairs_(pairs),
        motions_(system, state.states),
        bonded_(system.blocks().size() + 1),
        group_(system.blocks().size()) {
    std::iota(group_.begin(), group_.end(), 0);
    for (const ContactPair& pair : pairs) note_bonds(pair);
  }

  /// @return false if no blocks meet fast enough
  bool find() {
    touching_.assign(pairs_.size(), {});
    bool any = false;
    for (std::size_t n = 0; n < pairs_.size(); ++n) any = note_touching(n) || any;
    if (!any) return false;
    for (std::size_t n = 0; n < pairs_.size(); ++n)
      if (meets_[group_of(pairs_[n])]) add_points(n);
    return !points_.empty();
  }

  void apply() {
    const ImpactResult result = solve_impact(inertia_, sizes_, points_);
    if (result.residual > impact_accuracy)
      throw std::runtime_error(
          "the impulses of an impact between " + std::to_string(bodies_.size()) +
          " blocks did not converge (velocities differ by " + std::to_string(result.residual) +
          " of the fastest from those of the law); without restitution, or with damping in "
          "its place, springs act");
    double lost = 0.0;
    for (const auto& [block, index] : bodies_) {
      const BlockModel& model = system_.blocks()[at(block)];
      BlockState& state = state_.states[at(block)];
      lost += model.kinetic_energy(state);
      state.velocity += model.space().expand(motions_.modes(block) * result.changes[at(index)]);
      lost -= model.kinetic_energy(state);
    }
    // Supports move against the impulses.
    double of_supports = 0.0;
    for (std::size_t k = 0; k < points_.size(); ++k) of_supports -= result.impulses[k].dot(driven_[k]);
    state_.ledger.loads_did(of_supports);
    state_.ledger.damping_took(lost + of_supports);
  }

 private:
  struct TouchingPoint {
    std::size_t point;
    double target;  ///< m/s
    bool bonded;
  };

  [[nodiscard]] std::size_t root(std::size_t block) const {
    while (group_[block] != block) block = group_[block];
    return block;
  }
  /// Blocks that do not move transmit no impulses.
  [[nodiscard]] std::size_t group_of(const ContactPair& pair) const {
    return root(at(motions_.moves(pair.a()) ? pair.a() : pair.b()));
  }

  /// Blocks that cannot move rigidly are one with the ground.
  [[nodiscard]] int body_or_ground(int block) {
    const bool moves = motions_.moves(block) && motions_.modes(block).cols() > 0;
    return moves ? block : static_cast<int>(system_.blocks().size());
  }
  void note_bonds(const ContactPair& pair) {
    for (std::size_t k = 0; k < pair.points().size(); ++k) {
      if (!pair.holds(k)) continue;
      bonded_.unite(body_or_ground(pair.a()), body_or_ground(pair.b()));
      return;
    }
  }

  /// Lists the touching points of a pair and joins its blocks. @return true if they meet
  bool note_touching(std::size_t n) {
    const ContactPair& pair = pairs_[n];
    meets_.resize(group_.size(), false);
    const auto [gap, fast] = limits_;
    const double e = pair.restitution().value_or(0.0);
    const bool apart = bonded_.find(body_or_ground(pair.a())) != bonded_.find(body_or_ground(pair.b()));
    std::optional<Eigen::Matrix3Xd> velocities;
    bool meets = false;
    for (std::size_t k = 0; k < pair.points().size(); ++k) {
      if (pair.holds(k)) {
        touching_[n].push_back({k, 0.0, true});
        continue;
      }
      const bool loaded = pair.loaded(k);
      if (!loaded && pair.start_gap(k) > gap) continue;
      if (!velocities) velocities = motions_.at_points(pair);
      const double velocity = (*velocities)(0, static_cast<Eigen::Index>(k));
      const bool impact = pair.restitution() && apart && !loaded && -velocity > fast;
      const bool rebounds = impact && -e * velocity > 0.5 * fast;
      meets = meets || impact;
      // A contact that bears is not loaded further, whatever its springs do.
      touching_[n].push_back({k, rebounds ? -e * velocity : impact ? 0.0 : std::min(velocity, 0.0), false});
    }
    if (touching_[n].empty()) return false;
    join(pair, meets);
    return meets;
  }

  void join(const ContactPair& pair, bool meets) {
    const std::size_t first = group_of(pair);
    const bool both = motions_.moves(pair.a()) && motions_.moves(pair.b());
    const std::size_t second = both ? root(at(pair.b())) : first;
    const std::size_t low = std::min(first, second), high = std::max(first, second);
    group_[high] = low;
    meets_[low] = meets_[low] || meets_[high] || meets;
  }

  /// Index of a block among the bodies of the impact; -1: it does not move.
  int body_of(int block) {
    if (!motions_.moves(block)) return -1;
    const auto [found, is_new] = bodies_.emplace(block, static_cast<int>(bodies_.size()));
    if (is_new) {
      inertia_.push_back(system_.blocks()[at(block)].material().density);
      sizes_.push_back(static_cast<int>(motions_.modes(block).cols()));
    }
    return found->second;
  }

  /// Motion of each point by each rigid mode of one block of a pair. @return by point, (3, modes)
  std::vector<Eigen::Matrix3Xd> rows_of(const ContactPair& pair, int block, bool of_a) {
    std::vector<Eigen::Matrix3Xd> rows(pair.points().size());
    if (!motions_.moves(block)) return rows;
    const Eigen::MatrixXd& modes = motions_.modes(block);
    for (Eigen::Matrix3Xd& row : rows) row.resize(3, modes.cols());
    const Eigen::VectorXd rest =
        Eigen::VectorXd::Zero(system_.blocks()[at(of_a ? pair.b() : pair.a())].unknowns());
    for (Eigen::Index m = 0; m < modes.cols(); ++m) {
      const Eigen::VectorXd mode = modes.col(m);
      const Eigen::Matrix3Xd moved = of_a ? pair.rows().free_motion(mode, rest)  //
                                          : pair.rows().free_motion(rest, mode);
      for (std::size_t k = 0; k < rows.size(); ++k) rows[k].col(m) = moved.col(static_cast<Eigen::Index>(k));
    }
    return rows;
  }

  void add_points(std::size_t n) {
    if (touching_[n].empty()) return;
    const ContactPair& pair = pairs_[n];
    const std::vector<Eigen::Matrix3Xd> of_a = rows_of(pair, pair.a(), true);
    const std::vector<Eigen::Matrix3Xd> of_b = rows_of(pair, pair.b(), false);
    const Eigen::Matrix3Xd velocities = motions_.at_points(pair);
    const Eigen::Matrix3Xd own =
        pair.rows().free_motion(motions_.velocity(pair.a()), motions_.velocity(pair.b()));
    for (const TouchingPoint& touching : touching_[n]) {
      const auto column = static_cast<Eigen::Index>(touching.point);
      ImpactPoint point{body_of(pair.a()), body_of(pair.b()), of_a[touching.point], of_b[touching.point]};
      point.velocity = velocities.col(column);
      point.target = touching.target;
      point.friction = pair.laws()[touching.point].friction;
      point.bonded = touching.bonded;
      points_.push_back(std::move(point));
      driven_.emplace_back(velocities.col(column) - own.col(column));
    }
  }

  const BlockSystem& system_;
  RunState& state_;
  ImpactLimits limits_;
  const std::vector<ContactPair>& pairs_;
  RigidMotions motions_;
  UnionFind bonded_;                ///< blocks that bonds hold together, and the ground behind them
  std::vector<std::size_t> group_;  ///< by block: another one of its group, itself: the first
  std::vector<bool> meets_;         ///< by first block of a group
  std::vector<std::vector<TouchingPoint>> touching_;  ///< by pair
  std::map<int, int> bodies_;                         ///< by block
  std::vector<double> inertia_;
  std::vector<int> sizes_;
  std::vector<ImpactPoint> points_;
  std::vector<Eigen::Vector3d> driven_;  ///< velocity of each point by moving supports, m/s
};

bool any_rebounds(const std::vector<ContactPair>& pairs) {
  return std::any_of(pairs.begin(), pairs.end(),
                     [](const ContactPair& pair) { return pair.restitution().has_value(); });
}

}  // namespace

std::optional<double> share_until_impact(const BlockSystem& system, const RunState& state, double step,
                                         const StepProblem& problem) {
  if (!any_rebounds(problem.pairs)) return std::nullopt;
  RigidMotions motions(system, state.states);
  const ImpactLimits limits = limits_of(system.settings(), state.time());
  double first = std::numeric_limits<double>::infinity();
  for (const ContactPair& pair : problem.pairs)
    if (pair.restitution()) first = std::min(first, first_impact(problem, step, pair, limits, motions));
  if (std::isinf(first)) return std::nullopt;
  // A prediction that does not shorten the step has missed what turns or bends.
  constexpr double shorter = 0.999;
  return first < shorter * step ? first / step : 0.5;
}

bool rebound(const BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs) {
  if (!any_rebounds(pairs)) return false;
  ImpactOfBlocks impact(system, state, pairs);
  if (!impact.find()) return false;
  impact.apply();
  return true;
}

}  // namespace ashlar
