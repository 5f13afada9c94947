// Vertices of the common part of two crossing shapes (contact_region.hpp), by signs only: on which side of
// each facet plane each corner lies, and on which side of each edge of a facet a piercing edge passes.
//
// An edge enters a solid through the plane it goes through last on its way in, and leaves through the first
// one on its way out. The floating heights of its ends bound its parameter at each plane, and that
// decides almost all cases; where planes are too near to each other (those of a face that rounding has bent), the
// sides of the facets' edges decide.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "geometry/convex/contact_region.hpp"
#include "geometry/exact/piercing_point.hpp"

namespace ashlar {

namespace {

using Word = std::uint64_t;
constexpr int word_bits = 64;

// Calls visit(index) for the bits of a word.
template <class Visit>
void for_each_bit(Word bits, int first, Visit visit) {
  for (; bits != 0; bits &= bits - 1) visit(first + std::countr_zero(bits));
}

// Relations of the corners and edges of one shape to the facets of the other.
class CrossingVertices {
 public:
  CrossingVertices(const PlaneHeights& heights, PredicateLadder& ladder)
      : mine_(heights.corners()),
        other_(heights.planes()),
        heights_(heights),
        ladder_(ladder),
        word_count_((other_.facet_count() + word_bits - 1) / word_bits),
        outside_(mine_.corners().size() * static_cast<std::size_t>(word_count_), 0),
        inside_(outside_.size(), 0) {
    passages_.reserve(16);
    for (int v = 0; v < static_cast<int>(mine_.corners().size()); ++v)
      for (int word = 0; word < word_count_; ++word) find_sides(v, word);
  }

