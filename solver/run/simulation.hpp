// A run: blocks, what they remember of their contacts, and the time step that takes them on.
//
// A step: the contacts of all blocks (contact_finder.hpp) and their contact points with memory; islands; an
// open-close iteration per island; a check that no block passes through another; then all blocks move
// together. A step that does not settle is cut in half, one in which blocks would pass is cut to their first
// touch, with the reason recorded; nothing of the state changes until a step is accepted.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "solver/contact/contact_accounts.hpp"
#include "solver/contact/contact_finder.hpp"
#include "solver/contact/depth_audit.hpp"
#include "solver/contact/internal_edges.hpp"
#include "solver/run/ledger.hpp"
#include "solver/run/step_clock.hpp"
#include "solver/settings.hpp"
#include "solver/statics/static_analysis.hpp"
#include "solver/step/island.hpp"
#include "solver/step/lone_body.hpp"

namespace ashlar {

/// Why a step was cut.
enum class RejectionReason {
  open_close_not_settled,  ///< reduce time_step or the stiffness of the joints
  not_positive_definite,   ///< a joint or material far too stiff for the step
  passing,                 ///< blocks would have passed through each other: cut to the first touch
  no_shape,                ///< an incremental block would have turned inside out: reduce time_step
  not_finite,              ///< a state that doubles cannot hold: check loads, stiffness and time_step
  inside_out,              ///< a block would have turned inside out: stiffer material or less load
  too_deep,                ///< blocks deeper in each other than allowed: see settings.allowed_depth
};
[[nodiscard]] std::string to_string(RejectionReason reason);

/// A rejected step.
struct Rejection {
  double time;  ///< s, at its start
  double step;  ///< s, its length
  RejectionReason reason;
};

/// Why a state is no state that a step may end in.
struct StateFault {
  RejectionReason reason;           ///< not_finite, inside_out or too_deep
  std::array<int, 2> blocks;        ///< of one block: the same twice; too_deep: the first is in the second
  double depth = 0.0;               ///< m, of too_deep
  double allowed = 0.0;             ///< m
  Vector3 place = Vector3::Zero();  ///< m
};

/// How a step ended.
enum class StepStatus {
  accepted,
  too_many_cuts,  ///< the state is that of the last accepted step; see Simulation::rejections
};

/// Work done and skipped so far.
struct SimulationCounts {
  FinderCounts finder;
  std::uint64_t contact_points = 0;
  std::uint64_t open_close_iterations = 0;
  std::uint64_t open_close_fallbacks = 0;  ///< times Newton went round in circles (open_close.hpp)
  std::uint64_t passing_contacts =
      0;  ///< contacts added because blocks at rest on each other's rim would pass
  FactorCounts factors;
};

/// The contact points of one pair of blocks as an accepted step left them.
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

/// What the last accepted step did.
struct StepReport {
  double step = 0.0;
  int iterations = 0;  ///< most of any island
  int open = 0;
  int locked = 0;
  int sliding = 0;
  double penetration = 0.0;  ///< largest of any contact point, m, >= 0
  double depth = 0.0;        ///< true depth of the deepest point of any block in another one, m, >= 0
};

/// The deepest that any block has been in another one.
struct DeepestPoint {
  std::array<int, 2> blocks = {-1, -1};  ///< the first is in the second; -1: none has been
  double depth = 0.0;                    ///< m
  double share = 0.0;                    ///< depth over the size of the smaller block
  double time = 0.0;                     ///< s
  Vector3 place = Vector3::Zero();       ///< m
};

/// Friction at points that slid on multipliers, beside what Coulomb's law makes of their normal forces.
struct FrictionTally {
  double due = 0.0;    ///< N s, tan(phi) times normal impulses, and cohesion
  double acted = 0.0;  ///< N s, of the shear forces

