#include "oracle/exact_separation.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace ashlar::oracle {
namespace {

/// True if direction = divisor (p - q) proves p and q to be a closest pair: p lowest and q highest along it.
bool is_closest(const ConvexBody& p, const ConvexBody& q, const IntegerVector& direction,
                const mpz_class& lowest_p, const mpz_class& highest_q) {
  if (is_zero(direction)) return false;
  return std::all_of(p.vertices.begin(), p.vertices.end(),
                     [&](const IntegerVector& v) { return dot(direction, v) >= lowest_p; }) &&
         std::all_of(q.vertices.begin(), q.vertices.end(),
                     [&](const IntegerVector& v) { return dot(direction, v) <= highest_q; });
}

std::optional<Separation> vertex_vertex(const ConvexBody& p, const ConvexBody& q) {
  for (const IntegerVector& a : p.vertices) {
    for (const IntegerVector& b : q.vertices) {
      const IntegerVector w = subtract(a, b);
      if (is_closest(p, q, w, dot(w, a), dot(w, b))) return Separation{w, 1};
    }
  }
  return std::nullopt;
}

/// Vertices of p against the insides of edges of q.
std::optional<Separation> vertex_edge(const ConvexBody& p, const ConvexBody& q) {
  for (const auto& edge : q.edges) {
    const IntegerVector& start = q.vertices[static_cast<std::size_t>(edge[0])];
    const IntegerVector u = subtract(q.vertices[static_cast<std::size_t>(edge[1])], start);
    const mpz_class length = dot(u, u);
    for (const IntegerVector& v : p.vertices) {
      const IntegerVector offset = subtract(v, start);
      const mpz_class along = dot(offset, u);
      if (sgn(along) <= 0 || along >= length) continue;
      const IntegerVector w = subtract(scale_add(length, offset, {}), scale_add(along, u, {}));
      if (is_closest(p, q, w, dot(w, v), dot(w, start))) return Separation{w, length};
    }
  }
  return std::nullopt;
}

/// Vertices of p against the insides of facets of q.
std::optional<Separation> vertex_facet(const ConvexBody& p, const ConvexBody& q) {
  const auto& facets = q.dimension == 3 ? q.planes : q.carrier_planes;
  for (const Plane& facet : facets) {
    const mpz_class square = dot(facet.normal, facet.normal);
    for (const IntegerVector& v : p.vertices) {
      const mpz_class height = dot(facet.normal, v) - facet.offset;
      if (sgn(height) == 0 || (q.dimension == 3 && sgn(height) < 0)) continue;
      const IntegerVector direction = sgn(height) > 0 ? facet.normal : negated(facet.normal);
      const mpz_class level = sgn(height) > 0 ? facet.offset : mpz_class(-facet.offset);
      if (!is_closest(p, q, direction, dot(direction, v), level)) continue;
      const IntegerVector foot = scale_add(-height, facet.normal, scale_add(square, v, {}));
      const bool inside = std::all_of(q.planes.begin(), q.planes.end(), [&](const Plane& plane) {
        return dot(plane.normal, foot) <= square * plane.offset;
      });
      if (inside) return Separation{scale_add(height, facet.normal, {}), square};
    }
  }
  return std::nullopt;
}

std::optional<Separation> edge_edge(const ConvexBody& p, const ConvexBody& q) {
  for (const auto& first : p.edges) {
    const IntegerVector& a = p.vertices[static_cast<std::size_t>(first[0])];
    const IntegerVector u = subtract(p.vertices[static_cast<std::size_t>(first[1])], a);
    for (const auto& second : q.edges) {
      const IntegerVector& b = q.vertices[static_cast<std::size_t>(second[0])];
      const IntegerVector v = subtract(q.vertices[static_cast<std::size_t>(second[1])], b);
      IntegerVector n = cross(u, v);
      if (is_zero(n)) continue;
      const mpz_class square = dot(n, n);
      const IntegerVector offset = subtract(b, a);
      const mpz_class on_first = dot(cross(offset, v), n);
      const mpz_class on_second = dot(cross(offset, u), n);
      if (sgn(on_first) < 0 || on_first > square || sgn(on_second) < 0 || on_second > square) continue;
      const mpz_class height = -dot(n, offset);
      const IntegerVector w = scale_add(height, n, {});
      if (is_closest(p, q, w, dot(w, a), dot(w, b))) return Separation{w, square};
    }
  }
  return std::nullopt;
}

}  // namespace

Separation separation(const ConvexBody& p, const ConvexBody& q) {
  const auto reversed = [](std::optional<Separation> found) {
    if (found) found->direction = negated(found->direction);
    return found;
  };
  auto found = vertex_vertex(p, q);
  if (!found) found = vertex_edge(p, q);
  if (!found) found = reversed(vertex_edge(q, p));
  if (!found) found = vertex_facet(p, q);
  if (!found) found = reversed(vertex_facet(q, p));
  if (!found) found = edge_edge(p, q);
  if (!found) throw std::logic_error("bodies apart without a closest pair of features");
  const mpz_class divisor =
      gcd(gcd(gcd(found->direction[0], found->direction[1]), found->direction[2]), found->divisor);
  for (mpz_class& component : found->direction) component /= divisor;
  found->divisor /= divisor;
  return *found;
}

}  // namespace ashlar::oracle
