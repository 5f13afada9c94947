// Numbers of blocks in a page. The first part of a cracked block has the number of the block in a run; a page, whose blocks
// have the same cells in all frames, numbers it after all blocks of the run.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

class PageBlocks {
 public:
  /// @param names of the blocks of the last frame, by number
  explicit PageBlocks(const std::vector<std::string>& names) : of_run_(names.size()), names_(names.size()) {}

  /// Adds the next frame. @param names of its blocks, by number, no more than in the last frame
  void add(const std::vector<std::string>& names);
  /// Replaces the numbers of blocks in the arrays of a grid. @param frame number of an added frame
  void renumber(UnstructuredGrid& grid, std::size_t frame) const;

  /// By number of the page, of all blocks of the added frames.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::size_t of_run_;  ///< number of blocks of the last frame
  std::vector<std::string> names_;
  std::map<std::pair<std::size_t, std::string>, int> later_;  ///< by number in the run and name
  std::vector<std::vector<int>> numbers_;                     ///< by frame and number in the run
};

}  // namespace ashlar
