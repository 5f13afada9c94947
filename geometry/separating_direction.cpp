#include "geometry/separating_direction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/closest_simplex.hpp"

namespace ashlar {

namespace {

Difference edge_vector(const ConvexShape& s, int e) {
  const auto& c = s.edges()[e].corners;
  return {&s.corners()[c[1]], &s.corners()[c[0]]};
}

// Signs of the edge vectors of one shape along the facet normals of the other: all that decides which pairs
// of edges make a facet of D.
class EdgeSides {
 public:
  EdgeSides(const ConvexShape& facets, const ConvexShape& edges, PredicateLadder& ladder)
      : facets_(facets), edges_(edges), ladder_(ladder), edge_count_(static_cast<int>(edges.edges().size())) {
    signs_.resize(static_cast<std::size_t>(edge_count_) * static_cast<std::size_t>(facets.facet_count()),
                  unknown_sign);
    if (ladder.floating) fill();
  }
  /// (#edges): signs along one normal, unknown_sign where the filter is in doubt.
  [[nodiscard]] const signed char* row(int facet) const { return &signs_[index(facet, 0)]; }
  [[nodiscard]] int sign(int edge, int facet) {
    signed char& s = signs_[index(facet, edge)];
    if (s == unknown_sign)
      s = static_cast<signed char>(
          sign_along(facets_.facet_normal(facet), edge_vector(edges_, edge), ladder_));
    return s;
  }

 private:
  [[nodiscard]] std::size_t index(int facet, int edge) const {
    return static_cast<std::size_t>(facet) * static_cast<std::size_t>(edge_count_) +
           static_cast<std::size_t>(edge);
  }
  void fill() {
    std::vector<std::array<double, 4>> vectors;
    vectors.reserve(static_cast<std::size_t>(edge_count_));
    for (const ConvexEdge& e : edges_.edges()) {
      const Vector3 v = edges_.corners()[e.corners[1]] - edges_.corners()[e.corners[0]];
      vectors.push_back({v[0], v[1], v[2], std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2])});
    }
    auto sign = signs_.begin();
    for (int f = 0; f < facets_.facet_count(); ++f) {
      const auto& n = facets_.normal_numbers(f);
      for (const auto& v : vectors) {
        const double value = n.tracked.x.value * v[0] + n.tracked.y.value * v[1] + n.tracked.z.value * v[2];
        const double bound = v[3] * n.bound;  // ContactDirection::quick_sign
        const int s = (value > bound) - (value < -bound);
        ladder_.counts.filter += s * s;
        *sign++ = static_cast<signed char>(s != 0 ? s : unknown_sign);
      }
    }
  }

  const ConvexShape& facets_;
  const ConvexShape& edges_;
  PredicateLadder& ladder_;
  int edge_count_;
  std::vector<signed char> signs_;
};

class EntranceSearch {
 public:
  EntranceSearch(const ConvexShape& a, const ConvexShape& b, PredicateLadder& ladder)
      : a_(a), b_(b), ladder_(ladder) {}

  SeparationResult run() {
    candidates_.reserve(64);
    search_facets(a_, b_, EntranceKind::face_of_a);
    if (result_.relation != Relation::apart) search_facets(b_, a_, EntranceKind::face_of_b);
    if (result_.relation == Relation::crossing) search_edge_pairs();
    if (result_.relation == Relation::crossing && !(a_.flat() && b_.flat())) keep_least();
    return std::move(result_);
  }

  std::vector<Support> run_farthest() {
    farthest_ = true;
    search_facets(a_, b_, EntranceKind::face_of_a);
    search_facets(b_, a_, EntranceKind::face_of_b);
    search_edge_pairs();
    return std::move(result_.supports);
  }

 private:
  struct Candidate {
    Entrance entrance;
    double least_squared_depth;  // a proved lower bound
  };

  // The height of a facet of `own` is the least N.(y - x) over the corners y of the other shape.
  void search_facets(const ConvexShape& own, const ConvexShape& other, EntranceKind kind) {
    for (int f = 0; f < own.facet_count(); ++f)
      for (const bool reversed : {false, true}) {
        if (reversed && !own.flat()) continue;  // a triangle has its facet on both sides
        const Entrance entrance{kind, kind == EntranceKind::face_of_a ? f : -1,
                                kind == EntranceKind::face_of_b ? f : -1, reversed};
        if (!ladder_.floating || !penetrates(own, f, reversed, other, entrance)) settle(support_of(entrance));
        if (result_.relation == Relation::apart) return;
      }
  }

