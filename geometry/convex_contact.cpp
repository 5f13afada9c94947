#include "geometry/convex_contact.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/closest_simplex.hpp"
#include "geometry/rounding_mode.hpp"

namespace ashlar {

namespace {

class ContactReport {
 public:
  ContactReport(const ConvexShape& a, const ConvexShape& b) : a_(a), b_(b) {
    NumericRange range = a.range();
    range.include(b.range());
    ladder_.floating = range.safe();
    report_.displacement = report_.normal = Vector3::Zero();
  }

  ConvexContact run(const std::optional<Entrance>& history, const CrossingDetail& detail) {
    const CornerSimplex guess = guess_closest_simplex(a_, b_);
    // A guess that found the origin inside is worth asking for a separating direction first.
    if (guess.size < 4 || !intersecting(history, detail)) {
      ClosestSimplex closest = find_closest_simplex(a_, b_, guess, ladder_);
      if (!closest.contains_origin)
        apart(std::move(closest));
      else
        intersecting(history, detail);
    }
    report_.decided_by = ladder_.counts;
    return std::move(report_);
  }

 private:
  [[nodiscard]] Difference height_of(const Support& s) const {
    return {&a_.corners()[s.a[0]], &b_.corners()[s.b[0]]};
  }
  [[nodiscard]] ContactRegion region_of(const Support& s, PlaneSetting setting) {
    const std::vector<int> loop_a = support_loop(a_, s.a, s.w, true, ladder_);
    const std::vector<int> loop_b = support_loop(b_, s.b, s.w, false, ladder_);
    const PlaneSet a{a_.corners().data(), loop_a}, b{b_.corners().data(), loop_b};
    if (setting == PlaneSetting::coplanar) return region_along(s.w, setting, a_, a, b_, b, nullptr, ladder_);
    const ContactHeight height(s.w, height_of(s), ladder_);
    return region_along(s.w, setting, a_, a, b_, b, &height, ladder_);
  }

  void apart(ClosestSimplex&& closest) {
    report_.relation = Relation::apart;
    const CornerPair first = closest.simplex.pairs[0];
    const ContactHeight height(closest.w, {&a_.corners()[first.a], &b_.corners()[first.b]}, ladder_);
    report_.squared_distance = height.squared();
    report_.displacement = height.step();
    report_.normal = unit_vector(closest.w, ladder_);
    report_.rule = DirectionRule::closest_points;
    if (const auto point = single_point(closest, height)) {
      report_.region = point_region(*point);
    } else {
      report_.region =
          region_of({{}, std::move(closest.w), std::move(closest.support_a), std::move(closest.support_b)},
                    PlaneSetting::level);
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
    SeparationResult separation = find_separation(a_, b_, ladder_);
    if (separation.relation == Relation::apart) return false;
    if (separation.relation == Relation::touching) return touching(separation.supports, history);
    crossing(separation.supports, history, detail);
    return true;
  }

  // Both have points in a plane that separates them: the common points of those are all they have in common.
  bool touching(const std::vector<Support>& supports, const std::optional<Entrance>& history) {
    report_.region = region_of(supports[0], PlaneSetting::coplanar);
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
    if (detail.region) report_.region = crossing_region(a_, b_, ladder_);
    if (supports.empty()) return;
    report_.squared_depth = ContactHeight(supports[0].w, height_of(supports[0]), ladder_).squared();
    for (const Support& s : supports) {
      const Difference outward{height_of(s).minus, height_of(s).plus};
      report_.minimal_translations.push_back(
          {s.entrance, ContactHeight(s.w, outward, ladder_).step(),
           detail.translation_regions ? region_of(s, PlaneSetting::level) : ContactRegion{}});
    }
    choose(supports, history);
  }

  // The history rule; without history the least penetration (all supports are equally near).
  void choose(const std::vector<Support>& supports, const std::optional<Entrance>& history) {
    if (history) {
      Support s = support_along(a_, b_, direction_of(*history, a_, b_), ladder_);
      s.entrance = *history;
      if (region_of(s, PlaneSetting::level).dimension >= 0) return take(s, DirectionRule::history);
    }
    take(preferred_support(supports, a_, b_, ladder_),
         supports.size() == 1 ? DirectionRule::least_penetration : DirectionRule::least_penetration_tie);
  }

  void take(const Support& s, DirectionRule rule) {
    report_.normal = unit_vector(s.w, ladder_);
    report_.rule = rule;
    report_.entrance = s.entrance;
  }

  const ConvexShape& a_;
  const ConvexShape& b_;
  PredicateLadder ladder_;
  ConvexContact report_;
};

// Apart from classify() so that no arithmetic moves across the change of the rounding mode.
[[gnu::noinline]] ConvexContact classify_to_nearest(const ConvexShape& a, const ConvexShape& b,
                                                    const std::optional<Entrance>& history,
                                                    const CrossingDetail& detail) {
  return ContactReport(a, b).run(history, detail);
}

}  // namespace

ConvexContact classify(const ConvexShape& a, const ConvexShape& b, const std::optional<Entrance>& history,
                       const CrossingDetail& detail) {
  const NearestRounding nearest;
  return classify_to_nearest(a, b, history, detail);
}

}  // namespace ashlar
