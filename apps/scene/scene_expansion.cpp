#include "apps/scene/scene_expansion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "apps/scene/assignments.hpp"
#include "apps/scene/block_arrays.hpp"
#include "apps/scene/mesh_stones.hpp"

namespace ashlar {
namespace {

// Where [[block]] is recorded once its entries are no longer those of the scene.
const std::string written_blocks = "written block";

/// The blocks of a scene, each with the path that it was written at.
struct BlockList {
  std::vector<SceneBlock> blocks;
  std::vector<std::string> origins;

  void add(std::vector<SceneBlock> added, const std::string& origin) {
    for (SceneBlock& block : added) {
      blocks.push_back(std::move(block));
      origins.push_back(origin);
    }
  }
};

// One block with an array whose mesh is split is an array of each stone.
std::vector<SceneBlock> blocks_of(Scene& scene, const SceneBlock& block, const std::string& path,
                                  Diagnostics& diagnostics) {
  std::vector<SceneBlock> blocks;
  for (SceneBlock& stone : stones_of(scene, block, path, diagnostics)) {
    if (!stone.array) {
      blocks.push_back(std::move(stone));
      continue;
    }
    double memory = memory_of(stone);
    for (const int count : stone.array->count) memory *= count;
    if (memory > most_laid_memory) {
      diagnostics.error(
          scene.places.value(path + ".array"),
          fmt::format("copies of block \"{}\" take too much memory ({:.3g} bytes, of points and "
                      "histories), at most {:.3g} are allowed",
                      stone.name, memory, most_laid_memory));
      continue;
    }
    std::vector<SceneBlock> copies = blocks_of_array(stone);
    std::move(copies.begin(), copies.end(), std::back_inserter(blocks));
  }
  return blocks;
}

bool is_plain(const SceneBlock& block) {
  return !block.array && !is_imported(block);
}

void refuse_number(const Scene& scene, const BlockList& list, Diagnostics& diagnostics) {
  std::string most;
  std::ptrdiff_t largest = 0;
  for (auto first = list.origins.begin(); first != list.origins.end();) {
    const auto last =
        std::find_if(first, list.origins.end(), [&](const auto& origin) { return origin != *first; });
    if (last - first > largest) {
      largest = last - first;
      most = *first;
    }
    first = last;
  }
  diagnostics.error(
      scene.places.key(most),
      fmt::format("scene has too many blocks ({} or more, {} of them here), at most {} are allowed with "
                  "arrays, split meshes or masonry",
                  list.blocks.size(), largest, most_laid_blocks));
}

}  // namespace

void expand_blocks(Scene& scene, std::vector<std::vector<SceneBlock>> masonry, Diagnostics& diagnostics) {
  // What has a fault has no pieces; names that would be theirs are no faults of their own.
  const bool complete =
      std::none_of(masonry.begin(), masonry.end(), [](const auto& pieces) { return pieces.empty(); });
  if (!std::all_of(scene.block.begin(), scene.block.end(), is_plain) || !masonry.empty()) {
    BlockList list;
    const std::vector<SceneBlock> written = std::move(scene.block);
    scene.block.clear();
    scene.places.move_list("block", written_blocks);
    // Beyond the limit nothing is laid out any more.
    for (std::size_t k = 0; k < written.size() && list.blocks.size() <= most_laid_blocks; ++k) {
      const std::string origin = fmt::format("{}.{}", written_blocks, k);
      list.add(blocks_of(scene, written[k], origin, diagnostics), origin);
    }
    for (std::size_t k = 0; k < masonry.size(); ++k)
      list.add(std::move(masonry[k]), fmt::format("masonry.{}", k));
    if (list.blocks.size() > most_laid_blocks) refuse_number(scene, list, diagnostics);
    for (std::size_t k = 0; k < list.blocks.size(); ++k)
      scene.places.record_origin(fmt::format("block.{}", k), list.origins[k]);
    scene.block = std::move(list.blocks);
  }
  if (complete) apply_assignments(scene, diagnostics);
}

}  // namespace ashlar
