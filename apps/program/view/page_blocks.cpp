#include "apps/program/view/page_blocks.hpp"

#include <cstdint>
#include <stdexcept>
#include <variant>

#include "geometry/index.hpp"

namespace ashlar {

void PageBlocks::add(const std::vector<std::string>& names) {
  if (names.size() > of_run_) throw std::runtime_error("the last frame has fewer blocks");
  std::vector<int> numbers;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names_[k].empty()) names_[k] = names[k];
    int number = static_cast<int>(k);
    if (names_[k] != names[k]) {
      const auto [known, is_new] = later_.try_emplace({k, names[k]}, static_cast<int>(names_.size()));
      if (is_new) names_.push_back(names[k]);
      number = known->second;
    }
    numbers.push_back(number);
  }
  numbers_.push_back(std::move(numbers));
}

void PageBlocks::renumber(UnstructuredGrid& grid, std::size_t frame) const {
  if (later_.empty()) return;
  const std::vector<int>& numbers = numbers_.at(frame);
  for (std::vector<DataArray>* arrays : {&grid.point_data, &grid.cell_data})
    for (DataArray& array : *arrays) {
      if (array.name != "block" && array.name != "block_a" && array.name != "block_b") continue;
      auto* values = std::get_if<std::vector<std::int32_t>>(&array.values);
      if (values == nullptr) continue;
      for (std::int32_t& block : *values)
        if (block >= 0) block = numbers.at(at(block));
    }
}

}  // namespace ashlar
