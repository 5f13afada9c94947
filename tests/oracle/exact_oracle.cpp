#include "oracle/exact_oracle.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "oracle/exact_separation.hpp"

namespace ashlar::oracle {
namespace {

using Mask = std::vector<char>;

Mask both(const Mask& a, const Mask& b) {
  Mask result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] != 0 && b[i] != 0 ? 1 : 0;
  return result;
}

/// On k different bounding planes of a convex body a point is on a face of dimension max(0, dimension - k).
int carrier_dimension(const ConvexBody& body, const Mask& on_planes) {
  const auto count = std::count(on_planes.begin(), on_planes.end(), char{1});
  return std::max(0, body.dimension - static_cast<int>(count));
}

/// A vertex of P n Q with the bounding planes of both bodies that it lies on.
struct CommonPoint {
  RationalVector position;
  Mask p_planes;
  Mask q_planes;
};

/// Signed values normal . x - offset of every vertex of one body in every plane of the other.
struct PlaneValues {
  std::vector<std::vector<mpz_class>> bounding;  ///< (#vertices, #planes)
  std::vector<std::vector<mpz_class>> carrier;   ///< (#vertices, #carrier planes)
};

PlaneValues values_in(const ConvexBody& body, const std::vector<IntegerVector>& points) {
  PlaneValues values;
  for (const IntegerVector& point : points) {
    auto& bounding = values.bounding.emplace_back();
    for (const Plane& plane : body.planes) bounding.emplace_back(dot(plane.normal, point) - plane.offset);
    auto& carrier = values.carrier.emplace_back();
    for (const Plane& plane : body.carrier_planes) {
      carrier.emplace_back(dot(plane.normal, point) - plane.offset);
    }
  }
  return values;
}

/// The bounding planes a point lies on, or nothing if the point is outside.
std::optional<Mask> location(const std::vector<mpz_class>& bounding, const std::vector<mpz_class>& carrier) {
  for (const mpz_class& value : carrier) {
    if (sgn(value) != 0) return std::nullopt;
  }
  Mask on(bounding.size(), 0);
  for (std::size_t i = 0; i < bounding.size(); ++i) {
    if (sgn(bounding[i]) > 0) return std::nullopt;
    on[i] = sgn(bounding[i]) == 0 ? 1 : 0;
  }
  return on;
}

std::vector<Mask> own_planes(const ConvexBody& body) {
  const PlaneValues own = values_in(body, body.vertices);
  std::vector<Mask> masks;
  for (std::size_t i = 0; i < own.bounding.size(); ++i) {
    const auto mask = location(own.bounding[i], own.carrier[i]);
    if (!mask) throw std::logic_error("a vertex lies outside its own body");
    masks.push_back(*mask);
  }
  return masks;
}

/// The points of `first` (its vertices, and its edges where they pass through a plane of `second`) that are
/// vertices of the intersection. All of them are: an edge point strictly between the sides of a plane that
/// bounds or carries the face of `second` it lies on shares no direction with that face.
void collect(const ConvexBody& first, const ConvexBody& second, bool swapped,
             std::vector<CommonPoint>& points) {
  const PlaneValues values = values_in(second, first.vertices);
  const std::vector<Mask> own = own_planes(first);
  const auto add = [&](RationalVector position, const Mask& first_mask, const Mask& second_mask) {
    points.push_back(swapped ? CommonPoint{std::move(position), second_mask, first_mask}
                             : CommonPoint{std::move(position), first_mask, second_mask});
  };
  for (std::size_t i = 0; i < first.vertices.size(); ++i) {
    const auto& v = first.vertices[i];
    if (const auto mask = location(values.bounding[i], values.carrier[i])) {
      add({mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])}, own[i], *mask);
    }
  }
  for (const auto& edge : first.edges) {
    const auto a = static_cast<std::size_t>(edge[0]);
    const auto b = static_cast<std::size_t>(edge[1]);
    const auto cut = [&](const mpz_class& at_a, const mpz_class& at_b) {
      if (sgn(at_a) * sgn(at_b) >= 0) return;
      const mpz_class weight_a = abs(at_b);
      const mpz_class weight_b = abs(at_a);
      const auto between = [&](const std::vector<mpz_class>& u, const std::vector<mpz_class>& v) {
        std::vector<mpz_class> mixed;
        mixed.reserve(u.size());
        for (std::size_t k = 0; k < u.size(); ++k) mixed.emplace_back(weight_a * u[k] + weight_b * v[k]);
        return mixed;
      };
      const auto mask = location(between(values.bounding[a], values.bounding[b]),
                                 between(values.carrier[a], values.carrier[b]));
      if (!mask) return;
      RationalVector position;
      for (std::size_t k = 0; k < 3; ++k) {
        position[k] =
            mpq_class(weight_a * first.vertices[a][k] + weight_b * first.vertices[b][k], weight_a + weight_b);
        position[k].canonicalize();
      }
      add(std::move(position), both(own[a], own[b]), *mask);
    };
    for (std::size_t k = 0; k < second.planes.size(); ++k) cut(values.bounding[a][k], values.bounding[b][k]);
    for (std::size_t k = 0; k < second.carrier_planes.size(); ++k) {
      cut(values.carrier[a][k], values.carrier[b][k]);
    }
  }
}