  /// By how much of what was due more has acted, < 0: less.
  [[nodiscard]] double excess() const { return due > 0.0 ? acted / due - 1.0 : 0.0; }
};

/// Initial motion of a block.
struct InitialMotion {
  Vector3 velocity = Vector3::Zero();          ///< m/s
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s about the centroid
};

/// What a change of order lost.
struct DroppedByOrder {
  double displacement = 0.0;  ///< root of the mean square over the block, m
  double velocity = 0.0;      ///< likewise, m/s
  double energy = 0.0;        ///< kinetic, elastic and of gravity, J
};

/// Wall time of the parts of a step, s.
struct PhaseSeconds {
  double contact_search = 0.0;
  double contact_points = 0.0;
  double solve = 0.0;
  double motion_check = 0.0;
  double depth_audit = 0.0;
};

struct SimulationSnapshot;  // checkpoint.hpp

/// A scene in motion. Block indices are those of the vector given.
class Simulation {
 public:
  using LawOfPair = std::function<JointLaw(int, int)>;

  /// @param law joint law of each pair (a < b)
  Simulation(std::vector<BlockModel> blocks, std::vector<InitialMotion> motions, LawOfPair law,
             const SimulationSettings& settings);

  /// Moves every block whose supports leave no rigid motion to its equilibrium under gravity and the loads at
  /// time 0, contacts off, at rest. To be called before the first step. Incremental blocks go there in steps,
  /// as far as settings.settling_steps takes them. @return the blocks that are there
  std::vector<int> settle_supported_blocks();

  /// Takes the blocks to their equilibrium under gravity and the loads at time 0, contacts on, by a static
  /// analysis; initial velocities are theirs then (static_start.cpp). To be called before the first step.
  /// @return how it ended; unless that is equilibrium all is as placed
  [[nodiscard]] StaticStatus start_from_statics();

  /// Bonds two blocks over the faces they have in common (tie.hpp), and looks for no contacts between them.
  /// To be called before settle_supported_blocks(), which leaves tied blocks as they are. @param a,b a < b
  /// @param stiffness Pa/m. @return whether they have a common face
  /// @throws std::invalid_argument if one of them is incremental
  bool tie_blocks(int a, int b, double stiffness);

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
  /// Blocks that a static analysis found to be moving, and others that move with them.
  [[nodiscard]] std::vector<MovingBlock> moving_blocks() const;
  /// Sets of blocks in contact with each other that no fixed block, contact or support keeps from moving: no
  /// static analysis can hold them. A block alone is one of them if its supports leave any rigid motion.
  [[nodiscard]] std::vector<std::vector<int>> loose_blocks();

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

  [[nodiscard]] double time() const { return clock_.time(); }
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] const std::vector<BlockModel>& blocks() const { return blocks_; }
  [[nodiscard]] const std::vector<BlockState>& states() const { return states_; }
  /// Surfaces as the last step's search had them, and where they came from.
  [[nodiscard]] const ContactFinder& finder() const { return finder_; }
  [[nodiscard]] const StepReport& report() const { return report_; }
  [[nodiscard]] const std::vector<PairRecord>& contacts() const { return records_; }
  [[nodiscard]] const Ledger& ledger() const { return ledger_; }
  /// Largest change of the residual in one step and largest energy so far, J.
  [[nodiscard]] double largest_step_residual() const { return largest_step_residual_; }
  [[nodiscard]] double largest_energy() const { return largest_energy_; }
  /// Of contact points, m.
  [[nodiscard]] double largest_penetration() const { return largest_penetration_; }
  /// Of any corner or edge, whatever its contacts say (depth_audit.hpp).
  [[nodiscard]] const DeepestPoint& deepest() const { return deepest_; }
  /// 0 where contact is springs, whose friction is Coulomb's at each point and time.
  [[nodiscard]] const FrictionTally& sliding_friction() const { return sliding_friction_; }
  /// Measures how deep blocks are in each other now. @return the pair that is too deep by
  /// most
  std::optional<StateFault> audit();
  /// What was wrong with the end of the last rejected step, if that was why.
  [[nodiscard]] const std::optional<StateFault>& fault() const { return fault_; }
  [[nodiscard]] Vector3 momentum() const;
  [[nodiscard]] Vector3 angular_momentum() const;
  [[nodiscard]] int unknowns() const;
  [[nodiscard]] const std::vector<Rejection>& rejections() const { return rejections_; }
  [[nodiscard]] SimulationCounts counts() const;
  [[nodiscard]] const PhaseSeconds& seconds() const { return seconds_; }

 private:
  using PairKey = std::array<int, 2>;

