// Contacts at seams: a block that slides from one block to the next has sunk into what it rests on, as
// springs must give way to hold it, and so meets the side of the next one by as much. Such a contact is not
// there for blocks that do not sink, and would stop or throw it.
//
// A contact is one of a seam if it vanishes when one of the two blocks moves out, across the contact's own
// normal, of what it was in contact with at the end of the last step: by twice the depth, as depths change
// within a step. What is left out is narrower than that, and the face that the block goes on to is found
// beside it.
#pragma once

#include <map>
#include <vector>

#include "geometry/motion_check.hpp"
#include "mechanics/contact_memory.hpp"

namespace ashlar {

/// Ways out of what each block had sunk into at the end of the last step.
class WaysOut {
 public:
  WaysOut() = default;  ///< none
  /// @param memory of pairs of blocks (a, b)
  explicit WaysOut(const std::map<std::array<int, 2>, ContactMemory>& memory);
  /// Motions of a relative to b, m, that take either of them out of what it had sunk into.
  [[nodiscard]] std::vector<Vector3> of_pair(int a, int b) const;

 private:
  std::map<int, std::vector<Vector3>> ways_;  ///< by block, m
};

/// Removes the contacts of a pair that one of the ways undoes. @param ways as WaysOut::of_pair returns
void leave_out_seams(const PlacedSurface& a, const PlacedSurface& b, const std::vector<Vector3>& ways,
                     PairContacts& contacts);

/// Whether one of the ways undoes a touch.
[[nodiscard]] bool at_seam(const PlacedSurface& a, const PlacedSurface& b, const std::vector<Vector3>& ways,
                           const Touch& touch);

}  // namespace ashlar
