#include "geometry/contact_region.hpp"

#include <algorithm>

namespace ashlar {

namespace {

ContactFeature feature(const ConvexShape& shape, const PlaneSet& set, const PlaneLocation& location) {
  switch (location.dimension) {
    case 0:
      return {0, set.loop[location.index]};
    case 1:
      return {1, shape.find_edge(set.loop[location.index], set.loop[(location.index + 1) % set.size()])};
    default:
      return {2, shape.find_facet(set.loop)};
  }
}

class RegionBuilder {
 public:
  RegionBuilder(const ContactDirection& w, const PlaneSet& a, const PlaneSet& b, const Difference& height,
                bool touching, PredicateLadder& ladder)
      : w_(w), a_(a), b_(b), height_(height), touching_(touching), ladder_(ladder) {}

  [[nodiscard]] Vector3 on_a(const OverlapVertex& v) const {
    if (v.a.dimension == 0) return a_.point(v.a.index);
    if (v.b.dimension == 0) return moved(b_.point(v.b.index), height_);
    return crossing_point(w_, a_.point(v.a.index), a_.point(v.a.index + 1), b_.point(v.b.index),
                          b_.point(v.b.index + 1), ladder_);
  }
  [[nodiscard]] Vector3 on_b(const OverlapVertex& v) const {
    if (v.b.dimension == 0) return b_.point(v.b.index);
    if (v.a.dimension == 0) return moved(a_.point(v.a.index), {height_.minus, height_.plus});
    return crossing_point(w_, b_.point(v.b.index), b_.point(v.b.index + 1), a_.point(v.a.index),
                          a_.point(v.a.index + 1), ladder_);
  }

 private:
  [[nodiscard]] Vector3 moved(const Vector3& x, const Difference& by) const {
    return touching_ ? x : shifted(&x, w_, by, ladder_);
  }

  const ContactDirection& w_;
  const PlaneSet &a_, &b_;
  Difference height_;
  bool touching_;
  PredicateLadder& ladder_;
};

}  // namespace

ContactRegion region_along(const ContactDirection& w, const ConvexShape& shape_a, const PlaneSet& a,
                           const ConvexShape& shape_b, const PlaneSet& b, const Difference& height,
                           bool touching, PredicateLadder& ladder) {
  const std::vector<OverlapVertex> vertices = overlap(w, a, b, ladder);
  ContactRegion region;
  if (vertices.empty()) return region;
  std::vector<PlaneLocation> in_a, in_b;
  const RegionBuilder builder(w, a, b, height, touching, ladder);
  region.points.reserve(vertices.size());
  for (const OverlapVertex& v : vertices) {
    in_a.push_back(v.a);
    in_b.push_back(v.b);
    const Vector3 on_a = builder.on_a(v);
    region.points.push_back(
        {feature(shape_a, a, v.a), feature(shape_b, b, v.b), on_a, touching ? on_a : builder.on_b(v)});
  }
  region.dimension = static_cast<int>(std::min<std::size_t>(vertices.size(), 3)) - 1;
  region.a = feature(shape_a, a, carrier(a, in_a));
  region.b = feature(shape_b, b, carrier(b, in_b));
  region.a_dimension = region.a.dimension;
  region.b_dimension = region.b.dimension;
  region.type = contact_type(region.a_dimension, region.b_dimension);
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
