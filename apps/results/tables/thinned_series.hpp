// An even selection of a long series.
#pragma once

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace ashlar {

/// Keeps items 0, s, 2s, ... and those named at the start. s is the smallest power of two for which the sum of costs
/// stays within a limit. Items are added in order. Memory never exceeds the limit plus the item just added. Items
/// named at the start, and item 0, are kept at any cost.
template <class T>
class ThinnedSeries {
 public:
  struct Item {
    std::size_t index;
    std::size_t cost;
    T value;
  };

  /// @param kept indices of items that are never dropped
  ThinnedSeries(std::size_t limit, std::set<std::size_t> kept) : limit_(limit), kept_(std::move(kept)) {}

  /// True if the item would be kept at present; others need not be computed.
  [[nodiscard]] bool wants(std::size_t index) const { return index % stride_ == 0 || kept_.contains(index); }

  /// @param index larger than that of the last item
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
