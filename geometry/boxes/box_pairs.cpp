#include "geometry/boxes/box_pairs.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace ashlar {
namespace {

using NumberedBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

/// For lists this short comparing all is faster than sorting.
constexpr std::size_t few_pairs = 256;

std::vector<NumberedBox> numbered(const std::vector<Box>& boxes) {
  std::vector<NumberedBox> result;
  result.reserve(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (boxes[k].is_empty()) continue;
    Box box = boxes[k];  // the library takes no constant coordinates
    result.emplace_back(box.low.data(), box.high.data(), static_cast<int>(k));
  }
  return result;
}

}  // namespace

std::vector<std::array<int, 2>> meeting_boxes(const std::vector<Box>& boxes) {
  std::vector<std::array<int, 2>> pairs;
  std::vector<NumberedBox> list = numbered(boxes);
  CGAL::box_self_intersection_d(list.begin(), list.end(), [&](const NumberedBox& a, const NumberedBox& b) {
    pairs.push_back({std::min(a.info(), b.info()), std::max(a.info(), b.info())});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<std::array<int, 2>> meeting_boxes(const std::vector<Box>& first, const std::vector<Box>& second) {
  std::vector<std::array<int, 2>> pairs;
  if (first.size() * second.size() <= few_pairs) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t j = 0; j < second.size(); ++j) {
        if (first[i].meets(second[j])) pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
    return pairs;
  }
  std::vector<NumberedBox> list = numbered(first);
  std::vector<NumberedBox> other = numbered(second);
  CGAL::box_intersection_d(list.begin(), list.end(), other.begin(), other.end(),
                           [&](const NumberedBox& a, const NumberedBox& b) {
                             pairs.push_back({a.info(), b.info()});
                           });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace ashlar
