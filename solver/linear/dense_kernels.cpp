#include "solver/linear/dense_kernels.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

extern "C" {
void sgemm_(const char*, const char*, const int*, const int*, const int*, const float*, const float*,
            const int*, const float*, const int*, const float*, float*, const int*);
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*);
void ssyrk_(const char*, const char*, const int*, const int*, const float*, const float*, const int*,
            const float*, float*, const int*);
void dsyrk_(const char*, const char*, const int*, const int*, const double*, const double*, const int*,
            const double*, double*, const int*);
void strsm_(const char*, const char*, const char*, const char*, const int*, const int*, const float*,
            const float*, const int*, float*, const int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*,
            const double*, const int*, double*, const int*);
void strmm_(const char*, const char*, const char*, const char*, const int*, const int*, const float*,
            const float*, const int*, float*, const int*);
void dtrmm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*,
            const double*, const int*, double*, const int*);
void sgemv_(const char*, const int*, const int*, const float*, const float*, const int*, const float*,
            const int*, const float*, float*, const int*);
void dgemv_(const char*, const int*, const int*, const double*, const double*, const int*, const double*,
            const int*, const double*, double*, const int*);
}

namespace ashlar {
namespace {

/// The functions of BLAS for a type of numbers.
template <class T>
struct Blas;
template <>
struct Blas<float> {
  static constexpr auto gemm = sgemm_;
  static constexpr auto syrk = ssyrk_;
  static constexpr auto trsm = strsm_;
  static constexpr auto trmm = strmm_;
  static constexpr auto gemv = sgemv_;
};
template <>
struct Blas<double> {
  static constexpr auto gemm = dgemm_;
  static constexpr auto syrk = dsyrk_;
  static constexpr auto trsm = dtrsm_;
  static constexpr auto trmm = dtrmm_;
  static constexpr auto gemv = dgemv_;
};

constexpr int small_triangle = 24;

/// Rows `from` to n of a column.
template <class T>
auto column_of(T* a, int a_columns, int column, int from, int n) {
  return Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, 1>>(a + std::ptrdiff_t{column} * a_columns + from,
                                                         n - from);
}

template <class T>
bool factorize_small(int n, T* a, int a_columns) {
  for (int j = 0; j < n; ++j) {
    auto column = column_of(a, a_columns, j, j, n);
    if (!(column[0] > T{0}) || !std::isfinite(column[0])) return false;
    column *= T{1} / std::sqrt(column[0]);
    for (int k = j + 1; k < n; ++k) column_of(a, a_columns, k, k, n) -= column[k - j] * column.tail(n - k);
  }
  return true;
}

template <class T>
void invert_small(int n, T* l, int l_columns) {
  // From the last column on: a column of the inverse needs those behind it.
  for (int j = n - 1; j >= 0; --j) {
    auto column = column_of(l, l_columns, j, j, n);
    const T diagonal = T{1} / column[0];
    Eigen::Matrix<T, small_triangle, 1> below;
    below.head(n - j - 1) = column.tail(n - j - 1);
    column.setZero();
    for (int k = j + 1; k < n; ++k)
      column.tail(n - k) -= diagonal * below[k - j - 1] * column_of(l, l_columns, k, k, n);
    column[0] = diagonal;
  }
}

}  // namespace

template <class T>
void subtract_product(int m, int n, int k, const T* a, int a_columns, const T* b, int b_columns, T* c,
                      int c_columns) {
  constexpr T minus = -1, one = 1;
  if (m > 0 && n > 0 && k > 0)
    Blas<T>::gemm("N", "T", &m, &n, &k, &minus, a, &a_columns, b, &b_columns, &one, c, &c_columns);
}

template <class T>
void subtract_square(int n, int k, const T* a, int a_columns, T beta, T* c, int c_columns) {
  constexpr T minus = -1;
  if (n > 0) Blas<T>::syrk("L", "N", &n, &k, &minus, a, &a_columns, &beta, c, &c_columns);
}

template <class T>
void divide_by_triangle(int m, int n, const T* l, int l_columns, bool transposed, T* b, int b_columns) {
  constexpr T one = 1;
  if (m > 0 && n > 0)
    Blas<T>::trsm("R", "L", transposed ? "N" : "T", "N", &m, &n, &one, l, &l_columns, b, &b_columns);
}

template <class T>
void times_vector(int m, int n, const T* a, int a_columns, bool transposed, const T* x, T beta, T* y) {
  constexpr T one = 1;
  constexpr int next = 1;
  if (m > 0 && n > 0)
    Blas<T>::gemv(transposed ? "T" : "N", &m, &n, &one, a, &a_columns, x, &next, &beta, y, &next);
}

template <class T>
bool factorize_triangle(int n, T* a, int a_columns) {
  if (n <= small_triangle) return factorize_small(n, a, a_columns);
  const int half = n / 2;
  T* const below = a + half;
  T* const rest = below + std::ptrdiff_t{half} * a_columns;
  if (!factorize_triangle(half, a, a_columns)) return false;
  divide_by_triangle(n - half, half, a, a_columns, false, below, a_columns);
  subtract_square(n - half, half, below, a_columns, T{1}, rest, a_columns);
  return factorize_triangle(n - half, rest, a_columns);
}

template <class T>
void invert_triangle(int n, T* l, int l_columns) {
  if (n <= small_triangle) return invert_small(n, l, l_columns);
  const int half = n / 2, other = n - half;
  T* const below = l + half;
  T* const rest = below + std::ptrdiff_t{half} * l_columns;
  invert_triangle(half, l, l_columns);
  invert_triangle(other, rest, l_columns);
  constexpr T minus = -1, one = 1;
  Blas<T>::trmm("L", "L", "N", "N", &other, &half, &minus, rest, &l_columns, below, &l_columns);
  Blas<T>::trmm("R", "L", "N", "N", &other, &half, &one, l, &l_columns, below, &l_columns);
}

#define ASHLAR_KERNELS(T)                                                               \
  template void subtract_product(int, int, int, const T*, int, const T*, int, T*, int); \
  template void subtract_square(int, int, const T*, int, T, T*, int);                   \
  template void divide_by_triangle(int, int, const T*, int, bool, T*, int);             \
  template void times_vector(int, int, const T*, int, bool, const T*, T, T*);           \
  template bool factorize_triangle(int, T*, int);                                       \
  template void invert_triangle(int, T*, int);
ASHLAR_KERNELS(float)
ASHLAR_KERNELS(double)
#undef ASHLAR_KERNELS

}  // namespace ashlar
