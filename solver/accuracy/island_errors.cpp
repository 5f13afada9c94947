#include "solver/accuracy/island_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

bool touches(const PairRecord& pair) {
  return std::any_of(pair.responses.begin(), pair.responses.end(),
                     [](const PointResponse& response) { return response.state != ContactState::open; });
}

}  // namespace

std::vector<BlockDifference> block_differences(const Simulation& simulation, const std::vector<BlockState>& a,
                                               const std::vector<BlockState>& b) {
  std::vector<BlockDifference> differences(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!simulation.system().moving()[k]) continue;
    const BlockModel& block = simulation.blocks()[k];
    const Eigen::MatrixX3d position = a[k].position - b[k].position;
    const BlockState motion{a[k].position, a[k].velocity - b[k].velocity};
    BlockDifference& difference = differences[k];
    difference.energy = block.kinetic_energy(motion);
    if (!block.rigid()) {
      const Eigen::MatrixX3d force = block.elastic(a[k].position).force - block.elastic(b[k].position).force;
      difference.energy += 0.5 * std::abs(force.cwiseProduct(position).sum());
    }
    difference.displacement = position.norm() / std::sqrt(block.basis().volume());
  }
  return differences;
}

double relative_difference(const std::vector<BlockDifference>& differences, const std::vector<int>& blocks,
                           const MotionScales& scales) {
  double energy = 0.0, displacement = 0.0;
  for (const int block : blocks) {
    energy += differences[at(block)].energy;
    displacement = std::max(displacement, differences[at(block)].displacement);
  }
  const double of_energy = scales.energy > 0.0 ? std::sqrt(energy / scales.energy) : 0.0;
  return scales.displacement > 0.0 ? std::max(of_energy, displacement / scales.displacement) : of_energy;
}

std::vector<std::vector<int>> blocks_in_touch(const Simulation& simulation) {
  const BlockSystem& system = simulation.system();
  const std::vector<bool>& moving = system.moving();
  UnionFind joined(moving.size());
  const auto join = [&](int a, int b) {
    if (moving[at(a)] && moving[at(b)]) joined.unite(a, b);
  };
  for (const PairRecord& pair : simulation.contacts())
    if (touches(pair)) join(pair.a, pair.b);
  for (const TiedBlocks& tie : system.ties()) join(tie.a, tie.b);
  for (const Bolt& bolt : system.bolts())
    for (const BoltSpan& span : bolt.chain.shape().pieces())
      join(bolt.chain.shape().pieces().front().block, span.block);
  std::map<int, std::vector<int>> by_first;
  for (int k = 0; k < static_cast<int>(moving.size()); ++k)
    if (moving[at(k)]) by_first[joined.find(k)].push_back(k);
  std::vector<std::vector<int>> islands;
  for (auto& [first, blocks] : by_first) islands.push_back(std::move(blocks));
  std::sort(islands.begin(), islands.end());
  return islands;
}

BoundingIsland bounding_island(const std::vector<std::vector<int>>& islands,
                               const std::vector<BlockDifference>& differences, const MotionScales& scales,
                               int order) {
  BoundingIsland bounding;
  double largest = 0.0, next = 0.0;
  for (const std::vector<int>& blocks : islands) {
    const double error = relative_difference(differences, blocks, scales);
    if (error > largest) {
      next = largest;
      largest = error;
      bounding.blocks = blocks;
    } else {
      next = std::max(next, error);
    }
  }
  if (next > 0.0) bounding.gain = correctly_rounded::pow(largest / next, 1.0 / order);
  return bounding;
}

}  // namespace ashlar
