// A run: blocks, what they remember of their contacts, and the time step that takes them on.
//
// A step: the contacts of all blocks (step_contacts.hpp) and their contact points with memory; islands; an
// open-close iteration per island; a check that no block passes through another; then all blocks move
// together (dynamic_step.hpp; static_analysis.hpp: iterations towards equilibrium).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "solver/statics/static_analysis.hpp"
#include "solver/step/block_changes.hpp"
#include "solver/step/dynamic_step.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// Initial motion of a block.
struct InitialMotion {
  Vector3 velocity = Vector3::Zero();          ///< m/s
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s about the centroid
};

/// A rigid motion of a block: a turn about a point and a translation.
struct RigidDisplacement {
  int block;
  Vector3 about;        ///< m
  Vector3 translation;  ///< m
  Vector3 rotation;     ///< rad, along its axis
};

struct ContactExplanation;  // contact_explanation.hpp
struct RigidModel;          // rigid_model.hpp
struct SimulationSnapshot;  // checkpoint.hpp

/// A scene in motion. Block indices are those of the vector given.
class Simulation {
 public:
  using LawOfPair = BlockSystem::LawOfPair;

  /// @param law joint law of each pair (a < b). @param ties blocks that are bonded over the faces that they have
  /// in common (tie.hpp), with no contacts between them; see system().are_tied() for those that have any
  /// @param absent by block, or empty: see BlockSystem
  /// @throws std::invalid_argument if a tied block is incremental
  Simulation(std::vector<BlockModel> blocks, const std::vector<InitialMotion>& motions, LawOfPair law,
             const SimulationSettings& settings, const std::vector<TieRequest>& ties = {},
             std::vector<bool> absent = {});

  /// Takes pairs of blocks to touch without force where they are placed in each other
  /// (notes/known_overlaps.md). To be called before the first step.
  /// @param depths by pair, m, >= 0. @throws std::invalid_argument if a block is incremental: its material
  /// points do not tell where they were placed
  void start_overlapping(const std::map<PairKey, double>& depths);

  /// Moves every block whose supports leave no rigid motion to its equilibrium under gravity and the loads at
  /// time 0, contacts off, at rest. To be called before the first step. Incremental blocks go there in steps,
  /// as far as settings.settling_steps takes them. @return the blocks that are there
  std::vector<int> settle_supported_blocks();

  /// Takes the blocks to their equilibrium under gravity and the loads at time 0, contacts on, by a static
  /// analysis; initial velocities are theirs then (static_start.hpp). To be called before the first step.
  /// @param goes_on asked before each iteration: if not, it ends there
  /// @return how it ended, balancing if it was ended; unless that is equilibrium all is as placed
  [[nodiscard]] StaticStatus start_from_statics(const std::function<bool()>& goes_on = [] { return true; });

  /// Goes on from where a simulation of the same blocks has ended (stage_start.hpp). To be called before the
  /// first step. @param was_absent in it, by block
  /// @throws std::invalid_argument if it is one of other blocks, or of other orders
  void start_stage(const SimulationSnapshot& end, const std::vector<bool>& was_absent);

  /// Whether nothing is left up to `end_time` but rounding, or less than 1e-9 of a step.
  [[nodiscard]] bool reached(double end_time) const;
  /// Takes one step of at most settings.time_step, and not beyond `end_time`, which is not yet reached. A
  /// step that ends there but for rounding is not fitted to it, so that a run that goes on later has had the
  /// same steps.
  [[nodiscard]] StepStatus step(double end_time);

  /// Takes one iteration of a static analysis towards equilibrium under the loads of `end_time`. Velocities
  /// are dropped. @throws std::logic_error if a block is incremental. time() is that of the loads; a report's
  /// step is the length of the dda step that the iteration is.
  [[nodiscard]] StaticStatus static_step(double end_time);
  /// The same, which ends as moving as soon as a block is sure to go so far. @param far in block sizes, > 0
  [[nodiscard]] StaticStatus static_step(double end_time, double far);
  /// The blocks as they lie as rigid bodies, for limit analysis. @param end_time of the loads, s
  /// @param multiplied by block: whether its loads are those that a factor multiplies; empty: none
  /// @throws std::invalid_argument if a block is incremental
  [[nodiscard]] RigidModel rigid_model(double end_time, const std::vector<bool>& multiplied = {}) const;
  /// Places blocks elsewhere, at rest and without contacts, as a step of its own: for showing how they set off.
  void displace(const std::vector<RigidDisplacement>& displacements);
  /// Blocks that a static analysis found to be moving, and others that move with them.
  [[nodiscard]] std::vector<MovingBlock> moving_blocks() const;
  /// Wakes blocks that sleep (step/sleeping_islands.hpp). To be called where joint laws have changed.
  void wake();
  /// Sets of blocks in contact with each other that no fixed block, contact or support keeps from moving: no
  /// static analysis can hold them. A block alone is one of them if its supports leave any rigid motion.
  [[nodiscard]] std::vector<std::vector<int>> loose_blocks();

