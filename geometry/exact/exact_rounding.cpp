#include "geometry/exact/exact_rounding.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {

namespace {

constexpr long mantissa_bits = 53;
constexpr long lowest_exponent = -1074;

struct Integer {
  mpz_t value;
  Integer() { mpz_init(value); }
  ~Integer() { mpz_clear(value); }
  Integer(const Integer&) = delete;
  Integer& operator=(const Integer&) = delete;
};

// The double nearest to (n + tail) 2^exponent, n >= 0, where 0 <= tail < 1 and tail > 0 iff `inexact`; n has
// more than 54 bits if it is inexact.
double assemble(mpz_t n, long exponent, bool inexact) {
  if (mpz_sgn(n) == 0) return 0.0;
  const long bits = static_cast<long>(mpz_sizeinbase(n, 2));
  const long dropped = std::max(bits - mantissa_bits, lowest_exponent - exponent);
  if (dropped > 0) {
    const bool half = mpz_tstbit(n, static_cast<mp_bitcnt_t>(dropped - 1)) != 0;
    const bool above_half = half && (inexact || mpz_scan1(n, 0) < static_cast<mp_bitcnt_t>(dropped - 1));
    mpz_fdiv_q_2exp(n, n, static_cast<mp_bitcnt_t>(dropped));
    if (above_half || (half && mpz_odd_p(n) != 0)) mpz_add_ui(n, n, 1);
    exponent += dropped;
  }
  return std::ldexp(mpz_get_d(n), static_cast<int>(std::min(exponent, 5000L)));
}

}  // namespace

double round_to_nearest(const __mpq_struct* q) {
  const int sign = mpq_sgn(q);
  if (sign == 0) return 0.0;
  Integer n, rest;
  mpz_abs(n.value, mpq_numref(q));
  const long shift = std::max(0L, 2 + mantissa_bits + static_cast<long>(mpz_sizeinbase(mpq_denref(q), 2)) -
                                      static_cast<long>(mpz_sizeinbase(n.value, 2)) + 1);
  mpz_mul_2exp(n.value, n.value, static_cast<mp_bitcnt_t>(shift));
  mpz_fdiv_qr(n.value, rest.value, n.value, mpq_denref(q));
  return sign * assemble(n.value, -shift, mpz_sgn(rest.value) != 0);
}

double round_square_root(const __mpq_struct* q) {
  if (mpq_sgn(q) == 0) return 0.0;
  Integer n, rest;
  // sqrt(a / b) = sqrt(a b 4^shift) / (b 2^shift) would divide twice; sqrt(a 4^shift / b) 2^-shift does not.
  const long numerator_bits = static_cast<long>(mpz_sizeinbase(mpq_numref(q), 2));
  const long denominator_bits = static_cast<long>(mpz_sizeinbase(mpq_denref(q), 2));
  const long shift = std::max(0L, (2 * (mantissa_bits + 3) + denominator_bits - numerator_bits) / 2 + 1);
  mpz_mul_2exp(n.value, mpq_numref(q), static_cast<mp_bitcnt_t>(2 * shift));
  mpz_fdiv_qr(n.value, rest.value, n.value, mpq_denref(q));
  const bool divided_inexactly = mpz_sgn(rest.value) != 0;
  mpz_sqrtrem(n.value, rest.value, n.value);
  return assemble(n.value, -shift, divided_inexactly || mpz_sgn(rest.value) != 0);
}

}  // namespace ashlar
