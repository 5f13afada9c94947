// A run: blocks, the memory of their contacts, and the time step.
//
// A step: the contacts of all blocks (step_contacts.hpp) and their contact points with memory; islands; an
// open-close iteration per island; a check that no block passes through another; then all blocks move
// together (dynamic_step.hpp; static_analysis.hpp: iterations towards equilibrium).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/ground/initial_stress.hpp"
#include "solver/shared/ghosts.hpp"
#include "solver/shared/pairs_of_run.hpp"
#include "solver/shared/run_totals.hpp"
#include "solver/statics/static_analysis.hpp"
#include "solver/step/accept/block_changes.hpp"
#include "solver/step/dynamic_step.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// Initial motion of a block.
struct InitialMotion {
  Vector3 velocity = Vector3::Zero();          ///< m/s
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s about the centroid
};

struct ContactExplanation;  // contact_explanation.hpp
struct RigidModel;          // rigid_model.hpp
struct SimulationSnapshot;  // checkpoint.hpp

/// A dynamic or static simulation of a scene. Block indices are those of the vector given.
class Simulation {
 public:
  using LawOfPair = BlockSystem::LawOfPair;

  /// @param law joint law of each pair (a < b). @param ties blocks bonded over their common faces (tie.hpp), without
  /// contacts between them; see system().are_tied() for pairs that have any
  /// @param absent by block, or empty: see BlockSystem
  /// @throws std::invalid_argument if a tied block is incremental
  Simulation(std::vector<BlockModel> blocks, const std::vector<InitialMotion>& motions, LawOfPair law,
             const SimulationSettings& settings, const std::vector<TieRequest>& ties = {},
             std::vector<bool> absent = {});
  /// The part of one rank in a simulation that several ranks share (shared/ghosts.hpp, notes/ranks.md): dynamics and
  /// statics of contacts with springs or multipliers. Steps, iterations and starts from statics are then collective,
  /// and have the same status on all ranks. Sums over blocks, pairs and points are those of this rank;
  /// gathered_run.hpp has those of the run.
  /// @param blocks share_blocks(). Others as above, the same on all ranks
  Simulation(BlocksOfRank blocks, const std::vector<InitialMotion>& motions, LawOfPair law,
             const SimulationSettings& settings, const std::vector<TieRequest>& ties = {});

  /// Pressure of water in the joint of two blocks at a place of the placed blocks, Pa; only results use it.
  using JointPressure = std::function<double(int a, int b, const Vector3& place)>;
  void set_joint_pressure(JointPressure pressure) { joint_pressure_ = std::move(pressure); }
  /// Empty: no joint holds water.
  [[nodiscard]] const JointPressure& joint_pressure() const { return joint_pressure_; }

  /// @name The start of a run
  /// Nothing changes, and std::logic_error is thrown, once contacts have been detected: by a step, an iteration, a static
  /// start, the start of a stage, or in the snapshot restored last.
  /// @{
  /// Contacts of blocks with initial stress begin with its forces (initial_stress.hpp).
  /// @return the block that is farthest from balance
  std::optional<StressImbalance> start_stressed();
  /// Lets pairs of blocks with an initial overlap touch without force (notes/known_overlaps.md).
  /// @param depths by pair, m, >= 0. @throws std::invalid_argument if a block is incremental: its material points do
  /// not store their initial places; std::logic_error after start_stressed(), too, whose forces depend on overlaps.
  /// With several ranks collective, with the same depths on all
  void start_overlapping(const std::map<PairKey, double>& depths);

  /// Adds bolts and props, those that are installed without forces but for their pretension, in the present state.
  /// @throws std::invalid_argument if a block of a bolt is incremental; std::logic_error if there are bolts, too.
  /// With several ranks collective, with the same bolts on all
  void add_bolts(std::vector<Bolt> bolts);