  /// Multiplies a load of a block by a factor on top of its history, from the next step on. A static analysis takes
  /// up its load anew; blocks that sleep are woken.
  /// @param load index into blocks()[block].loads(). @throws std::out_of_range if there is no such block or load,
  /// std::invalid_argument if the factor is not finite: nothing has changed then
  void set_load_factor(int block, int load, double factor);

  /// Changes the order of a moving block of the total formulation between two steps. Contacts keep their
  /// memory; raising loses nothing, and what lowering drops of the energy is booked as numerical. A static
  /// analysis takes up its load anew.
  /// @throws std::invalid_argument for other blocks or an order that the block cannot have: nothing has
  /// changed then
  DroppedByOrder change_order(int block, int order);

  /// All that has changed since construction, and back (checkpoint.hpp).
  [[nodiscard]] SimulationSnapshot snapshot() const;
  /// @throws std::invalid_argument if the snapshot was taken of other blocks.
  void restore(const SimulationSnapshot& snapshot);

  [[nodiscard]] const BlockSystem& system() const { return system_; }
  [[nodiscard]] double time() const { return state_.time(); }
  [[nodiscard]] int steps() const { return state_.steps; }
  [[nodiscard]] const std::vector<BlockModel>& blocks() const { return system_.blocks(); }
  [[nodiscard]] const std::vector<BlockState>& states() const { return state_.states; }
  /// Surfaces as the last step's search had them, and where they came from.
  [[nodiscard]] const ContactFinder& finder() const { return contacts_.finder(); }
  [[nodiscard]] const StepReport& report() const { return state_.report; }
  [[nodiscard]] const std::vector<PairRecord>& contacts() const { return state_.records; }
  [[nodiscard]] const PairHistories& histories() const { return state_.pairs; }
  [[nodiscard]] const Ledger& ledger() const { return state_.ledger.ledger(); }
  /// Largest change of the residual in one step and largest energy so far, J.
  [[nodiscard]] double largest_step_residual() const { return state_.ledger.largest_step_residual(); }
  [[nodiscard]] double largest_energy() const { return state_.ledger.largest_energy(); }
  /// Of contact points, m.
  [[nodiscard]] double largest_penetration() const { return state_.extremes.penetration; }
  /// Of any corner or edge, whatever its contacts say (depth_audit.hpp).
  [[nodiscard]] const DeepestPoint& deepest() const { return state_.extremes.deepest; }
  /// 0 where contact is springs, whose friction is Coulomb's at each point and time.
  [[nodiscard]] const FrictionTally& sliding_friction() const { return state_.extremes.sliding_friction; }
  /// Of all steps. 0 where no joint dilates.
  [[nodiscard]] const DilatingSlip& dilating_slip() const { return state_.extremes.dilating_slip; }
  /// Contacts of two blocks as the next step will find them, and those that it will leave out, each with its reason.
  /// @throws std::invalid_argument if there are no such blocks or they are the same
  [[nodiscard]] ContactExplanation explain_contacts(int a, int b) const;
  /// Measures how deep blocks are in each other now. @return the pair that is too deep by most
  std::optional<StateFault> audit();
  /// What was wrong with the end of the last rejected step, if that was why.
  [[nodiscard]] const std::optional<StateFault>& fault() const { return fault_; }
  [[nodiscard]] Vector3 momentum() const;
  [[nodiscard]] Vector3 angular_momentum() const;
  [[nodiscard]] int unknowns() const { return system_.unknowns(); }
  [[nodiscard]] const std::vector<Rejection>& rejections() const { return state_.log.rejections; }
  [[nodiscard]] SimulationCounts counts() const;
  [[nodiscard]] const PhaseSeconds& seconds() const { return state_.log.seconds; }

 private:
  [[nodiscard]] RunContext context();

  BlockSystem system_;
  RunState state_;
  StepContacts contacts_;
  FactorCache factors_;
  DepthAudit audit_;
  std::optional<StateFault> fault_;
};

}  // namespace ashlar
