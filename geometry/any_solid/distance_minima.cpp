#include "geometry/any_solid/distance_minima.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "geometry/any_solid/near_features.hpp"
#include "geometry/exact/direction_constructions.hpp"

namespace ashlar {

namespace {

using Key = std::array<int, 4>;

Key key_of(const ContactFeature& a, const ContactFeature& b) {
  return {a.dimension, a.index, b.dimension, b.index};
}

// Features of one of the two solids; `sign` is that of w in its normal cone.
struct Body {
  const SolidFeatures& features;
  int sign;
  std::vector<ContactDirection> normals;  // by face

  Body(const SolidFeatures& f, int s) : features(f), sign(s) {
    for (int face = 0; face < static_cast<int>(f.solid().faces().size()); ++face) {
      const auto& [i, j, k] = f.triangle_of_face(face);
      normals.push_back(ContactDirection::cross({&f.point(j), &f.point(i)}, {&f.point(k), &f.point(i)}));
    }
  }
  [[nodiscard]] const Vector3& point(int v) const { return features.point(v); }
  [[nodiscard]] const Vector3& point_of_face(int f) const { return point(features.triangle_of_face(f)[0]); }
  [[nodiscard]] RationalVector exact(int v) const { return to_rational(point(v)); }
  [[nodiscard]] RationalVector exact_normal(int f) const {
    const auto& [i, j, k] = features.triangle_of_face(f);
    const RationalVector o = exact(i);
    return cross_product(difference(exact(j), o), difference(exact(k), o));
  }
  [[nodiscard]] RationalVector exact_edge(const SolidEdge& e) const {
    return difference(exact(e.to), exact(e.from));
  }
  [[nodiscard]] FlatPiece face_piece(int f, bool reversed) const {
    FlatPiece piece{&features.solid().mesh().points, {}, f};
    for (const SolidSide& s : features.sides(f))
      piece.sides.push_back(reversed ? FlatSide{s.to, s.from, s.edge} : FlatSide{s.from, s.to, s.edge});
    return piece;
  }
  [[nodiscard]] FlatPiece edge_piece(int e) const {
    const SolidEdge& edge = features.edges()[e];
    return {&features.solid().mesh().points, {{edge.from, edge.to, e}}, -1};
  }
};

// The part of d along v, and across it.
RationalVector along(const RationalVector& d, const RationalVector& v) {
  return multiple(v, Rational(dot_product(d, v) / dot_product(v, v)));
}
RationalVector across(const RationalVector& d, const RationalVector& v) {
  return difference(d, along(d, v));
}
RationalVector times_sign(const RationalVector& v, int sign) {
  return multiple(v, Rational(sign));
}

// The images of points below 2^400 are below 2^401: no component of the direction is greater than the one
// along which it projects. A product of two differences is below 2^804.
constexpr int highest_bit_of_overlaps = 400;

// Predicates on one pair of features; for pairs of different kinds the order is lower feature, higher feature,
// regardless of their solids.
class MinimumFinder {
 public:
  MinimumFinder(const SolidFeatures& a, const SolidFeatures& b, const MinimumBound& bound)
      : a_(a, 1), b_(b, -1), bound_(bound) {
    NumericRange range;
    for (const SolidFeatures* solid : {&a, &b})
      for (const Vector3& p : solid->solid().mesh().points)
        for (int i = 0; i < 3; ++i) range.include(p[i]);
    floating_ = range.highest_bit <= highest_bit_of_overlaps;
    if (bound.distance) range.include(*bound.distance);
    ladder_.open(range);
  }

  std::vector<DistanceMinimum> find(DecisionCounts& counts) {
    const NearFeatures pairs = near_features(a_.features, b_.features, squared_limit());
    // Higher pairs first: they determine the lower ones in their closure.
    for (int total = 4; total >= 0; --total)
      for (const auto& [f, g] : pairs[total])
        if (!closed_.contains(key_of(f, g))) decide(f, g);
    std::sort(found_.begin(), found_.end(), [](const DistanceMinimum& x, const DistanceMinimum& y) {
      return key_of(x.a, x.b) < key_of(y.a, y.b);
    });
    counts.filter += ladder_.counts.filter;
    counts.exact += ladder_.counts.exact;
    return std::move(found_);
  }

