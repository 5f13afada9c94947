// Ghosts of a run that ranks share: which blocks of others are near, their models and their state.
//
// Two blocks may touch in a step only if their boxes come within contact reach. Ghosts are the blocks of others that do
// so if all blocks move by a margin. They are found again when some block may leave its margin in the coming step. Boxes
// are then exchanged among all ranks, models are made from the scene, which each rank can read, and states are sent.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "mechanics/block/block_model.hpp"
#include "solver/ranks/block_share.hpp"
#include "solver/ranks/partition.hpp"
#include "solver/shared/border_pairs.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"
#include "solver/state/step_exchange.hpp"
#include "solver/step/step_caches.hpp"

namespace ashlar {

/// Makes the model of any block as the run starts.
using BlockLoader = std::function<BlockModel(int block)>;

/// Blocks of a run that ranks share, beyond their models.
struct SharedBlocks {
  std::unique_ptr<BlockShare> share;
  BlockLoader load;
  std::vector<bool> absent;   ///< by block: on all ranks
  double margin = 0.0;        ///< m, by which each block may move before ghosts are found again
  bool keeps_models = false;  ///< this rank keeps the models of all blocks, for results
  std::vector<PairKey> tied =
      {};  ///< pairs of blocks of two ranks that are ghosts of each other wherever they are
  std::vector<double> paths = {};  ///< by block, m: ContactFinder::path() when ghosts were found
  RankTraffic for_results = {};    ///< messages of results and snapshots
  int searches = 0;                ///< for ghosts, after the first one
  Rebalancing balance = {};
  SharedWork earlier = {};  ///< systems of earlier stages (run/stage_start.hpp)
  BorderPairs border = {};
  std::unique_ptr<StepExchange> exchange = {};  ///< not null once share_blocks() has made it
};

/// The blocks of one rank at the start of a run.
struct BlocksOfRank {
  std::vector<BlockModel> blocks;  ///< own blocks and ghosts; all others are the same small fixed block
  std::unique_ptr<SharedBlocks> shared;
};

/// Loads own blocks and ghosts. Collective; errors of the loader are thrown on all ranks.
/// @param owners rank of each block, the same on all ranks
/// @param absent by block, or empty: blocks that are absent from the run
/// @param solver see BlockShare. @param keeps_models true: this rank has the models of all blocks
/// @param ties of the run: tied blocks of two ranks are always ghosts of each other
[[nodiscard]] BlocksOfRank share_blocks(Ranks& ranks, std::vector<int> owners, BlockLoader load,
                                        const SimulationSettings& settings, std::vector<bool> absent = {},
                                        const RankSolverMaker& solver = {}, bool keeps_models = false,
                                        const std::vector<TieRequest>& ties = {});

/// Removes what a rank knows of the contacts of a pair. Sums over the run and the initial overlap stay.
void forget_contacts(PairHistory& pair);

/// Counts the work of a rank in the stage before together with that of the present one.
void continue_work(const SharedBlocks& before, SharedBlocks& now);

/// Makes a block one of those that this rank has, or takes it from them: it forgets the block's contacts. Sums over the
/// run stay. @param model of the block; of one that is elsewhere any
void set_block_here(BlockSystem& system, RunState& state, StepCaches& caches, int block, BlockModel model,
                    bool here);

/// Finds ghosts again, by the present state. Collective.
void find_ghosts(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches);

/// Finds ghosts again if a block may leave its margin in the coming step. Collective.
/// @param step s; 0: an iteration of a static analysis
void find_ghosts_for(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                     double step);

/// Largest path of an own block since ghosts were found, m. @param motion by block: change of its position, (p, 3);
/// empty: none
[[nodiscard]] double farthest_path(const SharedBlocks& shared, const BlockSystem& system,
                                   const ContactFinder& finder,
                                   const std::function<Eigen::MatrixX3d(int block)>& motion);

/// Finds ghosts again, with a margin for a path of blocks. Collective. @param travel m; 0: with the present margin
void find_ghosts_within(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                        double travel);

/// Ghosts at some time of a run, to be restored with a snapshot of one rank.
struct GhostsThen {
  std::vector<int> ghosts;
  double margin = 0.0;
  std::vector<double> paths;
};
[[nodiscard]] GhostsThen ghosts_now(const SharedBlocks& shared);
/// Restores ghosts, whose states are to be restored then. Collective.
void restore_ghosts(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                    const GhostsThen& then);

/// Gives ranks the memory of contacts of their ghosts with other blocks that are not their own: retractions from them
/// decide which contacts are at internal edges. Normals of closed points and depths suffice. Collective.
void update_ghost_contacts(const BlockSystem& system, RunState& state);

}  // namespace ashlar
