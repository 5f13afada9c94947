#include "geometry/any_solid/touching_features.hpp"

#include <array>
#include <optional>
#include <vector>

namespace ashlar {

namespace {

Rational determinant(const RationalVector& x, const RationalVector& y, const RationalVector& z) {
  return dot_product(x, cross_product(y, z));
}

RationalVector between(const SolidFeatures& solid, int from, int to) {
  return difference(to_rational(solid.point(to)), to_rational(solid.point(from)));
}

ContactDirection normal_of(const SolidFeatures& solid, int face) {
  const auto& [i, j, k] = solid.triangle_of_face(face);
  return ContactDirection::cross({&solid.point(j), &solid.point(i)}, {&solid.point(k), &solid.point(i)});
}

RationalVector exact_normal_of(const SolidFeatures& solid, int face) {
  const auto& [i, j, k] = solid.triangle_of_face(face);
  return cross_product(between(solid, i, j), between(solid, i, k));
}

// Directions across an axis by their angle from a first one, counter-clockwise when the axis points at the
// viewer.
class AngleOrder {
 public:
  AngleOrder(const RationalVector& axis, const RationalVector& first) : axis_(axis), first_(first) {}

  /// Sign of angle(x) - angle(y), angles from 0 to below a full turn.
  [[nodiscard]] int compare(const RationalVector& x, const RationalVector& y) const {
    const int half_x = half(x), half_y = half(y);
    return half_x != half_y ? half_x - half_y : -sgn(determinant(axis_, x, y));
  }

 private:
  [[nodiscard]] int half(const RationalVector& x) const {
    const int sine = sgn(determinant(axis_, first_, x));
    if (sine != 0) return sine > 0 ? 0 : 1;
    const int cosine = sgn(dot_product(cross_product(axis_, first_), cross_product(axis_, x)));
    return cosine > 0 ? 0 : 1;
  }

