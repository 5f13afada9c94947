// Fractions to doubles.
#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/exact_oracle.hpp"

namespace ashlar::oracle {

double round_to_double(const mpq_class& value) {
  if (sgn(value) == 0) return 0.0;
  const mpz_class numerator = abs(value.get_num());
  const auto bits = [](const mpz_class& z) { return static_cast<long>(mpz_sizeinbase(z.get_mpz_t(), 2)); };
  // 2^exponent is the weight of the last kept bit; subnormal numbers keep fewer bits.
  const long lowest = std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
  const auto round_at = [&](long exponent) {
    const mpz_class scaled_numerator =
        exponent < 0 ? mpz_class(numerator << static_cast<unsigned long>(-exponent)) : numerator;
    const mpz_class scaled_denominator =
        exponent > 0 ? mpz_class(value.get_den() << static_cast<unsigned long>(exponent)) : value.get_den();
    mpz_class quotient = scaled_numerator / scaled_denominator;
    const mpz_class twice_rest = 2 * (scaled_numerator - quotient * scaled_denominator);
    const int half = cmp(twice_rest, scaled_denominator);
    const bool exceeds = bits(quotient) > std::numeric_limits<double>::digits;
    if (!exceeds && (half > 0 || (half == 0 && mpz_odd_p(quotient.get_mpz_t()) != 0))) quotient += 1;
    return std::pair{quotient, exceeds};
  };
  const long guess = bits(numerator) - bits(value.get_den()) - std::numeric_limits<double>::digits;
  const long exponent = std::max(guess, lowest);
  auto [quotient, exceeds] = round_at(exponent);
  const long used = exceeds ? exponent + 1 : exponent;
  if (exceeds) quotient = round_at(used).first;
  const double magnitude = std::ldexp(quotient.get_d(), static_cast<int>(used));
  return sgn(value) < 0 ? -magnitude : magnitude;
}

double round_quotient_by_root(const mpq_class& x, const mpq_class& squared) {
  if (sgn(x) == 0) return 0.0;
  const mpq_class square = x * x / squared;
  // sqrt(square) lies above a bound b >= 0 exactly if square > b^2; the bounds are halfway between doubles.
  const auto side_of_middle = [&](double low, double high) {
    const mpq_class middle = (mpq_class(low) + mpq_class(high)) / 2;
    return cmp(square, middle * middle);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  double root = std::sqrt(round_to_double(square));
  while (side_of_middle(root, std::nextafter(root, infinity)) > 0) root = std::nextafter(root, infinity);
  while (root > 0.0 && side_of_middle(std::nextafter(root, 0.0), root) < 0) root = std::nextafter(root, 0.0);
  return sgn(x) < 0 ? -root : root;
}

}  // namespace ashlar::oracle
