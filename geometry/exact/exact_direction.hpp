// Third rung of the predicate ladder: a contact direction in multiple precision. Only sources of this layer include
// this file.
#pragma once

#include <CGAL/Mpzf.h>

#include <utility>

#include "geometry/exact/contact_direction.hpp"

namespace ashlar {

/// A dyadic number of any size. CGAL declares its moves noexcept although they may allocate.
// NOLINTNEXTLINE(bugprone-exception-escape)
struct Exact : CGAL::Mpzf {
  Exact(double a = 0.0) : CGAL::Mpzf(a) {}
  Exact(CGAL::Mpzf a) : CGAL::Mpzf(std::move(a)) {}
  static Exact difference(double a, double b) { return Exact(CGAL::Mpzf(a) - CGAL::Mpzf(b)); }
};

// NOLINTNEXTLINE(bugprone-exception-escape)
struct ContactDirection::ExactVector {
  NumberVector<Exact> value;
};

[[nodiscard]] inline int sign_of(const Exact& a) {
  return static_cast<int>(a.sign());
}

/// a - b in the numbers of a rung.
template <class N>
[[nodiscard]] NumberVector<N> subtract_points(const Vector3& a, const Vector3& b) {
  return {N::difference(a[0], b[0]), N::difference(a[1], b[1]), N::difference(a[2], b[2])};
}

}  // namespace ashlar
