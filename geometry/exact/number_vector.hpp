// Three-vectors over the number types of the predicate ladder (see contact_direction.hpp).
#pragma once

namespace ashlar {

/// A vector over any ring N; the exact types have no business in Eigen expressions.
template <class N>
// NOLINTNEXTLINE(bugprone-exception-escape): CGAL's numbers have noexcept moves that may allocate
struct NumberVector {
  N x, y, z;

  friend NumberVector operator-(const NumberVector& a, const NumberVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};

template <class N>
[[nodiscard]] N dot(const NumberVector<N>& a, const NumberVector<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class N>
[[nodiscard]] NumberVector<N> cross(const NumberVector<N>& a, const NumberVector<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class N>
[[nodiscard]] NumberVector<N> scale(const NumberVector<N>& a, const N& s) {
  return {a.x * s, a.y * s, a.z * s};
}

/// x, y or z. @param i 0, 1 or 2
template <class N>
[[nodiscard]] const N& component(const NumberVector<N>& v, int i) {
  return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

}  // namespace ashlar
