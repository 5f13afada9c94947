#include "geometry/separating_direction.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/closest_simplex.hpp"

namespace ashlar {

namespace {

Difference edge_vector(const ConvexShape& s, int e) {
  const auto& c = s.edges()[e].corners;
  return {&s.corners()[c[1]], &s.corners()[c[0]]};
}

// Signs of edge vectors of one shape along the facet normals of the other; unknown_sign is allowed, nothing
// is decided here but which pairs of edges are worth a look.
class EdgeSides {
 public:
  EdgeSides(const ConvexShape& facets, const ConvexShape& edges) : facet_count_(facets.facet_count()) {
    std::vector<NumberVector<TrackedNumber>> normals;
    for (int f = 0; f < facet_count_; ++f) normals.push_back(facets.facet_normal(f).tracked());
    for (int e = 0; e < static_cast<int>(edges.edges().size()); ++e) {
      const auto v = ContactDirection::along(edge_vector(edges, e)).tracked();
      for (const auto& n : normals) signs_.push_back(static_cast<signed char>(sign_of(dot(n, v))));
    }
  }
  /// The edge may ascend (sign 1) or descend (-1) along the normal.
  [[nodiscard]] bool may_be(int edge, int facet, int sign) const {
    const int s = signs_[static_cast<std::size_t>(edge * facet_count_ + facet)];
    return s == sign || s == unknown_sign;
  }

 private:
  int facet_count_;
  std::vector<signed char> signs_;
};

class EntranceSearch {
 public:
  EntranceSearch(const ConvexShape& a, const ConvexShape& b, PredicateLadder& ladder)
      : a_(a), b_(b), ladder_(ladder) {}

  SeparationResult run() {
    for (int f = 0; f < a_.facet_count(); ++f) consider({EntranceKind::face_of_a, f, -1, false});
    for (int f = 0; f < b_.facet_count(); ++f) consider({EntranceKind::face_of_b, -1, f, false});
    if (a_.flat() || b_.flat())
      consider_flat_entrances();
    else
      consider_edge_pairs();
    if (!result_.separated && !(a_.flat() && b_.flat())) keep_least();
    return std::move(result_);
  }

 private:
  struct Candidate {
    Entrance entrance;
    double least_squared_depth;  // a proved lower bound
  };

  // A flat shape has its facet on both sides, and all around its edges: nothing can be left out.
  void consider_flat_entrances() {
    for (int f = 0; f < a_.facet_count() && a_.flat(); ++f) consider({EntranceKind::face_of_a, f, -1, true});
    for (int f = 0; f < b_.facet_count() && b_.flat(); ++f) consider({EntranceKind::face_of_b, -1, f, true});
    for (int i = 0; i < static_cast<int>(a_.edges().size()); ++i)
      for (int j = 0; j < static_cast<int>(b_.edges().size()); ++j)
        for (const bool reversed : {false, true}) consider({EntranceKind::edge_edge, i, j, reversed});
  }

  // Edges u of A (facets n1 left, n2 right) and v of B (m1, m2) make a facet of D iff v.n1, -v.n2, u.m1,
  // -u.m2 have one sign s; then w = -s u x v. Zeros belong to entrances with a facet.
  void consider_edge_pairs() {
    if (!ladder_.floating) {
      for (int i = 0; i < static_cast<int>(a_.edges().size()); ++i)
        for (int j = 0; j < static_cast<int>(b_.edges().size()); ++j)
          for (const bool reversed : {false, true}) consider({EntranceKind::edge_edge, i, j, reversed});
      return;
    }
    const EdgeSides edges_of_b(a_, b_), edges_of_a(b_, a_);
    for (int i = 0; i < static_cast<int>(a_.edges().size()); ++i) {
      const auto& n = a_.edges()[i].facets;
      for (int j = 0; j < static_cast<int>(b_.edges().size()); ++j) {
        const auto& m = b_.edges()[j].facets;
        for (const int s : {1, -1})
          if (edges_of_b.may_be(j, n[0], s) && edges_of_b.may_be(j, n[1], -s) &&
              edges_of_a.may_be(i, m[0], s) && edges_of_a.may_be(i, m[1], -s))
            consider({EntranceKind::edge_edge, i, j, s > 0});
      }
    }
  }

