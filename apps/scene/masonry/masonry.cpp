#include "apps/scene/masonry/masonry.hpp"

#include <fmt/format.h>

#include <utility>

#include "apps/scene/keys/masonry_keys.hpp"

namespace ashlar {
namespace {

std::vector<MasonryPiece> read_kind(SceneMasonry::Kind kind, TomlTableReader& table) {
  switch (kind) {
    case SceneMasonry::Kind::wall:
      return read_wall(table);
    case SceneMasonry::Kind::arch:
      return read_arch(table);
    case SceneMasonry::Kind::column:
      return read_column(table);
    case SceneMasonry::Kind::dome:
      return read_dome(table);
  }
  return {};
}

}  // namespace

std::vector<SceneBlock> read_masonry(TomlTableReader& table) {
  const SceneMasonry masonry = keys::masonry_keys().read(table);
  if (!masonry.kind) return {};
  const SceneBlock& common = masonry.block;
  std::vector<SceneBlock> blocks;
  for (MasonryPiece& piece : read_kind(*masonry.kind, table)) {
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
