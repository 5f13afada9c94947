// Numbers of 50 decimal digits, for values computed once and then rounded. Only sources include this file.
#pragma once

#include <boost/multiprecision/mpfr.hpp>

namespace ashlar {

/// On the stack, without expression templates: Eigen takes it as a scalar.
using FiftyDigits = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

}  // namespace ashlar
