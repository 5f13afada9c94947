// Frames of a run in stages as frames that all have the same cells: a block that is not there in one of them is
// there without a place.
#pragma once

#include <map>

#include "apps/results/vtu_writer.hpp"

namespace ashlar {

/// The blocks of some frames.
class BlockUnion {
 public:
  /// Takes note of blocks that were in no frame before. @param frame with cells by block (the cell array
  /// "block"), no point of two blocks
  /// @throws std::runtime_error if there is no such array, or its cells are not in the order of blocks
  void add(const UnstructuredGrid& frame);

  /// All blocks, each as the first frame that it was in has it.
  [[nodiscard]] UnstructuredGrid whole() const;
  /// A frame with the blocks that it lacks: their points and point data are nan. @param frame one of those
  /// added; if none was, it is returned as it is
  [[nodiscard]] UnstructuredGrid completed(UnstructuredGrid frame) const;

 private:
  std::map<int, UnstructuredGrid> parts_;  ///< by block
};

}  // namespace ashlar
