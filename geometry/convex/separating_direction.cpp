#include "geometry/convex/separating_direction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

#include "geometry/convex/closest_simplex.hpp"

namespace ashlar {

namespace {

Difference edge_vector(const ConvexShape& s, int e) {
  const auto& c = s.edges()[e].corners;
  return {&s.corners()[c[1]], &s.corners()[c[0]]};
}

// Signs of the edge vectors of one shape along the facet normals of the other, which decide the pairs of edges
// that form a facet of D. A row of bits for each facet, a bit for each edge.
class EdgeSides {
 public:
  using Word = std::uint64_t;
  static constexpr int word_bits = 64;
  static constexpr Word all = ~Word{0};

  EdgeSides(const PlaneHeights& heights, PredicateLadder& ladder)
      : facets_(heights.planes()),
        edges_(heights.corners()),
        ladder_(ladder),
        edge_count_(static_cast<int>(edges_.edges().size())),
        word_count_((edge_count_ + word_bits - 1) / word_bits) {
    const std::size_t size = index(facets_.facet_count(), 0);
    words_.resize(2 * size, 0);
    positive_ = words_.data();
    negative_ = positive_ + size;
    for (int f = 0; ladder.floating && f < facets_.facet_count(); ++f) fill(f, heights);
  }
  [[nodiscard]] int word_count() const { return word_count_; }
  /// Edges whose sign along a facet's normal is `sign`, or undecided or zero.
  [[nodiscard]] Word perhaps(int sign, int facet, int word) const {
    const int last = edge_count_ - word * word_bits;
    const Word valid = last < word_bits ? ~(all << static_cast<unsigned>(last)) : all;
    return ~(sign > 0 ? negative_ : positive_)[index(facet, word)] & valid;
  }
  [[nodiscard]] int sign(int edge, int facet) {
    const std::size_t word = index(facet, edge / word_bits);
    const Word bit = Word{1} << static_cast<unsigned>(edge % word_bits);
    if ((positive_[word] & bit) != 0) return 1;
    if ((negative_[word] & bit) != 0) return -1;
    const int sign = sign_along(facets_.facet_normal(facet), edge_vector(edges_, edge), ladder_);
    if (sign != 0) (sign > 0 ? positive_ : negative_)[word] |= bit;
    return sign;
  }

 private:
  [[nodiscard]] std::size_t index(int facet, int word) const {
    return static_cast<std::size_t>(facet) * word_count_ + word;
  }
  // The height of an edge vector is the difference of those of its ends. Signs of random edges are not predicted
  // by any branch predictor, so there is no branch.
  void fill(int f, const PlaneHeights& heights) {
    const double* const height = heights.row(f);
    const double bound = heights.difference_error(f);
    const ConvexEdge* edge = edges_.edges().data();
    for (int word = 0, left = edge_count_; left > 0; ++word, left -= word_bits) {
      Word up = 0, down = 0;
      const int count = std::min(left, word_bits);
      for (int k = 0; k < count; ++k, ++edge) {
        const double value = height[edge->corners[1]] - height[edge->corners[0]];
        up |= static_cast<Word>(value > bound) << static_cast<unsigned>(k);
        down |= static_cast<Word>(value < -bound) << static_cast<unsigned>(k);
      }
      positive_[index(f, word)] = up;
      negative_[index(f, word)] = down;
      const Word decided = up | down;
      ladder_.counts.filter +=
          decided == all >> static_cast<unsigned>(word_bits - count) ? count : std::popcount(decided);
    }
  }

  const ConvexShape& facets_;
  const ConvexShape& edges_;
  PredicateLadder& ladder_;
  int edge_count_, word_count_;
  std::vector<Word> words_;
  Word *positive_ = nullptr, *negative_ = nullptr;  // (#facets, #words) each
};

class EntranceSearch {
 public:
  EntranceSearch(const ConvexShape& a, const ConvexShape& b, PairHeights& heights, PredicateLadder& ladder)
      : a_(a), b_(b), heights_(heights), ladder_(ladder) {
    candidates_.clear();
    edge_pairs_.clear();
  }

  SeparationResult run() {
    search_facets(a_, heights_.above_a, EntranceKind::face_of_a);
    if (result_.relation != Relation::apart) search_facets(b_, heights_.above_b, EntranceKind::face_of_b);
    if (result_.relation == Relation::crossing) search_edge_pairs();
    if (result_.relation == Relation::crossing && !(a_.flat() && b_.flat())) keep_least();
    return std::move(result_);
  }

