// Contact detection from step to step: near pairs of blocks, their contacts, and continuous collision checks.
//
// Work is proportional to changes. A block is skipped while it cannot have come near another one. Pairs known to be
// apart are searched again only when they could have met. Faces are divided only if they curve and have a neighbour
// in reach.
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
#include "solver/contact/covered_faces.hpp"
#include "solver/contact/pair_history.hpp"
#include "solver/settings.hpp"

namespace ashlar {

/// The contacts of a pair of blocks (a < b) at the start of a step.
struct FoundContacts {
  PairKey blocks;
  PairContacts contacts;
  double reach = 0.0;  ///< m, largest gap searched; 0: valid for this step only
  std::shared_ptr<const KeptContacts> kept = nullptr;  ///< null: detected by a search
};

/// Two blocks whose boxes can meet in a step and that are not known to be apart.
struct NearPair {
  PairKey blocks;
  double reach;  ///< m, largest gap searched
};

/// Contacts of each near pair known without a search; null: unknown.
using KnownContacts = std::vector<const PairContacts*>;

/// Blocks that would pass through each other in a step.
struct PassingBlocks {
  PairKey blocks;
  Touch touch;
};

/// Counts of work done and skipped.
struct FinderCounts {
  std::uint64_t block_pairs_tested = 0;   ///< whose surfaces were searched
  std::uint64_t convex_pairs = 0;         ///< of them, convex solids that were classified as such
  std::uint64_t block_pairs_skipped = 0;  ///< whose boxes cannot meet in the step
  std::uint64_t block_pairs_kept = 0;     ///< whose last search is still valid
  std::uint64_t block_pairs_far = 0;      ///< known to be too far apart to have met since the last search
  std::uint64_t cells_near = 0;           ///< sub-faces looked at in searches of pairs, by their boxes
  std::uint64_t motions_checked = 0;      ///< pairs in continuous collision checks
  std::uint64_t divisions = 0;            ///< times the sub-faces of a block changed
  /// times a block had the largest number of sub-faces, so that the chord tolerance may not be met
  std::uint64_t divisions_at_limit = 0;
  DecisionCounts predicates;
};

/// Place of a block and length of its path, as last evaluated.
struct BlockTrack {
  Box box;                      ///< true box at the last evaluation; empty: never
  double box_path = 0.0;        ///< path at that time, m
  double path = 0.0;            ///< upper bound of the path of its fastest point so far, m
  double motion = 0.0;          ///< expected in the step, m; 0 for blocks that are not near others
  double checked_motion = 0.0;  ///< of the last continuous collision check, m
};

/// Data of a finder beyond its blocks (checkpoint.hpp).
struct FinderState {
  std::vector<BlockTrack> tracks;          ///< by block
  std::vector<SurfaceDivision> divisions;  ///< of surfaces, by block
  FinderCounts counts;
};

/// Expected motion of surface points of each block in a step, m.
struct ExpectedMotion {
  std::vector<double> loose;          ///< (#blocks) cheap upper bounds
  std::function<double(int)> closer;  ///< for a block that may be near another, at most `loose`
  double fall = 0.0;                  ///< part due to gravity
};

/// Keeps surfaces from step to step. Results about pairs are stored in their histories.
class ContactFinder {
 public:
  /// @param blocks must outlive this and keep their addresses
  /// @param left_out pairs of blocks between which no contacts are searched
  /// @param absent by block, or empty: blocks without contacts
  /// @param observer of the stages up to the entrance; empty: none
  /// @param axes of the boxes; empty: along the largest face of all blocks
  ContactFinder(const std::vector<BlockModel>& blocks, const SimulationSettings& settings,
                std::set<PairKey> left_out = {}, std::vector<bool> absent = {}, ContactObserver observer = {},
                const std::optional<Eigen::Matrix3d>& axes = std::nullopt);

  /// Sets the blocks that may move. No contacts are searched between two blocks that do not. @param moving by block,
  /// false for fixed blocks
  void watch(const std::vector<bool>& moving) { moving_ = moving; }
  /// Upper bound of the path of a block's fastest point in the last continuous collision check, m.
  [[nodiscard]] double checked_motion(int block) const {
    return tracks_[static_cast<std::size_t>(block)].checked_motion;
  }

  /// Upper bound of the path of a block's fastest point so far, m.
  [[nodiscard]] double path(int block) const { return tracks_[static_cast<std::size_t>(block)].path; }
  /// Upper bound of the path of a block's fastest point for a change of its position, m. @param change (p, 3)
  [[nodiscard]] double motion_bound(int block, const Eigen::MatrixX3d& change) const {
    return surfaces_[static_cast<std::size_t>(block)].quick_motion_bound(change);
  }

  /// Pairs that may have contacts within reach at the start of a step, sorted: the argument of find().
  [[nodiscard]] const std::vector<NearPair>& near_pairs(const std::vector<BlockState>& states,
                                                        const ExpectedMotion& motion,
                                                        const PairHistories& histories);
  /// Contacts of the near pairs that are not known. A known pair is searched too, and set unknown, if a block near to
  /// both has unknown contacts with one of them.
  /// @param histories of pairs: depths, clearances and entrances are read and updated
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

