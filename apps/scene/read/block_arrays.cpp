#include "apps/scene/read/block_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ashlar {
namespace {

void move(std::variant<ScenePlane, Vector3>& where, const Vector3& shift) {
  if (Vector3* point = std::get_if<Vector3>(&where))
    *point += shift;
  else
    std::get<ScenePlane>(where).point += shift;
}

SceneBlock moved(const SceneBlock& block, const Vector3& shift, std::size_t number) {
  SceneBlock copy = block;
  copy.array.reset();
  copy.name = fmt::format("{}.{}", block.name, number);
  copy.translate += shift;
  for (SceneFix& fix : copy.fix) move(fix.where, shift);
  for (SceneLoad& load : copy.load) move(load.where, shift);
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

std::vector<SceneBlock> blocks_of_array(const SceneBlock& block) {
  const SceneArray& array = *block.array;
  std::array<int, most_array_directions> count = {1, 1, 1};
  std::array<Vector3, most_array_directions> step;
  step.fill(Vector3::Zero());
  std::copy(array.count.begin(), array.count.end(), count.begin());
  std::copy(array.step.begin(), array.step.end(), step.begin());
  std::vector<SceneBlock> blocks;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        const int last = array.count.size() == 1 ? i : array.count.size() == 2 ? j : k;
        Vector3 shift = i * step[0] + j * step[1] + k * step[2];
        if (last % 2 == 1) shift += array.stagger;
        blocks.push_back(moved(block, shift, blocks.size() + 1));
      }
  return blocks;
}

}  // namespace ashlar
