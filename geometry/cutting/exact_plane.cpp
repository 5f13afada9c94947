#include "geometry/cutting/exact_plane.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {
namespace {

/// Correctly rounded, without the greatest common divisor needed for a fraction: a quotient of 64 or 65 bits whose
/// last bit also represents the remainder. @param denominator > 0
double rounded_ratio(const Integer& numerator, const Integer& denominator) {
  if (sgn(numerator) == 0) return 0.0;
  const auto bits = [](const Integer& number) {
    return static_cast<long>(mpz_sizeinbase(number.get_mpz_t(), 2));
  };
  const long shift = 65 - (bits(numerator) - bits(denominator));
  constexpr long ordinary = 900;  // far from over- and underflow
  if (std::abs(shift) > ordinary) {
    Rational ratio(numerator, denominator);
    ratio.canonicalize();
    return round_to_nearest(ratio.get_mpq_t());
  }
  Integer quotient = abs(numerator), divisor = denominator, rest;
  (shift >= 0 ? quotient : divisor) <<= static_cast<unsigned long>(std::abs(shift));
  mpz_tdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), quotient.get_mpz_t(), divisor.get_mpz_t());
  if (sgn(rest) != 0) mpz_setbit(quotient.get_mpz_t(), 0);
  const long dropped = bits(quotient) - 53;
  Integer kept = quotient >> static_cast<unsigned long>(dropped);
  const Integer lost = quotient - (kept << static_cast<unsigned long>(dropped));
  const int above_half = cmp(lost, Integer(1) << static_cast<unsigned long>(dropped - 1));
  if (above_half > 0 || (above_half == 0 && mpz_odd_p(kept.get_mpz_t()) != 0)) ++kept;
  return sgn(numerator) * std::ldexp(kept.get_d(), static_cast<int>(dropped - shift));
}

void round_coordinates(ExactPoint& point) {
  point.rounded = {rounded_ratio(point.x, point.w), rounded_ratio(point.y, point.w),
                   rounded_ratio(point.z, point.w)};
}

/// Integers in the proportion of the rational numbers, with the same signs.
template <std::size_t count>
std::array<Integer, count> in_integers(const std::array<Rational, count>& numbers) {
  Integer multiple = 1, divisor = 0;
  for (const Rational& number : numbers) multiple = lcm(multiple, number.get_den());
  std::array<Integer, count> result;
  for (std::size_t k = 0; k < count; ++k) {
    result[k] = numbers[k].get_num() * (multiple / numbers[k].get_den());
    divisor = gcd(divisor, result[k]);
  }
  for (Integer& number : result) number /= divisor;
  return result;
}

constexpr double error_units = 8.0 * 0x1p-53;
/// Far above the loss by underflow of a coefficient or a product, relative to 1 + the coordinates.
constexpr double underflow = 0x1p-1000;

}  // namespace

ExactPoint ExactPoint::of(const Vector3& point) {
  auto [x, y, z, w] =
      in_integers<4>({Rational(point.x()), Rational(point.y()), Rational(point.z()), Rational(1)});
  return {std::move(x), std::move(y), std::move(z), std::move(w), point + Vector3::Zero()};
}

RationalVector ExactPoint::rational() const {
  RationalVector result{Rational(x, w), Rational(y, w), Rational(z, w)};
  result.x.canonicalize();
  result.y.canonicalize();
  result.z.canonicalize();
  return result;
}

ExactPlane::ExactPlane(const RationalVector& normal, const Rational& height)
    : coefficients_(in_integers<4>({normal.x, normal.y, normal.z, height})) {
  round();
}

ExactPlane::ExactPlane(const CutPlane& plane)
    : ExactPlane(to_rational(plane.normal),
                 Rational(dot_product(to_rational(plane.normal), to_rational(plane.point)) +
                          Rational(plane.offset))) {}

ExactPlane ExactPlane::through(const RationalVector& a, const RationalVector& b, const RationalVector& c) {
  const RationalVector normal = cross_product(difference(b, a), difference(c, a));
  return {normal, dot_product(normal, a)};
}

void ExactPlane::round() {
  // The largest component of the normal is of size 1, so that no product overflows.
  std::size_t bits = 0;
  for (int k = 0; k < 3; ++k) bits = std::max(bits, mpz_sizeinbase(coefficients_[k].get_mpz_t(), 2));
  Integer unit = 1;
  unit <<= bits;
  for (std::size_t k = 0; k < 4; ++k) rounded_[k] = rounded_ratio(coefficients_[k], unit);
}

std::optional<int> ExactPlane::quick_side(const Vector3& x) const {
  const double a = rounded_[0] * x[0], b = rounded_[1] * x[1], c = rounded_[2] * x[2];
  const double value = a + b + c - rounded_[3];
  const double size = std::abs(a) + std::abs(b) + std::abs(c) + std::abs(rounded_[3]);
  const double bound = error_units * size + underflow * (1.0 + x.cwiseAbs().sum());
  if (value > bound) return 1;
  if (value < -bound) return -1;
  return std::nullopt;
}

int ExactPlane::side(const ExactPoint& point) const {
  if (const std::optional<int> side = quick_side(point.rounded)) return *side;
  const Integer value = coefficients_[0] * point.x + coefficients_[1] * point.y + coefficients_[2] * point.z -
                        coefficients_[3] * point.w;
  return sgn(value);
}

int ExactPlane::side_of_box(const Vector3& low, const Vector3& high) const {
  double least = 0.0, most = 0.0, size = std::abs(rounded_[3]);
  for (int k = 0; k < 3; ++k) {
    const double at_low = rounded_[k] * low[k], at_high = rounded_[k] * high[k];
    least += std::min(at_low, at_high);
    most += std::max(at_low, at_high);
    size += std::max(std::abs(at_low), std::abs(at_high));
  }
  const double bound = error_units * size + underflow * (1.0 + low.cwiseAbs().sum() + high.cwiseAbs().sum());
  return least - rounded_[3] > bound ? 1 : most - rounded_[3] < -bound ? -1 : 0;
}

RationalVector ExactPlane::normal() const {
  return {Rational(coefficients_[0]), Rational(coefficients_[1]), Rational(coefficients_[2])};
}

Vector3 ExactPlane::unit_normal() const {
  return round_unit_vector(normal());
}

std::optional<ExactPoint> common_point(const ExactPlane& p, const ExactPlane& q, const ExactPlane& r) {
  const auto& [a, b, c, d] = p.coefficients();
  const auto& [e, f, g, h] = q.coefficients();
  const auto& [i, j, k, l] = r.coefficients();
  // Cramer's rule; minors of the second and the third plane.
  const Integer fk = f * k - g * j, ek = e * k - g * i, ej = e * j - f * i;
  const Integer hk = h * k - g * l, hj = h * j - f * l, he = e * l - h * i;
  ExactPoint point;
  point.w = a * fk - b * ek + c * ej;
  if (sgn(point.w) == 0) return std::nullopt;
  point.x = d * fk - b * hk + c * hj;
  point.y = a * hk - d * ek + c * he;
  point.z = -a * hj - b * he + d * ej;
  const Integer divisor = gcd(gcd(point.x, point.y), gcd(point.z, point.w));
  for (Integer* number : {&point.x, &point.y, &point.z, &point.w}) {
    mpz_divexact(number->get_mpz_t(), number->get_mpz_t(), divisor.get_mpz_t());
    if (number != &point.w && sgn(point.w) < 0) *number = -*number;
  }
  if (sgn(point.w) < 0) point.w = -point.w;
  round_coordinates(point);
  return point;
}

}  // namespace ashlar
