#include "geometry/convex_contact.hpp"

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
    ClosestSimplex closest = find_closest_simplex(a_, b_, guess_closest_simplex(a_, b_), ladder_);
    if (!closest.contains_origin) {
      apart({{}, std::move(closest.w), std::move(closest.support_a), std::move(closest.support_b)});
    } else {
      SeparationResult separation = find_separation(a_, b_, ladder_);
      if (separation.separated)
        touching(std::move(separation.supports), history);
      else
        crossing(std::move(separation.supports), history, detail);
    }
    report_.decided_by = ladder_.counts;
    return std::move(report_);
  }

 private:
  [[nodiscard]] Difference height_of(const Support& s) const {
    return {&a_.corners()[s.a[0]], &b_.corners()[s.b[0]]};
  }
  [[nodiscard]] ContactRegion region_of(const Support& s, bool touching) {
    const std::vector<int> loop_a = support_loop(a_, s.a, s.w, true, ladder_);
    const std::vector<int> loop_b = support_loop(b_, s.b, s.w, false, ladder_);
    return region_along(s.w, a_, {a_.corners().data(), loop_a}, b_, {b_.corners().data(), loop_b},
                        height_of(s), touching, ladder_);
  }

  void apart(const Support& s) {
    report_.relation = Relation::apart;
    report_.region = region_of(s, false);
    report_.squared_distance = squared_height(s.w, height_of(s), ladder_);
    report_.displacement = shifted(nullptr, s.w, height_of(s), ladder_);
    report_.normal = unit_vector(s.w, ladder_);
    report_.rule = DirectionRule::closest_points;
  }

  void touching(std::vector<Support> supports, const std::optional<Entrance>& history) {
    report_.relation = Relation::touching;
    report_.region = region_of(supports[0], true);
    const ContactType type = report_.type();
    const bool open = type == ContactType::vertex_vertex || type == ContactType::vertex_edge ||
                      (type == ContactType::edge_edge && report_.region.dimension == 1);
    if (open) return choose(supports, history);
    take(supports[0], DirectionRule::unique);
  }

  void crossing(std::vector<Support> supports, const std::optional<Entrance>& history,
                const CrossingDetail& detail) {
    report_.relation = Relation::crossing;
    if (detail.region) report_.region = crossing_region(a_, b_, ladder_);
    if (supports.empty()) return;
    report_.squared_depth = squared_height(supports[0].w, height_of(supports[0]), ladder_);
    for (const Support& s : supports) {
      const Difference outward{height_of(s).minus, height_of(s).plus};
      report_.minimal_translations.push_back(
          {s.entrance, shifted(nullptr, s.w, outward, ladder_),
           detail.translation_regions ? region_of(s, false) : ContactRegion{}});
    }
    choose(supports, history);
  }

  // The history rule; without history the least penetration (all supports are equally near).
  void choose(const std::vector<Support>& supports, const std::optional<Entrance>& history) {
    if (history) {
      Support s = support_along(a_, b_, direction_of(*history, a_, b_), ladder_);
      s.entrance = *history;
      if (region_of(s, false).dimension >= 0) return take(s, DirectionRule::history);
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
