// Which blocks meet, where, and whether they would pass through each other: the bodies of a scene as geometry
// sees them from step to step.
//
// Work is proportional to what changes: a block is not looked at while it cannot have come near another one,
// pairs known to be apart are not searched again until they could have met, faces are divided only where they
// curve and have a neighbour in reach.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "geometry/contacts/convex_search.hpp"
#include "geometry/contacts/motion_check.hpp"
#include "mechanics/block/block_surface.hpp"
#include "solver/contact/contact_stages.hpp"
#include "solver/contact/occluded_faces_of_step.hpp"
#include "solver/contact/pair_history.hpp"
#include "solver/settings.hpp"

namespace ashlar {

/// The contacts of a pair of blocks (a < b) at the start of a step.
struct FoundContacts {
  PairKey blocks;
  PairContacts contacts;
  double reach = 0.0;  ///< m, up to which gap they were looked for; 0: they are of this step only
  std::shared_ptr<const KeptContacts> kept = nullptr;  ///< null: they were found anew
};

/// Two blocks whose boxes can meet in a step and that are not known to be apart.
struct NearPair {
  PairKey blocks;
  double reach;  ///< m, up to which gap contacts are looked for
};

/// What is known of a near pair without a search; null: nothing.
using KnownContacts = std::vector<const PairContacts*>;

/// Blocks that would pass through each other in a step.
struct PassingBlocks {
  PairKey blocks;
  Touch touch;
};

/// What was done and skipped.
struct FinderCounts {
  std::uint64_t block_pairs_tested = 0;   ///< whose surfaces were searched
  std::uint64_t convex_pairs = 0;         ///< of them, convex solids that were classified as such
  std::uint64_t block_pairs_skipped = 0;  ///< whose boxes cannot meet in the step
  std::uint64_t block_pairs_kept = 0;     ///< whose last search still holds
  std::uint64_t block_pairs_far = 0;      ///< known to be too far apart to have met since the last search
  std::uint64_t motions_checked = 0;      ///< pairs whose surfaces were followed through a step
  std::uint64_t divisions = 0;            ///< times the sub-faces of a block changed
  /// times a block had as many sub-faces as there may be, so that the chord tolerance may not be met
  std::uint64_t divisions_at_limit = 0;
  DecisionCounts predicates;
};

/// Where a block is and what it has gone, as far as it has been looked at.
struct BlockTrack {
  Box box;                      ///< true box when it was looked at last; empty: never
  double box_path = 0.0;        ///< what it had gone until then, m
  double path = 0.0;            ///< what its fastest point has gone so far at most, m
  double motion = 0.0;          ///< expected in the step, m; 0 of blocks that are not near others
  double checked_motion = 0.0;  ///< of the motion checked last, m
};

/// What a finder has beyond its blocks (checkpoint.hpp).
struct FinderState {
  std::vector<BlockTrack> tracks;          ///< by block
  std::vector<SurfaceDivision> divisions;  ///< of surfaces, by block
  FinderCounts counts;
};

/// How far surface points of each block are expected to go in a step, m.
struct ExpectedMotion {
  std::vector<double> loose;          ///< (#blocks) from above, cheap
  std::function<double(int)> closer;  ///< of a block that may be near another, at most `loose`
  double fall = 0.0;                  ///< what of it gravity does
};

/// Keeps surfaces from step to step. What it finds out about pairs is noted in their histories.
class ContactFinder {
 public:
  /// @param blocks must outlive this and stay where they are
  /// @param left_out pairs of blocks between which no contacts are looked for
  /// @param absent by block, or empty: blocks that nothing touches
  /// @param observer of the stages up to the entrance; empty: none
  ContactFinder(const std::vector<BlockModel>& blocks, const SimulationSettings& settings,
                std::set<PairKey> left_out = {}, std::vector<bool> absent = {},
                ContactObserver observer = {});

  /// Takes note which blocks may move; no contacts are looked for between two that do not. @param moving by
  /// block, of fixed blocks false
  void watch(const std::vector<bool>& moving) { moving_ = moving; }
  /// What the fastest point of a block has gone at most in the motion that was checked last, m.
  [[nodiscard]] double checked_motion(int block) const {
    return tracks_[static_cast<std::size_t>(block)].checked_motion;
  }

  /// What the fastest point of a block goes at most when its position changes, m. @param change (p, 3)
  [[nodiscard]] double motion_bound(int block, const Eigen::MatrixX3d& change) const {
    return surfaces_[static_cast<std::size_t>(block)].quick_motion_bound(change);
  }

  /// Pairs that may have contacts within reach at the start of a step, sorted: those to give to find().
  [[nodiscard]] const std::vector<NearPair>& near_pairs(const std::vector<BlockState>& states,
                                                        const ExpectedMotion& motion,
                                                        const PairHistories& histories);
  /// Contacts of the near pairs of which nothing is known, and of those with a neighbour that is near to both and has
  /// contacts with one of them that are not known: they are no longer known either.
  /// @param histories of pairs: how deep they were, clearances and entrances are read and noted
  [[nodiscard]] std::vector<FoundContacts> find(const std::vector<BlockState>& states, KnownContacts& known,
                                                PairHistories& histories);
  /// All contacts within reach at the start of a step.
  [[nodiscard]] std::vector<FoundContacts> find(const std::vector<BlockState>& states,
                                                const ExpectedMotion& motion, PairHistories& histories);
  [[nodiscard]] bool leaves_out(int a, int b) const {
    return absent_[static_cast<std::size_t>(a)] || absent_[static_cast<std::size_t>(b)] ||
           left_out_.count({a, b}) > 0;
  }
  /// The surface of a block of a found pair.
  [[nodiscard]] const PlacedSurface& placed(int block) const {
    return placed_[static_cast<std::size_t>(block)].value();
  }

