#include "oracle/exact_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace ashlar::oracle {
namespace {

constexpr int kMantissaBits = std::numeric_limits<double>::digits;

mpz_class whole_multiple(double value, long exponent) {
  int binary_exponent = 0;
  const double mantissa = std::frexp(value, &binary_exponent);
  mpz_class whole(std::ldexp(mantissa, kMantissaBits));
  const long shift = binary_exponent - kMantissaBits - exponent;
  if (shift >= 0) return whole << static_cast<unsigned long>(shift);
  const auto down = static_cast<unsigned long>(-shift);
  mpz_class result;
  mpz_divexact(result.get_mpz_t(), whole.get_mpz_t(), mpz_class(mpz_class(1) << down).get_mpz_t());
  return result;
}

long trailing_exponent(double value) {
  int binary_exponent = 0;
  const double mantissa = std::frexp(value, &binary_exponent);
  const mpz_class whole(std::ldexp(mantissa, kMantissaBits));
  return binary_exponent - kMantissaBits + static_cast<long>(mpz_scan1(whole.get_mpz_t(), 0));
}

std::vector<IntegerVector> whole_points(const Shape& shape, long exponent) {
  std::vector<IntegerVector> result;
  for (const Point& point : shape.points) {
    result.push_back({whole_multiple(point[0], exponent), whole_multiple(point[1], exponent),
                      whole_multiple(point[2], exponent)});
  }
  return result;
}

Plane plane_through(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c) {
  Plane plane;
  plane.normal = cross(subtract(b, a), subtract(c, a));
  if (is_zero(plane.normal)) throw std::invalid_argument("a triangle has no area");
  make_primitive(plane.normal);
  plane.offset = dot(plane.normal, a);
  return plane;
}

ConvexBody make_triangle(const std::vector<IntegerVector>& points, const std::array<int, 3>& corners) {
  ConvexBody body;
  body.dimension = 2;
  for (const int corner : corners) {
    body.vertices.push_back(points.at(static_cast<std::size_t>(corner)));
    body.source.push_back(corner);
  }
  const auto& v = body.vertices;
  body.edges = {{0, 1}, {1, 2}, {2, 0}};
  body.carrier_planes = {plane_through(v[0], v[1], v[2])};
  for (const auto& [from, to] : body.edges) {
    const auto& start = v[static_cast<std::size_t>(from)];
    Plane side;
    side.normal = cross(subtract(v[static_cast<std::size_t>(to)], start), body.carrier_planes[0].normal);
    make_primitive(side.normal);
    side.offset = dot(side.normal, start);
    body.planes.push_back(side);
  }
  return body;
}

/// (#planes, #points): which points lie on which plane. @throws if a point is outside of one.
std::vector<std::vector<char>> incidence(const std::vector<Plane>& planes,
                                         const std::vector<IntegerVector>& points) {
  std::vector<std::vector<char>> on(planes.size(), std::vector<char>(points.size(), 0));
  for (std::size_t f = 0; f < planes.size(); ++f) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int side = cmp(dot(planes[f].normal, points[i]), planes[f].offset);
      if (side > 0) throw std::invalid_argument("the solid is not convex or not outward");
      on[f][i] = side == 0 ? 1 : 0;
    }
  }
  return on;
}

ConvexBody make_solid(const std::vector<IntegerVector>& points, const Shape& shape) {
  ConvexBody body;
  body.dimension = 3;
  for (const auto& t : shape.triangles) {
    const auto corner = [&](int i) -> const IntegerVector& {
      return points.at(static_cast<std::size_t>(t[static_cast<std::size_t>(i)]));
    };
    Plane plane = plane_through(corner(0), corner(1), corner(2));
    const bool known = std::any_of(body.planes.begin(), body.planes.end(), [&](const Plane& other) {
      return other.normal == plane.normal && other.offset == plane.offset;
    });
    if (!known) body.planes.push_back(std::move(plane));
  }
  if (body.planes.size() < 4) throw std::invalid_argument("a solid needs four facets");
  const auto on = incidence(body.planes, points);

  // A point on three different supporting planes is a vertex, on two an edge point, on one a facet point.
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto count = std::count_if(on.begin(), on.end(), [&](const auto& row) { return row[i] != 0; });
    const bool repeated = std::any_of(corners.begin(), corners.end(),
                                      [&](std::size_t other) { return points[other] == points[i]; });
    if (count >= 3 && !repeated) corners.push_back(i);
  }
  for (const std::size_t i : corners) {
    body.vertices.push_back(points[i]);
    body.source.push_back(static_cast<int>(i));
  }
  // Two facets of a convex solid share nothing, a vertex, or the two ends of an edge.
  for (std::size_t f = 0; f < on.size(); ++f) {
    for (std::size_t g = f + 1; g < on.size(); ++g) {
      std::vector<int> common;
      for (std::size_t c = 0; c < corners.size(); ++c) {
        if (on[f][corners[c]] != 0 && on[g][corners[c]] != 0) common.push_back(static_cast<int>(c));
      }
      if (common.size() == 2) body.edges.push_back({common[0], common[1]});
    }
  }
  return body;
}

}  // namespace

