// Detects the contacts of a step: which blocks meet where, less what only sinking has made meet
// (internal_edges.hpp), and makes contact pairs of them, with what their histories remember. A list of contacts
// is made by detect(), or by with_passing() from another one, and not changed after.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/contact/contact_finder.hpp"
#include "solver/contact/contact_pair.hpp"
#include "solver/contact/internal_edges.hpp"
#include "solver/contact/reference_order.hpp"
#include "solver/contact/surface_continuation.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// What contact pairs are made for.
enum class PairUse {
  motion,  ///< springs found anew hold no more than at the end of the last step, multipliers hold what is found
  statics  ///< slip counts from the start of the load level, bonds hold until it has been in balance
};

/// The contacts of some list, and those of features that would pass through each other.
[[nodiscard]] std::vector<FoundContacts> with_passing(std::vector<FoundContacts> found,
                                                      const std::vector<PassingBlocks>& passing);

/// Keeps surfaces from step to step.
class StepContacts {
 public:
  /// @param system its blocks must stay where they are. @param observer of the stages of detect(); empty: none
  explicit StepContacts(const BlockSystem& system, ContactObserver observer = {});

  /// All contacts at the present state. @param step s, in which blocks may come near; 0: in an iteration of a
  /// static analysis
  [[nodiscard]] std::vector<FoundContacts> detect(const BlockSystem& system, RunState& state, double step);
  /// Contact pairs of a list, then ties.
  [[nodiscard]] std::vector<ContactPair> pairs(const BlockSystem& system, RunState& state,
                                               const std::vector<FoundContacts>& found, PairUse use) const;
  /// Blocks that would pass through each other on the way to new states, the earliest first.
  [[nodiscard]] std::vector<PassingBlocks> check_motion(const BlockSystem& system, RunState& state,
                                                        const std::vector<BlockState>& after,
                                                        const std::vector<FoundContacts>& found);

  [[nodiscard]] const ContactFinder& finder() const { return finder_; }
  [[nodiscard]] ContactFinder& finder() { return finder_; }

 private:
  /// Contacts of near pairs that need not be found anew, empty where they have to be.
  [[nodiscard]] std::vector<std::shared_ptr<const KeptContacts>> kept(
      const BlockSystem& system, const RunState& state, const std::vector<NearPair>& near) const;
  /// Notes that nothing was found of near pairs that were searched.
  /// @param found by the search, without what was known
  void note_apart(const BlockSystem& system, RunState& state, const std::vector<NearPair>& near,
                  const KnownContacts& known, const std::vector<FoundContacts>& found) const;
  /// Contacts of seams are left out of those that were found anew.
  void remove_internal_edges_of(const BlockSystem& system, const RunState& state,
                                std::vector<FoundContacts>& found);
  /// One pair whose contacts were known.
  [[nodiscard]] static ContactPair kept_pair(const BlockSystem& system, const RunState& state,
                                             const FoundContacts& found, JointLaw law);
  /// Ways out of the step, found when first asked for.
  const Retractions& retractions(const RunState& state, const std::vector<bool>& moving,
                                 const std::vector<FoundContacts>& found);
  /// One pair of a list; none if its contacts have no points.
  [[nodiscard]] std::optional<ContactPair> pair_of(const BlockSystem& system, const RunState& state,
                                                   const FoundContacts& found, JointLaw law, PairUse use,
                                                   const SurfaceContinuation& covered) const;
  /// By how much blocks have given way, at the present state.
  [[nodiscard]] static BlockCompression compression_of(const BlockSystem& system, const RunState& state);
  /// Which ways out count among some contacts. All must outlive the answer.
  [[nodiscard]] std::function<bool(const Retraction&)> standing_retractions(
      const BlockSystem& system, const RunState& state, const std::vector<FoundContacts>& found) const;

  ContactObserver observer_;
  ContactFinder finder_;
  ReferenceOrder order_;
  std::optional<Retractions> retractions_;  ///< of the step
};

}  // namespace ashlar