  struct TiedBlocks {
    int a;
    int b;
    Tie tie;
    double stiffness;  ///< Pa/m
  };
  [[nodiscard]] bool is_tied(std::size_t block) const;
  /// Whether contacts have been looked at before, so that new ones are new.
  [[nodiscard]] bool has_begun() const { return steps_ > 0 || remembers_statics_; }

  /// A step as tried: nothing of it is taken over before it is accepted.
  struct Trial {
    std::vector<ContactPair> pairs;
    std::vector<Island> islands;
    std::vector<BodyStep> bodies;
    std::vector<IslandResult> results;
    std::map<std::size_t, CarriedBlock> carried;  ///< next steps of incremental blocks
    std::vector<PairDepth> depths;                ///< at its end
  };
  /// In parts of a step: a remainder of this length up to the end is no step of its own.
  static constexpr double step_rounding = 1e-9;
  /// Such a remainder in s, and at least the rounding of times near the end.
  [[nodiscard]] double time_rounding(double end_time) const;

  [[nodiscard]] std::vector<FoundContacts> find_contacts(double step);
  /// By how much a block is shorter or longer along a unit direction, in the mean, than it is without load,
  /// m.
  [[nodiscard]] double given_way(int block, const Vector3& direction) const;
  [[nodiscard]] GivenWay blocks_given_way() const;
  /// Of two blocks, at the last search for contacts.
  [[nodiscard]] std::vector<WayOut> ways_out(int a, int b) const;
  /// Which ways out count among some contacts, which must outlive the answer.
  [[nodiscard]] std::function<bool(const WayOut&)> standing_ways(
      const std::vector<FoundContacts>& found) const;
  /// @param hold_energy springs found anew hold no more than at the end of the last step
  [[nodiscard]] std::vector<ContactPair> make_pairs(const std::vector<FoundContacts>& found,
                                                    bool hold_energy);
  [[nodiscard]] IslandStatus try_step(const TimeScheme& scheme, Trial& trial);
  [[nodiscard]] ContactBody body_at_start(int block) const;
  [[nodiscard]] std::vector<PassingBlocks> check_motion(const Trial& trial,
                                                        const std::vector<FoundContacts>& found);
  [[nodiscard]] std::vector<BodyStep> prepare_bodies(const TimeScheme& scheme) const;
  /// Gravity and loads of a block where the integrator takes them, (p, 3).
  [[nodiscard]] Eigen::MatrixX3d external_force(const BlockModel& block, const TimeScheme& scheme) const;
  /// States with the velocities that supports that move are about to have; empty if none moves.
  /// @param step s; 0: as if the iteration of a static analysis took one second
  [[nodiscard]] std::vector<BlockState> driven_states(double step) const;
  /// Accelerations in balance with the smooth forces of the present state.
  [[nodiscard]] std::vector<Eigen::MatrixX3d> smooth_accelerations() const;
  /// Adds contacts for blocks that would pass through each other, pairs kept in order.
  static void add_contacts(const std::vector<PassingBlocks>& passing, std::vector<FoundContacts>& found);

  // position_projection.cpp
  /// Whether multipliers hold points so deep that a step could leave them beyond the penetration tolerance.
  [[nodiscard]] bool too_deep(const std::vector<ContactPair>& pairs) const;
  /// Moves the blocks of such points apart. @param step s. @param additions times that contacts may be added
  /// for blocks that would pass through each other. @return whether any was moved: contacts have to be found
  /// anew then
  bool move_apart(double step, std::vector<ContactPair>& pairs, std::vector<FoundContacts>& found,
                  int additions);
  /// Whether nothing but its own blocks acts on an island beside gravity and loads.
  [[nodiscard]] bool is_free(const Island& island, const std::vector<ContactPair>& pairs) const;
  /// Energy that a motion without velocity takes from outside: of elasticity and gravity without the work of
  /// loads, J. @param bodies of an island
  [[nodiscard]] double energy_of_motion(const std::vector<int>& island,
                                        const std::vector<BodyStep>& bodies) const;