  /// Face of the other shape that carries a corner; dimension -1 if the corner is outside.
  [[nodiscard]] ContactFeature locate_corner(int v) {
    if (other_.flat()) return side(0, v) == 0 ? locate_in_facet(v) : ContactFeature{};
    std::vector<int> planes;
    for (int word = 0; word < word_count_; ++word) {
      const std::size_t i = index(v, word);
      if (outside_[i] != 0) return {};
      for_each_bit(~inside_[i] & valid(word), word * word_bits, [&](int f) { planes.push_back(f); });
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

  /// Calls visit(facet, feature) for every facet of the other shape that an edge goes through in an inner
  /// point of the edge, in order; the feature is the facet or an edge of it.
  template <class Visit>
  void pierce(int e, Visit visit) {
    if (misses(e)) return;
    find_passages(e);
    if (passages_.empty()) return;
    const bool bounded = ladder_.floating && !other_.flat() && !lies_in_a_plane(e);
    const Span span = bounded ? bound_span() : Span{};
    if (span.missed) return;
    for (const Passage& p : passages_) {
      if (span.known && !span.may_end_at(p)) continue;
      const int candidates = !span.known ? 0 : p.enters ? span.entries : span.exits;
      const ContactFeature hit = candidates == 1   ? ContactFeature{2, p.facet}
                                 : candidates == 2 ? locate_piercing(e, p.facet, partner(span, p))
                                                   : locate_piercing(e, p.facet);
      if (hit.dimension > 0) visit(p.facet, hit);
    }
  }

  // The same where the edge goes through the solid's boundary in f or in `partner` and in no other facet:
  // only the edge between the two has to be tested.
  [[nodiscard]] ContactFeature locate_piercing(int e, int f, int partner) {
    const std::span<const int> loop = other_.facet(f), sides = other_.edges_of_facet(f);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto& facets = other_.edges()[sides[k]].facets;
      if (facets[0] != partner && facets[1] != partner) continue;
      const auto& ends = mine_.edges()[e].corners;
      const Vector3& c = other_.corners()[loop[k]];
      const Vector3& d = other_.corners()[loop[(k + 1) % loop.size()]];
      const int inside =
          -side(f, ends[0]) * sign_volume(mine_.corners()[ends[0]], mine_.corners()[ends[1]], c, d, ladder_);
      return inside > 0 ? ContactFeature{2, f} : inside == 0 ? ContactFeature{1, sides[k]} : ContactFeature{};
    }
    return locate_piercing(e, f);
  }

  [[nodiscard]] Vector3 piercing_point(int e, int f) {
    const auto& ends = mine_.edges()[e].corners;
    const Vector3 &from = mine_.corners()[ends[0]], &to = mine_.corners()[ends[1]];
    const Vector3& x = other_.corners()[other_.facet(f)[0]];
    if (ladder_.floating)
      if (const auto point = quick_piercing_point(other_.normal_numbers(f).double_double, from, to, x)) {
        ladder_.counts.filter += 3;
        return *point;
      }
    return plane_point(other_.facet_normal(f), from, to, x, ladder_);
  }

 private:
  // An edge going through a plane, at a parameter between these bounds; 0 and 1 are the ends of the edge.
  struct Passage {
    int facet;
    bool enters;
    double least, greatest;
  };
  // The part of an edge inside the solid.
  struct Span {
    bool known = false;   // there is one, and its ends are inner points of the edge or ends of it
    bool missed = false;  // there is none
    double begin = -infinite, end = infinite;  // not later, and not earlier, than its ends
    int entries = 0, exits = 0;                // passages that may be its ends

    [[nodiscard]] bool may_end_at(const Passage& p) const {
      return p.enters ? p.greatest >= begin : p.least <= end;
    }
  };
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  [[nodiscard]] std::size_t index(int v, int word) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(word_count_) +
           static_cast<std::size_t>(word);
  }
  [[nodiscard]] Word valid(int word) const {
    const int count = std::min(other_.facet_count() - word * word_bits, word_bits);
    return ~Word{0} >> static_cast<unsigned>(word_bits - count);
  }
  [[nodiscard]] int side(int f, int v) const {
    const auto shift = static_cast<unsigned>(f % word_bits);
    const std::size_t i = index(v, f / word_bits);
    return static_cast<int>(outside_[i] >> shift & 1U) - static_cast<int>(inside_[i] >> shift & 1U);
  }
  // The sides of random corners are unpredictable, so only undecided signs cause a branch.
  void find_sides(int v, int word) {
    const int first = word * word_bits;
    Word outside = 0, inside = 0;
    if (ladder_.floating) {
      const int count = std::min(other_.facet_count() - first, word_bits);
      for (int k = 0; k < count; ++k) {
        const double height = heights_.row(first + k)[v], error = heights_.error(first + k);
        outside |= static_cast<Word>(height > error) << static_cast<unsigned>(k);
        inside |= static_cast<Word>(height < -error) << static_cast<unsigned>(k);
      }
      ladder_.counts.filter += count;
    }
    for_each_bit(~(outside | inside) & valid(word), first, [&](int f) {
      if (ladder_.floating) --ladder_.counts.filter;
      const Vector3& x = other_.corners()[other_.facet(f)[0]];
      const int sign = sign_along(other_.facet_normal(f), mine_.corners()[v], x, ladder_);
      const Word bit = Word{1} << static_cast<unsigned>(f - first);
      if (sign != 0) (sign > 0 ? outside : inside) |= bit;
    });
    outside_[index(v, word)] = outside;
    inside_[index(v, word)] = inside;
  }