  /// Moves every block whose supports prevent all rigid motions to its equilibrium under gravity and the loads at
  /// time 0, at rest, without contacts. Incremental blocks get there in at most
  /// settings.settling_steps steps. @return the blocks in equilibrium
  std::vector<int> settle_supported_blocks();

  /// Moves the blocks to their equilibrium under gravity and the loads at time 0, with contacts, by a static
  /// analysis, and then sets their initial velocities (static_start.hpp).
  /// @param may_continue called before each iteration: false ends the analysis; the same on all ranks
  /// @return status of the analysis, balancing if it was ended; unless it is equilibrium all blocks are as placed
  [[nodiscard]] StaticStatus start_from_statics(const std::function<bool()>& may_continue);
  /// The same, to its end.
  [[nodiscard]] StaticStatus start_from_statics();

  /// Continues from the end of a simulation of the same blocks (stage_start.hpp).
  /// @param was_absent in it, by block
  /// @throws std::invalid_argument if it has other blocks or other orders, or on several ranks
  void start_stage(const SimulationSnapshot& end, const std::vector<bool>& was_absent);
  /// The same with the simulation itself. On several ranks collective: of a simulation of the same ranks, whose blocks may
  /// have had other owners, after its gather_results(). Counts of the work of ranks continue.
  void start_stage(const Simulation& last);
  /// @}

  /// Puts the results of all ranks together on the first one: its report(), ledger() and other sums are those of the run
  /// until the next step, and so are states(), contacts() and areas of bonds in histories() as far as asked for; contacts()
  /// are no others. Collective; no effect without ranks.
  /// @param needs for all, the first rank has to have the models of all blocks (share_blocks)
  /// @param shown of the pairs that this rank owns
  void gather_results(const ResultNeeds& needs = {}, const ShownContacts& shown = {});
  /// Shown contacts of all ranks; null: results have not been gathered, or there are no ranks.
  [[nodiscard]] const ShownContacts* shown_contacts() const { return told_ ? &told_->totals.shown : nullptr; }

  /// True if the remaining time up to `end_time` is within rounding error or less than 1e-9 of a step.
  [[nodiscard]] bool reached(double end_time) const;
  /// Takes one step of at most settings.time_step that does not pass `end_time`, which is not yet reached. A step
  /// that ends at `end_time` but for rounding is not snapped to it, so that a run continued later has had the same
  /// steps.
  [[nodiscard]] StepStatus step(double end_time);

  /// Takes one iteration of a static analysis towards equilibrium under the loads at `end_time`. Velocities are set
  /// to zero. time() is that of the loads; the step of a report is the length of the dda step equivalent to the
  /// iteration.
  /// @throws std::logic_error if a block is incremental
  [[nodiscard]] StaticStatus static_step(double end_time);
  /// The same, with an early stop as moving once a block is certain to go so far. @param far in block sizes, > 0
  [[nodiscard]] StaticStatus static_step(double end_time, double far);
  /// True if a static analysis has ended with the equilibrium of rigid blocks (rigid_verdict.hpp).
  [[nodiscard]] bool rests_rigidly() const { return state_.statics.rests_rigidly; }
  /// The blocks at their present positions as rigid bodies, for limit analysis; of one rank that has all of them.
  /// @param end_time of the loads, s
  /// @param multiplied by block: true if its loads are multiplied by a factor; empty: none
  /// @throws std::invalid_argument if a block is incremental
  [[nodiscard]] RigidModel rigid_model(double end_time, const std::vector<bool>& multiplied = {}) const;
  /// The same where the present load level of a static analysis began.
  [[nodiscard]] RigidModel level_model(double end_time) const;
  /// The same with springs in its joints, for a load path (load_path.hpp).
  [[nodiscard]] RigidModel spring_model(double end_time, const std::vector<bool>& multiplied = {}) const;
  /// Places blocks elsewhere, at rest and with forces found otherwise in their contacts, as a step of its own: to show the
  /// state that an answer speaks of. On several ranks the same on all.
  /// @param positions reference coefficients by block, (p, 3); empty: all blocks as they are. @param end_time of the
  /// loads, s
  void show(const std::vector<Eigen::MatrixX3d>& positions, const std::vector<PairRecord>& contacts,
            double end_time);
  /// Blocks that a static analysis found to be moving, including blocks carried along. On several ranks those of this
  /// one, on the first one after gather_results() those of all.
  [[nodiscard]] std::vector<MovingBlock> moving_blocks() const;
  /// Wakes sleeping blocks (step/detect/sleeping_islands.hpp). To be called when joint laws have changed.
  void wake();
  /// Sets of blocks in contact with each other that no fixed block, contact or support restrains: no static analysis
  /// can hold them. Includes single blocks whose supports allow any rigid motion. On several ranks collective, and the
  /// same on all.
  [[nodiscard]] std::vector<std::vector<int>> loose_blocks();

