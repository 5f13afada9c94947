// Blocks of a scene: their sizes, their neighbours, and the cuts between them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/model/cut_rock.hpp"

namespace ashlar {

/// A face, or a part of one, shared with another block.
struct BlockBorder {
  std::size_t block;               ///< the other one
  double area;                     ///< m^2
  std::optional<std::size_t> cut;  ///< origin of the border; empty: the blocks were separate before
  int plane;                       ///< of the block's CutSolid; `below` is its side
  bool below;
};

struct BlockEntry {
  double volume;                     ///< m^3, the exact value rounded once
  std::vector<BlockBorder> borders;  ///< by other block and cut
  double surface = 0.0;              ///< m^2, of the whole block
};

/// The solid of which a block is a piece, also made for blocks that were not cut.
struct BlockSolid {
  const CutSolid* solid;
  int piece;
};

class BlockReport {
 public:
  /// Borders of pieces of one block are exact, each area rounded once. Those of other blocks are faces in contact
  /// within the allowed overlap of a scene, with areas of rounded corners.
  /// @param loaded not null
  explicit BlockReport(std::shared_ptr<const LoadedScene> loaded);

  [[nodiscard]] const std::vector<BlockEntry>& blocks() const { return blocks_; }
  [[nodiscard]] BlockSolid solid(std::size_t block) const;
  /// False for blocks that are not there in the stage of the scene: they have no borders.
  [[nodiscard]] bool is_there(std::size_t block) const;
  /// True for a face of a block without another piece that is there on its other side.
  [[nodiscard]] bool is_bare(std::size_t block, const PieceFace& face) const;
  [[nodiscard]] const LoadedScene& loaded() const { return *loaded_; }
  /// m^3, of all blocks that are there; m^2, of the faces that each cut made, by index in Scene::cut.
  [[nodiscard]] double volume() const;
  [[nodiscard]] std::vector<double> areas_by_cut() const;

 private:
  /// The block on the other side of a face of a piece.
  [[nodiscard]] std::size_t neighbour(std::size_t block, const PieceFace& face) const;
  void add_borders_of_pieces();
  void add_contacts();
  void add_contact(std::size_t a, std::size_t b);
  void add_border(std::size_t block, std::size_t other, const Vector3& normal, double area);

  std::shared_ptr<const LoadedScene> loaded_;
  std::vector<std::optional<CutSolid>> whole_;                   ///< by block, for those that are no pieces
  std::map<std::pair<std::size_t, int>, std::size_t> block_of_;  ///< by uncut block and piece
  std::vector<BlockEntry> blocks_;
};

}  // namespace ashlar
