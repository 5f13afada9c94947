#include "oracle/contact_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <tuple>

namespace ashlar::oracle {
namespace {

Point to_point(const Vector3& x) {
  return {x[0], x[1], x[2]};
}

Point rounded(const RationalVector& x) {
  return {round_to_double(x[0]), round_to_double(x[1]), round_to_double(x[2])};
}

mpq_class rational_dot(const RationalVector& a, const RationalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point rounded_unit(const RationalVector& x) {
  const mpq_class squared = rational_dot(x, x);
  return {round_quotient_by_root(x[0], squared), round_quotient_by_root(x[1], squared),
          round_quotient_by_root(x[2], squared)};
}

/// Place on A and on B and the two carrier dimensions of a region's vertex.
using PlacedPoint = std::tuple<Point, Point, int, int>;
using PlacedPoints = std::vector<PlacedPoint>;

PlacedPoints sorted(PlacedPoints points) {
  std::sort(points.begin(), points.end());
  return points;
}

PlacedPoints points_of(const ContactRegion& region) {
  PlacedPoints points;
  for (const RegionVertex& point : region.points) {
    points.emplace_back(to_point(point.on_a), to_point(point.on_b), point.a.dimension, point.b.dimension);
  }
  return points;
}

PlacedPoints points_of(const ExactContact& contact) {
  PlacedPoints points;
  for (const RegionPoint& point : contact.region) {
    points.emplace_back(rounded(point.on_p), rounded(point.on_q), point.p_dimension, point.q_dimension);
  }
  return points;
}

/// Corners of a carrier as indices into the points of the shape it was made from.
std::vector<int> corners_of(const ContactFeature& feature, const ConvexShape& convex, const Shape& shape) {
  std::vector<int> corners;
  const auto add = [&](int corner) {
    const int source = convex.source_points()[static_cast<std::size_t>(corner)];
    corners.push_back(convex.flat() ? shape.triangles[0][static_cast<std::size_t>(source)] : source);
  };
  switch (feature.dimension) {
    case 0:
      add(feature.index);
      break;
    case 1:
      for (const int corner : convex.edges()[static_cast<std::size_t>(feature.index)].corners) add(corner);
      break;
    case 2:
      for (const int corner : convex.facet(feature.index)) add(corner);
      break;
    default:
      for (int i = 0; i < static_cast<int>(convex.corners().size()); ++i) add(i);
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

RationalVector turn_of(const RationalVector& a, const RationalVector& b, const RationalVector& c) {
  const RationalVector u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const RationalVector v{c[0] - b[0], c[1] - b[1], c[2] - b[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// The vertices of a polygon must be in order around it: all turns in one direction, one full turn.
bool is_cycle(const ContactRegion& region, const ExactContact& exact, const Vector3& towards_a) {
  std::vector<RationalVector> polygon;
  for (const RegionVertex& point : region.points) {
    for (const RegionPoint& candidate : exact.region) {
      if (rounded(candidate.on_p) == to_point(point.on_a) &&
          rounded(candidate.on_q) == to_point(point.on_b)) {
        polygon.push_back(candidate.on_p);
        break;
      }
    }
  }
  const std::size_t n = polygon.size();
  const RationalVector direction{mpq_class(towards_a[0]), mpq_class(towards_a[1]), mpq_class(towards_a[2])};
  // All corners left of every side: convex, counter-clockwise, each corner once.
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i || j == (i + 1) % n) continue;
      const RationalVector turn = turn_of(polygon[i], polygon[(i + 1) % n], polygon[j]);
      if (rational_dot(turn, direction) <= 0) return false;
    }
  }
  return true;
}

class Report {
 public:
  template <class Expected, class Found>
  void expect(const std::string& field, const Expected& expected, const Found& found) {
    if (expected == found) return;
    std::ostringstream text;
    text.precision(17);
    text << field << ": expected ";
    print(text, expected);
    text << ", found ";
    print(text, found);
    differences_.push_back(text.str());
  }
  [[nodiscard]] Differences take() { return std::move(differences_); }

 private:
  template <class T>
  static void print(std::ostream& text, const T& value) {
    if constexpr (requires { text << value; }) {
      text << value;
    } else if constexpr (requires { value.begin(); }) {
      text << "[";
      for (const auto& item : value) {
        print(text, item);
        text << " ";
      }
      text << "]";
    } else {
      std::apply([&](const auto&... items) { ((print(text, items), text << " "), ...); }, value);
    }
  }

  Differences differences_;
};

Point negated(const Point& x) {
  return {-x[0], -x[1], -x[2]};
}

struct Pair {
  const Shape& p;
  const Shape& q;
  ConvexShape a;
  ConvexShape b;
};

void compare_region(const std::string& name, const Pair& pair, const ExactContact& exact,
                    const ContactRegion& region, Report& report) {
  report.expect(name + "type", type_name(exact), std::string(to_string(region.type)));
  report.expect(name + "a_dimension", exact.p_dimension, region.a_dimension);
  report.expect(name + "b_dimension", exact.q_dimension, region.b_dimension);
  report.expect(name + "dimension", exact.region_dimension, region.dimension);
  report.expect(name + "a.dimension", exact.p_dimension, region.a.dimension);
  report.expect(name + "b.dimension", exact.q_dimension, region.b.dimension);
  if (exact.p_dimension == region.a.dimension) {
    report.expect(name + "carrier on A", exact.p_carrier, corners_of(region.a, pair.a, pair.p));
  }
  if (exact.q_dimension == region.b.dimension) {
    report.expect(name + "carrier on B", exact.q_carrier, corners_of(region.b, pair.b, pair.q));
  }
  report.expect(name + "points", sorted(points_of(exact)), sorted(points_of(region)));
}

void compare_order(const std::string& name, const ExactContact& exact, const ContactRegion& region,
                   const Vector3& towards_a, Report& report) {
  const PlacedPoints points = sorted(points_of(region));
  if (region.dimension != 2 || points != sorted(points_of(exact))) return;
  // Vertices that round to the same doubles cannot be distinguished.
  const auto same_place = [](const PlacedPoint& x, const PlacedPoint& y) {
    return std::get<0>(x) == std::get<0>(y) && std::get<1>(x) == std::get<1>(y);
  };
  if (std::adjacent_find(points.begin(), points.end(), same_place) != points.end()) return;
  report.expect(name + "polygon in order", true, is_cycle(region, exact, towards_a));
}

void compare_normal(const Pair& pair, const ExactAnswer& exact, const ConvexContact& found, Report& report) {
  const Point normal = to_point(found.normal);
  if (!exact.contact.intersecting) {
    report.expect("normal", rounded_unit(exact.contact.w), normal);
    return;
  }
  std::set<Point> allowed;
  if (exact.contact.crossing) {
    for (const ExactContact& minimal : exact.minimal_translations)
      allowed.insert(rounded_unit(minimal.translation));
    if (allowed.empty()) allowed.insert(Point{0, 0, 0});
  } else {
    for (const RationalVector& n : separating_normals(pair.p, pair.q)) allowed.insert(rounded_unit(n));
  }
  if (!allowed.contains(normal)) report.expect("normal", allowed, std::set<Point>{normal});
}

/// The points of a region as they are in the variant.
PlacedPoints carried(const ContactRegion& region, const Variant& variant, bool places) {
  PlacedPoints points;
  for (auto [on_a, on_b, a_dimension, b_dimension] : points_of(region)) {
    if (variant.swapped) std::swap(on_a, on_b);
    if (variant.swapped) std::swap(a_dimension, b_dimension);
    const Similarity& similarity = variant.similarity;
    points.emplace_back(places ? similarity(on_a) : Point{}, places ? similarity(on_b) : Point{}, a_dimension,
                        b_dimension);
  }
  return sorted(std::move(points));
}

PlacedPoints without_places(const ContactRegion& region) {
  PlacedPoints points;
  for (const RegionVertex& point : region.points) {
    points.emplace_back(Point{}, Point{}, point.a.dimension, point.b.dimension);
  }
  return sorted(std::move(points));
}

/// A translation of A as one of the variant's A: of B it is the opposite. Length scaled as given.
Point carried_vector(const Vector3& x, const Variant& variant, int scale) {
  Similarity similarity = variant.similarity;
  similarity.scale = scale;
  const Point turned = similarity.turn(to_point(x));
  return variant.swapped ? negated(turned) : turned;
}

void compare_variant_regions(const std::string& name, const ContactRegion& original,
                             const ContactRegion& of_variant, const Variant& variant, Report& report) {
  const bool swapped = variant.swapped;
  report.expect(name + "type", to_string(original.type), to_string(of_variant.type));
  report.expect(name + "a_dimension", swapped ? original.b_dimension : original.a_dimension,
                of_variant.a_dimension);
  report.expect(name + "b_dimension", swapped ? original.a_dimension : original.b_dimension,
                of_variant.b_dimension);
  report.expect(name + "dimension", original.dimension, of_variant.dimension);
  const bool places = variant.similarity.offset == Point{};
  report.expect(name + "points", carried(original, variant, places),
                places ? sorted(points_of(of_variant)) : without_places(of_variant));
}

}  // namespace

ConvexShape to_convex_shape(const Shape& shape) {
  TriangleMesh mesh;
  for (const Point& point : shape.points) mesh.points.emplace_back(point[0], point[1], point[2]);
  mesh.triangles = shape.triangles;
  if (mesh.triangles.size() > 1) return ConvexShape::from_mesh(mesh);
  const auto corner = [&](std::size_t i) {
    return mesh.points[static_cast<std::size_t>(mesh.triangles[0][i])];
  };
  return ConvexShape::from_triangle(corner(0), corner(1), corner(2));
}

Differences compare_with_oracle(const Shape& p, const Shape& q) {
  const ExactAnswer exact = classify_exactly(p, q);
  const Pair pair{p, q, to_convex_shape(p), to_convex_shape(q)};
  const ConvexContact found = classify(pair.a, pair.b);
  Report report;
  const std::string relation = exact.contact.crossing       ? "crossing"
                               : exact.contact.intersecting ? "touching"
                                                            : "apart";
  report.expect("relation", relation, std::string(to_string(found.relation)));
  compare_region("", pair, exact.contact, found.region, report);
  compare_order("", exact.contact, found.region, found.normal, report);
  report.expect("squared_distance", round_to_double(exact.contact.squared_distance), found.squared_distance);
  report.expect("displacement", rounded(exact.contact.w), to_point(found.displacement));
  report.expect("squared_depth", round_to_double(exact.squared_depth), found.squared_depth);
  compare_normal(pair, exact, found, report);

  report.expect("number of minimal translations", exact.minimal_translations.size(),
                found.minimal_translations.size());
  for (const ExactContact& minimal : exact.minimal_translations) {
    const Point translation = rounded(minimal.translation);
    const auto match = std::find_if(
        found.minimal_translations.begin(), found.minimal_translations.end(),
        [&](const MinimalTranslation& candidate) { return to_point(candidate.translation) == translation; });
    report.expect("minimal translation found", true, match != found.minimal_translations.end());
    if (match == found.minimal_translations.end()) continue;
    compare_region("after translation: ", pair, minimal, match->region, report);
    compare_order("after translation: ", minimal, match->region, match->translation, report);
  }
  return report.take();
}

Differences compare_with_variant(const ConvexContact& original, const ConvexContact& of_variant,
                                 const Variant& variant, bool triangles) {
  Report report;
  const int scale = variant.similarity.scale;
  report.expect("relation", to_string(original.relation), to_string(of_variant.relation));
  compare_variant_regions("", original.region, of_variant.region, variant, report);
  report.expect("squared_distance", std::ldexp(original.squared_distance, 2 * scale),
                of_variant.squared_distance);
  report.expect("squared_depth", std::ldexp(original.squared_depth, 2 * scale), of_variant.squared_depth);
  report.expect("displacement", carried_vector(original.displacement, variant, scale),
                to_point(of_variant.displacement));
  report.expect("rule", static_cast<int>(original.rule), static_cast<int>(of_variant.rule));
  // Coplanar triangles have no side, so their order of corners chooses the sign of the normal.
  const bool free_sign = triangles && original.relation == Relation::touching;
  if (original.rule != DirectionRule::least_penetration_tie && !free_sign) {
    report.expect("normal", carried_vector(original.normal, variant, 0), to_point(of_variant.normal));
  }

  report.expect("number of minimal translations", original.minimal_translations.size(),
                of_variant.minimal_translations.size());
  for (const MinimalTranslation& minimal : original.minimal_translations) {
    const Point translation = carried_vector(minimal.translation, variant, scale);
    const auto match = std::find_if(
        of_variant.minimal_translations.begin(), of_variant.minimal_translations.end(),
        [&](const MinimalTranslation& candidate) { return to_point(candidate.translation) == translation; });
    report.expect("minimal translation found", true, match != of_variant.minimal_translations.end());
    if (match == of_variant.minimal_translations.end()) continue;
    // Another body moves in a swapped pair, so the places differ by the translation, rounded.
    if (!variant.swapped)
      compare_variant_regions("after translation: ", minimal.region, match->region, variant, report);
  }
  return report.take();
}

std::string to_json(const Shape& p, const Shape& q) {
  std::ostringstream text;
  text << std::hexfloat << "{";
  for (const Shape* shape : {&p, &q}) {
    text << (shape == &p ? "\"A\": {\"v\": [" : ", \"B\": {\"v\": [");
    for (std::size_t i = 0; i < shape->points.size(); ++i) {
      const Point& x = shape->points[i];
      text << (i == 0 ? "" : ", ") << "[\"" << x[0] << "\", \"" << x[1] << "\", \"" << x[2] << "\"]";
    }
    text << "], \"f\": [";
    for (std::size_t i = 0; i < shape->triangles.size(); ++i) {
      const auto& t = shape->triangles[i];
      text << (i == 0 ? "" : ", ") << "[" << t[0] << ", " << t[1] << ", " << t[2] << "]";
    }
    text << "]}";
  }
  text << "}";
  return text.str();
}

}  // namespace ashlar::oracle
