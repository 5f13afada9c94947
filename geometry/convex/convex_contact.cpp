#include "geometry/convex/convex_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry/convex/closest_simplex.hpp"
#include "geometry/exact/rounding_mode.hpp"

namespace ashlar {

namespace {

class ConvexContactFinder {
 public:
  ConvexContactFinder(const ConvexShape& a, const ConvexShape& b, const Resolution& resolution = {})
      : a_(a), b_(b), resolution_(resolution), heights_(a, b) {
    NumericRange range = a.range();
    range.include(b.range());
    range.include(resolution.distance);
    range.include(resolution.sine);
    ladder_.open(range);
    report_.displacement = report_.normal = Vector3::Zero();
  }

  ConvexContact run(const std::optional<Entrance>& history, const CrossingDetail& detail) {
    const CornerSimplex guess = guess_closest_simplex(a_.corners(), b_.corners());
    // If the initial simplex contains the origin, a separating direction is searched first.
    if (guess.size < 4 || !intersecting(history, detail)) {
      ClosestSimplex closest = find_closest_simplex(a_, b_, guess, ladder_);
      if (!closest.contains_origin)
        apart(std::move(closest), detail);
      else
        intersecting(history, detail);
    }
    report_.decided_by = ladder_.counts;
    return std::move(report_);
  }

  ResolvedContact run_resolved(const std::optional<Entrance>& history) {
    keep_direction_ = true;
    const ConvexContact exact = run(history, {false, false, false});
    ResolvedContact result;
    result.relation = exact.relation;
    result.normal = exact.normal;
    result.rule = exact.rule;
    result.entrance = exact.entrance;
    result.resolution = resolution_;
    if (accepted_.a.empty()) {
      result.region = crossing_region(a_, b_, heights_, ladder_);
    } else {
      const ContactHeight height(accepted_.w, height_of(accepted_), ladder_);
      const double length = height.length();
      result.gap = exact.relation == Relation::crossing ? -length : length;
      const std::vector<int> loop_a = resolved_loop(a_, accepted_.a), loop_b = resolved_loop(b_, accepted_.b);
      result.region = region_along(accepted_.w, PlaneSetting::tilted, {a_, {a_.corners().data(), loop_a}},
                                   {b_, {b_.corners().data(), loop_b}}, &height, ladder_);
    }
    result.decided_by = ladder_.counts;
    return result;
  }

 private:
  [[nodiscard]] Difference height_of(const Support& s) const {
    return {&a_.corners()[s.a[0]], &b_.corners()[s.b[0]]};
  }
  [[nodiscard]] ContactRegion coplanar_region_of(const Support& s) {
    return region_of(s, PlaneSetting::coplanar, nullptr);
  }
  [[nodiscard]] ContactRegion level_region_of(const Support& s, const ContactHeight& height) {
    return region_of(s, PlaneSetting::level, &height);
  }
  [[nodiscard]] ContactRegion level_region_of(const Support& s) {
    return level_region_of(s, ContactHeight(s.w, height_of(s), ladder_));
  }
  [[nodiscard]] ContactRegion region_of(const Support& s, PlaneSetting setting, const ContactHeight* height) {
    const std::vector<int> loop_a = support_loop(a_, s.a, s.w, true, ladder_);
    const std::vector<int> loop_b = support_loop(b_, s.b, s.w, false, ladder_);
    return region_along(s.w, setting, {a_, {a_.corners().data(), loop_a}},
                        {b_, {b_.corners().data(), loop_b}}, height, ladder_);
  }

  // Corners of P_tau or Q_tau that are corners of its projection, counter-clockwise along w.
  [[nodiscard]] std::vector<int> resolved_loop(const ConvexShape& shape, const std::vector<int>& support) {
    const std::vector<Vector3>& x = shape.corners();
    const auto reaches = [&](int v) {
      if (std::find(support.begin(), support.end(), v) != support.end()) return true;
      if (is_within(accepted_.w, {&x[v], &x[support[0]]}, resolution_.distance, false, ladder_)) return true;
      return std::all_of(support.begin(), support.end(), [&](int p) {
        return is_within(accepted_.w, {&x[v], &x[p]}, resolution_.sine, true, ladder_);
      });
    };
    std::vector<int> candidates;
    for (int v = 0; v < static_cast<int>(x.size()); ++v)
      if (reaches(v)) candidates.push_back(v);
    return projected_hull(accepted_.w, x.data(), candidates, ladder_);
  }