  // Sorts an entrance into: separating (exactly), certainly penetrating with a lower bound of its depth.
  void consider(const Entrance& entrance) {
    ContactDirection w = direction_of(entrance, a_, b_);
    if (entrance.kind == EntranceKind::edge_edge && is_zero(w, ladder_)) return;
    if (ladder_.floating) {
      const TrackedNumber height = floating_height(w);
      if (sign_of(height) == -1) {
        if (!result_.separated) candidates_.push_back({entrance, squared_depth_bound(w, height)});
        return;
      }
    }
    Support support = support_along(a_, b_, std::move(w), ladder_);
    support.entrance = entrance;
    if (height_sign(support, a_, b_, ladder_) < 0) {
      if (!result_.separated) candidates_.push_back({entrance, 0.0});
      return;
    }
    result_.separated = true;
    result_.supports.push_back(std::move(support));
  }

  // w . (x - y) for corners x, y that are the lowest and highest as far as rounding shows: never below the
  // true height.
  [[nodiscard]] TrackedNumber floating_height(const ContactDirection& w) const {
    const Vector3 v(w.tracked().x.value, w.tracked().y.value, w.tracked().z.value);
    const auto lowest = [](const std::vector<Vector3>& points, const Vector3& along) {
      std::size_t best = 0;
      double value = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < points.size(); ++k)
        if (const double candidate = along.dot(points[k]); candidate < value) {
          best = k;
          value = candidate;
        }
      return &points[best];
    };
    return dot(w.tracked(),
               ContactDirection::along({lowest(a_.corners(), v), lowest(b_.corners(), -v)}).tracked());
  }
  // Lower bound of height^2 / |w|^2; every operation errs by less than 2^-50 of its result.
  [[nodiscard]] static double squared_depth_bound(const ContactDirection& w, const TrackedNumber& height) {
    const TrackedNumber length = dot(w.tracked(), w.tracked());
    const double least = (-height.value - height.error) * (1.0 - 0x1p-29);
    return std::max(0.0, least * least / ((length.value + length.error) * (1.0 + 0x1p-29)) * (1.0 - 0x1p-40));
  }

  [[nodiscard]] Difference height_of(const Support& s) const {
    return {&a_.corners()[s.a[0]], &b_.corners()[s.b[0]]};
  }

  void keep_least() {
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& x, const Candidate& y) {
      return x.least_squared_depth < y.least_squared_depth;
    });
    double enough = std::numeric_limits<double>::infinity();
    for (const Candidate& c : candidates_) {
      if (ladder_.floating && c.least_squared_depth > enough) break;
      Support support = support_along(a_, b_, direction_of(c.entrance, a_, b_), ladder_);
      support.entrance = c.entrance;
      if (!insert(std::move(support))) continue;
      PredicateLadder uncounted = ladder_;
      const Support& least = result_.supports.front();
      const double depth = squared_height(least.w, height_of(least), uncounted);
      enough = depth * (1.0 + 0x1p-40);
    }
  }

  // True if the support is now the only one of least depth.
  bool insert(Support&& support) {
    if (!result_.supports.empty()) {
      const Support& least = result_.supports.front();
      const int sign = compare_heights(support.w, height_of(support), least.w, height_of(least), ladder_);
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
  s.a = support_corners(a, w, ladder);
  w.reverse();
  s.b = support_corners(b, w, ladder);
  w.reverse();
  s.w = std::move(w);
  return s;
}

int height_sign(const Support& s, const ConvexShape& a, const ConvexShape& b, PredicateLadder& ladder) {
  return sign_along(s.w, a.corners()[s.a[0]], b.corners()[s.b[0]], ladder);
}

SeparationResult find_separation(const ConvexShape& a, const ConvexShape& b, PredicateLadder& ladder) {
  return EntranceSearch(a, b, ladder).run();
}

const Support& preferred_support(const std::vector<Support>& supports, const ConvexShape& a,
                                 const ConvexShape& b, PredicateLadder& ladder) {
  const Support* best = &supports[0];
  const auto has_facet = [](const Support& s) { return s.entrance.kind != EntranceKind::edge_edge; };
  for (const Support& s : supports) {
    if (&s == best || (has_facet(*best) && !has_facet(s))) continue;
    if ((has_facet(s) && !has_facet(*best)) ||
        compare_alignment(s.w, best->w, a.corners(), b.corners(), ladder) > 0)
      best = &s;
  }
  return *best;
}

}  // namespace ashlar
