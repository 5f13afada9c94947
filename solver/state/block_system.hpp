// The blocks of a scene, their ties and joint laws: all data that are constant in a run, except models of blocks that
// change their order or are incremental.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "mechanics/block/block_model.hpp"
#include "mechanics/contact/laws/joint_law.hpp"
#include "mechanics/contact/laws/tie.hpp"
#include "solver/block_pair.hpp"
#include "solver/bolts/bolt.hpp"
#include "solver/settings.hpp"

namespace ashlar {

class StepExchange;  // step_exchange.hpp

/// The exchange of a run of one process.
[[nodiscard]] StepExchange& no_exchange();

/// Two blocks to be bonded over their common faces.
struct TieRequest {
  int a;  ///< a < b
  int b;
  double stiffness;  ///< Pa/m, > 0
};

/// Two bonded blocks (tie.hpp).
struct TiedBlocks {
  int a;
  int b;
  std::shared_ptr<const Tie> tie;  ///< not null
  double stiffness;                ///< Pa/m
};

/// Blocks by their numbers, ties and joint laws.
class BlockSystem {
 public:
  using LawOfPair = std::function<JointLaw(int, int)>;

  /// @param law joint law of each pair (a < b). @param ties a pair without a common face is not tied, but its
  /// contacts are excluded all the same. @param absent by block, or empty: absent blocks keep their numbers, but have
  /// no motion, contact, weight or energy
  /// @param exchange with other processes that share the blocks, must outlive this. Blocks that are neither own nor
  /// neighbours are elsewhere: like absent ones here. Collective; blocks tied to own ones are neighbours.
  /// @throws std::invalid_argument if a tied block is incremental
  BlockSystem(std::vector<BlockModel> blocks, LawOfPair law, const SimulationSettings& settings,
              const std::vector<TieRequest>& ties, std::vector<bool> absent = {},
              StepExchange& exchange = no_exchange());

  [[nodiscard]] int count() const { return static_cast<int>(blocks_.size()); }
  [[nodiscard]] const std::vector<BlockModel>& blocks() const { return blocks_; }
  [[nodiscard]] bool present(int block) const { return !absent_[static_cast<std::size_t>(block)]; }
  [[nodiscard]] const std::vector<bool>& absent() const { return absent_; }
  /// Present blocks that this process has, own or neighbours; without others all present blocks.
  [[nodiscard]] bool here(int block) const { return !away_[static_cast<std::size_t>(block)]; }
  /// Absent blocks and those elsewhere.
  [[nodiscard]] const std::vector<bool>& away() const { return away_; }
  [[nodiscard]] StepExchange& exchange() const { return *exchange_; }
  /// True if this process computes the motion of a block.
  [[nodiscard]] bool owns(int block) const;
  /// True if this process makes the contacts of two blocks and accounts for their energy: the owner of the lower block, of
  /// the only one if the other is fixed.
  [[nodiscard]] bool owns_pair(int a, int b) const;
  /// True if one of two blocks is own and not fixed.
  [[nodiscard]] bool concerns(int a, int b) const;
  /// By block: false for fixed and absent blocks, and for blocks held at present: loose ones in statics, sleeping
  /// ones in dynamics.
  [[nodiscard]] const std::vector<bool>& moving() const { return moving_; }
  /// The joint law of a pair (a < b), with springs or multipliers, never left to the scene.
  [[nodiscard]] JointLaw law(int a, int b) const;
  [[nodiscard]] const SimulationSettings& settings() const { return settings_; }
  [[nodiscard]] const std::vector<TiedBlocks>& ties() const { return ties_; }
  /// Bolts and props of all stages.
  [[nodiscard]] const std::vector<Bolt>& bolts() const { return bolts_; }
  /// @throws std::invalid_argument if a block of a bolt is incremental
  void set_bolts(std::vector<Bolt> bolts);
  [[nodiscard]] bool is_tied(int block) const;
  [[nodiscard]] bool are_tied(int a, int b) const;
  /// Pairs without contact search, the lower block first.
  [[nodiscard]] const std::set<PairKey>& left_out() const { return left_out_; }
  /// Sets of blocks that rotate together and are supported by contacts only (free_bodies.hpp); of several processes
  /// those with own blocks.
  [[nodiscard]] const std::vector<std::vector<int>>& free_bodies() const { return free_bodies_; }
  /// Free bodies with blocks of several processes, the same on all.
  [[nodiscard]] const std::vector<std::vector<int>>& parted_bodies() const { return parted_bodies_; }
  /// Size of the rounding errors of a block's internal force, N m^-3/2.
  [[nodiscard]] double roundoff_force(int block) const;
  /// Gradients of a block's functions at the places checked for inversion, (3 #places, p); null: fixed or incremental
  /// blocks are not checked.
  [[nodiscard]] const Eigen::MatrixXd* asked_gradients(int block) const;
  [[nodiscard]] bool any_incremental() const;
  /// Blocks with quiet faces, held or released; absent ones are left out.
  [[nodiscard]] const std::vector<int>& quiet() const { return quiet_; }
  /// Forces behind released quiet faces, by block.
  [[nodiscard]] std::map<int, Eigen::MatrixX3d> reactions() const;
  /// @throws std::invalid_argument as BlockModel::set_reaction
  void set_reaction(int block, Eigen::MatrixX3d reaction);
  /// block_size of the smaller of two blocks, m.
  [[nodiscard]] double smaller_size(const BlockPair& blocks) const;
  [[nodiscard]] int unknowns() const;
  /// By block: true if its supports, or those of blocks tied to it, prevent all rigid motions.
  [[nodiscard]] std::vector<bool> held_without_contacts() const;

