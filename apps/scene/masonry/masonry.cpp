#include "apps/scene/masonry/masonry.hpp"
#include "apps/scene/read/block_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace ashlar {
namespace {

using PieceReader = std::vector<MasonryPiece> (*)(TomlTableReader&);

constexpr std::array<std::pair<const char*, PieceReader>, 4> kinds = {
    {{"wall", read_wall}, {"arch", read_arch}, {"column", read_column}, {"dome", read_dome}}};

}  // namespace

std::vector<SceneBlock> read_masonry(TomlTableReader& table) {
  SceneBlock common;
  for (const char* key : {"name", "kind"}) table.require(key);
  table.read_name("name", common.name);
  table.read_name("material", common.material);
  read_order(table, common);
  PieceReader read = nullptr;
  if (!table.read_choice("kind", read, kinds)) return {};
  std::vector<SceneBlock> blocks;
  for (MasonryPiece& piece : read(table)) {
    SceneBlock block = common;
    if (!common.name.empty()) block.name = fmt::format("{}.{}", common.name, piece.name);
    block.shape = std::move(piece.shape);
    block.rotate = piece.rotate;
    block.load = std::move(piece.load);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace ashlar