/// All vertices of P n Q, each once, increasing; empty if they are apart.
std::vector<CommonPoint> intersect(const ConvexBody& p, const ConvexBody& q) {
  std::vector<CommonPoint> points;
  collect(p, q, false, points);
  collect(q, p, true, points);
  std::sort(points.begin(), points.end(),
            [](const CommonPoint& a, const CommonPoint& b) { return a.position < b.position; });
  points.erase(
      std::unique(points.begin(), points.end(),
                  [](const CommonPoint& a, const CommonPoint& b) { return a.position == b.position; }),
      points.end());
  return points;
}

RationalVector difference(const RationalVector& a, const RationalVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RationalVector rational_cross(const RationalVector& a, const RationalVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Dimension of the smallest flat through all points.
int affine_dimension(const std::vector<CommonPoint>& points) {
  if (points.size() < 3) return static_cast<int>(points.size()) - 1;
  const RationalVector u = difference(points[1].position, points[0].position);
  RationalVector normal;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const RationalVector v = difference(points[i].position, points[0].position);
    const RationalVector n = rational_cross(u, v);
    const bool flat_so_far = normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
    if (flat_so_far) normal = n;
    if (normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2] != 0) return 3;
  }
  return normal[0] == 0 && normal[1] == 0 && normal[2] == 0 ? 1 : 2;
}

std::vector<int> corners_on(const ConvexBody& body, const Mask& planes) {
  std::vector<int> corners;
  const std::vector<Mask> own = own_planes(body);
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (both(own[i], planes) == planes) corners.push_back(body.source[i]);
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

mpq_class power_of_two(long exponent) {
  const mpz_class power = mpz_class(1) << static_cast<unsigned long>(std::labs(exponent));
  return exponent >= 0 ? mpq_class(power) : mpq_class(mpz_class(1), power);
}

/// Contact of `moved_p` = divisor P + p_shift and `moved_q` = divisor Q + q_shift, which must meet, in
/// the original coordinates (length unit 2^exponent).
ExactContact describe(const ConvexBody& moved_p, const ConvexBody& moved_q,
                      const std::vector<CommonPoint>& points, const mpz_class& divisor,
                      const IntegerVector& p_shift, const IntegerVector& q_shift, long exponent) {
  ExactContact contact;
  Mask p_planes = points.front().p_planes;
  Mask q_planes = points.front().q_planes;
  const mpq_class unit = power_of_two(exponent) / mpq_class(divisor);
  for (const CommonPoint& point : points) {
    p_planes = both(p_planes, point.p_planes);
    q_planes = both(q_planes, point.q_planes);
    RegionPoint& region_point = contact.region.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      region_point.on_p[k] = (point.position[k] - p_shift[k]) * unit;
      region_point.on_q[k] = (point.position[k] - q_shift[k]) * unit;
    }
    region_point.p_dimension = carrier_dimension(moved_p, point.p_planes);
    region_point.q_dimension = carrier_dimension(moved_q, point.q_planes);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    contact.w[k] = mpq_class(q_shift[k]) * unit;
    contact.translation[k] = mpq_class(p_shift[k]) * unit;
  }
  contact.squared_distance =
      contact.w[0] * contact.w[0] + contact.w[1] * contact.w[1] + contact.w[2] * contact.w[2];
  contact.intersecting = is_zero(q_shift);
  contact.region_dimension = affine_dimension(points);
  contact.p_dimension = carrier_dimension(moved_p, p_planes);
  contact.q_dimension = carrier_dimension(moved_q, q_planes);
  contact.p_carrier = corners_on(moved_p, p_planes);
  contact.q_carrier = corners_on(moved_q, q_planes);
  const bool solids = moved_p.dimension == 3 && moved_q.dimension == 3;
  const bool inside = contact.p_dimension == moved_p.dimension && contact.q_dimension == moved_q.dimension;
  contact.crossing = inside && (solids || (contact.intersecting && contact.region_dimension == 1));
  return contact;
}

std::vector<IntegerVector> edge_directions(const ConvexBody& body) {
  std::vector<IntegerVector> directions;
  for (const auto& edge : body.edges) {
    IntegerVector direction = subtract(body.vertices[static_cast<std::size_t>(edge[1])],
                                       body.vertices[static_cast<std::size_t>(edge[0])]);
    make_primitive(direction);
    const IntegerVector opposite = negated(direction);
    directions.push_back(std::max(direction, opposite));
  }
  std::sort(directions.begin(), directions.end());
  directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
  return directions;
}