  RationalVector axis_, first_;
};

// The directions of a solid around an edge, from begin counter-clockwise to end.
struct Wedge {
  RationalVector axis, begin, end;
};

// Seen from outside with the edge upwards the left face is at the left: rotation from it counter-clockwise leads out
// of the solid.
Wedge wedge_at(const SolidFeatures& solid, int e) {
  const SolidEdge& edge = solid.edges()[e];
  return {between(solid, edge.from, edge.to), between(solid, edge.from, edge.right_apex),
          between(solid, edge.from, edge.left_apex)};
}

bool wedges_meet(const Wedge& a, Wedge b) {
  if (sgn(dot_product(a.axis, b.axis)) < 0) std::swap(b.begin, b.end);
  const AngleOrder order(a.axis, a.begin);
  // Apart: a.begin, a.end, b.begin, b.end follow each other, and b may end where a begins.
  const bool begins_after = order.compare(a.end, b.begin) <= 0;
  const bool ends_before = order.compare(b.end, a.begin) == 0 || order.compare(b.begin, b.end) < 0;
  return !(begins_after && ends_before);
}

bool is_inside_wedge(const Wedge& wedge, const RationalVector& ray) {
  if (is_zero(cross_product(wedge.axis, ray))) return false;
  const AngleOrder order(wedge.axis, wedge.begin);
  return order.compare(ray, wedge.begin) > 0 && order.compare(ray, wedge.end) < 0;
}

// The cone of a solid at a corner, by the sectors of its triangles, counter-clockwise from outside.
using Fan = std::vector<std::array<RationalVector, 2>>;

Fan fan_at(const SolidFeatures& solid, int corner) {
  Fan fan;
  for (const int t : solid.triangles_at(corner)) {
    const auto& points = solid.solid().mesh().triangles[t];
    for (int k = 0; k < 3; ++k)
      if (points[k] == corner)
        fan.push_back(
            {between(solid, corner, points[(k + 1) % 3]), between(solid, corner, points[(k + 2) % 3])});
  }
  return fan;
}

bool is_in_sector(const std::array<RationalVector, 2>& sector, const RationalVector& ray) {
  const RationalVector normal = cross_product(sector[0], sector[1]);
  return sgn(dot_product(normal, ray)) == 0 && sgn(determinant(normal, sector[0], ray)) >= 0 &&
         sgn(determinant(normal, ray, sector[1])) >= 0;
}

bool are_opposite(const RationalVector& x, const RationalVector& y) {
  return sgn(dot_product(x, y)) < 0 && is_zero(cross_product(x, y));
}

// True if the arcs p q and r s on the sphere cross in inner points. Neither r nor s is on p q. If the plane of p q
// contains r or s, or p or q is opposite to r, the arc r s meets that plane outside p q. Empty if p or q is in the
// plane of r s, which other places of s avoid.
std::optional<bool> arcs_cross(const RationalVector& p, const RationalVector& q, const RationalVector& r,
                               const RationalVector& s) {
  const int r_side = -sgn(determinant(p, q, r)), s_side = sgn(determinant(p, q, s));
  if (r_side == 0 || s_side == 0 || are_opposite(p, r) || are_opposite(q, r)) return false;
  const int q_side = -sgn(determinant(r, s, q)), p_side = sgn(determinant(r, s, p));
  if (q_side == 0 || p_side == 0) return std::nullopt;
  return r_side == s_side && r_side == q_side && r_side == p_side;
}

// Follows the arc from a ray to one inside a sector of the fan: it arrives there from outside or from inside, and
// each sector in between changes sides.
std::optional<bool> is_inside_towards(const Fan& fan, std::size_t goal, const RationalVector& target,
                                      const RationalVector& ray) {
  const int arrival = sgn(determinant(fan[goal][0], fan[goal][1], ray));
  if (arrival == 0) return std::nullopt;
  bool inside = arrival < 0;
  for (std::size_t k = 0; k < fan.size(); ++k) {
    if (k == goal) continue;
    const auto cross = arcs_cross(fan[k][0], fan[k][1], ray, target);
    if (!cross) return std::nullopt;
    if (*cross) inside = !inside;
  }
  return inside;
}

// False for a ray of the boundary.
bool is_inside_cone(const Fan& fan, const RationalVector& ray) {
  for (const auto& sector : fan)
    if (is_in_sector(sector, ray)) return false;
  // Targets move along the sectors, away from the finitely many planes through the ray and a side of the fan.
  for (long m = 1;; ++m)
    for (std::size_t goal = 0; goal < fan.size(); ++goal) {
      const RationalVector target = sum(multiple(fan[goal][0], Rational(m)), fan[goal][1]);
      if (const auto inside = is_inside_towards(fan, goal, target, ray)) return *inside;
    }
}

bool corners_meet(const SolidFeatures& a, int v, const SolidFeatures& b, int u) {
  const Fan of_a = fan_at(a, v), of_b = fan_at(b, u);
  return is_inside_cone(of_b, of_a[0][0]) || is_inside_cone(of_a, of_b[0][0]);
}

bool corner_meets_edge(const SolidFeatures& of_corner, int v, const SolidFeatures& of_edge, int e) {
  const Fan fan = fan_at(of_corner, v);
  const Wedge wedge = wedge_at(of_edge, e);
  return is_inside_wedge(wedge, fan[0][0]) || is_inside_cone(fan, wedge.axis);
}

bool faces_meet(const SolidFeatures& a, int f, const SolidFeatures& b, int g, PredicateLadder& ladder) {
  ContactDirection opposite = normal_of(a, f);
  opposite.reverse();
  return !same_direction(opposite, normal_of(b, g), ladder);
}

// The rest of the solid must be on the outer side of the face.
bool edge_meets_face(const SolidFeatures& of_edge, int e, const SolidFeatures& of_face, int f,
                     PredicateLadder& ladder) {
  const SolidEdge& edge = of_edge.edges()[e];
  const ContactDirection normal = normal_of(of_face, f);
  return sign_along(normal, of_edge.point(edge.to), of_edge.point(edge.from), ladder) != 0 ||
         !of_edge.admits(edge, normal, 1, ladder);
}

bool corner_meets_face(const SolidFeatures& of_corner, int v, const SolidFeatures& of_face, int f,
                       PredicateLadder& ladder) {
  return !of_corner.rays_admit(v, normal_of(of_face, f), 1, ladder) ||
         !of_corner.lies_on_side_of(v, exact_normal_of(of_face, f));
}

// Edges that cross have convex wedges on different sides of their common plane: a wedge of more than 180 degrees
// leaves no space for a line across it.
bool edges_meet(const SolidFeatures& a, int e, const SolidFeatures& b, int g, PredicateLadder& ladder) {
  const SolidEdge &of_a = a.edges()[e], &of_b = b.edges()[g];
  const ContactDirection w = ContactDirection::cross({&a.point(of_a.to), &a.point(of_a.from)},
                                                     {&b.point(of_b.to), &b.point(of_b.from)});
  if (is_zero(w, ladder)) return wedges_meet(wedge_at(a, e), wedge_at(b, g));
  for (const int side : {1, -1})
    if (a.admits(of_a, w, side, ladder) && b.admits(of_b, w, -side, ladder)) return false;
  return true;
}

}  // namespace

bool cross_at(const SolidFeatures& a, const ContactFeature& f, const SolidFeatures& b,
              const ContactFeature& g, PredicateLadder& ladder) {
  if (f.dimension > g.dimension) return cross_at(b, g, a, f, ladder);
  if (f.dimension == 2) return faces_meet(a, f.index, b, g.index, ladder);
  if (g.dimension == 2)
    return f.dimension == 1 ? edge_meets_face(a, f.index, b, g.index, ladder)
                            : corner_meets_face(a, f.index, b, g.index, ladder);
  if (f.dimension == 1) return edges_meet(a, f.index, b, g.index, ladder);
  return g.dimension == 1 ? corner_meets_edge(a, f.index, b, g.index) : corners_meet(a, f.index, b, g.index);
}

}  // namespace ashlar