  /// Multiplies a load of a block by a factor in addition to its history, from the next step on. A static analysis
  /// starts a new load level; sleeping blocks are woken.
  /// @param load index into blocks()[block].loads(). @throws std::out_of_range if there is no such block or load,
  /// std::invalid_argument if the factor is not finite: nothing changes in these cases
  void set_load_factor(int block, int load, double factor);

  /// Changes the order of a moving block of the total formulation between two steps. Contacts keep their memory. A
  /// higher order is exact; the energy lost with a lower one is booked as numerical. A static analysis starts a new
  /// load level.
  /// @throws std::invalid_argument for other blocks or an order that the block cannot have: nothing changes then
  DroppedByOrder change_order(int block, int order);

  /// Changes settings.time_step between two steps. It is not part of a snapshot. @param step s
  /// @throws std::invalid_argument unless it is > 0
  void set_time_step(double step);
  /// Changes SearchSettings::chord_tolerance between two steps: contacts are detected again with other sub-faces, and keep
  /// their memory. It is not part of a snapshot. A static analysis starts a new load level.
  /// @param tolerance m. @throws std::invalid_argument unless it is > 0
  void set_chord_tolerance(double tolerance);

  /// All data changed since construction (checkpoint.hpp); restore() sets them. On several ranks both are collective
  /// (shared/shared_snapshot.hpp): the first rank has the snapshot of the run after gather_results(), however little it asked
  /// for, and all restore it.
  [[nodiscard]] SimulationSnapshot snapshot() const;
  /// The same without pairs and records. Collective
  [[nodiscard]] SimulationSnapshot snapshot_without_pairs() const;
  /// Pairs and records of the present state, to be written as they come from other ranks. The state must not change before.
  [[nodiscard]] PairsOfRun pairs_of_run(PairVisitors visitors = PairVisitors::first) const;
  /// @throws std::invalid_argument if the snapshot was taken of other blocks.
  void restore(const SimulationSnapshot& snapshot);

