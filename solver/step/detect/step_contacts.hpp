// Detects the contacts of a step, removes those caused only by penetration (internal_edges.hpp), and makes contact
// pairs from them and from their histories. A list of contacts is made by detect(), or from another one by
// with_passing(), and not changed afterwards.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solver/contact/contact_finder.hpp"
#include "solver/contact/contact_pair.hpp"
#include "solver/contact/covered_faces.hpp"
#include "solver/contact/internal_edges.hpp"
#include "solver/contact/reference_order.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"
#include "solver/step/detect/pair_recipe.hpp"

namespace ashlar {

/// Purpose of contact pairs.
enum class PairUse {
  motion,  ///< re-detected springs hold at most the force at the end of the last step; multipliers freeze the
           ///< current gap
  statics  ///< slip counts from the start of the load level, bonds do not fail until it has been in balance
};

/// Adds the contacts of features that would pass through each other to a list.
[[nodiscard]] std::vector<FoundContacts> with_passing(std::vector<FoundContacts> found,
                                                      const std::vector<PassingBlocks>& passing);

/// Keeps surfaces from step to step.
class StepContacts {
 public:
  /// @param system its blocks must stay where they are. @param observer of the stages of detect(); empty: none
  explicit StepContacts(const BlockSystem& system, ContactObserver observer = {});

  /// All contacts at the present state. @param step s, for the search distance of moving blocks; 0: in an iteration
  /// of a static analysis
  [[nodiscard]] std::vector<FoundContacts> detect(const BlockSystem& system, RunState& state, double step);
  /// Contact pairs of a list, then ties. With several processes those of own blocks; collective then.
  [[nodiscard]] std::vector<ContactPair> pairs(const BlockSystem& system, RunState& state,
                                               const std::vector<FoundContacts>& found, PairUse use);
  /// Blocks that would pass through each other on the way to new states, ordered by time.
  [[nodiscard]] std::vector<PassingBlocks> check_motion(const BlockSystem& system, RunState& state,
                                                        const std::vector<BlockState>& after,
                                                        const std::vector<FoundContacts>& found);

  [[nodiscard]] const ContactFinder& finder() const { return finder_; }
  [[nodiscard]] ContactFinder& finder() { return finder_; }

 private:
  /// Cached contacts of near pairs that are still valid; empty where they have to be detected again.
  [[nodiscard]] std::vector<std::shared_ptr<const KeptContacts>> kept(
      const BlockSystem& system, const RunState& state, const std::vector<NearPair>& near) const;
  /// Records near pairs whose search found no contact.
  /// @param found by the search, without cached contacts
  void note_apart(const BlockSystem& system, RunState& state, const std::vector<NearPair>& near,
                  const KnownContacts& known, const std::vector<FoundContacts>& found) const;
  /// Removes contacts at internal edges from those that were detected again.
  void remove_internal_edges_of(const BlockSystem& system, const RunState& state,
                                std::vector<FoundContacts>& found);
  /// Retractions of the step, computed at the first call.
  const Retractions& retractions(const RunState& state, const std::vector<bool>& moving,
                                 const std::vector<FoundContacts>& found);
  /// Makes the recipe of one entry of a list; empty if its contacts have no points.
  [[nodiscard]] std::optional<PairRecipe> recipe_of(const BlockSystem& system, const RunState& state,
                                                    const FoundContacts& found, JointLaw law, PairUse use,
                                                    const SurfaceContinuation& covered) const;
  /// Elastic compression of blocks at the present state.
  [[nodiscard]] static BlockCompression compression_of(const BlockSystem& system, const RunState& state);

  ContactObserver observer_;
  ContactFinder finder_;
  ReferenceOrder order_;
  std::optional<Retractions> retractions_;  ///< of the step
};

}  // namespace ashlar
