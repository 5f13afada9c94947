// Three exact numbers as an array, for constructions that index coordinates. Only sources of this layer include it.
#pragma once

#include <array>

namespace ashlar {

/// @tparam Number integers, fractions or binary fractions; products and sums may be expression templates
template <class Number>
using NumberTriple = std::array<Number, 3>;

template <class Number>
[[nodiscard]] NumberTriple<Number> minus(const NumberTriple<Number>& a, const NumberTriple<Number>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}

template <class Number>
[[nodiscard]] NumberTriple<Number> cross(const NumberTriple<Number>& a, const NumberTriple<Number>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]),
          Number(a[0] * b[1] - a[1] * b[0])};
}

template <class Number>
[[nodiscard]] Number dot(const NumberTriple<Number>& a, const NumberTriple<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace ashlar
