// Vertices of the common part of two crossing shapes (contact_region.hpp), by signs only: on which side of
// each facet plane each corner lies, and on which side of each edge of a facet a piercing edge passes.
#include <algorithm>
#include <set>

#include "geometry/contact_region.hpp"

namespace ashlar {

namespace {

// All that one shape's corners and edges do with the facets of the other.
class CrossingVertices {
 public:
  CrossingVertices(const ConvexShape& mine, const ConvexShape& other, PredicateLadder& ladder)
      : mine_(mine),
        other_(other),
        ladder_(ladder),
        facet_count_(other.facet_count()),
        sides_(mine.corners().size() * static_cast<std::size_t>(facet_count_)) {
    for (int f = 0; f < facet_count_; ++f) {
      const auto& n = other.normal_numbers(f);
      const Vector3& x = other.corners()[other.facet(f)[0]];
      for (int v = 0; v < static_cast<int>(mine.corners().size()); ++v) {
        int sign = unknown_sign;
        if (ladder.floating) sign = quick_sign(n, mine.corners()[v], x);
        if (sign != unknown_sign)
          ++ladder.counts.filter;
        else
          sign = sign_along(other.facet_normal(f), mine.corners()[v], x, ladder);
        sides_[index(f, v)] = static_cast<signed char>(sign);
      }
    }
  }

  /// Face of the other shape that carries a corner; dimension -1 if the corner is outside.
  [[nodiscard]] ContactFeature locate_corner(int v) {
    if (other_.flat()) return side(0, v) == 0 ? locate_in_facet(v) : ContactFeature{};
    std::vector<int> planes;
    for (int f = 0; f < other_.facet_count(); ++f) {
      if (side(f, v) > 0) return {};
      if (side(f, v) == 0) planes.push_back(f);
    }
    if (planes.empty()) return {3, -1};
    if (planes.size() == 1) return {2, planes[0]};
    for (int e = 0; planes.size() == 2 && e < static_cast<int>(other_.edges().size()); ++e) {
      const auto& f = other_.edges()[e].facets;
      if (std::min(f[0], f[1]) == planes[0] && std::max(f[0], f[1]) == planes[1]) return {1, e};
    }
    const auto& corners = other_.corners();
    const auto same = std::find(corners.begin(), corners.end(), mine_.corners()[v]);
    return {0, static_cast<int>(same - corners.begin())};
  }

  /// True if a facet plane of the other shape has the whole edge on its outer side.
  [[nodiscard]] bool is_outside(int e) const {
    const auto& ends = mine_.edges()[e].corners;
    for (int f = 0; f < other_.facet_count() && !other_.flat(); ++f)
      if (side(f, ends[0]) > 0 && side(f, ends[1]) > 0) return true;
    return false;
  }

  /// Face of the other shape where an edge goes through facet f in an inner point of the edge: the facet or
  /// an edge of it; dimension -1 if it does not, 0 at a corner.
  [[nodiscard]] ContactFeature locate_piercing(int e, int f) {
    const auto& ends = mine_.edges()[e].corners;
    if (side(f, ends[0]) * side(f, ends[1]) >= 0) return {};
    const Vector3& from = mine_.corners()[ends[0]];
    const Vector3& to = mine_.corners()[ends[1]];
    const std::span<const int> loop = other_.facet(f);
    int touched = -1;
    int touched_count = 0;
    for (int k = 0; k < static_cast<int>(loop.size()); ++k) {
      const Vector3& c = other_.corners()[loop[k]];
      const Vector3& d = other_.corners()[loop[(k + 1) % loop.size()]];
      const int inside = -side(f, ends[0]) * sign_volume(from, to, c, d, ladder_);
      if (inside < 0) return {};
      if (inside > 0) continue;
      touched = k;
      ++touched_count;
    }
    if (touched_count == 0) return {2, f};
    if (touched_count == 2) return {0, -1};
    return {1, other_.find_edge(loop[touched], loop[(touched + 1) % loop.size()])};
  }

