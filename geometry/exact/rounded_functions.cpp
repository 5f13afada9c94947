#include "geometry/exact/rounded_functions.hpp"

#include <mpfr.h>

#include <cfenv>
#include <limits>

namespace ashlar::correctly_rounded {
namespace {

using Limits = std::numeric_limits<double>;

/// While alive, numbers of this thread have the exponents of doubles; the destructor restores those of before.
class ExponentsOfDoubles {
 public:
  ExponentsOfDoubles() {
    mpfr_set_emin(Limits::min_exponent - Limits::digits + 1);
    mpfr_set_emax(Limits::max_exponent);
  }
  ~ExponentsOfDoubles() {
    mpfr_set_emin(least_);
    mpfr_set_emax(largest_);
  }
  ExponentsOfDoubles(const ExponentsOfDoubles&) = delete;
  ExponentsOfDoubles& operator=(const ExponentsOfDoubles&) = delete;

 private:
  mpfr_exp_t least_ = mpfr_get_emin();
  mpfr_exp_t largest_ = mpfr_get_emax();
};

/// Raises what MPFR has met since its flags were cleared, where the system counts faults.
void raise_faults() {
#if defined(FE_INVALID) && defined(FE_DIVBYZERO) && defined(FE_OVERFLOW)
  const int met = (mpfr_nanflag_p() != 0 ? FE_INVALID : 0) | (mpfr_divby0_p() != 0 ? FE_DIVBYZERO : 0) |
                  (mpfr_overflow_p() != 0 ? FE_OVERFLOW : 0);
  if (met != 0) std::feraiseexcept(met);
#endif
}

/// @param compute sets its first argument from the number in it, and returns how it was rounded.
template <class Function>
double nearest(double x, Function compute) {
  const ExponentsOfDoubles exponents;
  MPFR_DECL_INIT(value, Limits::digits);
  mpfr_set_d(value, x, MPFR_RNDN);
  mpfr_clear_flags();
  mpfr_subnormalize(value, compute(value), MPFR_RNDN);
  raise_faults();
  return mpfr_get_d(value, MPFR_RNDN);
}

using FunctionOfOne = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using FunctionOfTwo = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
using FunctionOfTurns = int (*)(mpfr_ptr, mpfr_srcptr, unsigned long, mpfr_rnd_t);

constexpr unsigned long degrees_of_a_turn = 360;

template <FunctionOfOne function>
double nearest(double x) {
  return nearest(x, [](mpfr_ptr value) { return function(value, value, MPFR_RNDN); });
}

template <FunctionOfTurns function>
double nearest(double x) {
  return nearest(x, [](mpfr_ptr value) { return function(value, value, degrees_of_a_turn, MPFR_RNDN); });
}

template <FunctionOfTwo function>
double nearest(double x, double y) {
  return nearest(x, [y](mpfr_ptr value) {
    MPFR_DECL_INIT(other, Limits::digits);
    mpfr_set_d(other, y, MPFR_RNDN);
    return function(value, value, other, MPFR_RNDN);
  });
}

int degrees_of_atan2(mpfr_ptr result, mpfr_srcptr y, mpfr_srcptr x, mpfr_rnd_t rounding) {
  return mpfr_atan2u(result, y, x, degrees_of_a_turn, rounding);
}

}  // namespace

double sin(double x) {
  return nearest<mpfr_sin>(x);
}

double cos(double x) {
  return nearest<mpfr_cos>(x);
}

double tan(double x) {
  return nearest<mpfr_tan>(x);
}

double asin(double x) {
  return nearest<mpfr_asin>(x);
}

double acos(double x) {
  return nearest<mpfr_acos>(x);
}

double atan(double x) {
  return nearest<mpfr_atan>(x);
}

double atan2(double y, double x) {
  return nearest<mpfr_atan2>(y, x);
}

double sin_of_degrees(double x) {
  return nearest<mpfr_sinu>(x);
}

double cos_of_degrees(double x) {
  return nearest<mpfr_cosu>(x);
}

double tan_of_degrees(double x) {
  return nearest<mpfr_tanu>(x);
}

double degrees_of_atan(double x) {
  return nearest<mpfr_atanu>(x);
}

double degrees_of_atan2(double y, double x) {
  return nearest<degrees_of_atan2>(y, x);
}

double sinh(double x) {
  return nearest<mpfr_sinh>(x);
}

double cosh(double x) {
  return nearest<mpfr_cosh>(x);
}

double tanh(double x) {
  return nearest<mpfr_tanh>(x);
}

double asinh(double x) {
  return nearest<mpfr_asinh>(x);
}

double exp(double x) {
  return nearest<mpfr_exp>(x);
}

double log(double x) {
  return nearest<mpfr_log>(x);
}

double log10(double x) {
  return nearest<mpfr_log10>(x);
}

double log1p(double x) {
  return nearest<mpfr_log1p>(x);
}

double cbrt(double x) {
  return nearest<mpfr_cbrt>(x);
}

double pow(double x, double exponent) {
  return nearest<mpfr_pow>(x, exponent);
}

double hypot(double x, double y) {
  return nearest<mpfr_hypot>(x, y);
}

}  // namespace ashlar::correctly_rounded