  void apart(ClosestSimplex&& closest, const CrossingDetail& detail) {
    report_.relation = Relation::apart;
    const CornerPair first = closest.simplex.pairs[0];
    const ContactHeight height(closest.w, {&a_.corners()[first.a], &b_.corners()[first.b]}, ladder_);
    report_.squared_distance = height.squared();
    if (detail.gap) report_.gap = height.length();
    report_.displacement = height.step();
    report_.normal = unit_vector(closest.w, ladder_);
    report_.rule = DirectionRule::closest_points;
    if (keep_direction_) {
      accepted_ = {{}, std::move(closest.w), std::move(closest.support_a), std::move(closest.support_b)};
    } else if (const auto point = single_point(closest, height)) {
      report_.region = point_region(*point);
    } else {
      report_.region = level_region_of(
          {{}, std::move(closest.w), std::move(closest.support_a), std::move(closest.support_b)});
    }
  }

  // The face that carries the nearest point of a shape whose corners in the simplex are `corners`: the point
  // is in the relative interior of their hull, which lies in the face spanned by `support`.
  [[nodiscard]] static ContactFeature carrier_of_point(const ConvexShape& shape,
                                                       const std::vector<int>& corners,
                                                       const std::vector<int>& support) {
    if (corners.size() == 1) return {0, corners[0]};
    if (corners.size() == 2)
      if (const int edge = shape.find_edge(corners[0], corners[1]); edge >= 0) return {1, edge};
    return {2, shape.find_facet(support)};
  }

  // The region where a corner is nearest, or two edges that are not parallel; no need for an overlap.
  [[nodiscard]] std::optional<RegionVertex> single_point(const ClosestSimplex& closest,
                                                         const ContactHeight& height) {
    std::vector<int> a, b;
    for (int k = 0; k < closest.simplex.size; ++k) {
      const auto add = [](std::vector<int>& corners, int v) {
        if (std::find(corners.begin(), corners.end(), v) == corners.end()) corners.push_back(v);
      };
      add(a, closest.simplex.pairs[k].a);
      add(b, closest.simplex.pairs[k].b);
    }
    RegionVertex point;
    point.a = carrier_of_point(a_, a, closest.support_a);
    point.b = carrier_of_point(b_, b, closest.support_b);
    if (closest.support_a.size() == 1) {
      point.on_a = a_.corners()[a[0]];
      point.on_b = b.size() == 1 ? b_.corners()[b[0]] : height.below(point.on_a);
      return point;
    }
    if (closest.support_b.size() == 1) {
      point.on_b = b_.corners()[b[0]];
      point.on_a = a.size() == 1 ? a_.corners()[a[0]] : height.above(point.on_b);
      return point;
    }
    if (closest.support_a.size() != 2 || closest.support_b.size() != 2 || closest.simplex.size != 3)
      return std::nullopt;
    const auto ends = [](const ConvexShape& shape, const std::vector<int>& edge) {
      return std::array<const Vector3*, 2>{&shape.corners()[edge[0]], &shape.corners()[edge[1]]};
    };
    const auto u = ends(a_, closest.support_a), v = ends(b_, closest.support_b);
    point.on_a = crossing_point(closest.w, *u[0], *u[1], *v[0], *v[1], ladder_);
    point.on_b = crossing_point(closest.w, *v[0], *v[1], *u[0], *u[1], ladder_);
    return point;
  }

  // False, with nothing reported, if the two are apart.
  bool intersecting(const std::optional<Entrance>& history, const CrossingDetail& detail) {
    SeparationResult separation = find_separation(a_, b_, heights_, ladder_);
    if (separation.relation == Relation::apart) return false;
    if (separation.relation == Relation::touching) return touching(separation.supports, history);
    crossing(separation.supports, history, detail);
    return true;
  }

  // Both have points in a plane that separates them: the common points of those are all they have in common.
  bool touching(const std::vector<Support>& supports, const std::optional<Entrance>& history) {
    report_.region = coplanar_region_of(supports[0]);
    if (report_.region.dimension < 0) return false;
    report_.relation = Relation::touching;
    const ContactType type = report_.type();
    const bool open = type == ContactType::vertex_vertex || type == ContactType::vertex_edge ||
                      (type == ContactType::edge_edge && report_.region.dimension == 1);
    if (open)
      choose(supports, history);
    else
      take(supports[0], DirectionRule::unique);
    return true;
  }

  void crossing(const std::vector<Support>& supports, const std::optional<Entrance>& history,
                const CrossingDetail& detail) {
    report_.relation = Relation::crossing;
    if (detail.region) report_.region = crossing_region(a_, b_, heights_, ladder_);
    if (supports.empty()) {  // triangles: no depth, so only history knows a direction
      choose_from_history(history);
      return;
    }
    for (const Support& s : supports) {
      const ContactHeight height(s.w, height_of(s), ladder_);
      if (&s == &supports.front()) {
        report_.squared_depth = height.squared();
        if (detail.gap) report_.gap = -height.length();
      }
      report_.minimal_translations.push_back(
          {s.entrance, height.step_back(),
           detail.translation_regions ? level_region_of(s, height) : ContactRegion{}});
    }
    choose(supports, history);
  }