  std::vector<Support> run_farthest() {
    farthest_ = true;
    search_facets(a_, heights_.above_a, EntranceKind::face_of_a);
    search_facets(b_, heights_.above_b, EntranceKind::face_of_b);
    search_edge_pairs();
    return std::move(result_.supports);
  }

 private:
  // A facet of D with a proved lower bound of its squared depth.
  struct Candidate {
    Entrance entrance;
    double least_squared_depth;
  };

  // The height of a facet of `own` is the least N.(y - x) over the corners y of the other shape.
  void search_facets(const ConvexShape& own, PlaneHeights& heights, EntranceKind kind) {
    for (int f = 0; f < own.facet_count(); ++f) {
      if (ladder_.floating) heights.compute(f);
      for (const bool reversed : {false, true}) {
        if (reversed && !own.flat()) continue;  // a triangle has its facet on both sides
        const Entrance entrance{kind, kind == EntranceKind::face_of_a ? f : -1,
                                kind == EntranceKind::face_of_b ? f : -1, reversed};
        if (!ladder_.floating || !penetrates(heights, f, entrance)) settle(support_of(entrance));
        if (result_.relation == Relation::apart) return;
      }
    }
  }

  // True if a corner of the other shape is certainly behind the facet; notes how deep.
  bool penetrates(const PlaneHeights& heights, int f, const Entrance& entrance) {
    const double deepest = entrance.reversed ? heights.highest(f) : -heights.lowest(f);
    const double error = heights.error(f);
    if (!(deepest > error)) return false;
    ++ladder_.counts.filter;
    note(entrance, deepest, error, heights.planes().squared_normal(f));
    return true;
  }

  // |height| is within the error of depth > error. Facets that are certainly not the nearest are dropped.
  void note(const Entrance& entrance, double depth, double error, const TrackedNumber& squared_length) {
    constexpr double slack = 0x1p-29;  // covers the rounding of these lines and of the bounds themselves
    error *= 1.0 + slack;
    const double length_error = squared_length.error * (1.0 + slack);
    const double least = std::max(depth - error, 0.0), greatest = depth + error;
    const double longest = squared_length.value + length_error;
    if (least * least * (1.0 - slack) > enough_ * longest * (1.0 + slack)) return;
    const double shortest = squared_length.value - length_error;
    if (shortest > 0.0) enough_ = std::min(enough_, greatest * greatest / shortest * (1.0 + slack));
    candidates_.push_back({entrance, least * least / longest * (1.0 - slack)});
  }

  void settle(Support&& s) {
    const int sign = sign_along(s.w, height_of(s), ladder_);
    if (farthest_) {
      if (sign >= 0) insert(std::move(s));
      return;
    }
    if (sign < 0) {
      if (result_.relation == Relation::crossing) candidates_.push_back({s.entrance, 0.0});
      return;
    }
    result_.relation = sign > 0 ? Relation::apart : Relation::touching;
    if (sign > 0)
      result_.supports.clear();
    else
      result_.supports.push_back(std::move(s));
  }

