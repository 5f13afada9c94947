// Moments of tetrahedra and triangles for any number type: the exact core of moments.cpp and basis.cpp.
//
// For the tetrahedron with corners 0, a, b, c and a vector s,
//     integral of (s.x)^m dV = det[a b c] m!/(m+3)! h_m(s.a, s.b, s.c),
// h_m being the complete homogeneous symmetric polynomial (Shi's simplex integration in closed form).
// Expanding both sides in s gives
//     I_abc = det[a b c] a! b! c!/(a+b+c+3)! * coefficient of s1^a s2^b s3^c in 1/((1-s.a)(1-s.b)(1-s.c)),
// and the coefficients follow from three first-order recurrences, one for each factor.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mechanics/basis/multi_index.hpp"

namespace ashlar {

/// Coefficients of 1/((1-s.a)(1-s.b)(1-s.c)) in the order of multi_index.hpp.
/// @param coefficients (polynomial_count(degree)), overwritten
template <class Number>
void corner_series(const std::array<std::array<Number, 3>, 3>& corners, int degree,
                   std::vector<Number>& coefficients) {
  coefficients.assign(static_cast<std::size_t>(polynomial_count(degree)), Number(0));
  coefficients[0] = 1;
  for (const auto& corner : corners) {
    std::size_t place = 1;
    for (int m = 1; m <= degree; ++m) {
      for (int a = m; a >= 0; --a) {
        for (int b = m - a; b >= 0; --b, ++place) {
          const int c = m - a - b;
          Number& value = coefficients[place];
          if (a > 0) value += corner[0] * coefficients[static_cast<std::size_t>(monomial_index(a - 1, b, c))];
          if (b > 0) value += corner[1] * coefficients[static_cast<std::size_t>(monomial_index(a, b - 1, c))];
          if (c > 0) value += corner[2] * coefficients[static_cast<std::size_t>(monomial_index(a, b, c - 1))];
        }
      }
    }
  }
}

/// det[a b c]: six times the signed volume of the tetrahedron 0, a, b, c.
template <class Number>
Number corner_determinant(const std::array<std::array<Number, 3>, 3>& corners) {
  const auto& [a, b, c] = corners;
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Sums over the triangles of det[a b c] * corner_series: moment k is sum k times a! b! c!/(a+b+c+3)!.
/// @param points (#points), triangles (#triangles), outward
/// @return (polynomial_count(degree)) in the order of multi_index.hpp
template <class Number>
std::vector<Number> moment_sums(const std::vector<std::array<Number, 3>>& points,
                                const std::vector<std::array<int, 3>>& triangles, int degree) {
  const auto count = static_cast<std::size_t>(polynomial_count(degree));
  std::vector<Number> sums(count, Number(0));
  std::vector<Number> series;
  for (const auto& triangle : triangles) {
    const std::array<std::array<Number, 3>, 3> corners = {points[static_cast<std::size_t>(triangle[0])],
                                                          points[static_cast<std::size_t>(triangle[1])],
                                                          points[static_cast<std::size_t>(triangle[2])]};
    const Number determinant = corner_determinant(corners);
    if (determinant == 0) continue;
    corner_series(corners, degree, series);
    for (std::size_t k = 0; k < count; ++k) sums[k] += determinant * series[k];
  }
  return sums;
}

/// 0! to last!, as exact as the number type.
template <class Number>
std::vector<Number> factorials(int last) {
  std::vector<Number> values(static_cast<std::size_t>(last) + 1, Number(1));
  for (std::size_t k = 1; k < values.size(); ++k) values[k] = values[k - 1] * Number(static_cast<int>(k));
  return values;
}

}  // namespace ashlar
