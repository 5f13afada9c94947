// Shares blocks out among ranks by their contacts: Scotch, through PETSc.
#pragma once

#include <vector>

#include "solver/ranks/partition.hpp"

namespace ashlar {

/// A Partition: few contact points are between ranks, and each rank gets about the same weight. Parts have the names of the
/// ranks that know most of their blocks, so that few blocks move. Without contacts: partition_by_place.
///
/// Rank 0 divides the graph of all: divided by several processes, the same graph has different parts each time, because
/// messages arrive in another order. It holds some 100 bytes for each block meanwhile.
/// @pre an MpiSession. @param ranks all of the program
[[nodiscard]] std::vector<int> partition_by_contact(Ranks& ranks, const std::vector<PartitionBlock>& own,
                                                    int blocks);

}  // namespace ashlar