 private:
  // An upper bound of the requested squared distances.
  [[nodiscard]] double squared_limit() const {
    constexpr double up = std::numeric_limits<double>::infinity();
    if (bound_.distance) return std::nextafter(*bound_.distance * *bound_.distance, up);
    return bound_.touching ? 0.0 : std::nextafter(bound_.least_squared, up);
  }

  void decide(const ContactFeature& f, const ContactFeature& g) {
    switch (3 * std::min(f.dimension, g.dimension) + std::max(f.dimension, g.dimension)) {
      case 0:
        return decide_corners(f.index, g.index);
      case 1:
        return f.dimension == 0 ? decide_corner_edge(a_, f.index, b_, g.index)
                                : decide_corner_edge(b_, g.index, a_, f.index);
      case 2:
        return f.dimension == 0 ? decide_corner_face(a_, f.index, b_, g.index)
                                : decide_corner_face(b_, g.index, a_, f.index);
      case 4:
        return decide_edges(f.index, g.index);
      case 5:
        return f.dimension == 1 ? decide_edge_face(a_, f.index, b_, g.index)
                                : decide_edge_face(b_, g.index, a_, f.index);
      default:
        return decide_faces(f.index, g.index);
    }
  }

  // True if the height of d along w is within the bound.
  bool is_near(const ContactDirection& w, const Difference& d) {
    if (bound_.distance) return is_within(w, d, *bound_.distance, false, ladder_);
    if (bound_.touching) return sign_along(w, d, ladder_) == 0;
    return ContactHeight(w, d, ladder_).squared() == bound_.least_squared;
  }
  // For w = 0.
  [[nodiscard]] bool wants_touching() const {
    return bound_.distance || bound_.touching || bound_.least_squared == 0.0;
  }
  // True if w (exact only if needed) is in a corner's normal cone; `sign` turns w to the side of the solid.
  template <class ExactW>
  bool corner_admits(const Body& body, int v, const ContactDirection& w, int sign, ExactW exact_w) {
    const CornerKind kind = body.features.corner_kind(v);
    if (kind == CornerKind::reflex || !body.features.rays_admit(v, w, sign, ladder_)) return false;
    return kind == CornerKind::convex || body.features.lies_on_side_of(v, times_sign(exact_w(), sign));
  }

  void decide_corners(int v, int u) {
    const ContactDirection w = ContactDirection::along({&a_.point(v), &b_.point(u)});
    const auto exact_w = [&] { return difference(a_.exact(v), b_.exact(u)); };
    if (a_.point(v) == b_.point(u)) {
      if (!wants_touching()) return;
    } else if (!corner_admits(a_, v, w, 1, exact_w) || !corner_admits(b_, u, w, -1, exact_w) ||
               !is_near(w, {&a_.point(v), &b_.point(u)})) {
      return;
    }
    const RationalVector exact = exact_w();
    add_point({0, v}, {0, u}, exact, exact, a_.exact(v));
  }

  void decide_corner_edge(const Body& of_corner, int v, const Body& of_edge, int e) {
    const SolidEdge& edge = of_edge.features.edges()[e];
    const Vector3 &p = of_corner.point(v), &from = of_edge.point(edge.from), &to = of_edge.point(edge.to);
    const ContactDirection line = ContactDirection::along({&to, &from});
    if (sign_along(line, p, from, ladder_) <= 0 || sign_along(line, to, p, ladder_) <= 0) return;
    // From the edge to the corner.
    const ContactDirection w = ContactDirection::rejection({&p, &from}, {&to, &from});
    const auto exact_w = [&] {
      return across(difference(to_rational(p), to_rational(from)), of_edge.exact_edge(edge));
    };
    if (is_zero(w, ladder_)) {
      if (!wants_touching()) return;
    } else if (!of_edge.features.admits(edge, w, -1, ladder_) ||
               !corner_admits(of_corner, v, w, 1, exact_w) || !is_near(w, {&p, &from})) {
      return;
    }
    const RationalVector exact = times_sign(exact_w(), of_corner.sign);
    if (of_corner.sign > 0)
      add_point({0, v}, {1, e}, exact, exact, to_rational(p));
    else
      add_point({1, e}, {0, v}, exact, exact, sum(to_rational(p), exact));
  }