  // True if no inner point of the edge is on the other solid, because of a single plane.
  [[nodiscard]] bool misses(int e) const {
    if (other_.flat()) return false;
    const auto& ends = mine_.edges()[e].corners;
    for (int word = 0; word < word_count_; ++word) {
      const std::size_t i = index(ends[0], word), j = index(ends[1], word);
      if (((outside_[i] & ~inside_[j]) | (outside_[j] & ~inside_[i])) != 0) return true;
    }
    return false;
  }
  [[nodiscard]] bool lies_in_a_plane(int e) const {
    const auto& ends = mine_.edges()[e].corners;
    for (int word = 0; word < word_count_; ++word) {
      const std::size_t i = index(ends[0], word), j = index(ends[1], word);
      if ((valid(word) & ~(outside_[i] | inside_[i] | outside_[j] | inside_[j])) != 0) return true;
    }
    return false;
  }
  // Collects the facets whose plane has the ends of the edge strictly on different sides.
  void find_passages(int e) {
    passages_.clear();
    const auto& ends = mine_.edges()[e].corners;
    for (int word = 0; word < word_count_; ++word) {
      const std::size_t i = index(ends[0], word), j = index(ends[1], word);
      const Word entering = outside_[i] & inside_[j], leaving = inside_[i] & outside_[j];
      for_each_bit(entering | leaving, word * word_bits, [&](int f) {
        const bool enters = (entering >> static_cast<unsigned>(f % word_bits) & 1U) != 0;
        passages_.push_back(passage(f, enters, ends));
      });
    }
  }
  // With heights h, k of the ends, of different signs and each off by at most E, the parameter h / (h - k) is
  // off by at most E / (|h - k| - 2 E) but for its own rounding.
  [[nodiscard]] Passage passage(int f, bool enters, const std::array<int, 2>& ends) const {
    if (!ladder_.floating) return {f, enters, -infinite, infinite};
    const double* const height = heights_.row(f);
    const double error = heights_.error(f), width = height[ends[0]] - height[ends[1]];
    if (!(std::abs(width) > 8.0 * error)) return {f, enters, -infinite, infinite};
    const double inverse = 1.0 / width, t = height[ends[0]] * inverse;
    const double bound = 2.0 * error * std::abs(inverse) + 8.0 * TrackedNumber::unit_roundoff;
    return {f, enters, t - bound, t + bound};
  }
  // The other of two candidates for an end of the span.
  [[nodiscard]] int partner(const Span& span, const Passage& p) const {
    for (const Passage& q : passages_)
      if (q.enters == p.enters && q.facet != p.facet && span.may_end_at(q)) return q.facet;
    return -1;
  }
  // The edge is inside between the last entry and the first exit.
  [[nodiscard]] Span bound_span() const {
    Span span;
    double last_entry = -infinite, first_exit = infinite;
    for (const Passage& p : passages_) {
      if (p.enters) {
        span.begin = std::max(span.begin, p.least);
        last_entry = std::max(last_entry, p.greatest);
      } else {
        span.end = std::min(span.end, p.greatest);
        first_exit = std::min(first_exit, p.least);
      }
    }
    span.missed = span.begin > span.end;
    span.known = last_entry < first_exit;
    for (const Passage& p : passages_)
      if (span.may_end_at(p)) ++(p.enters ? span.entries : span.exits);
    return span;
  }
  // Face of the other shape where an edge goes through facet f in an inner point of the edge: the facet or
  // an edge of it; dimension -1 if it does not, 0 at a corner.
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
    return {1, other_.edges_of_facet(f)[touched]};
  }

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
  const PlaneHeights& heights_;
  PredicateLadder& ladder_;
  int word_count_;
  std::vector<Word> outside_, inside_;  // (#corners, #words), a bit for each facet
  std::vector<Passage> passages_;       // of one edge
};

}  // namespace

ContactRegion crossing_region(const ConvexShape& a, const ConvexShape& b, const PairHeights& heights,
                              PredicateLadder& ladder) {
  CrossingVertices of_a(heights.above_b, ladder), of_b(heights.above_a, ladder);
  ContactRegion region;
  region.points.reserve(24);
  for (int v = 0; v < static_cast<int>(a.corners().size()); ++v) {
    const ContactFeature in_b = of_a.locate_corner(v);
    if (in_b.dimension >= 0) region.points.push_back({{0, v}, in_b, a.corners()[v], a.corners()[v]});
  }
  for (int v = 0; v < static_cast<int>(b.corners().size()); ++v) {
    const ContactFeature in_a = of_b.locate_corner(v);
    if (in_a.dimension > 0) region.points.push_back({in_a, {0, v}, b.corners()[v], b.corners()[v]});
  }
  std::set<std::pair<int, int>> edge_crossings;
  const auto pierce = [&](CrossingVertices& mine, const ConvexShape& shape, bool mine_is_a) {
    for (int e = 0; e < static_cast<int>(shape.edges().size()); ++e)
      mine.pierce(e, [&](int f, const ContactFeature& hit) {
        const std::pair<int, int> edges = mine_is_a ? std::pair(e, hit.index) : std::pair(hit.index, e);
        if (hit.dimension == 1 && !edge_crossings.insert(edges).second) return;
        const Vector3 point = mine.piercing_point(e, f);
        const ContactFeature own{1, e};
        region.points.push_back({mine_is_a ? own : hit, mine_is_a ? hit : own, point, point});
      });
  };
  pierce(of_a, a, true);
  pierce(of_b, b, false);
  const bool flat = a.flat() && b.flat();
  region.dimension = flat ? 1 : a.flat() || b.flat() ? 2 : 3;
  region.a = {a.flat() ? 2 : 3, a.flat() ? 0 : -1};
  region.b = {b.flat() ? 2 : 3, b.flat() ? 0 : -1};
  region.a_dimension = region.a.dimension;
  region.b_dimension = region.b.dimension;
  return region;
}

}  // namespace ashlar
