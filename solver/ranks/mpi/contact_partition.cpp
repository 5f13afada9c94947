#include "solver/ranks/mpi/contact_partition.hpp"

#include <petscmat.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "geometry/index.hpp"
#include "solver/ranks/mpi/petsc_check.hpp"
#include "solver/ranks/rank_values.hpp"

// Of Scotch, whose header declares names of its own version of MPI's.
extern "C" void SCOTCH_randomReset(void);

namespace ashlar {
namespace {

/// Scotch adds weights as 32-bit integers: their largest sum, and the fractions of an unknown that they tell, which are
/// precise enough.
constexpr double largest_sum_of_weights = 1e9, fractions_of_unknown = 1e3;

/// A block and the number of its neighbours, which follow in another list.
struct ToldBlock {
  int block;
  int neighbours;
  double weight;
};

struct ToldContact {
  int neighbour;
  int points;
};

/// All blocks that ranks know, by block.
struct WholeGraph {
  std::vector<int> present;                        ///< rank, -1: nobody knows the block
  std::vector<double> weights;                     ///< 0 of unknown ones
  std::vector<std::vector<ToldContact>> contacts;  ///< on rank 0
};

std::vector<Bytes> contacts_of_all(Ranks& ranks, const std::vector<PartitionBlock>& own) {
  std::vector<ToldContact> contacts;
  for (const PartitionBlock& block : own)
    for (std::size_t k = 0; k < block.neighbours.size(); ++k)
      contacts.push_back({block.neighbours[k], block.points[k]});
  std::vector<Bytes> messages(at(ranks.count()));
  messages[0] = bytes_of_values<ToldContact>(contacts);
  return ranks.exchange(std::move(messages));
}

WholeGraph whole_graph(Ranks& ranks, const std::vector<PartitionBlock>& own, int blocks) {
  std::vector<ToldBlock> told;
  told.reserve(own.size());
  for (const PartitionBlock& block : own)
    told.push_back({block.block, static_cast<int>(block.neighbours.size()), block.weight});
  WholeGraph graph{std::vector<int>(at(blocks), -1), std::vector<double>(at(blocks), 0.0), {}};
  const std::vector<Bytes> known = ranks.gather(bytes_of_values<ToldBlock>(told));
  const std::vector<Bytes> contacts = contacts_of_all(ranks, own);
  if (ranks.own() == 0) graph.contacts.resize(at(blocks));
  for (std::size_t rank = 0; rank < known.size(); ++rank) {
    const auto touching = values_of_bytes<ToldContact>(contacts[rank]);
    auto next = touching.begin();
    for (const ToldBlock& block : values_of_bytes<ToldBlock>(known[rank])) {
      graph.present[at(block.block)] = static_cast<int>(rank);
      graph.weights[at(block.block)] = block.weight;
      if (ranks.own() != 0) continue;
      graph.contacts[at(block.block)].assign(next, next + block.neighbours);
      next += block.neighbours;
    }
  }
  return graph;
}

/// Integers of an array that PETSc frees.
PetscInt* petsc_array(const std::vector<PetscInt>& values) {
  PetscInt* array = nullptr;
  check_petsc(PetscMalloc1(values.size() + 1, &array));
  std::copy(values.begin(), values.end(), array);
  return array;
}

std::vector<PetscInt> whole_weights(const std::vector<double>& weights) {
  const double scale = std::min(
      fractions_of_unknown, largest_sum_of_weights / std::accumulate(weights.begin(), weights.end(), 0.0));
  std::vector<PetscInt> whole;
  whole.reserve(weights.size());
  for (const double weight : weights)
    whole.push_back(std::max(1, static_cast<PetscInt>(std::lround(weight * scale))));
  return whole;
}

/// @return part by block; blocks that nobody knows are in any
std::vector<int> parts_of_graph(const WholeGraph& graph, int parts) {
  std::vector<PetscInt> starts = {0}, neighbours, points;
  for (std::vector<ToldContact> contacts : graph.contacts) {
    std::sort(contacts.begin(), contacts.end(),
              [](const auto& a, const auto& b) { return a.neighbour < b.neighbour; });
    for (const ToldContact& contact : contacts) {
      neighbours.push_back(contact.neighbour);
      points.push_back(contact.points);
    }
    starts.push_back(static_cast<PetscInt>(neighbours.size()));
  }
  const auto blocks = static_cast<PetscInt>(graph.weights.size());
  Mat adjacency = nullptr;
  MatPartitioning partitioning = nullptr;
  IS found = nullptr;
  check_petsc(MatCreateMPIAdj(PETSC_COMM_SELF, blocks, blocks, petsc_array(starts), petsc_array(neighbours),
                              petsc_array(points), &adjacency));
  check_petsc(MatPartitioningCreate(PETSC_COMM_SELF, &partitioning));
  check_petsc(MatPartitioningSetAdjacency(partitioning, adjacency));
  check_petsc(MatPartitioningSetVertexWeights(partitioning, petsc_array(whole_weights(graph.weights))));
  check_petsc(MatPartitioningSetUseEdgeWeights(partitioning, PETSC_TRUE));
  check_petsc(MatPartitioningSetNParts(partitioning, parts));
  check_petsc(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  check_petsc(MatPartitioningSetFromOptions(partitioning));
  // The same random numbers for the same question, whatever was asked before.
  SCOTCH_randomReset();
  check_petsc(MatPartitioningApply(partitioning, &found));
  const PetscInt* part = nullptr;
  check_petsc(ISGetIndices(found, &part));
  std::vector<int> result(part, part + blocks);
  check_petsc(ISRestoreIndices(found, &part));
  check_petsc(ISDestroy(&found));
  check_petsc(MatPartitioningDestroy(&partitioning));
  check_petsc(MatDestroy(&adjacency));
  return result;
}

}  // namespace

std::vector<int> partition_by_contact(Ranks& ranks, const std::vector<PartitionBlock>& own, int blocks) {
  const bool touching = std::any_of(own.begin(), own.end(),
                                    [](const PartitionBlock& block) { return !block.neighbours.empty(); });
  if (!any_rank(ranks, touching)) return partition_by_place(ranks, own, blocks);
  const WholeGraph graph = whole_graph(ranks, own, blocks);
  std::vector<int> part;
  if (ranks.own() == 0) part = parts_of_graph(graph, ranks.count());
  part = values_of_bytes<int>(ranks.gather(bytes_of_values<int>(part))[0]);
  for (std::size_t k = 0; k < part.size(); ++k)
    if (graph.present[k] < 0) part[k] = -1;
  return with_names_of(graph.present, part, graph.weights, ranks.count());
}

}  // namespace ashlar
