// A long series of which an even selection is kept.
#pragma once

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace ashlar {

/// Keeps items 0, s, 2s, ... and those named at the start, s being the smallest power of two with which the
/// sum of costs stays within a limit. Items come in order; at no time is more held than the limit and the
/// item just added. Items named at the start, and item 0, are kept whatever they cost.
template <class T>
class ThinnedSeries {
 public:
  struct Item {
    std::size_t index;
    std::size_t cost;
    T value;
  };

  /// @param kept indices of items that are never left out
  ThinnedSeries(std::size_t limit, std::set<std::size_t> kept) : limit_(limit), kept_(std::move(kept)) {}

  /// Whether the item would be kept so far; one that would not need not be made.
  [[nodiscard]] bool wants(std::size_t index) const { return index % stride_ == 0 || kept_.contains(index); }

  /// @param index larger than that of the item before
  void add(std::size_t index, T value, std::size_t cost) {
    if (!wants(index)) return;
    items_.push_back({index, cost, std::move(value)});
    total_ += cost;
    while (total_ > limit_ && stride_ <= index) widen();
  }

  [[nodiscard]] const std::vector<Item>& items() const { return items_; }
  [[nodiscard]] std::size_t total_cost() const { return total_; }

 private:
  void widen() {
    stride_ *= 2;
    std::erase_if(items_, [&](const Item& item) { return !wants(item.index); });
    total_ = 0;
    for (const Item& item : items_) total_ += item.cost;
  }

  std::size_t limit_;
  std::set<std::size_t> kept_;
  std::size_t stride_ = 1;
  std::size_t total_ = 0;
  std::vector<Item> items_;
};

}  // namespace ashlar
