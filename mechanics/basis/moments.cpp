// All arithmetic is on integers: doubles become integers after scaling by a common power of two, the recurrences of
// simplex_moments.hpp need no division, and each moment is rounded once at the end.
#include "mechanics/basis/moments.hpp"

#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "mechanics/basis/simplex_moments.hpp"

namespace ashlar {
namespace {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

/// Digits of a double after scaling to an integer.
constexpr int digits_of_double = std::numeric_limits<double>::digits;
/// Digits of a quotient that rounds like the exact value: 64 and a sticky bit.
constexpr long digits_of_quotient = 66;
/// Exponents beyond this range are zero or infinite as doubles.
constexpr long largest_exponent = 5000;
/// Largest degree of moments: higher ones are beyond any basis, and their integers are large.
constexpr int largest_degree = 60;

/// Exponent of the largest power of two of which all coordinates are multiples.
int common_exponent(const std::vector<Vector3>& points) {
  int exponent = 0;
  bool first = true;
  for (const Vector3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (point[axis] == 0.0) continue;
      int e = 0;
      std::frexp(point[axis], &e);
      exponent = first ? e - digits_of_double : std::min(exponent, e - digits_of_double);
      first = false;
    }
  }
  return exponent;
}

/// sum * 2^exponent * numerator / denominator to the nearest double.
double rounded(const Integer& sum, long exponent, const Integer& numerator, const Integer& denominator) {
  if (sum == 0) return 0.0;
  Integer top = sum * numerator;
  const bool negative = top < 0;
  if (negative) top = -top;
  const long shift = digits_of_quotient + static_cast<long>(msb(denominator)) - static_cast<long>(msb(top));
  Integer bottom = denominator;
  if (shift >= 0) {
    top <<= static_cast<unsigned long>(shift);
  } else {
    bottom <<= static_cast<unsigned long>(-shift);
  }
  Integer quotient;
  Integer remainder;
  divide_qr(top, bottom, quotient, remainder);
  // As many leading bits as a double has, rounded to nearest even by hand; results below the normal range are rounded
  // by ldexp.
  const long extra = static_cast<long>(msb(quotient)) - (digits_of_double - 1);
  Integer mantissa = quotient >> static_cast<unsigned long>(extra);
  const Integer rest = quotient - (mantissa << static_cast<unsigned long>(extra));
  const Integer half = Integer(1) << static_cast<unsigned long>(extra - 1);
  if (rest > half || (rest == half && (remainder != 0 || (mantissa & 1) != 0))) ++mantissa;
  const double value =
      std::ldexp(static_cast<double>(mantissa.convert_to<long long>()),
                 static_cast<int>(std::clamp(extra - shift + exponent, -largest_exponent, largest_exponent)));
  return negative ? -value : value;
}

}  // namespace

std::vector<double> moments(const TriangleMesh& mesh, int degree) {
  if (degree < 0 || degree > largest_degree)
    throw std::invalid_argument("degree of moments must be 0 to " + std::to_string(largest_degree));
  const int exponent = common_exponent(mesh.points);
  std::vector<std::array<Integer, 3>> points;
  points.reserve(mesh.points.size());
  for (const Vector3& point : mesh.points) {
    std::array<Integer, 3> scaled;
    for (int axis = 0; axis < 3; ++axis) {
      int e = 0;
      const double fraction = std::frexp(point[axis], &e);
      scaled[static_cast<std::size_t>(axis)] =
          Integer(static_cast<long long>(std::ldexp(fraction, digits_of_double)));
      if (point[axis] != 0.0)
        scaled[static_cast<std::size_t>(axis)] <<= static_cast<unsigned>(e - digits_of_double - exponent);
    }
    points.push_back(scaled);
  }

  const std::vector<Integer> sums = moment_sums(points, mesh.triangles, degree);
  const std::vector<Integer> factorial = factorials<Integer>(degree + 3);
  std::vector<double> values;
  values.reserve(sums.size());
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    const auto at = [&](int k) -> const Integer& { return factorial[static_cast<std::size_t>(k)]; };
    values.push_back(rounded(sums[values.size()], static_cast<long>(a + b + c + 3) * exponent,
                             at(a) * at(b) * at(c), at(a + b + c + 3)));
  }
  return values;
}

}  // namespace ashlar
