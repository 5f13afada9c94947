// Blocks shared out among ranks, seen from one of them.
//
// Each block belongs to one rank, its owner, which computes its motion. A rank also has the blocks of others that are so
// near its own that they may touch in a step: its ghosts, whose state it gets from their owners. All other blocks are
// absent there. All ranks number blocks as the scene does.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "solver/contact/placed_volume.hpp"
#include "solver/ranks/measured_solver.hpp"
#include "solver/ranks/rank_messages.hpp"

namespace ashlar {

class BlockShare {
 public:
  /// @param owners rank of each block, the same on all ranks
  /// @param solver of systems that ranks share; empty: make_gathered_solver()
  /// @throws std::invalid_argument if there is no such rank
  BlockShare(Ranks& ranks, std::vector<int> owners, const RankSolverMaker& solver = {});

  [[nodiscard]] Ranks& ranks() const { return ranks_; }
  /// Of systems that nothing keeps.
  [[nodiscard]] MeasuredSolver& solver() const { return *solver_; }
  /// Of the joined island of a step: its factor may serve later steps (SharedFactor).
  [[nodiscard]] MeasuredSolver& step_solver() const { return *step_solver_; }
  [[nodiscard]] int count() const { return static_cast<int>(owners_.size()); }
  [[nodiscard]] int owner(int block) const { return owners_[static_cast<std::size_t>(block)]; }
  [[nodiscard]] bool owns(int block) const { return owner(block) == ranks_.own(); }
  [[nodiscard]] bool is_ghost(int block) const { return is_ghost_[static_cast<std::size_t>(block)]; }
  /// Increasing.
  [[nodiscard]] const std::vector<int>& own() const { return own_; }
  [[nodiscard]] const std::vector<int>& ghosts() const { return ghosts_; }
  /// Own blocks that are ghosts of a rank, increasing.
  [[nodiscard]] const std::vector<int>& lent_to(int rank) const {
    return lent_[static_cast<std::size_t>(rank)];
  }
  /// Gives blocks to other ranks. Those that this rank had, own or ghosts, and does not own now count as ghosts until
  /// set_ghosts(), which has to follow. @param owners as in the constructor
  void set_owners(std::vector<int> owners);
  /// Replaces the ghosts of this rank. Collective. @param ghosts blocks of other ranks, increasing
  void set_ghosts(std::vector<int> ghosts);

  /// Hands vectors of own blocks to the ranks whose ghosts they are. Collective.
  /// @param of vector of a lent block; null: none is sent. @param take a ghost and its vector
  void to_ghosts(const std::function<const Eigen::VectorXd*(int block)>& of,
                 const std::function<void(int block, Eigen::VectorXd value)>& take) const;
  /// Sets of tied blocks of several ranks that rotate together, supported by contacts only, the same on all ranks.
  [[nodiscard]] const std::vector<std::vector<int>>& shared_bodies() const { return shared_bodies_; }
  void set_shared_bodies(std::vector<std::vector<int>> bodies) { shared_bodies_ = std::move(bodies); }

  /// Exchanges messages with the ranks that have ghosts of this one or own ghosts of it. Collective.
  /// @param write (archive, receiver). @param read (archive, sender), of messages that are not empty
  void exchange(const std::function<void(ByteWriter& writer, int rank)>& write,
                const std::function<void(ByteReader& reader, int rank)>& read) const;

  /// @name Places of all undeformed blocks, which all ranks know (share_blocks in shared/ghosts.hpp)
  /// @{
  void set_places(std::vector<PlacedVolume> places, const Eigen::Matrix3d& axes) {
    places_ = std::move(places);
    axes_ = axes;
  }
  [[nodiscard]] const std::vector<PlacedVolume>& places() const { return places_; }  ///< by block
  /// Along the largest face of all blocks.
  [[nodiscard]] const Eigen::Matrix3d& axes() const { return axes_; }
  /// @}

 private:
  void find_own();

  Ranks& ranks_;
  std::unique_ptr<MeasuredSolver> solver_;
  std::unique_ptr<MeasuredSolver> step_solver_;
  std::vector<int> owners_;
  std::vector<int> own_;
  std::vector<int> ghosts_;
  std::vector<bool> is_ghost_;          ///< by block
  std::vector<std::vector<int>> lent_;  ///< by rank
  std::vector<PlacedVolume> places_;
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
  std::vector<std::vector<int>> shared_bodies_;
};

}  // namespace ashlar
