// An impact at one moment: the points of blocks that touch each other, directly or not, and their impulses.
//
// Processes gather the points of all blocks that take part in it, each from the owner of its pair, and solve for all impulses
// (notes/ranks.md).
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "geometry/union_find.hpp"
#include "solver/step/impact/closing_speeds.hpp"
#include "solver/step/impact/impact.hpp"
#include "solver/step/impact/rigid_motions.hpp"

namespace ashlar {

/// Points of two blocks that touch. Of bodies only places in a list of all are unknown.
struct TouchingPoints {
  PairKey blocks = {-1, -1};
  bool tied = false;
  bool meets = false;                          ///< fast enough for an impact
  double restitution = 0.0;                    ///< of the joint, 0 to 1
  std::array<int, 2> moves = {0, 0};           ///< 1: of the blocks
  std::array<int, 2> modes = {0, 0};           ///< number of their rigid motions
  std::array<double, 2> inertia = {0.0, 0.0};  ///< density, kg/m^3
  std::vector<ImpactPoint> points = {};        ///< empty until they are asked for
  std::vector<Eigen::Vector3d> driven = {};    ///< velocity of each by moving supports, m/s
};

/// Functions are collective for the processes of a run.
class ImpactOfBlocks {
 public:
  /// @param pairs of the step; used as long as this
  ImpactOfBlocks(const BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs);
  /// False if no points of joints with restitution close fast enough, whatever else holds their blocks.
  [[nodiscard]] bool may_meet();
  /// @return false if no blocks meet
  [[nodiscard]] bool find();
  /// Changes velocities and books the loss.
  void apply();

 private:
  struct PointTarget {
    std::size_t point;
    double target;  ///< m/s
    bool bonded;
  };

  /// Blocks that do not move transmit no impulses.
  [[nodiscard]] std::size_t group_of(const TouchingPoints& touching);
  /// Blocks that cannot move rigidly are one with the ground.
  [[nodiscard]] int body_or_ground(int block);
  /// Joins the blocks that bonds hold together.
  void note_bonds();
  /// Lists the touching points of a pair. @return true if they meet
  bool note_touching(std::size_t n);
  /// Joins the groups of two blocks.
  void join(const TouchingPoints& touching);
  /// Notes whether the joints of one impact have different coefficients of restitution.
  void note_unlike(const std::vector<TouchingPoints>& touching);
  /// A pair without its points.
  [[nodiscard]] TouchingPoints touching_pair(std::size_t n, bool meets);
  /// Motion of each point by each rigid mode of one block of a pair. @return by point, (3, modes)
  [[nodiscard]] std::vector<Eigen::Matrix3Xd> rows_of(const ContactPair& pair, int block, bool of_a);
  void make_points(std::size_t n, TouchingPoints& touching);
  /// Index of a block among the bodies of the impact; -1: it does not move.
  [[nodiscard]] int body_of(const TouchingPoints& touching, std::size_t side);
  void add(const TouchingPoints& touching);

  const BlockSystem& system_;
  RunState& state_;
  ImpactLimits limits_;
  const std::vector<ContactPair>& pairs_;
  RigidMotions motions_;
  std::optional<ClosingSpeeds> speeds_;
  UnionFind bonded_;         ///< blocks that bonds hold together, and the ground behind them
  UnionFind group_;          ///< moving blocks that touch, directly or not
  std::vector<bool> meets_;  ///< by first block of a group
  bool unlike_ = false;      ///< joints of one impact have different restitution
  std::vector<std::vector<PointTarget>> targets_;  ///< by pair
  std::map<int, int> bodies_;                      ///< by block
  std::vector<double> inertia_;
  std::vector<int> sizes_;
  std::vector<ImpactPoint> points_;
  std::vector<Eigen::Vector3d> driven_;  ///< velocity of each point by moving supports, m/s
  std::vector<bool> own_points_;         ///< of pairs that this process owns
};

}  // namespace ashlar
