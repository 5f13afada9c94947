// Rounding of rational numbers to the nearest double, ties to even, subnormal results included.
#pragma once

#include <gmp.h>

namespace ashlar {

/// @param q canonical. Overflow gives an infinity.
[[nodiscard]] double round_to_nearest(const __mpq_struct* q);

/// The double nearest to the square root of q. @param q canonical, >= 0.
[[nodiscard]] double round_square_root(const __mpq_struct* q);

}  // namespace ashlar