  // Edges u of A (facets n1 left, n2 right) and v of B (m1, m2) make a facet of D iff v.n1, -v.n2, u.m1,
  // -u.m2 have one sign s; then w = -s u x v, and the two edges are its support. Zeros belong to entrances
  // with a facet. The facet right of a triangle's edge is its back.
  void search_edge_pairs() {
    EdgeSides edges_of_b(heights_.above_a, ladder_);
    const int a_back = a_.flat() ? -1 : 1, b_back = b_.flat() ? -1 : 1;
    find_edge_pairs(edges_of_b, a_back, b_back);
    for (const auto& [i, j] : edge_pairs_) {
      const auto &n = a_.edges()[i].facets, &m = b_.edges()[j].facets;
      const int s = edges_of_b.sign(j, n[0]);
      if (s == 0 || a_back * edges_of_b.sign(j, n[1]) != -s || sign_of_edge(i, m[0]) != s ||
          b_back * sign_of_edge(i, m[1]) != -s)
        continue;
      settle_edge_pair({EntranceKind::edge_edge, i, j, s > 0});
      if (result_.relation == Relation::apart) return;
    }
  }
  [[nodiscard]] static double edge_height(const PlaneHeights& heights, int facet, const ConvexEdge& edge) {
    const double* const height = heights.row(facet);
    return height[edge.corners[1]] - height[edge.corners[0]];
  }
  // Sign of an edge of A along the normal of a facet of B.
  [[nodiscard]] int sign_of_edge(int edge, int facet) {
    if (ladder_.floating) {
      const double height = edge_height(heights_.above_b, facet, a_.edges()[edge]);
      if (std::abs(height) > heights_.above_b.difference_error(facet)) {
        ++ladder_.counts.filter;
        return height > 0.0 ? 1 : -1;
      }
    }
    return sign_along(b_.facet_normal(facet), edge_vector(a_, edge), ladder_);
  }
  // Collects the pairs that the floating signs do not rule out, by bits instead of branches, because the signs
  // are unpredictable.
  void find_edge_pairs(const EdgeSides& edges_of_b, int a_back, int b_back) {
    using Word = EdgeSides::Word;
    constexpr int word_bits = EdgeSides::word_bits;
    std::size_t found = 0;
    for (int i = 0; i < static_cast<int>(a_.edges().size()); ++i) {
      const ConvexEdge& edge = a_.edges()[i];
      const auto& n = edge.facets;
      for (int word = 0; word < edges_of_b.word_count(); ++word) {
        const Word plus = edges_of_b.perhaps(1, n[0], word) & edges_of_b.perhaps(-a_back, n[1], word);
        const Word minus = edges_of_b.perhaps(-1, n[0], word) & edges_of_b.perhaps(a_back, n[1], word);
        if (edge_pairs_.size() < found + word_bits) edge_pairs_.resize(2 * (found + word_bits));
        for (Word open = plus | minus; open != 0; open &= open - 1) {
          const int bit = std::countr_zero(open), j = word * word_bits + bit;
          edge_pairs_[found] = {i, j};
          const bool doubtful = !ladder_.floating || ((plus & minus) >> static_cast<unsigned>(bit) & 1U) != 0;
          const double s = (plus >> static_cast<unsigned>(bit) & 1U) != 0 ? 1.0 : -1.0;
          found += static_cast<std::size_t>(doubtful || is_passed(edge, b_.edges()[j], s, b_back));
        }
      }
    }
    edge_pairs_.resize(found);
  }
  // False if an edge of A certainly does not have the signs s and -s along the normals beside an edge of B.
  [[nodiscard]] bool is_passed(const ConvexEdge& edge, const ConvexEdge& beside, double s, int b_back) const {
    const auto [left, right] = beside.facets;
    const PlaneHeights& heights = heights_.above_b;
    const bool above = s * edge_height(heights, left, edge) >= -heights.difference_error(left);
    const bool below = s * b_back * edge_height(heights, right, edge) <= heights.difference_error(right);
    return above & below;
  }
  // Error bounds, with |.| the sum of absolute components: each term of the height has three factors with one
  // rounding each and takes part in at most six more, so the height errs by less than 10 u |e| |f| |d|; a
  // component of w = e x f likewise, all of them together by less than 5 u |e| |f|.
  void settle_edge_pair(const Entrance& entrance) {
    if (ladder_.floating) {
      const auto ends = [](const ConvexShape& s, int e) {
        const auto& c = s.edges()[e].corners;
        return std::array<const Vector3*, 2>{&s.corners()[c[0]], &s.corners()[c[1]]};
      };
      const auto [a0, a1] = ends(a_, entrance.a);
      const auto [b0, b1] = ends(b_, entrance.b);
      const Vector3 e = *a1 - *a0, f = *b1 - *b0, d = *a0 - *b0;
      const Vector3 w = e.cross(f);
      const double height = entrance.reversed ? -w.dot(d) : w.dot(d);
      const double size = e.cwiseAbs().sum() * f.cwiseAbs().sum();
      const double error = 0x1p-49 * size * d.cwiseAbs().sum();
      if (height < -error) {
        ++ladder_.counts.filter;
        const double w_error = 0x1p-50 * size, squared_length = w.squaredNorm();
        const double length_error = w_error * (2.0 * w.cwiseAbs().sum() + w_error) + 0x1p-50 * squared_length;
        return note(entrance, -height, error, {squared_length, length_error});
      }
    }
    settle(support_of(entrance));
  }

