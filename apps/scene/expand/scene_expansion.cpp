#include "apps/scene/expand/scene_expansion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "apps/scene/expand/mesh_blocks.hpp"
#include "apps/scene/expand/piece_blocks.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "apps/scene/read/assignments.hpp"
#include "apps/scene/read/block_arrays.hpp"
#include "geometry/mesh/volume_mesh.hpp"

namespace ashlar {
namespace {

// Temporary path of [[block]] once its entries are no longer those of the scene.
const std::string written_blocks = "written block";

/// The blocks of a scene, each with the path at which it was written.
struct BlockList {
  std::vector<PieceBlock> blocks;
  std::vector<std::string> origins;

  void add(std::vector<PieceBlock> added, const std::string& origin) {
    for (PieceBlock& block : added) {
      blocks.push_back(std::move(block));
      origins.push_back(origin);
    }
  }
};

std::vector<PieceBlock> as_pieces(std::vector<SceneBlock> blocks) {
  std::vector<PieceBlock> pieces;
  pieces.reserve(blocks.size());
  for (SceneBlock& block : blocks) pieces.push_back({std::move(block), {}, {}});
  return pieces;
}

/// Parts of a volume mesh belong to one body, which has the supports, loads and measures.
void share_out(Scene& scene, const SceneBlock& whole, const std::string& path,
               std::vector<PieceBlock>& stones, Diagnostics& diagnostics) {
  Scene parts;
  parts.file = scene.file;
  std::vector<std::string> names;
  for (const PieceBlock& stone : stones) {
    parts.block.push_back(stone.block);
    names.push_back(stone.block.name);
  }
  Diagnostics told_later;
  std::vector<std::shared_ptr<const Polyhedron>> solids;
  for (std::optional<Polyhedron>& solid : build_solids(parts, told_later)) {
    if (!solid) return;
    solids.push_back(std::make_shared<const Polyhedron>(std::move(*solid)));
  }
  share_supports(scene, whole, path, solids, stones, diagnostics);
  move_measures(scene, whole.name, solids, names);
}

// A block with an array whose mesh is split is an array of each part.
std::vector<PieceBlock> blocks_of(Scene& scene, const SceneBlock& block, const std::string& path,
                                  Diagnostics& diagnostics) {
  std::vector<PieceBlock> stones = as_pieces(stones_of(scene, block, path, diagnostics));
  const auto* mesh = std::get_if<SceneMesh>(&block.shape);
  if (mesh != nullptr && mesh->split != SceneMesh::Split::none && is_volume_mesh(mesh->file))
    share_out(scene, block, path, stones, diagnostics);
  std::vector<PieceBlock> blocks;
  for (PieceBlock& stone : stones) {
    if (!stone.block.array) {
      blocks.push_back(std::move(stone));
      continue;
    }
    double memory = memory_of(stone.block);
    for (const int count : stone.block.array->count) memory *= count;
    if (memory > most_laid_memory) {
      diagnostics.error(
          scene.places.value(path + ".array"),
          fmt::format("copies of block \"{}\" take too much memory ({:.3g} bytes, of points and "
                      "histories), at most {:.3g} are allowed",
                      stone.block.name, memory, most_laid_memory));
      continue;
    }
    for (SceneBlock& copy : blocks_of_array(stone.block))
      blocks.push_back({std::move(copy), stone.fix, stone.load});
  }
  return blocks;
}

/// Keys of a block refer to the place where it was written; its supports and loads may be some of those there.
void record_origins(ScenePlaces& places, std::size_t index, const PieceBlock& block,
                    const std::string& origin) {
  const std::string path = fmt::format("block.{}", index);
  places.record_origin(path, origin);
  const auto record = [&](const char* key, const std::vector<std::size_t>& of) {
    for (std::size_t i = 0; i < of.size(); ++i)
      places.record_origin(fmt::format("{}.{}.{}", path, key, i),
                           fmt::format("{}.{}.{}", origin, key, of[i]));
  };
  record("fix", block.fix);
  record("load", block.load);
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
  // Masonry with a fault has no pieces; references to their names are no additional faults.
  const bool complete =
      std::none_of(masonry.begin(), masonry.end(), [](const auto& pieces) { return pieces.empty(); });
  if (!std::all_of(scene.block.begin(), scene.block.end(), is_plain) || !masonry.empty()) {
    BlockList list;
    const std::vector<SceneBlock> written = std::move(scene.block);
    scene.block.clear();
    scene.places.move_list("block", written_blocks);
    // Beyond the limit no further blocks are made.
    for (std::size_t k = 0; k < written.size() && list.blocks.size() <= most_laid_blocks; ++k) {
      const std::string origin = fmt::format("{}.{}", written_blocks, k);
      list.add(blocks_of(scene, written[k], origin, diagnostics), origin);
    }
    for (std::size_t k = 0; k < masonry.size(); ++k)
      list.add(as_pieces(std::move(masonry[k])), fmt::format("masonry.{}", k));
    if (list.blocks.size() > most_laid_blocks) {
      refuse_number(scene, list, diagnostics);
      // Other checks need their names; the solids of so many are not built.
      for (PieceBlock& block : list.blocks) block.block.shape = {};
    }
    for (std::size_t k = 0; k < list.blocks.size(); ++k) {
      record_origins(scene.places, k, list.blocks[k], list.origins[k]);
      scene.block.push_back(std::move(list.blocks[k].block));
    }
  }
  if (complete) apply_assignments(scene, diagnostics);
}

}  // namespace ashlar
