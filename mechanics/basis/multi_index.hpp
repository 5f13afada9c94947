// Order of the monomials X^a Y^b Z^c and of every polynomial basis built on them: by total degree, then by
// decreasing a, then by decreasing b: 1, X, Y, Z, X^2, XY, XZ, Y^2, YZ, Z^2, ... The first (n+1)(n+2)(n+3)/6
// of them span all polynomials of order n, for every n (theory.md section 1, equation (5)).
#pragma once

#include <array>
#include <vector>

namespace ashlar {

/// Number p of terms of a complete polynomial of an order (5). @param order >= -1 (p = 0 at -1)
[[nodiscard]] constexpr int polynomial_count(int order) {
  return (order + 1) * (order + 2) * (order + 3) / 6;
}

/// Place of X^a Y^b Z^c in the order above. @param a,b,c >= 0
[[nodiscard]] constexpr int monomial_index(int a, int b, int c) {
  const int degree = a + b + c;
  const int below = b + c;
  return polynomial_count(degree - 1) + below * (below + 1) / 2 + c;
}

/// The exponents (a, b, c) of the first polynomial_count(order) monomials. @return (p)
[[nodiscard]] inline std::vector<std::array<int, 3>> monomial_exponents(int order) {
  std::vector<std::array<int, 3>> exponents;
  exponents.reserve(static_cast<std::size_t>(polynomial_count(order)));
  for (int degree = 0; degree <= order; ++degree) {
    for (int a = degree; a >= 0; --a) {
      for (int b = degree - a; b >= 0; --b) exponents.push_back({a, b, degree - a - b});
    }
  }
  return exponents;
}

}  // namespace ashlar