  /// Replaces the model of a block by one of the same solid, of another order or with quiet faces released or held.
  void replace(int block, BlockModel model);
  /// @param step s, > 0
  void set_time_step(double step) { settings_.time_step = step; }
  /// @param tolerance of SearchSettings, m, > 0
  void set_chord_tolerance(double tolerance) { settings_.search.chord_tolerance = tolerance; }
  /// Makes a present block of another process a neighbour, or none any more.
  /// @param model of the block; of one elsewhere any
  void set_here(int block, BlockModel model, bool here);
  /// Replaces the model of an incremental block by that of its next step.
  void carry_on(int block, BlockModel model);
  /// @throws std::out_of_range for a block or load that does not exist
  void set_load_factor(int block, int load, double factor);
  /// Factors of loads that are not 1, by block and load.
  [[nodiscard]] std::map<std::array<int, 2>, double> load_factors() const;
  /// Holds blocks as if they were fixed until let_go().
  void hold(const std::vector<int>& blocks);
  void let_go();
  /// Holds blocks until let_go_loose(), also those that are not here yet: those without support in statics.
  void hold_loose(const std::vector<int>& blocks);
  void let_go_loose();

 private:
  void note_gradients(std::size_t block);
  /// @return pairs of tied blocks that this process owns
  std::vector<PairKey> make_ties(const std::vector<TieRequest>& ties);
  /// @param tied pairs of this process
  void find_free_bodies(const std::vector<PairKey>& tied);

  std::vector<BlockModel> blocks_;
  std::vector<bool> absent_;
  std::vector<bool> away_;
  StepExchange* exchange_;  ///< not null
  std::vector<bool> moving_;
  std::set<int> loose_;     ///< blocks of hold_loose()
  std::vector<int> quiet_;  ///< increasing
  LawOfPair law_;
  SimulationSettings settings_;
  std::vector<TiedBlocks> ties_;
  std::vector<Bolt> bolts_;
  std::set<PairKey> left_out_;
  std::vector<std::vector<int>> free_bodies_;
  std::vector<std::vector<int>> parted_bodies_;
  std::vector<double> roundoff_force_;
  std::vector<std::shared_ptr<const Eigen::MatrixXd>> asked_gradients_;  ///< shared by equal blocks
};

}  // namespace ashlar
