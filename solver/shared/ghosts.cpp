#include "solver/shared/ghosts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "geometry/solid/face_axes.hpp"
#include "solver/shared/ghost_models.hpp"
#include "solver/shared/shared_bolts.hpp"
#include "solver/shared/shared_step.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/detect/sleeping_islands.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

/// Of the mean size of blocks: with a larger margin ghosts are more, and found less often.
constexpr double least_margin = 0.05;
/// Relative to the lengths of a solid: areas and directions of its faces that differ by less are equal, as in
/// contact_finder.cpp. Larger values would let ranks order boxes along another face than one process does.
constexpr double equal_faces = 1e-9;
/// Expected motions of a step in the margin.
constexpr double steps_in_margin = 4.0;

/// A block that stands for all blocks of which a rank knows nothing: the solid with the fewest faces, as each has a
/// surface.
const BlockModel& unknown_block() {
  static const BlockModel block = [] {
    BlockDefinition definition;
    definition.name = "absent";
    definition.solid = std::make_shared<const Polyhedron>(
        TriangleMesh{{Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()},
                     {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
    definition.material = {1.0, 1.0, 0.0};
    definition.order = 1;
    definition.fixed = true;
    return BlockModel(std::move(definition));
  }();
  return block;
}

struct BlockBox {
  int block = -1;
  Box box;
  bool fixed = false;
};

/// Largest face of the blocks of a rank.
struct LargestFace {
  int block = std::numeric_limits<int>::max();
  double area = 0.0;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Tells all ranks the places of all undeformed blocks.
void exchange_places(BlockShare& share, const std::vector<BlockModel>& blocks) {
  std::vector<PlacedVolume> own;
  LargestFace largest;
  for (const int k : share.own()) {
    const BlockModel& block = blocks[at(k)];
    own.push_back({block.basis().centroid(), block.basis().volume()});
    const double area = largest_face_area(block.solid(), equal_faces);
    if (area > (1.0 + equal_faces) * largest.area)
      largest = {k, area, axes_along_largest_face({&block.solid()}, equal_faces)};
  }
  std::vector<PlacedVolume> places(blocks.size());
  const std::vector<std::vector<PlacedVolume>> of_ranks = values_of_ranks(share.ranks(), own);
  std::vector<std::size_t> next(of_ranks.size(), 0);
  for (int k = 0; k < share.count(); ++k) {
    const std::size_t rank = at(share.owner(k));
    places[at(k)] = of_ranks[rank][next[rank]++];
  }
  std::vector<LargestFace> faces = values_of_ranks(share.ranks(), largest);
  std::sort(faces.begin(), faces.end(), [](const auto& x, const auto& y) { return x.block < y.block; });
  LargestFace most = faces.front();
  for (const LargestFace& face : faces)
    if (face.area > (1.0 + equal_faces) * most.area) most = face;
  share.set_places(std::move(places), most.axes);
}

/// Blocks of other ranks near own ones that move. Collective. @param own boxes of own blocks along the common axes
/// @param reach m, of boxes from each other
std::vector<int> ghosts_of(const BlockShare& share, const std::vector<BlockBox>& own, double reach) {
  std::vector<Box> mine, others;
  std::vector<int> blocks;
  Box all;  // of own blocks that move
  for (const BlockBox& one : own) {
    if (one.fixed) continue;
    mine.push_back(one.box.grown(reach));
    all.include(mine.back());
  }
  const std::vector<std::vector<BlockBox>> of_ranks = values_of_ranks(share.ranks(), own);
  for (int rank = 0; rank < share.ranks().count(); ++rank) {
    if (rank == share.ranks().own()) continue;
    for (const BlockBox& one : of_ranks[at(rank)]) {
      if (!all.meets(one.box)) continue;
      blocks.push_back(one.block);
      others.push_back(one.box);
    }
  }
  std::set<int> ghosts;
  for (const auto& [one, other] : meeting_boxes(mine, others)) ghosts.insert(blocks[at(other)]);
  return {ghosts.begin(), ghosts.end()};
}

bool is_absent(const std::vector<bool>& absent, int block) {
  return !absent.empty() && absent[at(block)];
}

/// Adds the blocks that own ones are tied to.
std::vector<int> with_tied(const SharedBlocks& shared, std::vector<int> ghosts) {
  for (const auto& [a, b] : shared.tied) {
    if (is_absent(shared.absent, a) || is_absent(shared.absent, b)) continue;
    if (shared.share->owns(a)) ghosts.push_back(b);
    if (shared.share->owns(b)) ghosts.push_back(a);
  }
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  return ghosts;
}

/// Margin for an expected motion in a step, m.
double margin_for(const BlockShare& share, double motion) {
  double size = 0.0;
  for (const PlacedVolume& place : share.places()) size += correctly_rounded::cbrt(place.volume);
  return std::max(least_margin * size / static_cast<double>(share.places().size()), steps_in_margin * motion);
}

/// Largest gap of blocks that touch, m.
double reach_of(const SimulationSettings& settings, const RunState& state) {
  double dilation = 0.0;
  for (const auto& [blocks, pair] : state.pairs) dilation = std::max(dilation, pair.memory.most_dilation());
  return settings.contact_distance + dilation;
}

/// Memory with one closed point of each normal.
ContactMemory closed_normals(const ContactMemory& memory) {
  std::vector<ContactMemory::Entry> kept;
  for (const ContactMemory::Entry& entry : memory.entries()) {
    const auto same = [&entry](const ContactMemory::Entry& known) { return known.normal == entry.normal; };
    if (entry.memory.state != ContactState::open && std::none_of(kept.begin(), kept.end(), same))
      kept.push_back(entry);
  }
  return {std::move(kept), {}, memory.deepest(), memory.held(), memory.bulge()};
}

/// Removes what a rank knows of the contacts of a block which is no ghost any more, or was none before. Sums over the run
/// stay.
void forget_block(int block, RunState& state, StepCaches& caches) {
  const auto has = [block](const auto& blocks) { return blocks[0] == block || blocks[1] == block; };
  for (auto& [blocks, pair] : state.pairs) {
    if (has(blocks)) forget_contacts(pair);
  }
  std::erase_if(state.records,
                [block](const PairRecord& record) { return record.a == block || record.b == block; });
  std::erase_if(state.depths.depths, [&](const MeasuredDepth& depth) { return has(depth.pair.blocks); });
  if (at(block) < state.depths.positions.size()) state.depths.positions[at(block)].resize(0, 3);
  caches.audit.forget(at(block));
}

}  // namespace

void forget_contacts(PairHistory& pair) {
  pair.memory = ContactMemory();
  pair.cache.reset();
  pair.clearance.reset();
  pair.entrance.reset();
  pair.depth = 0.0;
}

void set_block_here(BlockSystem& system, RunState& state, StepCaches& caches, int block, BlockModel model,
                    bool here) {
  system.set_here(block, std::move(model), here);
  forget_block(block, state, caches);
  caches.contacts.finder().set_presence(block, system.blocks()[at(block)], system.here(block), state.pairs);
  const Eigen::Index size = system.blocks()[at(block)].basis().size();
  if (state.states[at(block)].position.rows() != size)
    state.states[at(block)] = system.blocks()[at(block)].initial_state();
  if (!state.accelerations.empty()) state.accelerations[at(block)].setZero(size, 3);
  state.sleep.rests[at(block)] = {};
}

namespace {

/// Removes sums of pairs with blocks that go away, unless this rank makes them: once a block is elsewhere this rank does
/// not know that it makes none of its contacts.
void leave_sums_to_owners(const BlockSystem& system, RunState& state, const std::vector<int>& gone) {
  const auto goes = [&gone](int block) { return std::binary_search(gone.begin(), gone.end(), block); };
  for (auto& [blocks, pair] : state.pairs) {
    if ((!goes(blocks[0]) && !goes(blocks[1])) || system.owns_pair(blocks[0], blocks[1])) continue;
    pair.work = pair.spent = pair.bonded = pair.broken = 0.0;
  }
}

/// Replaces the ghosts of this rank. Collective. @param after increasing
void change_ghosts(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                   const std::vector<int>& after) {
  BlockShare& share = *shared.share;
  const std::vector<int> before = share.ghosts();
  share.set_ghosts(after);
  std::vector<int> gone, come;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(gone));
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(come));
  std::vector<BlockModel> models;
  const auto known = [&](int block) { return system.blocks()[at(block)]; };
  do_on_all(share.ranks(), [&] {
    for (const int block : come) models.push_back(shared.keeps_models ? known(block) : shared.load(block));
  });
  leave_sums_to_owners(system, state, gone);
  for (const int block : gone)
    set_block_here(system, state, caches, block, shared.keeps_models ? known(block) : unknown_block(), false);
  for (std::size_t k = 0; k < come.size(); ++k)
    set_block_here(system, state, caches, come[k], std::move(models[k]), true);
  update_ghost_models(system, state, caches);
  hold_sleepers(system, state.sleep);
  shared.border.forget();
}

}  // namespace

void find_ghosts(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches) {
  BlockShare& share = *shared.share;
  const ContactFinder& finder = caches.contacts.finder();
  ++shared.searches;
  std::vector<BlockBox> boxes;
  for (const int k : share.own()) {
    if (!system.here(k)) continue;
    const BlockSurface& surface = finder.surfaces()[at(k)];
    boxes.push_back({k,
                     box_along(share.axes(), surface.points(state.states[at(k)]))
                         .grown(surface.bulge(state.states[at(k)])),
                     system.blocks()[at(k)].fixed()});
  }
  const double reach = max_of_ranks(share.ranks(), reach_of(system.settings(), state));
  const std::vector<int> near = ghosts_of(share, boxes, reach + 2.0 * shared.margin);
  change_ghosts(shared, system, state, caches, with_bolted(system, with_tied(shared, near)));
  tell_states(system, state);
  update_ghost_contacts(system, state);
  for (int k = 0; k < system.count(); ++k) shared.paths[at(k)] = finder.path(k);
}

BlocksOfRank share_blocks(Ranks& ranks, std::vector<int> owners, BlockLoader load,
                          const SimulationSettings& settings, std::vector<bool> absent,
                          const RankSolverMaker& solver, bool keeps_models,
                          const std::vector<TieRequest>& ties) {
  BlocksOfRank result;
  result.shared = std::make_unique<SharedBlocks>(SharedBlocks{
      std::make_unique<BlockShare>(ranks, std::move(owners), solver), std::move(load), std::move(absent)});
  SharedBlocks& shared = *result.shared;
  BlockShare& share = *shared.share;
  shared.keeps_models = keeps_models;
  for (const TieRequest& tie : ties)
    if (share.owner(tie.a) != share.owner(tie.b)) shared.tied.push_back({tie.a, tie.b});
  result.blocks.assign(at(share.count()), unknown_block());
  shared.paths.assign(at(share.count()), 0.0);
  const auto take = [&](const std::vector<int>& blocks) {
    do_on_all(ranks, [&] {
      for (const int k : blocks) result.blocks[at(k)] = shared.load(k);
    });
  };
  std::vector<int> all(at(share.count()));
  std::iota(all.begin(), all.end(), 0);
  take(keeps_models ? all : share.own());
  exchange_places(share, result.blocks);
  shared.margin = margin_for(share, 0.0);
  std::vector<BlockBox> boxes;
  for (const int k : share.own())
    if (!is_absent(shared.absent, k))
      boxes.push_back({k, box_along(share.axes(), result.blocks[at(k)].solid().mesh().points),
                       result.blocks[at(k)].fixed()});
  share.set_ghosts(
      with_tied(shared, ghosts_of(share, boxes, settings.contact_distance + 2.0 * shared.margin)));
  take(keeps_models ? std::vector<int>() : share.ghosts());
  shared.exchange = std::make_unique<SharedStep>(shared);
  return result;
}

void find_ghosts_for(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                     double step) {
  const ContactFinder& finder = caches.contacts.finder();
  const std::vector<BlockState> driven = driven_states(system, state, step);
  // As StepContacts::detect, whose iterations of a static analysis take a second.
  const ExpectedMotion motion = driven.empty() ? finder.expected_motion(state.states, step)
                                               : finder.expected_motion(driven, step > 0.0 ? step : 1.0);
  double farthest = 0.0, fastest = 0.0;
  for (const int k : shared.share->own()) {
    if (!system.here(k)) continue;
    fastest = std::max(fastest, motion.loose[at(k)]);
    farthest = std::max(farthest, finder.path(k) - shared.paths[at(k)] + motion.loose[at(k)]);
  }
  const std::vector<double> most = max_of_ranks(shared.share->ranks(), std::vector{farthest, fastest});
  if (most[0] <= shared.margin || !std::isfinite(most[1])) return;
  shared.margin = margin_for(*shared.share, most[1]);
  find_ghosts(shared, system, state, caches);
}

double farthest_path(const SharedBlocks& shared, const BlockSystem& system, const ContactFinder& finder,
                     const std::function<Eigen::MatrixX3d(int block)>& motion) {
  double farthest = 0.0;
  for (const int k : shared.share->own())
    if (system.moving()[at(k)])
      farthest = std::max(farthest, finder.path(k) - shared.paths[at(k)] +
                                        (motion ? finder.motion_bound(k, motion(k)) : 0.0));
  return farthest;
}

void find_ghosts_within(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                        double travel) {
  if (travel > 0.0) shared.margin = margin_for(*shared.share, travel);
  find_ghosts(shared, system, state, caches);
}

GhostsThen ghosts_now(const SharedBlocks& shared) {
  return {shared.share->ghosts(), shared.margin, shared.paths};
}

void restore_ghosts(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                    const GhostsThen& then) {
  change_ghosts(shared, system, state, caches, then.ghosts);
  shared.margin = then.margin;
  shared.paths = then.paths;
}

void update_ghost_contacts(const BlockSystem& system, RunState& state) {
  const BlockShare& share = share_of(system);
  const auto lends = [&](int block, int rank) {
    const std::vector<int>& lent = share.lent_to(rank);
    return share.owns(block) && std::binary_search(lent.begin(), lent.end(), block);
  };
  share.exchange(
      [&](ByteWriter& writer, int rank) {
        for (const auto& [blocks, pair] : state.pairs) {
          if (!(pair.memory.deepest() > 0.0) || !system.owns_pair(blocks[0], blocks[1])) continue;
          if (!lends(blocks[0], rank) && !lends(blocks[1], rank)) continue;
          const auto moves_there = [&](int block) {
            return share.owner(block) == rank && !system.blocks()[at(block)].fixed();
          };
          // A rank remembers pairs of its own blocks itself.
          if (!moves_there(blocks[0]) && !moves_there(blocks[1])) writer(blocks, closed_normals(pair.memory));
        }
      },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          PairKey blocks;
          ContactMemory memory;
          reader(blocks, memory);
          if (system.here(blocks[0]) && system.here(blocks[1]))
            state.pairs[blocks].memory = std::move(memory);
        }
      });
}

void continue_work(const SharedBlocks& before, SharedBlocks& now) {
  now.searches += before.searches;
  now.for_results += before.for_results;
  now.balance.repartitions += before.balance.repartitions;
  now.earlier += before.earlier;
  now.earlier += before.share->solver().work();
  now.earlier += before.share->step_solver().work();
}

}  // namespace ashlar