  // end_state.cpp
  /// Whether a block's state at the end of a trial is none that it can have.
  [[nodiscard]] std::optional<StateFault> broken_block(const Trial& trial) const;
  /// How deep blocks are in each other. @param fine see SimulationSettings::fine_audit_interval
  [[nodiscard]] std::vector<PairDepth> measure_depths(const std::vector<BlockState>& states, bool fine);
  /// The same at the end of a trial. @return the pair that is too deep by most
  [[nodiscard]] std::optional<StateFault> audit_depths(Trial& trial, bool fine);
  /// @param known depths of contacts, m
  [[nodiscard]] std::optional<StateFault> too_deep_of(const std::vector<PairDepth>& depths,
                                                      const std::map<PairKey, double>& known) const;
  void note_depths(const std::vector<PairDepth>& depths);
  /// block_size of the smaller of two blocks, m.
  [[nodiscard]] double smaller_size(const std::array<int, 2>& blocks) const;
  [[nodiscard]] std::vector<BlockState> states_after(const Trial& trial) const;
  /// Of a block that is new: what broken_block() needs.
  void note_gradients(std::size_t block);
  /// Takes note of a state that a step would have ended in.
  void reject(double step, const StateFault& fault);
  /// Takes note of a step whose islands found no balance: why, or that their numbers have overflowed.
  void reject_unsettled(double step, IslandStatus status, const Trial& trial);

  // block_changes.cpp
  [[nodiscard]] bool any_incremental() const;
  /// Makes the next steps of incremental blocks. @return false if one would be no block any more
  [[nodiscard]] bool carry_blocks(Trial& trial) const;
  void start_carried_step(std::size_t block, CarriedBlock next);
  void replace_model(std::size_t block, BlockModel model);

  // accepted_step.cpp
  void accept(const TimeScheme& scheme, Trial& trial);
  /// Takes one block on to the end of the step, with its entries of the ledger. @return energy that the
  /// integrator takes beside that of elasticity and contacts, J
  double move_block(std::size_t block, const TimeScheme& scheme, const BodyStep& body);
  /// Of free blocks, see angular_momentum.hpp. @param before states at the start of the step
  /// @param dissipated by the integrator in each block, J
  void keep_angular_momentum(const TimeScheme& scheme, const Trial& trial,
                             const std::vector<BlockState>& before, const std::vector<double>& dissipated);

  // velocity_contact.cpp
  /// What a pair's impulses at the end of a step do.
  struct StoppedPair {
    /// Of its points in their frames, impulse over step, N; empty: none
    std::vector<Eigen::Vector3d> forces;
    double work = 0.0;  ///< on both blocks, J
  };
  /// Stops what pushes at the end of a step. @return by pair
  std::vector<StoppedPair> stop_at_contacts(const TimeScheme& scheme, const Trial& trial);
  /// @param bodies models, and changes that are zero. @param stopped of the island's pairs is written
  void stop_island(const TimeScheme& of_step, const Island& island, const std::vector<ContactPair>& pairs,
                   const IslandResult& result, std::vector<BodyStep>& bodies,
                   std::vector<StoppedPair>& stopped);

  // rigid_onset.cpp
  /// Takes what giving way does out of the accelerations of an iteration of a static analysis. Before the
  /// trial is accepted. @param accelerations (p, 3) of each moving block. @return whether all are those of
  /// rigid blocks now
  [[nodiscard]] bool set_off(const TimeScheme& scheme, const Trial& trial,
                             std::vector<Eigen::MatrixX3d>& accelerations);

  // accepted_step.cpp
  /// Books what the springs hold anew since the end of the last step.
  void book_refound(const std::vector<ContactPair>& pairs);
  /// Counts it; what multipliers give beyond what they have taken so far is booked as gained.
  /// @param work that they have taken from the blocks of a pair in the step, J; negative: given
  void take_for_multipliers(const ContactPair& pair, double work);
  /// @param acted forces of a pair's points over a step, impulses included
  void tally_friction(const std::vector<PointResponse>& acted, const std::vector<PointLaw>& laws,
                      double step);
  void note_elastic_energy(std::size_t block);
  void note_elastic_energies();
  /// Of the present state; elastic as noted.
  void measure_energies(Ledger& ledger) const;