  [[nodiscard]] const BlockSystem& system() const { return system_; }
  [[nodiscard]] double time() const { return state_.time(); }
  [[nodiscard]] int steps() const { return state_.steps; }
  [[nodiscard]] const std::vector<BlockModel>& blocks() const { return system_.blocks(); }
  [[nodiscard]] const std::vector<BlockState>& states() const { return state_.states; }
  /// Surfaces in the last step's search, and their origins.
  [[nodiscard]] const ContactFinder& finder() const { return caches_.contacts.finder(); }
  [[nodiscard]] const StepReport& report() const { return told_ ? told_->totals.report : state_.report; }
  [[nodiscard]] const std::vector<PairRecord>& contacts() const {
    return told_ ? told_->contacts : state_.records;
  }
  [[nodiscard]] const PairHistories& histories() const { return state_.pairs; }
  /// By point of a record in contacts(): 1 if its joint has lost its strength (lost_strength.hpp).
  [[nodiscard]] std::vector<char> points_without_strength(const PairRecord& record) const;
  /// By bolt of system().
  [[nodiscard]] const std::vector<BoltState>& bolts() const { return state_.bolts; }
  [[nodiscard]] const Ledger& ledger() const { return told_ ? told_->totals.ledger : state_.ledger.ledger(); }
  /// Largest change of the residual in one step and largest energy so far, J.
  [[nodiscard]] double largest_step_residual() const { return state_.ledger.largest_step_residual(); }
  [[nodiscard]] double largest_energy() const { return state_.ledger.largest_energy(); }
  [[nodiscard]] const ContactExtremes& extremes() const {
    return told_ ? told_->totals.extremes : state_.extremes;
  }
  /// Largest penetration of contact points, m.
  [[nodiscard]] double largest_penetration() const { return extremes().penetration; }
  /// Largest depth of any corner or edge, independent of contacts (depth_audit.hpp).
  [[nodiscard]] const DeepestPoint& deepest() const { return extremes().deepest; }
  /// Of all steps in time so far.
  [[nodiscard]] const LargestTurn& largest_turn() const { return extremes().turn; }
  /// 0 for contact by springs, whose friction obeys Coulomb's law at each point and time.
  [[nodiscard]] const FrictionTally& sliding_friction() const { return extremes().sliding_friction; }
  /// Sum over all steps. 0 if no joint dilates.
  [[nodiscard]] const DilatingSlip& dilating_slip() const { return extremes().dilating_slip; }
  [[nodiscard]] const MostClosed& most_closed() const { return extremes().most_closed; }
  /// Impacts of joints with restitution.
  [[nodiscard]] const ImpactTally& impacts() const { return extremes().impacts; }
  /// Contacts of two blocks that the next step will detect, and those that it will remove, each with the reason.
  /// @throws std::invalid_argument if there are no such blocks or they are the same
  [[nodiscard]] ContactExplanation explain_contacts(int a, int b) const;
  /// Measures the present penetrations of blocks. @return the pair that exceeds its allowed depth by most
  std::optional<StateFault> audit();
  /// Fault at the end of the last rejected step, if it was rejected for one.
  [[nodiscard]] const std::optional<StateFault>& fault() const { return fault_; }
  [[nodiscard]] Vector3 momentum() const;
  [[nodiscard]] Vector3 angular_momentum() const;
  [[nodiscard]] int unknowns() const { return told_ ? told_->totals.unknowns : system_.unknowns(); }
  [[nodiscard]] const std::vector<Rejection>& rejections() const { return state_.log.rejections; }
  [[nodiscard]] SimulationCounts counts() const;
  /// Of this rank alone; the first one of a resumed run has those of the earlier run, too.
  [[nodiscard]] SimulationCounts own_counts() const;
  /// Weight of the blocks of this rank after the last step (shared/rank_balance.hpp); 0 without ranks.
  [[nodiscard]] double own_weight() const;
  /// Null: one rank has all blocks.
  [[nodiscard]] const SharedBlocks* shared_blocks() const { return shared_.get(); }
  [[nodiscard]] const PhaseSeconds& seconds() const { return state_.log.seconds; }

 private:
  Simulation(std::unique_ptr<SharedBlocks> shared, std::vector<BlockModel> blocks,
             const std::vector<InitialMotion>& motions, LawOfPair law, const SimulationSettings& settings,
             const std::vector<TieRequest>& ties, std::vector<bool> absent);
  [[nodiscard]] RunContext context();
  /// @throws std::invalid_argument if several ranks share the run. @param what they cannot do, to begin a sentence
  void refuse_ranks(const char* what) const;
  /// @throws std::logic_error if contacts have been detected. @param call name of the function of the start
  void refuse_late(const char* call) const;

  std::unique_ptr<SharedBlocks> shared_;  ///< null: one rank has all blocks
  BlockSystem system_;
  RunState state_;
  StepCaches caches_;
  std::optional<StateFault> fault_;
  JointPressure joint_pressure_;
  std::optional<ToldResults> told_;  ///< of all ranks, until the next step
};

}  // namespace ashlar
