#include "apps/scene/read/block_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ashlar {
namespace {

constexpr std::size_t most_directions = 3;

void move(std::variant<ScenePlane, Vector3>& where, const Vector3& way) {
  if (Vector3* point = std::get_if<Vector3>(&where))
    *point += way;
  else
    std::get<ScenePlane>(where).point += way;
}

SceneBlock moved(const SceneBlock& block, const Vector3& way, std::size_t number) {
  SceneBlock copy = block;
  copy.array.reset();
  copy.name = fmt::format("{}.{}", block.name, number);
  copy.translate += way;
  for (SceneFix& fix : copy.fix) move(fix.where, way);
  for (SceneLoad& load : copy.load) move(load.where, way);
  return copy;
}

}  // namespace

double memory_of(const SceneFix& fix) {
  return sizeof(SceneFix) + static_cast<double>(fix.history.size() * sizeof(SceneFix::Motion));
}

double memory_of(const SceneLoad& load) {
  return sizeof(SceneLoad) + static_cast<double>(load.history.size() * sizeof(SceneLoad::Factor));
}

double memory_of(const SceneBlock& block) {
  double memory = sizeof(SceneBlock) + static_cast<double>(block.name.size() + block.material.size());
  if (const SceneHull* hull = std::get_if<SceneHull>(&block.shape))
    memory += static_cast<double>(hull->points.size() * sizeof(Vector3));
  for (const SceneFix& fix : block.fix) memory += memory_of(fix);
  for (const SceneLoad& load : block.load) memory += memory_of(load);
  return memory;
}

std::optional<SceneArray> read_array(TomlTableReader& block) {
  std::optional<TomlTableReader> table = block.table("array");
  if (!table) return std::nullopt;
  SceneArray array;
  for (const char* key : {"count", "step"}) table->require(key);
  const bool counted = table->read_integers("count", array.count, 1, most_laid_blocks);
  bool good = table->read_places("step", array.step, 1) && counted;
  good = (table->read_place("stagger", array.stagger) || !table->given("stagger")) && good;
  if (!counted) return std::nullopt;
  if (array.count.empty() || array.count.size() > most_directions) {
    table->error_at_value("count",
                          fmt::format("count has the wrong length ({} entries), 1 to 3 directions are "
                                      "needed",
                                      array.count.size()));
    return std::nullopt;
  }
  if (good && array.step.size() != array.count.size()) {
    table->error_at_value("step",
                          fmt::format("step has the wrong length ({} entries), one for each of the {} "
                                      "counts is needed",
                                      array.step.size(), array.count.size()));
    return std::nullopt;
  }
  double blocks = 1.0;
  for (const int count : array.count) blocks *= count;
  if (blocks > most_laid_blocks) {
    table->error_at_value("count", fmt::format("array is too large ({:.3g} blocks), at most {} are allowed",
                                               blocks, most_laid_blocks));
    return std::nullopt;
  }
  if (!good) return std::nullopt;
  return array;
}

std::vector<SceneBlock> blocks_of_array(const SceneBlock& block) {
  const SceneArray& array = *block.array;
  std::array<int, most_directions> count = {1, 1, 1};
  std::array<Vector3, most_directions> step;
  step.fill(Vector3::Zero());
  std::copy(array.count.begin(), array.count.end(), count.begin());
  std::copy(array.step.begin(), array.step.end(), step.begin());
  std::vector<SceneBlock> blocks;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        const int last = array.count.size() == 1 ? i : array.count.size() == 2 ? j : k;
        Vector3 way = i * step[0] + j * step[1] + k * step[2];
        if (last % 2 == 1) way += array.stagger;
        blocks.push_back(moved(block, way, blocks.size() + 1));
      }
  return blocks;
}

}  // namespace ashlar