  [[nodiscard]] Vector3 piercing_point(int e, int f) {
    const auto& ends = mine_.edges()[e].corners;
    return plane_point(other_.facet_normal(f), mine_.corners()[ends[0]], mine_.corners()[ends[1]],
                       other_.corners()[other_.facet(f)[0]], ladder_);
  }

 private:
  [[nodiscard]] std::size_t index(int f, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(facet_count_) + static_cast<std::size_t>(f);
  }
  [[nodiscard]] int side(int f, int v) const { return sides_[index(f, v)]; }
  // A corner in the plane of a triangle.
  [[nodiscard]] ContactFeature locate_in_facet(int v) {
    const std::span<const int> loop = other_.facet(0);
    ContactFeature result{2, 0};
    for (int k = 0; k < 3; ++k) {
      const int sign = sign_turn(other_.facet_normal(0), other_.corners()[loop[k]],
                                 other_.corners()[loop[(k + 1) % 3]], mine_.corners()[v], ladder_);
      if (sign < 0) return {};
      if (sign > 0) continue;
      if (result.dimension == 2)
        result = {1, other_.find_edge(loop[k], loop[(k + 1) % 3])};
      else
        result = {0, loop[k == 2 && side_is_first(result) ? 0 : k]};
    }
    return result;
  }
  // Sides 0 and 2 of a triangle meet in corner 0, the others in the first corner of the later side.
  [[nodiscard]] bool side_is_first(const ContactFeature& edge) const {
    const std::span<const int> loop = other_.facet(0);
    return edge.index == other_.find_edge(loop[0], loop[1]);
  }

  const ConvexShape& mine_;
  const ConvexShape& other_;
  PredicateLadder& ladder_;
  int facet_count_;
  std::vector<signed char> sides_;  // corner by corner, 1 outside
};

}  // namespace

ContactRegion crossing_region(const ConvexShape& a, const ConvexShape& b, PredicateLadder& ladder) {
  CrossingVertices of_a(a, b, ladder), of_b(b, a, ladder);
  ContactRegion region;
  region.points.reserve(16);
  for (int v = 0; v < static_cast<int>(a.corners().size()); ++v) {
    const ContactFeature in_b = of_a.locate_corner(v);
    if (in_b.dimension >= 0) region.points.push_back({{0, v}, in_b, a.corners()[v], a.corners()[v]});
  }
  for (int v = 0; v < static_cast<int>(b.corners().size()); ++v) {
    const ContactFeature in_a = of_b.locate_corner(v);
    if (in_a.dimension > 0) region.points.push_back({in_a, {0, v}, b.corners()[v], b.corners()[v]});
  }
  std::set<std::pair<int, int>> edge_crossings;
  const auto pierce = [&](CrossingVertices& mine, const ConvexShape& shape, const ConvexShape& other,
                          bool mine_is_a) {
    for (int e = 0; e < static_cast<int>(shape.edges().size()); ++e) {
      if (mine.is_outside(e)) continue;
      for (int f = 0; f < other.facet_count(); ++f) {
        const ContactFeature hit = mine.locate_piercing(e, f);
        if (hit.dimension < 1) continue;
        const std::pair<int, int> edges = mine_is_a ? std::pair(e, hit.index) : std::pair(hit.index, e);
        if (hit.dimension == 1 && !edge_crossings.insert(edges).second) continue;
        const Vector3 point = mine.piercing_point(e, f);
        const ContactFeature own{1, e};
        region.points.push_back({mine_is_a ? own : hit, mine_is_a ? hit : own, point, point});
      }
    }
  };
  pierce(of_a, a, b, true);
  pierce(of_b, b, a, false);
  const bool flat = a.flat() && b.flat();
  region.dimension = flat ? 1 : a.flat() || b.flat() ? 2 : 3;
  region.a = {a.flat() ? 2 : 3, a.flat() ? 0 : -1};
  region.b = {b.flat() ? 2 : 3, b.flat() ? 0 : -1};
  region.a_dimension = region.a.dimension;
  region.b_dimension = region.b.dimension;
  return region;
}

}  // namespace ashlar
