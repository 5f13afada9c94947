#include "solver/step/island/island.hpp"

#include <algorithm>
#include <stdexcept>

#include "geometry/index.hpp"
#include "geometry/union_find.hpp"
#include "solver/linear/tree_factor.hpp"
#include "solver/step/island/island_links.hpp"
#include "solver/step/solve/open_close.hpp"

namespace ashlar {

IslandSolvers::Entry& IslandSolvers::find(const std::vector<int>& key, const std::vector<int>& sizes,
                                          const std::vector<std::array<int, 2>>& pairs) {
  auto found = entries_.find(key);
  // From a snapshot of other blocks.
  if (found != entries_.end() && (found->second.sizes != sizes || found->second.pairs != pairs)) {
    dropped_ += found->second.factor->counts();
    entries_.erase(found);
    found = entries_.end();
  }
  if (found == entries_.end())
    found =
        entries_
            .emplace(key, Entry{sizes, pairs, BlockMatrix(sizes, pairs), make_linear_solver(method_, sizes)})
            .first;
  found->second.used = true;
  return found->second;
}

void IslandSolvers::drop_unused() {
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (entry->second.used) {
      entry->second.used = false;
      ++entry;
      continue;
    }
    dropped_ += entry->second.factor->counts();
    entry = entries_.erase(entry);
  }
}

FactorCounts IslandSolvers::counts() const {
  FactorCounts sum = dropped_;
  for (const auto& [key, entry] : entries_) sum += entry.factor->counts();
  return sum;
}

std::vector<KeptFactor> IslandSolvers::kept() const {
  std::vector<KeptFactor> result;
  for (const auto& [key, entry] : entries_) {
    if (entry.inertia > 0.0)
      result.push_back({key, entry.sizes, entry.pairs, entry.factor->matrix().values, entry.inertia});
  }
  return result;
}

void IslandSolvers::restore(const std::vector<KeptFactor>& kept) {
  *this = IslandSolvers(method_);
  for (const KeptFactor& factor : kept) {
    const int bodies = static_cast<int>(factor.sizes.size());
    const auto is_pair = [bodies](const std::array<int, 2>& pair) {
      return 0 <= pair[0] && pair[0] < pair[1] && pair[1] < bodies;
    };
    if (!std::all_of(factor.sizes.begin(), factor.sizes.end(), [](int size) { return size > 0; }) ||
        !std::all_of(factor.pairs.begin(), factor.pairs.end(), is_pair))
      throw std::invalid_argument("a factor is of no island");
    Entry& entry = find(factor.key, factor.sizes, factor.pairs);
    SymmetricMatrix matrix = entry.matrix.matrix();
    const bool fits = matrix.values.size() == factor.values.size();
    matrix.values = factor.values;
    set_use(*entry.factor, {FactorPrecision::in_single});  // as in the step that made it
    if (!fits || entry.factor->factorize(matrix) != FactorStatus::success)
      throw std::invalid_argument("a factor does not fit its island");
    entry.factor->drop_counts();
    entry.inertia = factor.inertia;
    entry.used = false;
  }
}

Eigen::MatrixX3d BodyStep::motion() const {
  Eigen::MatrixX3d sum = model->space().expand(change);
  if (prescribed.size() > 0) sum += prescribed;
  return sum;
}

void BodyStep::follow_rigid(const TimeScheme& scheme) {
  if (!model->rigid()) return;
  if (scheme.impulsive) {
    fields = rigid_fields(state->position);
    return;
  }
  const Eigen::MatrixX3d moved = rigid_change(state->position, motion());
  change = model->space().restrict(moved);
  fields = rigid_fields(state->position + 0.5 * moved);
}

namespace {

/// The frame that turns with a block.
Eigen::Matrix3d frame_of(const BlockModel& block, const Eigen::MatrixX3d& position,
                         const ElasticResponse& elastic) {
  if (block.material().elasticity == Elasticity::linear) return elastic.rotation;
  return polar_decomposition(position.transpose() * block.parts()->mean_gradients).rotation;
}

}  // namespace

void BodyStep::note_start_force() {
  const ElasticResponse at_start = model->elastic(state->position);
  start_force = at_start.force * frame_of(*model, state->position, at_start);
}

Eigen::MatrixX3d BodyStep::internal_force(const TimeScheme& scheme) const {
  if (start_force.size() == 0) return elastic.force;
  const Eigen::Matrix3d frame = frame_of(*model, state->position + scheme.end_share * motion(), elastic);
  return elastic.force + scheme.stiffness_share * (elastic.force - start_force * frame.transpose());
}