/// Outward directions of all planes that can bound D = P - Q.
std::vector<IntegerVector> difference_normals(const ConvexBody& p, const ConvexBody& q) {
  std::vector<IntegerVector> normals;
  for (const Plane& plane : p.planes) normals.push_back(plane.normal);
  for (const Plane& plane : q.planes) normals.push_back(negated(plane.normal));
  for (const IntegerVector& u : edge_directions(p)) {
    for (const IntegerVector& v : edge_directions(q)) {
      IntegerVector n = cross(u, v);
      if (is_zero(n)) continue;
      make_primitive(n);
      normals.push_back(negated(n));
      normals.push_back(std::move(n));
    }
  }
  std::sort(normals.begin(), normals.end());
  normals.erase(std::unique(normals.begin(), normals.end()), normals.end());
  return normals;
}

/// Every candidate plane supports D, and the largest ball around 0 in D touches D inside a facet only; so the
/// nearest candidate planes are facets, and moving P back along their normals is minimal.
void add_depth(const ConvexBody& p, const ConvexBody& q, long exponent, ExactAnswer& answer) {
  struct Exit {
    IntegerVector normal;
    mpz_class height;
    mpz_class square;
  };
  std::vector<Exit> nearest;
  for (const IntegerVector& n : difference_normals(p, q)) {
    mpz_class highest_p = dot(n, p.vertices[0]);
    for (const IntegerVector& v : p.vertices) highest_p = std::max(highest_p, dot(n, v));
    mpz_class lowest_q = dot(n, q.vertices[0]);
    for (const IntegerVector& v : q.vertices) lowest_q = std::min(lowest_q, dot(n, v));
    Exit exit{n, highest_p - lowest_q, dot(n, n)};
    if (!nearest.empty()) {
      const mpz_class candidate = exit.height * exit.height * nearest[0].square;
      const mpz_class best = nearest[0].height * nearest[0].height * exit.square;
      if (candidate > best) continue;
      if (candidate < best) nearest.clear();
    }
    nearest.push_back(std::move(exit));
  }
  const mpq_class unit = power_of_two(exponent);
  answer.squared_depth = mpq_class(nearest[0].height * nearest[0].height, nearest[0].square);
  answer.squared_depth.canonicalize();
  answer.squared_depth *= unit * unit;
  const IntegerVector none{};
  for (const Exit& exit : nearest) {
    const IntegerVector shift = scale_add(-exit.height, exit.normal, none);
    const ConvexBody moved_p = placed(p, exit.square, shift);
    const ConvexBody moved_q = placed(q, exit.square, none);
    answer.minimal_translations.push_back(
        describe(moved_p, moved_q, intersect(moved_p, moved_q), exit.square, shift, none, exponent));
  }
  std::sort(answer.minimal_translations.begin(), answer.minimal_translations.end(),
            [](const ExactContact& a, const ExactContact& b) { return a.translation < b.translation; });
}

}  // namespace

ExactAnswer classify_exactly(const Shape& p_shape, const Shape& q_shape) {
  const long exponent = common_exponent(p_shape, q_shape);
  const ConvexBody p = make_body(p_shape, exponent);
  const ConvexBody q = make_body(q_shape, exponent);
  const IntegerVector none{};
  ExactAnswer answer;
  const std::vector<CommonPoint> common = intersect(p, q);
  if (!common.empty()) {
    answer.contact = describe(p, q, common, 1, none, none, exponent);
    if (answer.contact.crossing && p.dimension == 3) add_depth(p, q, exponent, answer);
    return answer;
  }
  const Separation w = separation(p, q);
  const ConvexBody moved_p = placed(p, w.divisor, none);
  const ConvexBody moved_q = placed(q, w.divisor, w.direction);
  answer.contact =
      describe(moved_p, moved_q, intersect(moved_p, moved_q), w.divisor, none, w.direction, exponent);
  return answer;
}

std::string type_name(const ExactContact& contact) {
  if (contact.crossing) return "crossing";
  const std::string letters = "VEF";
  const auto [low, high] = std::minmax(contact.p_dimension, contact.q_dimension);
  return {letters.at(static_cast<std::size_t>(low)), '-', letters.at(static_cast<std::size_t>(high))};
}

std::vector<RationalVector> separating_normals(const Shape& p_shape, const Shape& q_shape) {
  const long exponent = common_exponent(p_shape, q_shape);
  const ConvexBody p = make_body(p_shape, exponent);
  const ConvexBody q = make_body(q_shape, exponent);
  std::vector<IntegerVector> candidates = difference_normals(p, q);
  for (const ConvexBody* body : {&p, &q}) {
    for (const Plane& plane : body->carrier_planes) {
      candidates.push_back(plane.normal);
      candidates.push_back(negated(plane.normal));
    }
  }
  std::vector<RationalVector> separating;
  for (const IntegerVector& outward : candidates) {
    // Outward on P - Q, that is from P towards Q.
    const auto below_all_of_q = [&](const IntegerVector& v) {
      return std::all_of(q.vertices.begin(), q.vertices.end(),
                         [&](const IntegerVector& u) { return dot(outward, v) <= dot(outward, u); });
    };
    if (!std::all_of(p.vertices.begin(), p.vertices.end(), below_all_of_q)) continue;
    separating.push_back({mpq_class(-outward[0]), mpq_class(-outward[1]), mpq_class(-outward[2])});
  }
  return separating;
}

}  // namespace ashlar::oracle
