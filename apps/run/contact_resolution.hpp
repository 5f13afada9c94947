// How well the sub-faces and the polynomials of blocks resolve the contacts that they have.
//
// A curved face is in contact by flat sub-faces, which differ from it by their chord error. The polynomial of a block of
// order n resolves lengths of about its size over n: stress around a smaller contact, such as Hertz's, is not in it.
#pragma once

#include <optional>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Distance of a curved face from a flat sub-face that presses another block.
struct ChordError {
  double distance = 0.0;  ///< m, normal to the sub-face, at its centroid and the middles of its sides
  double share = 0.0;     ///< of the smaller block's size
  int block = -1;         ///< the one whose face it is
  int other = -1;         ///< the one that it presses
};

/// Largest share at present, at the contacts of the last step. Empty: no face that may curve presses a block, or several
/// processes share the run
[[nodiscard]] std::optional<ChordError> largest_chord_error(const Simulation& simulation);

/// Contact of a block with one other block.
struct SmallContact {
  int other = -1;
  double width = 0.0;     ///< m, diameter of a disc of the area that presses
  double resolved = 0.0;  ///< m, size of the block over its order
};

/// The contact of a block with the largest mean pressure, if it is narrower than what the order of the block resolves.
/// @param block index of one that deforms
[[nodiscard]] std::optional<SmallContact> unresolved_contact(const Simulation& simulation, int block);

}  // namespace ashlar