  // static_analysis.cpp
  void start_load_level(double end_time);
  /// How far a has moved past b at each point since the load level began, m.
  [[nodiscard]] std::vector<Vector3> moved_in_level(int a, int b,
                                                    const std::vector<ContactPoint>& points) const;
  /// Of each block: whether supports leave it no rigid motion, or those of blocks that it is tied to.
  [[nodiscard]] std::vector<bool> held_without_contacts() const;
  [[nodiscard]] double least_inertia() const;
  /// Largest motion of a block of an island in block sizes.
  [[nodiscard]] static double largest_motion(const Island& island, const std::vector<BodyStep>& bodies);
  /// Of all islands.
  [[nodiscard]] static double largest_motion(const Trial& trial);
  /// What an iteration of a static analysis does to joints.
  struct Joints {
    std::vector<PairKey> sliding;  ///< blocks that slide on each other
    bool fail = false;             ///< whether any loses its strength
  };
  [[nodiscard]] Joints joints(const Trial& trial) const;
  /// Whether any block has gone as far as what moves does.
  [[nodiscard]] bool has_set_off() const;
  /// From now on bonds fail where balances ask for more than their strength.
  void let_bonds_go();
  /// Whether multipliers start the iteration with the forces that it ends with.
  [[nodiscard]] bool multipliers_repeat(const Trial& trial) const;
  /// How a static analysis ends that goes no farther.
  [[nodiscard]] StaticStatus give_up();
  /// Takes note of what each block lacks of balance. @return whether none lacks anything
  [[nodiscard]] bool note_balance(const TimeScheme& scheme, const Trial& trial);
  /// Keeps what is reported of moving blocks, see static_analysis.hpp. Before the trial is accepted.
  void note_accelerations(const TimeScheme& scheme, const Trial& trial);
  /// How far a block is from where it set off, m.
  [[nodiscard]] double travel(std::size_t block) const;
  /// What moves after an iteration in which nothing was lacking sets off anew.
  void forget_accelerations();

  std::vector<BlockModel> blocks_;
  std::vector<BlockState> states_;
  /// a of time_scheme.hpp, (p, 3) for each block; empty unless the integrator carries it on
  std::vector<Eigen::MatrixX3d> accelerations_;
  /// By block, J, <= 0: what dda steps have created, and must dissipate before spin may take up any of it
  std::vector<double> spin_debts_;
  LawOfPair law_;
  SimulationSettings settings_;
  std::vector<bool> moving_;  ///< false for fixed blocks
  ContactFinder finder_;
  WaysOut ways_out_;  ///< at the last search for contacts
  std::vector<TiedBlocks> ties_;
  /// See angular_momentum.hpp: no block becomes fixed, supported, incremental or the reverse
  std::vector<std::vector<int>> free_bodies_;
  std::vector<double> roundoff_force_;  ///< see BodyStep
  std::map<PairKey, ContactMemory> memory_;
  std::map<PairKey, double> contact_work_;  ///< of every pair that ever touched, J
  ContactAccounts taken_;                   ///< by multipliers, of every pair that ever touched
  std::vector<double> elastic_energies_;    ///< by block, J
  IslandSolvers solvers_;
  LoneBodyFactors lone_factors_;
  StepClock clock_;
  double next_step_;  ///< s, grows back to settings_.time_step after cuts
  int steps_ = 0;
  bool remembers_statics_ = false;  ///< contacts were known before the first step
  StepReport report_;
  std::vector<PairRecord> records_;
  Ledger ledger_;
  StaticState static_;
  double start_balance_ = 0.0;
  double largest_step_residual_ = 0.0;
  double largest_energy_ = 0.0;
  double largest_penetration_ = 0.0;
  DeepestPoint deepest_;
  FrictionTally sliding_friction_;
  std::map<PairKey, double>
      true_depths_;  ///< at the end of the last step, m, of pairs that are in each other
  DepthAudit audit_;
  /// By block, shared by equal ones, see end_state.cpp; null: fixed or incremental
  std::vector<std::shared_ptr<const Eigen::MatrixXd>> asked_gradients_;
  std::optional<StateFault> fault_;
  std::vector<Rejection> rejections_;
  SimulationCounts counts_;  ///< factors: those of a run that this one goes on with
  PhaseSeconds seconds_;
};

}  // namespace ashlar
