#include "solver/run/order_error_work.hpp"

#include <algorithm>
#include <set>

#include "geometry/index.hpp"
#include "mechanics/basis/multi_index.hpp"

namespace ashlar {
namespace {

constexpr double model_cubic = 20.0;      ///< by p^3
constexpr double model_triangles = 50.0;  ///< by triangles p^2
constexpr double solution_cubic = 6.0;    ///< by p^3
constexpr double step_of_block = 2e4;
constexpr double step_quadratic = 100.0;  ///< by p^2
constexpr double step_of_point = 3e3;

double work_of_basis(const BlockModel& block, int order) {
  const double p = polynomial_count(order);
  return model_cubic * p * p * p +
         model_triangles * static_cast<double>(block.solid().mesh().triangles.size()) * p * p;
}

/// Of the strain of a St.-Venant-Kirchhoff block.
int order_of_strain(int order) {
  return 2 * (order - 1);
}

/// The data that the model of higher order of a block shares with those of others; null: none.
const BlockParts* shared_parts(const BlockModel& block) {
  return block.fixed() || block.supported() || !block.tangent_turns() ? nullptr : block.parts().get();
}

}  // namespace

double work_of_model(const BlockModel& block, int order) {
  double work = work_of_basis(block, order);
  if (!block.tangent_turns()) work += work_of_basis(block, order_of_strain(order));
  return work;
}

double work_of_solution(const BlockModel& block, int order) {
  const double p = polynomial_count(block.tangent_turns() ? order : std::max(order, order_of_strain(order)));
  return solution_cubic * p * p * p;
}

double work_of_run(const Simulation& simulation) {
  const std::vector<BlockModel>& blocks = simulation.blocks();
  std::set<const BlockParts*> made;
  double models = 0.0, step = 0.0, moving = 0.0;
  for (int k = 0; k < static_cast<int>(blocks.size()); ++k) {
    const BlockModel& block = blocks[at(k)];
    if (block.fixed() || !simulation.system().present(k)) continue;
    if (made.insert(block.parts().get()).second) models += work_of_model(block, block.order());
    const double p = block.basis().size();
    step += step_of_block + step_quadratic * p * p;
    moving += 1.0;
  }
  const SimulationCounts counts = simulation.counts();
  const double asleep =
      moving > 0.0 ? static_cast<double>(counts.sleeping_block_steps) / moving : 0.0;  // steps
  const double awake = std::max(0.0, simulation.steps() - asleep);
  return models + awake * step + step_of_point * static_cast<double>(counts.contact_points);
}

double largest_estimate_work(const Simulation& simulation) {
  return std::max(least_estimate_work, estimate_share * work_of_run(simulation));
}

std::vector<std::vector<int>> equal_blocks(const std::vector<BlockModel>& blocks,
                                           const std::vector<int>& chosen) {
  std::vector<std::vector<int>> groups;
  std::map<const BlockParts*, std::size_t> open;  // groups that take further blocks
  for (const int k : chosen) {
    const BlockParts* parts = shared_parts(blocks[at(k)]);
    const auto group = parts != nullptr ? open.find(parts) : open.end();
    if (group != open.end() && groups[group->second].size() < largest_equal_group) {
      groups[group->second].push_back(k);
      continue;
    }
    if (parts != nullptr) open[parts] = groups.size();
    groups.push_back({k});
  }
  return groups;
}

bool EstimateBudget::take(const BlockModel& block, int order) {
  const BlockParts* parts = shared_parts(block);
  const std::size_t before = parts != nullptr ? counted_[parts] : 0;
  double work = work_of_solution(block, order);
  if (before % largest_equal_group == 0) work += work_of_model(block, order);
  if (!(work <= left_)) return false;
  left_ -= work;
  if (parts != nullptr) ++counted_[parts];
  return true;
}

}  // namespace ashlar
