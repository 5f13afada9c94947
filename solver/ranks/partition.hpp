// Shares blocks out among ranks: each gets about the same work, with few contacts between ranks.
//
// Here: recursive bisection of the centroids, for blocks without neighbours and for builds without MPI. By contacts: mpi/contact_partition.hpp. Both are functions of the blocks alone: the present ranks of the blocks
// change neither which are together nor, but for the names of the parts (with_names_of), their owners.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/ranks/ranks.hpp"

namespace ashlar {

/// A block as a partition sees it.
struct PartitionBlock {
  int block = -1;                                      ///< global
  double weight = 1.0;                                 ///< work of a step, > 0: see weight_of_block
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< m
  std::vector<int> neighbours;  ///< global blocks in contact, each once; both name each other
  std::vector<int> points;      ///< contact points with each, >= 1
};

/// Work of a block: its unknowns, and half of each contact point, which two blocks share.
[[nodiscard]] double weight_of_block(int unknowns, int contact_points);

/// Shares out all blocks. Collective. @param own blocks that this rank knows: each block is known to one rank
/// @param blocks number of all. @return rank by block, the same on all ranks; -1 for blocks that no rank knows
using Partition =
    std::function<std::vector<int>(Ranks& ranks, const std::vector<PartitionBlock>& own, int blocks)>;

/// When blocks are shared out again in a run (shared/rank_balance.hpp).
struct Rebalancing {
  Partition partition;   ///< empty: never
  double beyond = 0.2;   ///< imbalance of the weights of ranks
  int interval = 100;    ///< steps from one look at it to the next
  int repartitions = 0;  ///< so far
};

/// A Partition by centroids alone.
[[nodiscard]] std::vector<int> partition_by_place(Ranks& ranks, const std::vector<PartitionBlock>& own,
                                                  int blocks);

/// Divides points into parts of about equal weight: cuts them in two by a plane across the longest side of their bounding
/// box, and each side again. Points of equal coordinate are in the order of their index. A weight greater than that of a
/// part leaves parts empty. @param centroids (n, 3). @param weights (n), > 0. @param parts > 0
/// @return part by point, 0 to parts - 1
[[nodiscard]] std::vector<int> bisected(const std::vector<Eigen::Vector3d>& centroids,
                                        const std::vector<double>& weights, int parts);

/// Renames parts so that most of the weight stays where it is: the largest common weight of a new and a present part is
/// matched first. @param part by block, -1: none. @param present rank by block, -1: none. @param weights by block
[[nodiscard]] std::vector<int> with_names_of(const std::vector<int>& present, const std::vector<int>& part,
                                             const std::vector<double>& weights, int parts);

/// Largest weight of a rank relative to the mean, minus 1; 0 without blocks.
/// @param owners rank by block, -1: none
[[nodiscard]] double imbalance_of(const std::vector<int>& owners, const std::vector<double>& weights,
                                  int ranks);

}  // namespace ashlar