mpz_class dot(const IntegerVector& a, const IntegerVector& b) {
  mpz_class sum = a[0] * b[0];
  mpz_addmul(sum.get_mpz_t(), a[1].get_mpz_t(), b[1].get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a[2].get_mpz_t(), b[2].get_mpz_t());
  return sum;
}

IntegerVector cross(const IntegerVector& a, const IntegerVector& b) {
  IntegerVector result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result[i] = a[j] * b[k];
    mpz_submul(result[i].get_mpz_t(), a[k].get_mpz_t(), b[j].get_mpz_t());
  }
  return result;
}

IntegerVector subtract(const IntegerVector& a, const IntegerVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

IntegerVector negated(const IntegerVector& a) {
  return {-a[0], -a[1], -a[2]};
}

IntegerVector scale_add(const mpz_class& factor, const IntegerVector& a, const IntegerVector& b) {
  IntegerVector result = b;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_addmul(result[i].get_mpz_t(), factor.get_mpz_t(), a[i].get_mpz_t());
  }
  return result;
}

bool is_zero(const IntegerVector& a) {
  return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0;
}

void make_primitive(IntegerVector& a) {
  const mpz_class divisor = gcd(gcd(a[0], a[1]), a[2]);
  if (sgn(divisor) == 0) return;
  for (mpz_class& component : a) {
    mpz_divexact(component.get_mpz_t(), component.get_mpz_t(), divisor.get_mpz_t());
  }
}

long common_exponent(const Shape& p, const Shape& q) {
  long smallest = std::numeric_limits<long>::max();
  for (const Shape* shape : {&p, &q}) {
    for (const Point& point : shape->points) {
      for (const double value : point) {
        if (!std::isfinite(value)) throw std::invalid_argument("a coordinate is not finite");
        if (value != 0.0) smallest = std::min(smallest, trailing_exponent(value));
      }
    }
  }
  return smallest == std::numeric_limits<long>::max() ? 0 : smallest;
}

ConvexBody make_body(const Shape& shape, long exponent) {
  const std::vector<IntegerVector> points = whole_points(shape, exponent);
  return shape.triangles.size() == 1 ? make_triangle(points, shape.triangles[0]) : make_solid(points, shape);
}

ConvexBody placed(const ConvexBody& body, const mpz_class& factor, const IntegerVector& shift) {
  ConvexBody result = body;
  for (IntegerVector& vertex : result.vertices) vertex = scale_add(factor, vertex, shift);
  for (auto* planes : {&result.planes, &result.carrier_planes}) {
    for (Plane& plane : *planes) plane.offset = factor * plane.offset + dot(plane.normal, shift);
  }
  return result;
}

std::vector<std::vector<int>> facet_cycles(const Shape& solid) {
  const ConvexBody body = make_body(solid, common_exponent(solid, solid));
  std::vector<std::vector<int>> cycles;
  for (const Plane& plane : body.planes) {
    const auto on_plane = [&](int v) {
      return dot(plane.normal, body.vertices[static_cast<std::size_t>(v)]) == plane.offset;
    };
    // Every edge of the facet occurs in both directions; the direction with the facet on its left is kept.
    std::map<int, int> next;
    for (auto [from, to] : body.edges) {
      if (!on_plane(from) || !on_plane(to)) continue;
      const auto& start = body.vertices[static_cast<std::size_t>(from)];
      const auto inward = cross(plane.normal, subtract(body.vertices[static_cast<std::size_t>(to)], start));
      for (int v = 0; v < static_cast<int>(body.vertices.size()); ++v) {
        const int side = sgn(dot(inward, subtract(body.vertices[static_cast<std::size_t>(v)], start)));
        if (!on_plane(v) || side == 0) continue;
        if (side < 0) std::swap(from, to);
        break;
      }
      next[from] = to;
    }
    std::vector<int> cycle;
    int current = next.begin()->first;
    do {
      cycle.push_back(body.source[static_cast<std::size_t>(current)]);
      current = next.at(current);
    } while (current != next.begin()->first && cycle.size() <= next.size());
    cycles.push_back(std::move(cycle));
  }
  return cycles;
}

}  // namespace ashlar::oracle
