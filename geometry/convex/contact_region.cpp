#include "geometry/convex/contact_region.hpp"

#include <algorithm>

namespace ashlar {

namespace {

ContactFeature feature(const ConvexShape& shape, const PlaneSet& set, const PlaneLocation& location) {
  switch (location.dimension) {
    case 0:
      return {0, set.loop[location.index]};
    case 1:
      return {1, shape.find_edge(set.loop[location.index], set.loop[(location.index + 1) % set.size()])};
    default: {
      const int facet = shape.find_facet(set.loop);
      return {2, facet >= 0 && shape.facet(facet).size() == set.loop.size() ? facet : -1};
    }
  }
}

void set_carriers(ContactRegion& region, const ContactFeature& a, const ContactFeature& b) {
  region.a = a;
  region.b = b;
  region.a_dimension = a.dimension;
  region.b_dimension = b.dimension;
  region.type = contact_type(a.dimension, b.dimension);
}

// Coordinates of the vertices of an overlap.
class RegionPoints {
 public:
  RegionPoints(const ContactDirection& w, const PlaneSet& a, const PlaneSet& b, const ContactHeight* height,
               PredicateLadder& ladder)
      : w_(w), a_(a), b_(b), height_(height), ladder_(ladder) {}

  [[nodiscard]] Vector3 on_a(const OverlapVertex& v) const {
    if (v.a.dimension == 0) return a_.point(v.a.index);
    if (v.b.dimension != 0) return crossing(a_, v.a.index, b_, v.b.index);
    const Vector3& below = b_.point(v.b.index);
    return height_ != nullptr ? height_->above(below) : below;
  }
  [[nodiscard]] Vector3 on_b(const OverlapVertex& v) const {
    if (v.b.dimension == 0) return b_.point(v.b.index);
    if (v.a.dimension != 0) return crossing(b_, v.b.index, a_, v.a.index);
    return height_->below(a_.point(v.a.index));
  }

 private:
  [[nodiscard]] Vector3 crossing(const PlaneSet& own, int side, const PlaneSet& other, int other_side) const {
    return crossing_point(w_, own.point(side), own.point(side + 1), other.point(other_side),
                          other.point(other_side + 1), ladder_);
  }

  const ContactDirection& w_;
  const PlaneSet &a_, &b_;
  const ContactHeight* height_;
  PredicateLadder& ladder_;
};

}  // namespace

ContactRegion region_along(const ContactDirection& w, PlaneSetting setting, const ShapePlane& of_a,
                           const ShapePlane& of_b, const ContactHeight* height, PredicateLadder& ladder) {
  const auto& [shape_a, a] = of_a;
  const auto& [shape_b, b] = of_b;
  const std::vector<OverlapVertex> vertices = overlap(w, setting, a, b, ladder);
  ContactRegion region;
  if (vertices.empty()) return region;
  std::vector<PlaneLocation> in_a, in_b;
  const RegionPoints points(w, a, b, height, ladder);
  region.points.reserve(vertices.size());
  for (const OverlapVertex& v : vertices) {
    in_a.push_back(v.a);
    in_b.push_back(v.b);
    const Vector3 on_a = points.on_a(v);
    region.points.push_back({feature(shape_a, a, v.a), feature(shape_b, b, v.b), on_a,
                             height == nullptr ? on_a : points.on_b(v)});
  }
  region.dimension = static_cast<int>(std::min<std::size_t>(vertices.size(), 3)) - 1;
  set_carriers(region, feature(shape_a, a, carrier(a, in_a)), feature(shape_b, b, carrier(b, in_b)));
  return region;
}

ContactRegion point_region(const RegionVertex& point) {
  ContactRegion region;
  region.dimension = 0;
  region.points = {point};
  set_carriers(region, point.a, point.b);
  return region;
}

std::vector<int> support_loop(const ConvexShape& shape, const std::vector<int>& support,
                              const ContactDirection& w, bool above, PredicateLadder& ladder) {
  if (support.size() < 3) return support;
  const std::span<const int> facet = shape.facet(shape.find_facet(support));
  std::vector<int> loop(facet.begin(), facet.end());
  const std::vector<Vector3>& x = shape.corners();
  const bool clockwise = shape.flat() ? sign_turn(w, x[loop[0]], x[loop[1]], x[loop[2]], ladder) < 0 : above;
  if (clockwise) std::reverse(loop.begin(), loop.end());
  return loop;
}

}  // namespace ashlar
