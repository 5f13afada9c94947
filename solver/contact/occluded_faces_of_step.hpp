// Occluded faces of a step (occluded_faces.hpp): those between fixed blocks, found once, and those of the step's
// contacts.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mechanics/block/block_surface.hpp"
#include "solver/contact/occluded_faces.hpp"
#include "solver/contact/pair_history.hpp"
#include "solver/settings.hpp"

namespace ashlar {

/// The contacts of a pair of blocks (a < b).
using PairOfContacts = std::pair<PairKey, const PairContacts*>;

class OccludedFacesOfStep {
 public:
  /// @param fixed by block; false for absent blocks
  OccludedFacesOfStep(std::vector<bool> fixed, const SimulationSettings& settings);

  /// Makes a block one of the fixed ones, or removes it.
  void set_fixed(int block, bool fixed) {
    fixed_[static_cast<std::size_t>(block)] = fixed;
    of_fixed_.reset();
  }
  /// Begins a step without occluded faces.
  void begin() { of_step_.reset(); }
  [[nodiscard]] bool noted() const { return of_step_.has_value(); }
  /// Adds the faces that lie on each other, if any vertex is inside a block. @param surfaces of all blocks
  void note(const std::vector<PairOfContacts>& contacts, const std::vector<BlockSurface>& surfaces);
  /// Empty if no vertex is inside a block. @pre noted
  [[nodiscard]] const OccludedFaces& hidden() const { return *of_step_; }

 private:
  [[nodiscard]] OccludedFaces between_fixed_blocks(const std::vector<BlockSurface>& surfaces) const;

  std::vector<bool> fixed_;
  ContactLimits flush_;  ///< limits for faces that lie on each other
  std::optional<OccludedFaces> of_fixed_, of_step_;
};

}  // namespace ashlar