  void decide_corner_face(const Body& of_corner, int v, const Body& of_face, int f) {
    const Vector3 &p = of_corner.point(v), &o = of_face.point_of_face(f);
    const ContactDirection& normal = of_face.normals[f];
    const int side = sign_along(normal, p, o, ladder_);
    const auto exact_normal = [&] { return of_face.exact_normal(f); };
    if (side < 0 || (side == 0 && !wants_touching()) ||
        (side > 0 && !corner_admits(of_corner, v, normal, 1, exact_normal)) || !is_near(normal, {&p, &o}) ||
        !is_inside(p, of_face, f))
      return;
    const RationalVector n = times_sign(exact_normal(), of_corner.sign);
    const RationalVector w = times_sign(along(difference(to_rational(p), to_rational(o)), n), of_corner.sign);
    if (of_corner.sign > 0)
      add_point({0, v}, {2, f}, w, n, to_rational(p));
    else
      add_point({2, f}, {0, v}, w, n, sum(to_rational(p), w));
  }

  // True if a point projects along a face's normal to its inner points: by the parity of the sides crossed by a
  // half-line in its plane.
  bool is_inside(const Vector3& p, const Body& of_face, int f) {
    const ContactDirection& normal = of_face.normals[f];
    const Vector3 axis = Vector3::Unit(coordinate_plane(normal, ladder_).dropped == 0 ? 1 : 0);
    const auto above = [&](const Vector3& x) {
      return sign_triple(normal, Difference{&axis}, Difference{&x, &p}, ladder_);
    };
    bool inside = false;
    for (const SolidSide& side : of_face.features.sides(f)) {
      const Vector3 &from = of_face.point(side.from), &to = of_face.point(side.to);
      const int sign_from = above(from), sign_to = above(to);
      if (sign_from * sign_to > 0) continue;
      if (sign_from == 0 && sign_to == 0) {
        if (sign_projected_dot(normal, {&from, &p}, {&to, &p}, ladder_) <= 0) return false;
        continue;
      }
      const int turn = sign_turn(normal, from, to, p, ladder_);
      if (turn == 0) return false;
      if ((sign_from <= 0) != (sign_to <= 0) && turn == (sign_to > 0 ? 1 : -1)) inside = !inside;
    }
    return inside;
  }

