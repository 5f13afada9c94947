// A bolt within one step: its forces as a function of the unknowns of all its blocks.
//
// With y_b the changes of the unknowns of block b, the deformation (bolt_kinematics.hpp) at the end of the step is
//   v = v_0 + c + sum over b of B_b y_b,   B_b = J D_b
// J: derivative of the deformation with respect to the bolt's points, D_b: motion of the points with the unknowns. J is
// that of the start of the step and c = 0, until follow() evaluates J in the middle of the step and sets c so that v is
// exact at its end, as for contacts (notes/contact_at_the_end_of_a_step.md). Within a step the forces have a convex
// potential. From step to step v is a function of the blocks' positions: nothing drifts.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <vector>

#include "mechanics/block/block_model.hpp"
#include "mechanics/bolt/bolt_kinematics.hpp"
#include "solver/bolts/bolt.hpp"

namespace ashlar {

/// A bolt's forces over a step.
struct StepBoltResponse {
  BoltResponse end;                        ///< at the end of the step, without its tangent
  Eigen::VectorXd deformation;             ///< v, m
  Eigen::VectorXd force;                   ///< in the equations of motion, opposite to that on the blocks, N
  Eigen::MatrixXd tangent;                 ///< of `force`, N/m
  std::vector<Eigen::VectorXd> on_blocks;  ///< force on the unknowns of each of blocks(), N; empty: fixed
};

/// Positions of blocks, (p, 3), by index.
using PositionOfBlock = std::function<Eigen::MatrixX3d(int block)>;

class StepBolt {
 public:
  /// @param bolt must outlive this. @param index of the bolt in the run
  StepBolt(const Bolt& bolt, int index, const std::vector<BlockModel>& blocks,
           const std::vector<BlockState>& states, const BoltMemory& memory);

  [[nodiscard]] int index() const { return index_; }
  [[nodiscard]] const Bolt& bolt() const { return *bolt_; }
  /// Blocks that are present along the bolt, each once, increasing.
  [[nodiscard]] const std::vector<int>& blocks() const { return blocks_; }

  /// Sets the motion of moving supports. @param change by block, (p, 3), empty: none
  void prescribe(const PositionOfBlock& change);
  /// Overwrites a response. @param changes of the unknowns of each of blocks(); those of fixed blocks are empty
  /// @param averaged false: forces are those at the end of the step; true: the mean of its start and end
  void respond(const std::vector<const Eigen::VectorXd*>& changes, bool averaged,
               StepBoltResponse& response) const;
  /// Change of the deformation with the unknowns, without that of supports, m.
  [[nodiscard]] Eigen::VectorXd motion(const std::vector<const Eigen::VectorXd*>& changes) const;
  /// Deformation at the end of the step, m.
  [[nodiscard]] Eigen::VectorXd deformation(const std::vector<const Eigen::VectorXd*>& changes) const;
  /// Mean or end force at a deformation, N.
  [[nodiscard]] Eigen::VectorXd force(const Eigen::VectorXd& deformation, bool averaged) const;
  /// B_b of one of blocks(), (#deformations, unknowns); no columns if fixed.
  [[nodiscard]] const Eigen::MatrixXd& rows(std::size_t block) const { return rows_[block]; }

  /// Size of the rounding errors of the forces, in the norm of a block's unknowns.
  [[nodiscard]] double force_rounding(const StepBoltResponse& response) const;
  /// True if rows that are not updated cause an error of the deformation above a tolerance, or if the bar turns: its
  /// force would have a torque. @param tolerance m
  [[nodiscard]] bool needs_following(const PositionOfBlock& middle, const PositionOfBlock& end,
                                     const std::vector<const Eigen::VectorXd*>& changes,
                                     double tolerance) const;
  void follow(const PositionOfBlock& middle, const PositionOfBlock& end,
              const std::vector<const Eigen::VectorXd*>& changes);

  /// Work on all blocks, J. @param changes as for respond()
  [[nodiscard]] double work(const StepBoltResponse& response,
                            const std::vector<const Eigen::VectorXd*>& changes) const;
  /// Part of work() on moving supports, J.
  [[nodiscard]] double prescribed_work(const StepBoltResponse& response) const;
  /// Energy at the start of the step, J.
  [[nodiscard]] double start_energy() const { return start_.stored; }
  [[nodiscard]] const BoltMemory& memory() const { return *memory_; }

 private:
  /// Points of the bolt in one block.
  struct Part {
    const BlockModel* model;
    std::vector<int> points;               ///< of the bolt's points
    Eigen::MatrixXd values;                ///< (#points, p)
    std::array<Eigen::MatrixXd, 3> along;  ///< (#points, unknowns of the component)
  };

  [[nodiscard]] BoltPlaces places_at(const PositionOfBlock& position) const;
  void set_rows(const BoltPlaces& places);

  const Bolt* bolt_;
  int index_;
  const BoltMemory* memory_;
  std::vector<int> blocks_;
  std::vector<Part> parts_;            ///< by block of blocks_
  std::vector<Eigen::MatrixXd> rows_;  ///< B_b
  Eigen::MatrixXd to_points_;          ///< J
  Eigen::VectorXd known_;              ///< v_0 + c + motion of supports, m
  Eigen::VectorXd prescribed_;         ///< motion of supports, m; empty: none
  Eigen::Matrix3Xd prescribed_points_;
  BoltPlaces absent_;  ///< as placed: points of absent blocks do not move
  Eigen::VectorXd start_deformation_;
  BoltResponse start_;
  double size_ = 0.0;  ///< m, largest coordinate
};

/// The bolts of a step: those that are installed and hold a moving block. @param moving by block
[[nodiscard]] std::vector<StepBolt> step_bolts(const std::vector<Bolt>& bolts,
                                               const std::vector<BoltState>& bolt_states,
                                               const std::vector<BlockModel>& blocks,
                                               const std::vector<BlockState>& states,
                                               const std::vector<bool>& moving);

/// Deformation of a bolt in some state of the blocks, m.
[[nodiscard]] Eigen::VectorXd deformation_in(const Bolt& bolt, const std::vector<BlockModel>& blocks,
                                             const std::vector<BlockState>& states);
/// Places of the bolt's points in some state of the blocks, m; points of absent blocks are as placed.
[[nodiscard]] Eigen::Matrix3Xd points_in(const Bolt& bolt, const std::vector<BlockModel>& blocks,
                                         const std::vector<BlockState>& states);

}  // namespace ashlar