  // The history rule; without history the least penetration (all supports are equally near).
  void choose(const std::vector<Support>& supports, const std::optional<Entrance>& history) {
    if (choose_from_history(history)) return;
    take(preferred_support(supports, a_, b_, ladder_),
         supports.size() == 1 ? DirectionRule::least_penetration : DirectionRule::least_penetration_tie);
  }

  bool choose_from_history(const std::optional<Entrance>& history) {
    if (!history || !is_valid(*history)) return false;
    Support s = support_along(a_, b_, direction_of(*history, a_, b_), ladder_);
    s.entrance = *history;
    if (level_region_of(s).dimension < 0) return false;
    take(s, DirectionRule::history);
    return true;
  }

  // The entrance names features of these shapes, and two edges of it are not parallel.
  [[nodiscard]] bool is_valid(const Entrance& e) {
    const auto in = [](int index, std::size_t count) {
      return index >= 0 && index < static_cast<int>(count);
    };
    switch (e.kind) {
      case EntranceKind::face_of_a:
        return in(e.a, static_cast<std::size_t>(a_.facet_count()));
      case EntranceKind::face_of_b:
        return in(e.b, static_cast<std::size_t>(b_.facet_count()));
      case EntranceKind::edge_edge:
        return in(e.a, a_.edges().size()) && in(e.b, b_.edges().size()) &&
               !is_zero(direction_of(e, a_, b_), ladder_);
    }
    return false;
  }

  void take(const Support& s, DirectionRule rule) {
    report_.normal = unit_vector(s.w, ladder_);
    report_.rule = rule;
    report_.entrance = s.entrance;
    if (keep_direction_) accepted_ = {s.entrance, s.w.copy(), s.a, s.b};
  }

  const ConvexShape& a_;
  const ConvexShape& b_;
  Resolution resolution_;
  PairHeights heights_;
  PredicateLadder ladder_;
  ConvexContact report_;
  bool keep_direction_ = false;  // in taken_, instead of the region of two that are apart
  Support accepted_;
};

// Apart from classify() so that no arithmetic moves across the change of the rounding mode.
[[gnu::noinline]] ConvexContact classify_to_nearest(const ConvexShape& a, const ConvexShape& b,
                                                    const std::optional<Entrance>& history,
                                                    const CrossingDetail& detail) {
  return ConvexContactFinder(a, b).run(history, detail);
}

[[gnu::noinline]] ResolvedContact resolve_to_nearest(const ConvexShape& a, const ConvexShape& b,
                                                     const Resolution& resolution,
                                                     const std::optional<Entrance>& history) {
  return ConvexContactFinder(a, b, resolution).run_resolved(history);
}

[[gnu::noinline]] std::optional<Entrance> find_entrance_to_nearest(const ConvexShape& a, const ConvexShape& b,
                                                                   const std::optional<Entrance>& history) {
  NumericRange range = a.range();
  range.include(b.range());
  PredicateLadder ladder;
  ladder.open(range);
  const std::vector<Support> farthest = find_farthest_separation(a, b, ladder);
  if (farthest.empty()) return std::nullopt;
  if (std::any_of(farthest.begin(), farthest.end(),
                  [&](const Support& support) { return support.entrance == history; }))
    return history;
  return preferred_support(farthest, a, b, ladder).entrance;
}

}  // namespace

ConvexContact classify(const ConvexShape& a, const ConvexShape& b, const std::optional<Entrance>& history,
                       const CrossingDetail& detail) {
  const NearestRounding nearest;
  return classify_to_nearest(a, b, history, detail);
}

ResolvedContact classify_at(const ConvexShape& a, const ConvexShape& b, const Resolution& resolution,
                            const std::optional<Entrance>& history) {
  const auto valid = [](double value) { return std::isfinite(value) && value >= 0.0; };
  if (!valid(resolution.distance) || !valid(resolution.sine) || resolution.sine > 1.0)
    throw std::invalid_argument("classify_at: resolution is negative, not finite or above a right angle");
  const NearestRounding nearest;
  return resolve_to_nearest(a, b, resolution, history);
}

std::optional<Entrance> find_entrance(const ConvexShape& a, const ConvexShape& b,
                                      const std::optional<Entrance>& history) {
  const NearestRounding nearest;
  return find_entrance_to_nearest(a, b, history);
}

}  // namespace ashlar