  void decide_edges(int e, int g) {
    const SolidEdge &of_a = a_.features.edges()[e], &of_b = b_.features.edges()[g];
    const Vector3 &p = a_.point(of_a.from), &q = a_.point(of_a.to), &x = b_.point(of_b.from),
                  &y = b_.point(of_b.to);
    const ContactDirection w = ContactDirection::cross({&q, &p}, {&y, &x});
    if (is_zero(w, ladder_)) return decide_parallel_edges(e, g);
    if (!is_near(w, {&p, &x})) return;
    if (sign_turn(w, p, q, x, ladder_) * sign_turn(w, p, q, y, ladder_) >= 0 ||
        sign_turn(w, x, y, p, ladder_) * sign_turn(w, x, y, q, ladder_) >= 0)
      return;
    int side = sign_along(w, p, x, ladder_);
    const bool touching = side == 0;
    if (touching) {
      if (!wants_touching()) return;
      side = outer_side(of_a, of_b, w);
    }
    if (side == 0 || !a_.features.admits(of_a, w, side, ladder_) ||
        !b_.features.admits(of_b, w, -side, ladder_))
      return;
    const RationalVector u = a_.exact_edge(of_a), v = b_.exact_edge(of_b);
    const RationalVector normal = times_sign(cross_product(u, v), side);
    const RationalVector d = difference(to_rational(p), to_rational(x));
    const RationalVector exact_w = along(d, normal);
    // p + s u - w is on the line of B: (d + s u) x v has no part along the normal.
    const RationalVector n = cross_product(u, v);
    const Rational s(-dot_product(cross_product(d, v), n) / dot_product(n, n));
    add_point({1, e}, {1, g}, exact_w, normal, sum(to_rational(p), multiple(u, s)));
  }
  // Edges that cross in a common inner point of solids without common inner points: both wedges are convex
  // and on different sides of the plane of the edges. @return the sign of w on A's side.
  int outer_side(const SolidEdge& of_a, const SolidEdge& of_b, const ContactDirection& w) {
    for (const int v : {of_a.left_apex, of_a.right_apex})
      if (const int sign = sign_along(w, a_.point(v), a_.point(of_a.from), ladder_); sign != 0) return sign;
    for (const int v : {of_b.left_apex, of_b.right_apex})
      if (const int sign = sign_along(w, b_.point(v), b_.point(of_b.from), ladder_); sign != 0) return -sign;
    return 0;
  }

  void decide_parallel_edges(int e, int g) {
    const SolidEdge &of_a = a_.features.edges()[e], &of_b = b_.features.edges()[g];
    const ContactDirection line = ContactDirection::along({&a_.point(of_a.to), &a_.point(of_a.from)});
    // Both in the sense of A's edge.
    const auto before = [&](const Vector3& x, const Vector3& y) { return sign_along(line, y, x, ladder_); };
    int from = of_b.from, to = of_b.to;
    if (before(b_.point(from), b_.point(to)) < 0) std::swap(from, to);
    const Vector3 &p = a_.point(of_a.from), &q = a_.point(of_a.to), &x = b_.point(from), &y = b_.point(to);
    if (before(p, y) <= 0 || before(x, q) <= 0) return;
    const ContactDirection w = ContactDirection::rejection({&p, &x}, {&q, &p});
    if (is_zero(w, ladder_)) {
      if (!wants_touching()) return;
    } else if (!a_.features.admits(of_a, w, 1, ladder_) || !b_.features.admits(of_b, w, -1, ladder_) ||
               !is_near(w, {&p, &x})) {
      return;
    }
    DistanceMinimum minimum;
    minimum.a = {1, e};
    minimum.b = {1, g};
    minimum.w = minimum.normal = across(difference(to_rational(p), to_rational(x)), a_.exact_edge(of_a));
    minimum.dimension = 1;
    const auto end = [&](int corner_a, int corner_b, int order) {
      const ContactFeature a = order >= 0 ? ContactFeature{0, corner_a} : ContactFeature{1, e};
      const ContactFeature b = order <= 0 ? ContactFeature{0, corner_b} : ContactFeature{1, g};
      minimum.points.push_back({a, b, order >= 0 ? a_.exact(corner_a) : sum(b_.exact(corner_b), minimum.w)});
      closed_.insert(key_of(a, b));
    };
    end(of_a.from, from, before(x, p));
    end(of_a.to, to, before(q, y));
    found_.push_back(std::move(minimum));
  }

