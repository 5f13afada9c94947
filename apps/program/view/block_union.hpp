// Converts frames of a run whose blocks come, go or crack to frames with the same cells: absent blocks get no place.
#pragma once

#include <map>

#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

/// The blocks of some frames.
class BlockUnion {
 public:
  /// Adds blocks that were in no earlier frame. @param frame with cells block by block (the cell array "block"), in any order of
  /// numbers, and no point shared by blocks
  void add(const UnstructuredGrid& frame);

  /// All blocks by number, each as in its first frame.
  [[nodiscard]] UnstructuredGrid whole() const;
  /// Adds missing blocks to a frame: their points and point data are nan. @param frame one of those added; if none
  /// was, it is returned unchanged
  [[nodiscard]] UnstructuredGrid completed(UnstructuredGrid frame) const;

 private:
  std::map<int, UnstructuredGrid> parts_;  ///< by block
};

}  // namespace ashlar
