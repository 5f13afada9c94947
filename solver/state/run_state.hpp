// All data of a run that change from step to step, as plain values: a copy is a snapshot of the run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mechanics/contact/contact_points.hpp"
#include "solver/block_pair.hpp"
#include "solver/bolts/bolt.hpp"
#include "solver/contact/contact_finder.hpp"
#include "solver/contact/depth_audit.hpp"
#include "solver/contact/pair_history.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/state/ledger_keeper.hpp"
#include "solver/state/sleep.hpp"
#include "solver/state/static_state.hpp"
#include "solver/state/step_clock.hpp"

namespace ashlar {

/// Reason for cutting a step.
enum class RejectionReason {
  open_close_not_converged,  ///< reduce time_step or the stiffness of the joints
  not_positive_definite,     ///< a joint or material far too stiff for the step
  passing,                   ///< blocks would have passed through each other: cut to the first touch
  no_shape,                  ///< an incremental block would have been inverted: reduce time_step
  not_finite,                ///< a state outside the range of double precision: check loads, stiffness and
                             ///< time_step
  inside_out,                ///< a block would have been inverted: stiffer material or less load
  too_deep,                  ///< blocks deeper in each other than allowed: see settings.depth.allowed_depth
};
[[nodiscard]] std::string to_string(RejectionReason reason);

/// A rejected step.
struct Rejection {
  double time;  ///< s, at its start
  double step;  ///< s, its length
  RejectionReason reason;
};

/// Fault of a state at the end of a step.
struct StateFault {
  RejectionReason reason;  ///< not_finite, inside_out, too_deep or open_close_not_converged
  /// Both indices are the block of a single one; too_deep: the first is in the second; open_close_not_converged: blocks
  /// of the pair whose contact points have changed state most often
  BlockPair blocks;
  double depth = 0.0;               ///< m, of too_deep
  double allowed = 0.0;             ///< m
  Vector3 place = Vector3::Zero();  ///< m
};

/// Work done and skipped so far.
struct SimulationCounts {
  FinderCounts finder;
  std::uint64_t contact_points = 0;
  std::uint64_t open_close_iterations = 0;
  std::uint64_t open_close_fallbacks = 0;  ///< times Newton's iteration stalled (open_close.hpp)
  std::uint64_t passing_contacts =
      0;  ///< contacts added because blocks resting on each other's edges would pass
  std::uint64_t islands_put_to_sleep = 0;
  std::uint64_t sleeping_block_steps = 0;  ///< blocks that slept, summed over steps
  FactorCounts factors;
};

/// The contact points of one pair of blocks at the end of an accepted step.
struct PairRecord {
  int a;
  int b;
  std::vector<ContactPoint> points;  ///< places are those at the start of the step
  std::vector<PointResponse> responses;
  std::vector<double> gaps;  ///< at the end of the step, m
  double work;               ///< of the contact forces on both blocks since the start of the run, J
};
/// Sum of the contact forces on the block `a` of a pair, N.
[[nodiscard]] Vector3 force_on_a(const PairRecord& record);

/// Summary of the last accepted step.
struct StepReport {
  double step = 0.0;
  int iterations = 0;  ///< largest number in any island
  int open = 0;
  int locked = 0;
  int sliding = 0;
  double penetration = 0.0;  ///< largest of any contact point, m, >= 0
  /// True depth of the deepest point of any block in another one, beyond the initial overlap, m, >= 0
  double depth = 0.0;
};
/// Adds points to the numbers of a report by their states.
void count_states(const std::vector<PointResponse>& points, StepReport& report);

/// Largest penetration of any block in another one.
struct DeepestPoint {
  BlockPair blocks = {-1, -1};      ///< the first is in the second; -1: no penetration so far
  double depth = 0.0;               ///< m, beyond the initial overlap
  double share = 0.0;               ///< depth over the size of the smaller block
  double time = 0.0;                ///< s
  Vector3 place = Vector3::Zero();  ///< m
};

/// Joint that stiffens as it closes (NormalSpring), where it was closed the most.
struct MostClosed {
  BlockPair blocks = {-1, -1};
  double share = 0.0;  ///< of its largest closure; 0: none has been closed
  double time = 0.0;   ///< s
};

/// Friction at points that slid on multipliers, compared with Coulomb's law for their normal forces.
struct FrictionTally {
  double due = 0.0;    ///< N s, tan(phi) times normal impulses, and cohesion
  double acted = 0.0;  ///< N s, of the shear forces