Eigen::VectorXd BodyStep::dashpot_force(const TimeScheme& scheme) const {
  if (dashpots == nullptr) return {};
  return *dashpots * (scheme.dashpot_velocity.change * change + carried_velocity);
}

std::vector<Island> find_islands(const std::vector<bool>& moving, const std::vector<ContactPair>& pairs,
                                 const std::vector<StepBolt>& bolts) {
  UnionFind meeting(moving.size());
  for (const ContactPair& pair : pairs)
    if (moving[at(pair.a())] && moving[at(pair.b())]) meeting.unite(pair.a(), pair.b());
  std::vector<int> block_of_bolt;  // one that moves; -1: none
  for (const StepBolt& bolt : bolts) {
    int& first = block_of_bolt.emplace_back(-1);
    for (const int block : bolt.blocks()) {
      if (!moving[at(block)]) continue;
      if (first >= 0) meeting.unite(first, block);
      first = block;
    }
  }
  std::vector<Island> islands;
  std::map<int, std::size_t> island_of_root;
  for (int block = 0; block < static_cast<int>(moving.size()); ++block) {
    if (!moving[at(block)]) continue;
    const auto [place, added] = island_of_root.try_emplace(meeting.find(block), islands.size());
    if (added) islands.emplace_back();
    islands[place->second].bodies.push_back(block);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int block = moving[at(pairs[k].a())] ? pairs[k].a() : pairs[k].b();
    islands[island_of_root.at(meeting.find(block))].pairs.push_back(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < bolts.size(); ++k)
    if (block_of_bolt[k] >= 0)
      islands[island_of_root.at(meeting.find(block_of_bolt[k]))].bolts.push_back(&bolts[k]);
  return islands;
}

void validate(const std::vector<Island>& islands, const std::vector<bool>& moving,
              const std::vector<ContactPair>& pairs) {
  constexpr int nowhere = -1;
  std::vector<int> island_of(moving.size(), nowhere);
  for (std::size_t n = 0; n < islands.size(); ++n) {
    const std::vector<int>& bodies = islands[n].bodies;
    if (bodies.empty() || !std::is_sorted(bodies.begin(), bodies.end()))
      throw std::logic_error("an island is empty or not in order");
    for (const int body : bodies) {
      if (!moving[at(body)] || island_of[at(body)] != nowhere)
        throw std::logic_error("a block is in two islands, or in one without moving");
      island_of[at(body)] = static_cast<int>(n);
    }
  }
  for (std::size_t body = 0; body < moving.size(); ++body)
    if (moving[body] && island_of[body] == nowhere) throw std::logic_error("a block is in no island");
  std::vector<int> island_of_pair(pairs.size(), nowhere);
  for (std::size_t n = 0; n < islands.size(); ++n)
    for (const int pair : islands[n].pairs) island_of_pair[at(pair)] = static_cast<int>(n);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (const int block : {pairs[k].a(), pairs[k].b()})
      if (moving[at(block)] && island_of[at(block)] != island_of_pair[k])
        throw std::logic_error("a contact joins blocks of two islands");
  }
}

IslandSolvers::Entry& solver_of(const Island& island, const std::vector<BodyStep>& bodies,
                                const std::vector<ContactPair>& pairs, SystemRole role,
                                IslandSolvers& solvers) {
  std::map<int, int> place;
  std::vector<int> sizes;
  std::vector<int> key = {static_cast<int>(role)};
  for (const int body : island.bodies) {
    place[body] = static_cast<int>(place.size());
    sizes.push_back(bodies[at(body)].model->freedom());
    key.push_back(body);
  }
  const std::vector<std::array<int, 2>> links = links_of(island, pairs, place);
  for (const std::array<int, 2>& link : links) key.insert(key.end(), link.begin(), link.end());
  return solvers.find(key, sizes, links);
}

IslandResult solve_island(const Island& island, std::vector<BodyStep>& bodies,
                          const std::vector<ContactPair>& pairs, const TimeScheme& scheme,
                          const SimulationSettings& settings, IslandSolvers& solvers) {
  return solve_island(island, bodies, pairs, scheme, settings,
                      solver_of(island, bodies, pairs, SystemRole::step, solvers));
}

IslandResult solve_island(const Island& island, std::vector<BodyStep>& bodies,
                          const std::vector<ContactPair>& pairs, const TimeScheme& scheme,
                          const SimulationSettings& settings, IslandSolvers::Entry& solver) {
  IslandResult result;
  IslandProblem problem(island, bodies, pairs, scheme, settings, solver);
  iterate_open_close(problem, result);
  return result;
}

}  // namespace ashlar