  /// Blocks that would pass through each other on the way from the last search to new states, ordered by time.
  /// Features of detected contacts are excluded.
  [[nodiscard]] std::vector<PassingBlocks> check_motion(const std::vector<BlockState>& before,
                                                        const std::vector<BlockState>& after,
                                                        const std::vector<FoundContacts>& found,
                                                        const PairHistories& histories);
  /// Records that the last checked motion was accepted.
  void accept_motion();
  /// Replaces a block whose model has changed. @param model at the place of the old one
  /// @param histories clearances of the block are removed
  void renew(int block, const BlockModel& model, PairHistories& histories);
  /// Makes a block present, or absent, with a new model. It has no contacts yet. @param model at the place of the old one
  void set_presence(int block, const BlockModel& model, bool present, PairHistories& histories);
  /// Updates the coordinates for a new step of an incremental block.
  void start_step(int block) { surfaces_[static_cast<std::size_t>(block)].start_step(); }
  /// Changes SearchSettings::chord_tolerance from the next search on; contacts are detected again. @param tolerance m, > 0
  void set_chord_tolerance(double tolerance, PairHistories& histories);

  /// Expected motion of points on the blocks' surfaces in a step under their present velocity and gravity.
  /// @param states must outlive the result
  [[nodiscard]] ExpectedMotion expected_motion(const std::vector<BlockState>& states, double step) const;
  [[nodiscard]] const std::vector<BlockSurface>& surfaces() const { return surfaces_; }
  [[nodiscard]] const FinderCounts& counts() const { return counts_; }

  [[nodiscard]] FinderState state() const;
  /// @throws std::invalid_argument if the divisions do not fit the surfaces
  void restore(const FinderState& state);

 private:
  /// Bounding box of a block at the start of the step, from its last box and its path since then.
  [[nodiscard]] Box loose_box(int block) const;
  void look_at(int block, const BlockState& state);
  /// Boxes of all blocks that may be near others, grown by their possible motion in the step; others are empty.
  /// @param reach m, beyond the motion: largest gap of touching blocks
  [[nodiscard]] std::vector<Box> near_boxes(const std::vector<BlockState>& states,
                                            const ExpectedMotion& motion, double reach);
  /// Divides the surfaces of blocks that curve. @param candidates pairs whose boxes meet
  /// @param boxes of the evaluated blocks
  void divide_curved(const std::vector<PairKey>& candidates, const std::vector<Box>& boxes);
  /// Places the surfaces of all near blocks that have not been placed.
  void place_near(const std::vector<BlockState>& states);
  /// Sets pairs unknown that are near an unknown pair and share a block with it.
  void forget_neighbours(KnownContacts& known) const;
  /// True if two near blocks can have contacts.
  [[nodiscard]] bool can_meet(const PairKey& pair) const {
    const auto moves = [this](int block) { return moving_[static_cast<std::size_t>(block)]; };
    return (moves(pair[0]) || moves(pair[1])) && !leaves_out(pair[0], pair[1]);
  }
  [[nodiscard]] bool known_apart(const PairKey& pair, double reach, const PairHistories& histories) const;
  [[nodiscard]] Clearance clearance_of(const PairKey& pair) const;
  /// Pairs that need a continuous collision check from the last search to new states.
  /// @param tolerance m: smaller motion is ignored. @param ends gets the points of their blocks after
  [[nodiscard]] std::vector<PairKey> pairs_that_may_pass(const std::vector<BlockState>& before,
                                                         const std::vector<BlockState>& after,
                                                         double tolerance, const PairHistories& histories,
                                                         std::vector<std::vector<Vector3>>& ends);
  /// The surface of a block after a motion. Empty: it does not move. @param ends of pairs_that_may_pass
  [[nodiscard]] std::optional<PlacedSurface> end_of(int block,
                                                    const std::vector<std::vector<Vector3>>& ends) const;
  [[nodiscard]] ContactLimits limits_of(const NearPair& pair, const PairHistories& histories) const;
  /// Searches pairs again if a vertex is inside a block below an occluded part of its face.
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
  ContactAngle contact_angle_;
  ContactObserver observer_;
  Eigen::Matrix3d axes_;  ///< of the boxes below
  std::vector<bool> absent_;
  std::vector<bool> moving_;  ///< false for fixed and sleeping blocks
  std::set<PairKey> left_out_;
  std::vector<double>
      thickness_;  ///< volume over surface, m: a third of a ball's radius, half of a plate's thickness
  std::vector<bool> convex_;  ///< convex solids with flat faces
  std::vector<BlockSurface> surfaces_;
  std::vector<std::optional<PlacedSurface>> placed_;  ///< empty: no other block is near
  std::vector<BlockTrack> tracks_;                    ///< by block
  std::vector<NearPair> near_;                        ///< of the step
  OccludedFacesOfStep sides_;                         ///< occluded faces
  std::set<PairKey> hidden_;  ///< pairs of the last search that were searched again for occluded faces
  FinderCounts counts_;
};

}  // namespace ashlar
