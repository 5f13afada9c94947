#include "geometry/convex/overlap_polygon.hpp"

#include <algorithm>
#include <array>

namespace ashlar {

namespace {

struct Projection {
  const ContactDirection& w;
  PlaneSetting setting;
  CoordinatePlane plane;  // coplanar sets
};

// signs(s, p): on which side of side s of one set corner p of the other lies, 1 = left (inside).
class SideSigns {
 public:
  SideSigns(const Projection& projection, const PlaneSet& sides, const PlaneSet& corners,
            PredicateLadder& ladder)
      : corners_(corners.size()) {
    signs_.reserve(static_cast<std::size_t>(sides.side_count()) * static_cast<std::size_t>(corners_));
    for (int s = 0; s < sides.side_count(); ++s) {
      const Vector3 &from = sides.point(s), &to = sides.point(s + 1);
      if (projection.setting == PlaneSetting::coplanar) {
        for (int p = 0; p < corners_; ++p)
          add(sign_turn(projection.plane, from, to, corners.point(p), ladder));
      } else {
        const SideOfLine side(projection.w, from, to);
        for (int p = 0; p < corners_; ++p) add(side.sign(corners.point(p), ladder));
      }
    }
  }
  [[nodiscard]] int operator()(int side, int corner) const {
    const int wrapped = corner < corners_ ? corner : corner - corners_;
    return signs_[static_cast<std::size_t>(side) * static_cast<std::size_t>(corners_) +
                  static_cast<std::size_t>(wrapped)];
  }
  /// Both ends of the other set's side lie strictly on different sides.
  [[nodiscard]] bool separates(int side, int other_side) const {
    return (*this)(side, other_side) * (*this)(side, other_side + 1) < 0;
  }

 private:
  void add(int sign) { signs_.push_back(static_cast<signed char>(sign)); }