  /// Blocks that would pass through each other on the way from the last search to new states, features that
  /// a found contact stands for left out; the earliest first.
  [[nodiscard]] std::vector<PassingBlocks> check_motion(const std::vector<BlockState>& before,
                                                        const std::vector<BlockState>& after,
                                                        const std::vector<FoundContacts>& found,
                                                        const PairHistories& histories);
  /// Takes note that the motion checked last was accepted.
  void accept_motion();
  /// Starts anew with a block whose model is another one now. @param model at the place of the old one
  /// @param histories forget the block's clearances
  void renew(int block, const BlockModel& model, PairHistories& histories);
  /// Takes over the coordinates of a new step of an incremental block.
  void start_step(int block) { surfaces_[static_cast<std::size_t>(block)].start_step(); }

  /// How far points on the blocks' surfaces go in a step under their present velocity and gravity.
  /// @param states must outlive the result
  [[nodiscard]] ExpectedMotion expected_motion(const std::vector<BlockState>& states, double step) const;
  [[nodiscard]] const std::vector<BlockSurface>& surfaces() const { return surfaces_; }
  [[nodiscard]] const FinderCounts& counts() const { return counts_; }

  [[nodiscard]] FinderState state() const;
  /// @throws std::invalid_argument if surfaces cannot be divided so
  void restore(const FinderState& state);

 private:
  /// Contains a block at the start of the step, from where it was seen last and what it has gone since.
  [[nodiscard]] Box loose_box(int block) const;
  void look_at(int block, const BlockState& state);
  /// Boxes of all blocks that may be near others, grown by what they may do in the step; others are empty.
  /// @param reach m, beyond the motion: how far apart blocks may be that touch
  [[nodiscard]] std::vector<Box> near_boxes(const std::vector<BlockState>& states,
                                            const ExpectedMotion& motion, double reach);
  /// Divides the surfaces of blocks that curve. @param candidates pairs whose boxes meet
  /// @param boxes of the blocks that were looked at
  void divide_curved(const std::vector<PairKey>& candidates, const std::vector<Box>& boxes);
  /// Places the surfaces of all near blocks that are not placed.
  void place_near(const std::vector<BlockState>& states);
  /// Forgets what is known of pairs near to one that is not known, of which they share a block.
  void forget_neighbours(KnownContacts& known) const;
  /// Whether two near blocks can have contacts.
  [[nodiscard]] bool can_meet(const PairKey& pair) const {
    const auto moves = [this](int block) { return moving_[static_cast<std::size_t>(block)]; };
    return (moves(pair[0]) || moves(pair[1])) && !leaves_out(pair[0], pair[1]);
  }
  [[nodiscard]] bool known_apart(const PairKey& pair, double reach, const PairHistories& histories) const;
  [[nodiscard]] Clearance clearance_of(const PairKey& pair) const;
  /// Pairs whose surfaces have to be followed on the way from the last search to new states.
  /// @param tolerance m: what moves by less passes nothing. @param ends gets the points of their blocks after
  [[nodiscard]] std::vector<PairKey> pairs_that_may_pass(const std::vector<BlockState>& before,
                                                         const std::vector<BlockState>& after,
                                                         double tolerance, const PairHistories& histories,
                                                         std::vector<std::vector<Vector3>>& ends);
  [[nodiscard]] ContactLimits limits_of(const NearPair& pair, const PairHistories& histories) const;
  /// Searches pairs again in which a vertex is in a block below a hidden part of its face.
  /// @param limits of the pairs
  void search_below_occluded(std::vector<FoundContacts>& searched, const KnownContacts& known,
                             const std::vector<ContactLimits>& limits);
  /// Completes the contacts of pairs of convex solids, with history.
  void settle_convex_pairs(std::vector<FoundContacts>& searched, const KnownContacts& known,
                           PairHistories& histories);
  void observe(ContactStage stage, const std::vector<FoundContacts>& searched) const {
    if (!observer_) return;
    for (const FoundContacts& pair : searched) observer_(stage, pair.blocks, pair.contacts);
  }

  SimulationSettings settings_;
  ContactObserver observer_;
  Eigen::Matrix3d axes_;  ///< of the boxes below
  std::vector<bool> absent_;
  std::vector<bool> moving_;  ///< false for fixed blocks, and for those that sleep
  std::set<PairKey> left_out_;
  std::vector<double>
      thickness_;  ///< volume over surface, m: a third of a ball's radius, half of a plate's thickness
  std::vector<bool> convex_;  ///< convex solids whose faces stay flat
  std::vector<BlockSurface> surfaces_;
  std::vector<std::optional<PlacedSurface>> placed_;  ///< none: no other block is near
  std::vector<BlockTrack> tracks_;                    ///< by block
  std::vector<NearPair> near_;                        ///< of the step
  OccludedFacesOfStep sides_;                         ///< that lie on other blocks
  std::set<PairKey> hidden_;  ///< pairs of the last search that were searched again for hidden sides
  FinderCounts counts_;
};

}  // namespace ashlar
