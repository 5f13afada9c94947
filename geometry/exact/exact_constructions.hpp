// Last rung of direction_constructions.hpp: values along a contact direction w, each computed in exact numbers and
// rounded once. Only sources of this folder include it. The functions are in direction_predicates.cpp, with all that
// computes in CGAL's numbers, which no header exposes.
#pragma once

#include <utility>

#include "geometry/exact/contact_direction.hpp"

namespace ashlar {

/// Heights of the ends of a segment (a, b) over the line (c, d) in the projection along w, up to a common factor. The
/// points outlive it.
struct HeightsOverLine {
  const Vector3 &a, &b, &c, &d;

  template <class N>
  [[nodiscard]] std::pair<N, N> operator()(const NumberVector<N>& w) const {
    const NumberVector<N> across = cross(w, subtract_points<N>(d, c));
    return std::pair<N, N>(dot(across, subtract_points<N>(a, c)), dot(across, subtract_points<N>(b, c)));
  }
};

/// The same over the plane through c across w.
struct HeightsOverPlane {
  const Vector3 &a, &b, &c;

  template <class N>
  [[nodiscard]] std::pair<N, N> operator()(const NumberVector<N>& w) const {
    return std::pair<N, N>(dot(w, subtract_points<N>(a, c)), dot(w, subtract_points<N>(b, c)));
  }
};

/// (w.d)^2 / |w|^2.
[[nodiscard]] double exact_squared_height(const ContactDirection& w, const Difference& d);
/// |w.d| / |w|.
[[nodiscard]] double exact_height(const ContactDirection& w, const Difference& d);
/// Component i of x + sign w (w.d) / |w|^2. @param x null: the origin
[[nodiscard]] double exact_shifted(const ContactDirection& w, const Difference& d, const Vector3* x, int sign,
                                   int i);
/// Component i of w / |w|.
[[nodiscard]] double exact_unit_component(const ContactDirection& w, int i);
/// Component i of a + (b - a) s / (s - t), with s and t of `heights`.
[[nodiscard]] double exact_point_between(const ContactDirection& w, const Vector3& a, const Vector3& b,
                                         const HeightsOverLine& heights, int i);
[[nodiscard]] double exact_point_between(const ContactDirection& w, const Vector3& a, const Vector3& b,
                                         const HeightsOverPlane& heights, int i);

}  // namespace ashlar