  int corners_;
  std::vector<signed char> signs_;
};

PlaneLocation locate_in_segment(const Projection& projection, const PlaneSet& segment, const Vector3& p,
                                PredicateLadder& ladder) {
  const Vector3 &from = segment.point(0), &to = segment.point(1);
  const auto along = [&](const Vector3& x, const Vector3& y) {
    return projection.setting == PlaneSetting::tilted
               ? sign_projected_dot(projection.w, {&x, &y}, {&to, &from}, ladder)
               : sign_along(ContactDirection::along({&to, &from}), x, y, ladder);
  };
  const int after_start = along(p, from);
  if (after_start == 0) return {0, 0};
  const int before_end = along(to, p);
  if (before_end == 0) return {0, 1};
  return after_start > 0 && before_end > 0 ? PlaneLocation{1, 0} : PlaneLocation{};
}

PlaneLocation locate_in_polygon(const PlaneSet& polygon, const SideSigns& signs, int corner) {
  PlaneLocation result{2, -1};
  const int n = polygon.size();
  for (int s = 0; s < n; ++s) {
    const int sign = signs(s, corner);
    if (sign < 0) return {};
    if (sign > 0) continue;
    if (result.dimension == 2)
      result = {1, s};
    else
      result = {0, result.index == 0 && s == n - 1 ? 0 : s};
  }
  return result;
}

PlaneLocation locate(const Projection& projection, const PlaneSet& set, const SideSigns& signs,
                     const PlaneSet& corners, int corner, PredicateLadder& ladder) {
  const Vector3& p = corners.point(corner);
  if (set.size() >= 3) return locate_in_polygon(set, signs, corner);
  if (set.size() == 2)
    return signs(0, corner) == 0 ? locate_in_segment(projection, set, p, ladder) : PlaneLocation{};
  return is_parallel(projection.w, {&p, &set.point(0)}, ladder) ? PlaneLocation{0, 0} : PlaneLocation{};
}

// True if a location lies on side s (its ends included) of a polygon of n corners.
bool on_side(const PlaneLocation& location, int s, int n) {
  if (location.dimension == 1) return location.index == s;
  return location.dimension == 0 && (location.index == s || location.index == (s + 1) % n);
}

// 1 if the side of one polygon enters the other one at `location`, -1 if it leaves: its start, or its end, is
// beyond a side of the other that contains the location.
int enters(const PlaneLocation& location, int side, const SideSigns& other_side, int other_size) {
  for (int s = 0; s < other_size; ++s) {
    if (!on_side(location, s, other_size)) continue;
    if (other_side(s, side) < 0) return 1;
    if (other_side(s, side + 1) < 0) return -1;
  }
  return 0;
}

// The first of the two overlap vertices along one side of a polygon. `own` and `other` select the location in
// the polygon itself and in the other one.
template <class Own, class Other>
bool comes_first(const std::array<const OverlapVertex*, 2>& vertices, int side, const SideSigns& other_side,
                 int other_size, Own own, Other other) {
  const OverlapVertex &x = *vertices[0], &y = *vertices[1];
  for (const bool x_is_end : {true, false}) {
    const OverlapVertex& end = x_is_end ? x : y;
    if (own(end).dimension == 0) return (own(end).index == side) == x_is_end;
  }
  const int x_enters = enters(other(x), side, other_side, other_size);
  return x_enters != 0 ? x_enters > 0 : enters(other(y), side, other_side, other_size) < 0;
}

// Joins the vertices of an overlap with inner points to a counter-clockwise loop: every side of the overlap
// lies on a side of one of the polygons, which has exactly two of the vertices.
std::vector<OverlapVertex> ordered(const std::vector<OverlapVertex>& vertices, const PlaneSet& a,
                                   const PlaneSet& b, const SideSigns& sides_of_a,
                                   const SideSigns& sides_of_b) {
  std::vector<int> next(vertices.size(), -1);
  const auto of_a = [](const OverlapVertex& v) { return v.a; };
  const auto of_b = [](const OverlapVertex& v) { return v.b; };
  const auto join = [&](int side, const PlaneSet& own_set, const PlaneSet& other_set,
                        const SideSigns& other_side, auto own, auto other) {
    int first = -1, second = -1;
    for (int v = 0; v < static_cast<int>(vertices.size()); ++v)
      if (on_side(own(vertices[v]), side, own_set.size())) (first < 0 ? first : second) = v;
    if (second < 0) return;
    const bool keep =
        comes_first({&vertices[first], &vertices[second]}, side, other_side, other_set.size(), own, other);
    next[keep ? first : second] = keep ? second : first;
  };
  for (int s = 0; s < a.size(); ++s) join(s, a, b, sides_of_b, of_a, of_b);
  for (int s = 0; s < b.size(); ++s) join(s, b, a, sides_of_a, of_b, of_a);
  std::vector<OverlapVertex> loop;
  int v = 0;
  do {
    loop.push_back(vertices[v]);
    v = next[v];
  } while (v != 0);
  return loop;
}

}  // namespace

std::vector<OverlapVertex> overlap(const ContactDirection& w, PlaneSetting setting, const PlaneSet& a,
                                   const PlaneSet& b, PredicateLadder& ladder) {
  const Projection projection{
      w, setting, setting == PlaneSetting::coplanar ? coordinate_plane(w, ladder) : CoordinatePlane{}};
  const SideSigns sides_of_a(projection, a, b, ladder), sides_of_b(projection, b, a, ladder);
  std::vector<OverlapVertex> vertices;
  std::vector<bool> b_corner_used(static_cast<std::size_t>(b.size()), false);
  for (int p = 0; p < a.size(); ++p) {
    const PlaneLocation in_b = locate(projection, b, sides_of_b, a, p, ladder);
    if (in_b.dimension < 0) continue;
    vertices.push_back({{0, p}, in_b});
    if (in_b.dimension == 0) b_corner_used[in_b.index] = true;
  }
  for (int p = 0; p < b.size(); ++p) {
    if (b_corner_used[p]) continue;
    const PlaneLocation in_a = locate(projection, a, sides_of_a, b, p, ladder);
    if (in_a.dimension >= 0) vertices.push_back({in_a, {0, p}});
  }
  for (int s = 0; s < a.side_count(); ++s)
    for (int t = 0; t < b.side_count(); ++t)
      if (sides_of_a.separates(s, t) && sides_of_b.separates(t, s)) vertices.push_back({{1, s}, {1, t}});
  return vertices.size() < 3 ? vertices : ordered(vertices, a, b, sides_of_a, sides_of_b);
}

PlaneLocation carrier(const PlaneSet& set, std::span<const PlaneLocation> locations) {
  if (locations.size() == 1) return locations[0];
  for (int s = 0; s < set.side_count(); ++s)
    if (std::all_of(locations.begin(), locations.end(),
                    [&](const PlaneLocation& l) { return on_side(l, s, set.size()); }))
      return {1, s};
  return {2, -1};
}

std::vector<int> projected_hull(const ContactDirection& w, const Vector3* points,
                                const std::vector<int>& candidates, PredicateLadder& ladder) {
  std::vector<int> hull;
  std::vector<int> distinct;
  for (const int c : candidates)
    if (std::none_of(distinct.begin(), distinct.end(), [&](int d) {
          return is_parallel(w, {&points[c], &points[d]}, ladder);
        }))
      distinct.push_back(c);
  if (distinct.size() < 2) return distinct;
  // Gift wrapping from a corner that is extreme along a direction across w.
  const auto farther = [&](int base, int x, int y) {  // y lies beyond x as seen from base
    return sign_projected_dot(w, {&points[y], &points[x]}, {&points[x], &points[base]}, ladder) > 0;
  };
  int start = distinct[0];
  for (const int c : distinct)
    if (sign_projected_dot(w, {&points[c], &points[start]}, {&points[distinct[1]], &points[distinct[0]]},
                           ladder) < 0)
      start = c;
  const auto tie = [&](int x, int y) {  // equally extreme: the leftmost one is a corner
    return sign_projected_dot(w, {&points[y], &points[x]}, {&points[distinct[1]], &points[distinct[0]]},
                              ladder) == 0 &&
           sign_triple(w, {&points[distinct[1]], &points[distinct[0]]}, {&points[y], &points[x]}, ladder) > 0;
  };
  for (const int c : distinct)
    if (c != start && tie(start, c)) start = c;
  int current = start;
  do {
    hull.push_back(current);
    int best = -1;
    for (const int c : distinct) {
      if (c == current) continue;
      if (best < 0) {
        best = c;
        continue;
      }
      const int turn = sign_turn(w, points[current], points[best], points[c], ladder);
      if (turn < 0 || (turn == 0 && farther(current, best, c))) best = c;
    }
    current = best;
  } while (current != start && hull.size() <= distinct.size());
  return hull;
}

}  // namespace ashlar