  // True if a corner of the other shape is certainly behind the facet; notes how deep.
  bool penetrates(const ConvexShape& own, int f, bool reversed, const ConvexShape& other,
                  const Entrance& entrance) {
    const auto& n = own.normal_numbers(f);
    const double sign = reversed ? -1.0 : 1.0;
    const double nx = sign * n.tracked.x.value, ny = sign * n.tracked.y.value, nz = sign * n.tracked.z.value;
    const Vector3& x = own.corners()[own.facet(f)[0]];
    double deepest = 0.0;
    for (const Vector3& y : other.corners()) {
      const double d0 = y[0] - x[0], d1 = y[1] - x[1], d2 = y[2] - x[2];
      const double bound = (std::abs(d0) + std::abs(d1) + std::abs(d2)) * n.bound;
      deepest = std::min(deepest, (nx * d0 + ny * d1 + nz * d2) + bound);
    }
    // The sum of value and bound is rounded itself.
    deepest *= 1.0 - 0x1p-40;
    if (!(deepest < 0.0)) return false;
    ++ladder_.counts.filter;
    note(entrance, deepest, n.tracked);
    return true;
  }

  void note(const Entrance& entrance, double height_bound, const NumberVector<TrackedNumber>& w) {
    const TrackedNumber length = dot(w, w);
    candidates_.push_back(
        {entrance,
         height_bound * height_bound / ((length.value + length.error) * (1.0 + 0x1p-29)) * (1.0 - 0x1p-40)});
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
    EdgeSides edges_of_b(a_, b_, ladder_), edges_of_a(b_, a_, ladder_);
    const int a_back = a_.flat() ? -1 : 1, b_back = b_.flat() ? -1 : 1;
    for (int i = 0; i < static_cast<int>(a_.edges().size()); ++i) {
      const auto& n = a_.edges()[i].facets;
      const signed char *left = edges_of_b.row(n[0]), *right = edges_of_b.row(n[1]);
      for (int j = 0; j < static_cast<int>(b_.edges().size()); ++j) {
        if (left[j] == a_back * right[j] && left[j] != unknown_sign) continue;
        const auto& m = b_.edges()[j].facets;
        const int s = edges_of_b.sign(j, n[0]);
        if (s == 0 || a_back * edges_of_b.sign(j, n[1]) != -s || edges_of_a.sign(i, m[0]) != s ||
            b_back * edges_of_a.sign(i, m[1]) != -s)
          continue;
        settle_edge_pair({EntranceKind::edge_edge, i, j, s > 0});
        if (result_.relation == Relation::apart) return;
      }
    }
  }
  void settle_edge_pair(const Entrance& entrance) {
    if (ladder_.floating) {
      const NumberVector<TrackedNumber> w = cross(evaluate<TrackedNumber>(edge_vector(a_, entrance.a)),
                                                  evaluate<TrackedNumber>(edge_vector(b_, entrance.b)));
      TrackedNumber height =
          dot(w, evaluate<TrackedNumber>(Difference{&a_.corners()[a_.edges()[entrance.a].corners[0]],
                                                    &b_.corners()[b_.edges()[entrance.b].corners[0]]}));
      if (entrance.reversed) height.value = -height.value;
      if (sign_of(height) < 0) {
        ++ladder_.counts.filter;
        return note(entrance, (height.value + height.error) * (1.0 - 0x1p-29), w);
      }
    }
    settle(support_of(entrance));
  }

  // Exact support along an entrance; that of its own features is known.
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

  void keep_least() {
    // The first bound is the least one, so that few others need an exact look.
    const auto least = std::min_element(
        candidates_.begin(), candidates_.end(),
        [](const Candidate& x, const Candidate& y) { return x.least_squared_depth < y.least_squared_depth; });
    if (least == candidates_.end()) return;
    std::iter_swap(candidates_.begin(), least);
    double enough = std::numeric_limits<double>::infinity();
    for (const Candidate& c : candidates_) {
      if (ladder_.floating && c.least_squared_depth > enough) continue;
      if (!insert(support_of(c.entrance))) continue;
      PredicateLadder uncounted = ladder_;
      const Support& nearest = result_.supports.front();
      enough = ContactHeight(nearest.w, height_of(nearest), uncounted).squared() * (1.0 + 0x1p-40);
    }
  }

  // Keeps the supports of least |height| / |w|, or of the greatest in a search for the farthest one. True if
  // this one is now the only one.
  bool insert(Support&& support) {
    if (!result_.supports.empty()) {
      const Support& least = result_.supports.front();
      const int larger = compare_heights(support.w, height_of(support), least.w, height_of(least), ladder_);
      const int sign = farthest_ ? -larger : larger;
      if (sign > 0) return false;
      if (sign == 0) {
        if (std::none_of(result_.supports.begin(), result_.supports.end(),
                         [&](const Support& known) { return same_direction(known.w, support.w, ladder_); }))
          result_.supports.push_back(std::move(support));
        return false;
      }
      result_.supports.clear();
    }
    result_.supports.push_back(std::move(support));
    return true;
  }

  const ConvexShape& a_;
  const ConvexShape& b_;
  PredicateLadder& ladder_;
  bool farthest_ = false;
  SeparationResult result_;
  std::vector<Candidate> candidates_;
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

SeparationResult find_separation(const ConvexShape& a, const ConvexShape& b, PredicateLadder& ladder) {
  return EntranceSearch(a, b, ladder).run();
}

std::vector<Support> find_farthest_separation(const ConvexShape& a, const ConvexShape& b,
                                              PredicateLadder& ladder) {
  return EntranceSearch(a, b, ladder).run_farthest();
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