  void decide_edge_face(const Body& of_edge, int e, const Body& of_face, int f) {
    const SolidEdge& edge = of_edge.features.edges()[e];
    const Vector3 &p = of_edge.point(edge.from), &q = of_edge.point(edge.to), &o = of_face.point_of_face(f);
    const ContactDirection& normal = of_face.normals[f];
    if (sign_along(normal, q, p, ladder_) != 0) return;
    const int side = sign_along(normal, p, o, ladder_);
    if (side < 0 || (side == 0 && !wants_touching()) ||
        (side > 0 && !of_edge.features.admits(edge, normal, 1, ladder_)) || !is_near(normal, {&p, &o}))
      return;
    const RationalVector n = of_face.exact_normal(f);
    FlatOverlap overlap = overlap_edge({n, side == 0, floating_}, of_edge.edge_piece(e),
                                       of_face.face_piece(f, false), ladder_.counts);
    if (overlap.vertices.empty()) return;
    DistanceMinimum minimum;
    const bool edge_of_a = of_edge.sign > 0;
    minimum.a = edge_of_a ? ContactFeature{1, e} : ContactFeature{2, f};
    minimum.b = edge_of_a ? ContactFeature{2, f} : ContactFeature{1, e};
    minimum.normal = times_sign(n, of_edge.sign);
    minimum.w = times_sign(along(difference(to_rational(p), to_rational(o)), n), of_edge.sign);
    minimum.dimension = 1;
    if (!edge_of_a) {
      for (OverlapPoint& point : overlap.vertices) swap_sides(point);
      for (FeaturePair& pair : overlap.closure) std::swap(pair.first, pair.second);
    }
    add(std::move(minimum), overlap);
  }

  void decide_faces(int f, int g) {
    const ContactDirection& normal = b_.normals[g];
    if (a_.features.solid().faces()[f].normal.dot(b_.features.solid().faces()[g].normal) > 0.0) return;
    const Vector3 &p = a_.point_of_face(f), &o = b_.point_of_face(g);
    const int side = sign_along(normal, p, o, ladder_);
    if (side < 0 || (side == 0 && !wants_touching())) return;
    ContactDirection opposite = a_.normals[f].copy();
    opposite.reverse();
    if (!same_direction(opposite, normal, ladder_) || !is_near(normal, {&p, &o})) return;
    const RationalVector n = b_.exact_normal(g);
    const FlatOverlap overlap = overlap_faces({n, side == 0, floating_}, a_.face_piece(f, true),
                                              b_.face_piece(g, false), ladder_.counts);
    if (overlap.vertices.empty()) return;
    DistanceMinimum minimum;
    minimum.a = {2, f};
    minimum.b = {2, g};
    minimum.normal = n;
    minimum.w = along(difference(to_rational(p), to_rational(o)), n);
    minimum.dimension = 2;
    minimum.squared_area = overlap.squared_area;
    add(std::move(minimum), overlap);
  }

  static void swap_sides(OverlapPoint& point) {
    std::swap(point.a, point.b);
    std::swap(point.on_a, point.on_b);
  }
  void add(DistanceMinimum minimum, const FlatOverlap& overlap) {
    for (const OverlapPoint& p : overlap.vertices)
      minimum.points.push_back({p.a, p.b, p.on_a ? *p.on_a : sum(*p.on_b, minimum.w)});
    for (const auto& [a, b] : overlap.closure) closed_.insert(key_of(a, b));
    found_.push_back(std::move(minimum));
  }
  void add_point(const ContactFeature& a, const ContactFeature& b, const RationalVector& w,
                 const RationalVector& normal, const RationalVector& on_a) {
    DistanceMinimum minimum;
    minimum.a = a;
    minimum.b = b;
    minimum.w = w;
    minimum.normal = normal;
    minimum.points = {{a, b, on_a}};
    found_.push_back(std::move(minimum));
  }

  Body a_, b_;
  MinimumBound bound_;
  PredicateLadder ladder_;
  bool floating_ = true;  // as required by FlatSetting
  std::set<Key> closed_;  // pairs in the closure of a higher one
  std::vector<DistanceMinimum> found_;
};

}  // namespace

std::vector<DistanceMinimum> find_distance_minima(const SolidFeatures& a, const SolidFeatures& b,
                                                  const MinimumBound& bound, DecisionCounts& counts) {
  return MinimumFinder(a, b, bound).find(counts);
}

}  // namespace ashlar
