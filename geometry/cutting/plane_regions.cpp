#include "geometry/cutting/plane_regions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

namespace ashlar {
namespace {

using Loop = std::vector<OutlineSide>;

class RegionTracer {
 public:
  RegionTracer(const CellComplex& complex, const ExactPlane& plane, const std::vector<OutlineSide>& sides)
      : complex_(complex), view_(plane), sides_(sides) {}

  [[nodiscard]] std::vector<FaceOutline> trace() {
    const std::vector<Loop> loops = trace_loops();
    if (loops.size() == 1) return {region_of({&loops.front()})};
    std::vector<const Loop*> outer, holes;
    for (const Loop& loop : loops) (sgn(doubled_area(loop)) > 0 ? outer : holes).push_back(&loop);
    if (outer.empty()) throw std::logic_error("regions have outer loops");
    std::vector<std::vector<const Loop*>> grouped;
    grouped.reserve(outer.size());
    for (const Loop* loop : outer) grouped.push_back({loop});
    if (outer.size() == 1) {
      grouped.front().insert(grouped.front().end(), holes.begin(), holes.end());
    } else {
      for (const Loop* hole : holes) grouped[owner_of(*hole, outer)].push_back(hole);
    }
    std::vector<FaceOutline> regions;
    regions.reserve(grouped.size());
    for (const auto& group : grouped) regions.push_back(region_of(group));
    return regions;
  }

 private:
  [[nodiscard]] const ExactPoint& at(int point) const { return complex_.point(point).place; }

  /// The end of a side at a vertex: its other point, and whether the side leaves the vertex.
  struct Spoke {
    int other;
    bool leaves;
    int side;
  };

  /// Position of a direction from a vertex relative to another one: along it, to its left, opposite, to its right.
  [[nodiscard]] int quarter(int vertex, int first, int other) const {
    const int turn = view_.turn(at(vertex), at(first), at(other));
    if (turn != 0) return turn > 0 ? 1 : 3;
    return view_.compare(at(vertex), at(first)) == view_.compare(at(vertex), at(other)) ? 0 : 2;
  }

  /// Around a vertex a region lies between an outgoing side and the next one counter-clockwise, which is incoming. At
  /// a side in both directions, one region ends before the next begins.
  void pair_spokes(int vertex, std::vector<Spoke>& spokes) {
    const int first = spokes.front().other;
    std::sort(spokes.begin(), spokes.end(), [&](const Spoke& a, const Spoke& b) {
      const int of_a = quarter(vertex, first, a.other), of_b = quarter(vertex, first, b.other);
      if (of_a != of_b) return of_a < of_b;
      const int turn = of_a % 2 == 0 ? 0 : view_.turn(at(vertex), at(a.other), at(b.other));
      return turn != 0 ? turn > 0 : a.leaves < b.leaves;
    });
    for (std::size_t k = 0; k < spokes.size(); ++k)
      if (spokes[k].leaves)
        next_[static_cast<std::size_t>(spokes[(k + 1) % spokes.size()].side)] = spokes[k].side;
  }

  [[nodiscard]] std::vector<Loop> trace_loops() {
    std::map<int, std::vector<Spoke>> spokes;
    for (int k = 0; k < static_cast<int>(sides_.size()); ++k) {
      const OutlineSide& side = sides_[static_cast<std::size_t>(k)];
      spokes[side.from].push_back({side.to, true, k});
      spokes[side.to].push_back({side.from, false, k});
    }
    next_.assign(sides_.size(), -1);
    for (auto& [vertex, of] : spokes) {
      if (of.size() == 2)
        next_[static_cast<std::size_t>(of[of[0].leaves ? 1 : 0].side)] = of[of[0].leaves ? 0 : 1].side;
      else
        pair_spokes(vertex, of);
    }
    std::vector<Loop> loops;
    std::vector<bool> used(sides_.size(), false);
    for (std::size_t start = 0; start < sides_.size(); ++start) {
      if (used[start]) continue;
      loops.emplace_back();
      for (std::size_t k = start; !used[k]; k = static_cast<std::size_t>(next_[k])) {
        used[k] = true;
        loops.back().push_back(sides_[k]);
      }
    }
    return loops;
  }

  [[nodiscard]] Rational doubled_area(const Loop& loop) const {
    Rational sum = 0;
    const ExactPoint& apex = at(loop.front().from);
    for (const OutlineSide& side : loop) sum += view_.doubled_area(apex, at(side.from), at(side.to));
    return sum;
  }

  /// Empty: it is on the loop. By the parity of sides met by a ray towards greater first coordinates.
  [[nodiscard]] std::optional<bool> is_inside(const Loop& loop, const ExactPoint& point) const {
    bool inside = false;
    for (const OutlineSide& side : loop) {
      const ExactPoint &from = at(side.from), &to = at(side.to);
      if (view_.turn(from, to, point) == 0 && view_.compare(from, point) * view_.compare(to, point) <= 0)
        return std::nullopt;
      if (view_.ray_meets(point, from, to)) inside = !inside;
    }
    return inside;
  }

  /// True if a loop lies within another, which it may touch.
  [[nodiscard]] bool lies_within(const Loop& loop, const Loop& other) const {
    for (const OutlineSide& side : loop)
      if (const auto inside = is_inside(other, at(side.from))) return *inside;
    for (const OutlineSide& side : loop)
      if (const auto inside = is_inside(other, middle(at(side.from), at(side.to)))) return *inside;
    return false;
  }

  [[nodiscard]] static ExactPoint middle(const ExactPoint& a, const ExactPoint& b) {
    ExactPoint result{a.x * b.w + b.x * a.w, a.y * b.w + b.y * a.w, a.z * b.w + b.z * a.w, 2 * a.w * b.w, {}};
    result.rounded = round_to_nearest(result.rational());
    return result;
  }

  /// The innermost outer loop around a hole, which has one.
  [[nodiscard]] std::size_t owner_of(const Loop& hole, const std::vector<const Loop*>& outer) const {
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < outer.size(); ++k)
      if (lies_within(hole, *outer[k]) && (!best || lies_within(*outer[k], *outer[*best]))) best = k;
    return best.value();
  }

  [[nodiscard]] static FaceOutline region_of(const std::vector<const Loop*>& loops) {
    FaceOutline region;
    for (const Loop* loop : loops) {
      if (!region.points.empty()) region.holes.push_back(static_cast<int>(region.points.size()));
      for (const OutlineSide& side : *loop) {
        region.points.push_back(side.from);
        region.edges.push_back(side.edge);
      }
    }
    return region;
  }

  const CellComplex& complex_;
  FlatView view_;
  const std::vector<OutlineSide>& sides_;
  std::vector<int> next_;  ///< by side: the one that follows in its loop
};

}  // namespace

std::vector<FaceOutline> plane_regions(const CellComplex& complex, const ExactPlane& plane,
                                       const std::vector<OutlineSide>& sides) {
  if (sides.empty()) return {};
  return RegionTracer(complex, plane, sides).trace();
}

bool is_convex(const CellComplex& complex, const ExactPlane& plane, const FaceOutline& region) {
  if (!region.holes.empty()) return false;
  const FlatView view(plane);
  const std::size_t count = region.points.size();
  const auto at = [&](std::size_t k) -> const ExactPoint& {
    return complex.point(region.points[k % count]).place;
  };
  for (std::size_t k = 0; k < count; ++k)
    if (region.points[k] == region.points[(k + 2) % count] || view.turn(at(k), at(k + 1), at(k + 2)) < 0)
      return false;
  return true;
}

}  // namespace ashlar
