// Exact numbers in messages of tests. GMP's own library prints them to streams of GCC's standard library alone.
#pragma once

#include <gmpxx.h>

#include <ostream>

inline void PrintTo(const mpz_class& number, std::ostream* out) {
  *out << number.get_str();
}

inline void PrintTo(const mpq_class& number, std::ostream* out) {
  *out << number.get_str();
}