  /// Relative difference of the actual friction from Coulomb's value; < 0: less.
  [[nodiscard]] double excess() const { return due > 0.0 ? acted / due - 1.0 : 0.0; }
};

/// Slip of dilating joints in steps, area times slip, m^3: joints in flight do not dilate.
struct DilatingSlip {
  double all = 0.0;
  double in_flight = 0.0;  ///< while no point of a pair that has dilated touches

  [[nodiscard]] double flown_share() const { return all > 0.0 ? in_flight / all : 0.0; }
};

/// Impacts solved so far (impact.hpp). All processes solve all of them.
struct ImpactTally {
  std::uint64_t count = 0;
  std::uint64_t inaccurate = 0;  ///< whose residual exceeds impact_accuracy
  std::uint64_t unlike = 0;      ///< of joints with different coefficients of restitution at one moment
  double residual = 0.0;         ///< largest, of the fastest velocity of an impact
  double time = 0.0;             ///< s, of the largest
};

/// Largest rotation of a block within one step.
struct LargestTurn {
  int block = -1;             ///< -1: none so far
  double angle = 0.0;         ///< rad, to first order in the rotation
  double time = 0.0;          ///< s, at the end of the step
  std::uint64_t limited = 0;  ///< steps that were shortened for a turn (step/accept/turn_limit.hpp)
};

/// Wall time of the parts of a step, s.
struct PhaseSeconds {
  double contact_search = 0.0;
  double contact_points = 0.0;
  double solve = 0.0;
  double motion_check = 0.0;
  double depth_audit = 0.0;
};

/// Work done by a run and its cost.
struct RunLog {
  std::vector<Rejection> rejections;
  SimulationCounts counts;  ///< of finder and factors: including those of the run that this one continues
  PhaseSeconds seconds;
};

/// Extremes of penetration and of errors of contact.
struct ContactExtremes {
  double penetration = 0.0;  ///< of contact points, m
  DeepestPoint deepest;      ///< of any corner or edge, independent of contacts (depth_audit.hpp)
  /// 0 for contact by springs, whose friction obeys Coulomb's law at each point and time
  FrictionTally sliding_friction;
  DilatingSlip dilating_slip;
  MostClosed most_closed;
  ImpactTally impacts;
  LargestTurn turn;  ///< of steps in time
};

/// Vectors are by block.
struct RunState {
  StepClock clock;
  double next_step = 0.0;  ///< s, grows back to settings.time_step after cuts
  int steps = 0;
  bool remembers_statics = false;  ///< contacts were detected before the first step
  std::vector<BlockState> states;
  /// a of time_scheme.hpp, (p, 3) for each block; empty if the integrator does not use it
  std::vector<Eigen::MatrixX3d> accelerations;
  /// J, <= 0: energy generated by dda steps, to be dissipated before spin may use any
  std::vector<double> spin_debts;
  PairHistories pairs;
  KnownDepths depths;
  std::vector<BoltState> bolts;  ///< by bolt of the system
  StaticState statics;
  Sleep sleep;
  LedgerKeeper ledger;
  StepReport report;
  std::vector<PairRecord> records;
  ContactExtremes extremes;
  RunLog log;

  [[nodiscard]] double time() const { return clock.time(); }
  /// True if the remaining time up to `end_time` is within rounding error. @param time_step of the settings, s
  [[nodiscard]] bool reached(double time_step, double end_time) const {
    return end_time - time() <= time_rounding(time_step, end_time);
  }
  /// True if contacts have been detected before; until then none is treated as newly formed.
  [[nodiscard]] bool has_begun() const { return steps > 0 || remembers_statics; }
};

}  // namespace ashlar
