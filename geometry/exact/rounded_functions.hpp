// Elementary functions, rounded to the nearest double: by MPFR, so that every system has the same bits. Those of C
// libraries differ in their last bit from one library to the next, and with the processor.
//
// A call takes 1 to 5 microseconds. Subnormal results are rounded once. Arguments beyond a function's domain give NaN, and
// faults of arithmetic are raised (std::fetestexcept), as in the C library; for NaN too.
#pragma once

namespace ashlar::correctly_rounded {

/// x in radians.
[[nodiscard]] double sin(double x);
[[nodiscard]] double cos(double x);
[[nodiscard]] double tan(double x);

/// In radians.
[[nodiscard]] double asin(double x);
[[nodiscard]] double acos(double x);
[[nodiscard]] double atan(double x);
[[nodiscard]] double atan2(double y, double x);

/// x in degrees: exact where the value is a double, at multiples of 30 or 45.
[[nodiscard]] double sin_of_degrees(double x);
[[nodiscard]] double cos_of_degrees(double x);
[[nodiscard]] double tan_of_degrees(double x);

/// In degrees.
[[nodiscard]] double degrees_of_atan(double x);
[[nodiscard]] double degrees_of_atan2(double y, double x);

[[nodiscard]] double sinh(double x);
[[nodiscard]] double cosh(double x);
[[nodiscard]] double tanh(double x);
[[nodiscard]] double asinh(double x);

[[nodiscard]] double exp(double x);
[[nodiscard]] double log(double x);
[[nodiscard]] double log10(double x);
[[nodiscard]] double log1p(double x);

[[nodiscard]] double cbrt(double x);
[[nodiscard]] double pow(double x, double exponent);
/// sqrt(x^2 + y^2)
[[nodiscard]] double hypot(double x, double y);

}  // namespace ashlar::correctly_rounded