  // Exact support along an entrance; the support of its own features is known.
  [[nodiscard]] Support support_of(const Entrance& entrance) {
    Support s;
    s.entrance = entrance;
    s.w = direction_of(entrance, a_, b_);
    const auto facet = [](const ConvexShape& shape, int f) {
      return std::vector<int>(shape.facet(f).begin(), shape.facet(f).end());
    };
    const auto edge = [](const ConvexShape& shape, int e) {
      return std::vector<int>(shape.edges()[e].corners.begin(), shape.edges()[e].corners.end());
    };
    switch (entrance.kind) {
      case EntranceKind::face_of_a:
        s.a = facet(a_, entrance.a);
        s.b = support_corners(b_, s.w, -1, ladder_);
        break;
      case EntranceKind::face_of_b:
        s.a = support_corners(a_, s.w, 1, ladder_);
        s.b = facet(b_, entrance.b);
        break;
      case EntranceKind::edge_edge:
        s.a = edge(a_, entrance.a);
        s.b = edge(b_, entrance.b);
        break;
    }
    return s;
  }

  [[nodiscard]] Difference height_of(const Support& s) const {
    return {&a_.corners()[s.a[0]], &b_.corners()[s.b[0]]};
  }

  // In the order of the search, so that of several with the same direction the first is kept.
  void keep_least() {
    for (const Candidate& c : candidates_)
      if (c.least_squared_depth <= enough_) insert(support_of(c.entrance));
  }

  // Keeps the supports of least |height| / |w|, or of the greatest in a search for the farthest one.
  void insert(Support&& support) {
    if (!result_.supports.empty()) {
      const Support& least = result_.supports.front();
      const int larger = compare_heights(support.w, height_of(support), least.w, height_of(least), ladder_);
      const int sign = farthest_ ? -larger : larger;
      if (sign > 0) return;
      if (sign == 0) {
        if (std::none_of(result_.supports.begin(), result_.supports.end(),
                         [&](const Support& known) { return same_direction(known.w, support.w, ladder_); }))
          result_.supports.push_back(std::move(support));
        return;
      }
      result_.supports.clear();
    }
    result_.supports.push_back(std::move(support));
  }

  const ConvexShape& a_;
  const ConvexShape& b_;
  PairHeights& heights_;
  PredicateLadder& ladder_;
  bool farthest_ = false;
  SeparationResult result_;
  double enough_ = std::numeric_limits<double>::infinity();  // some squared depth is certainly not greater
  // Room that the next search of the thread uses again.
  inline static thread_local std::vector<Candidate> candidates_;
  inline static thread_local std::vector<std::array<int, 2>> edge_pairs_;
};

}  // namespace

ContactDirection direction_of(const Entrance& entrance, const ConvexShape& a, const ConvexShape& b) {
  ContactDirection w;
  switch (entrance.kind) {
    case EntranceKind::face_of_a:
      w = a.facet_normal(entrance.a);
      w.reverse();
      break;
    case EntranceKind::face_of_b:
      w = b.facet_normal(entrance.b);
      break;
    case EntranceKind::edge_edge:
      w = ContactDirection::cross(edge_vector(a, entrance.a), edge_vector(b, entrance.b));
      break;
  }
  if (entrance.reversed) w.reverse();
  return w;
}

Support support_along(const ConvexShape& a, const ConvexShape& b, ContactDirection w,
                      PredicateLadder& ladder) {
  Support s;
  s.a = support_corners(a, w, 1, ladder);
  s.b = support_corners(b, w, -1, ladder);
  s.w = std::move(w);
  return s;
}

SeparationResult find_separation(const ConvexShape& a, const ConvexShape& b, PairHeights& heights,
                                 PredicateLadder& ladder) {
  return EntranceSearch(a, b, heights, ladder).run();
}

std::vector<Support> find_farthest_separation(const ConvexShape& a, const ConvexShape& b,
                                              PredicateLadder& ladder) {
  PairHeights heights(a, b);
  return EntranceSearch(a, b, heights, ladder).run_farthest();
}

const Support& preferred_support(const std::vector<Support>& supports, const ConvexShape& a,
                                 const ConvexShape& b, PredicateLadder& ladder) {
  const Support* best = &supports[0];
  if (supports.size() == 1) return *best;
  const MeanDifference means(a.corners(), b.corners());
  const auto has_facet = [](const Support& s) { return s.entrance.kind != EntranceKind::edge_edge; };
  for (const Support& s : supports) {
    if (&s == best || (has_facet(*best) && !has_facet(s))) continue;
    if ((has_facet(s) && !has_facet(*best)) || means.compare_alignment(s.w, best->w, ladder) > 0) best = &s;
  }
  return *best;
}

}  // namespace ashlar
