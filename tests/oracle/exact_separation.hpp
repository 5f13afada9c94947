// The distance of two convex bodies, by trying all pairs of features.
#pragma once

#include "oracle/exact_body.hpp"

namespace ashlar::oracle {

/// p - q at a closest pair: direction / divisor, divisor > 0.
struct Separation {
  IntegerVector direction;
  mpz_class divisor;
};

/// @param p,q have no common point
[[nodiscard]] Separation separation(const ConvexBody& p, const ConvexBody& q);

}  // namespace ashlar::oracle
