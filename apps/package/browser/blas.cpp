// The functions of BLAS and LAPACK that the solver and CHOLMOD call, for the letters that they pass, by Eigen's kernels: OpenBLAS
// has no processor of this kind. Triangles are lower ones without a unit diagonal. Another call ends the program.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdlib>

namespace {

using Eigen::Dynamic;

template <class T>
using Matrix = Eigen::Map<Eigen::Matrix<T, Dynamic, Dynamic>, 0, Eigen::OuterStride<>>;
template <class T>
using ConstMatrix = Eigen::Map<const Eigen::Matrix<T, Dynamic, Dynamic>, 0, Eigen::OuterStride<>>;
template <class T>
using Vector = Eigen::Map<Eigen::Matrix<T, Dynamic, 1>, 0, Eigen::InnerStride<>>;
template <class T>
using ConstVector = Eigen::Map<const Eigen::Matrix<T, Dynamic, 1>, 0, Eigen::InnerStride<>>;

void require(bool known) {
  if (!known) std::abort();
}

bool is_transposed(const char* letter) {
  require(*letter == 'N' || *letter == 'T' || *letter == 'C');
  return *letter != 'N';
}

bool is_right(const char* letter) {
  require(*letter == 'L' || *letter == 'R');
  return *letter == 'R';
}

/// beta part, in which what is not a number does not matter where beta is zero.
template <class Part, class T>
void scale(Part&& part, T beta) {
  if (beta == T{0})
    part.setZero();
  else if (beta != T{1})
    part *= beta;
}

template <class T>
void gemm(const char* a_form, const char* b_form, int m, int n, int k, T alpha, const T* a, int a_columns,
          const T* b, int b_columns, T beta, T* c, int c_columns) {
  const bool turn_a = is_transposed(a_form), turn_b = is_transposed(b_form);
  const ConstMatrix<T> left(a, turn_a ? k : m, turn_a ? m : k, Eigen::OuterStride<>(a_columns));
  const ConstMatrix<T> right(b, turn_b ? n : k, turn_b ? k : n, Eigen::OuterStride<>(b_columns));
  Matrix<T> result(c, m, n, Eigen::OuterStride<>(c_columns));
  scale(result, beta);
  if (k == 0 || alpha == T{0}) return;
  if (turn_a && turn_b)
    result.noalias() += alpha * left.transpose() * right.transpose();
  else if (turn_a)
    result.noalias() += alpha * left.transpose() * right;
  else if (turn_b)
    result.noalias() += alpha * left * right.transpose();
  else
    result.noalias() += alpha * left * right;
}

template <class T>
void gemv(const char* form, int m, int n, T alpha, const T* a, int a_columns, const T* x, int x_step, T beta,
          T* y, int y_step) {
  const bool turn = is_transposed(form);
  require(x_step > 0 && y_step > 0);
  const ConstMatrix<T> matrix(a, m, n, Eigen::OuterStride<>(a_columns));
  const ConstVector<T> given(x, turn ? m : n, Eigen::InnerStride<>(x_step));
  Vector<T> result(y, turn ? n : m, Eigen::InnerStride<>(y_step));
  scale(result, beta);
  if (turn)
    result.noalias() += alpha * matrix.transpose() * given;
  else
    result.noalias() += alpha * matrix * given;
}

template <class T>
void syrk(const char* triangle, const char* form, int n, int k, T alpha, const T* a, int a_columns, T beta,
          T* c, int c_columns) {
  require(*triangle == 'L' && *form == 'N');
  Matrix<T> result(c, n, n, Eigen::OuterStride<>(c_columns));
  scale(result.template triangularView<Eigen::Lower>(), beta);
  if (k > 0)
    result.template selfadjointView<Eigen::Lower>().rankUpdate(
        ConstMatrix<T>(a, n, k, Eigen::OuterStride<>(a_columns)), alpha);
}

/// Calls use(triangle), a lower one or, transposed, an upper one.
template <class T, class Use>
void with_triangle(const char* triangle, const char* form, const char* diagonal, int n, const T* a,
                   int a_columns, const Use& use) {
  require(*triangle == 'L' && *diagonal == 'N');
  const ConstMatrix<T> matrix(a, n, n, Eigen::OuterStride<>(a_columns));
  if (is_transposed(form))
    use(matrix.transpose().template triangularView<Eigen::Upper>());
  else
    use(matrix.template triangularView<Eigen::Lower>());
}

template <class T>
void trsm(const char* side, const char* triangle, const char* form, const char* diagonal, int m, int n,
          T alpha, const T* a, int a_columns, T* b, int b_columns) {
  const bool right = is_right(side);
  Matrix<T> result(b, m, n, Eigen::OuterStride<>(b_columns));
  scale(result, alpha);
  if (m == 0 || n == 0) return;
  with_triangle(triangle, form, diagonal, right ? n : m, a, a_columns, [&](const auto& divisor) {
    if (right)
      divisor.template solveInPlace<Eigen::OnTheRight>(result);
    else
      divisor.solveInPlace(result);
  });
}

template <class T>
void trmm(const char* side, const char* triangle, const char* form, const char* diagonal, int m, int n,
          T alpha, const T* a, int a_columns, T* b, int b_columns) {
  const bool right = is_right(side);
  Matrix<T> result(b, m, n, Eigen::OuterStride<>(b_columns));
  const Eigen::Matrix<T, Dynamic, Dynamic> given = alpha * result;
  with_triangle(triangle, form, diagonal, right ? n : m, a, a_columns, [&](const auto& factor) {
    if (right)
      result.noalias() = given * factor;
    else
      result.noalias() = factor * given;
  });
}

}  // namespace

#define ASHLAR_BLAS(letter, T)                                                                           \
  void letter##gemm_(const char* a_form, const char* b_form, const int* m, const int* n, const int* k,   \
                     const T* alpha, const T* a, const int* a_columns, const T* b, const int* b_columns, \
                     const T* beta, T* c, const int* c_columns) {                                        \
    gemm(a_form, b_form, *m, *n, *k, *alpha, a, *a_columns, b, *b_columns, *beta, c, *c_columns);        \
  }                                                                                                      \
  void letter##gemv_(const char* form, const int* m, const int* n, const T* alpha, const T* a,           \
                     const int* a_columns, const T* x, const int* x_step, const T* beta, T* y,           \
                     const int* y_step) {                                                                \
    gemv(form, *m, *n, *alpha, a, *a_columns, x, *x_step, *beta, y, *y_step);                            \
  }                                                                                                      \
  void letter##syrk_(const char* triangle, const char* form, const int* n, const int* k, const T* alpha, \
                     const T* a, const int* a_columns, const T* beta, T* c, const int* c_columns) {      \
    syrk(triangle, form, *n, *k, *alpha, a, *a_columns, *beta, c, *c_columns);                           \
  }                                                                                                      \
  void letter##trsm_(const char* side, const char* triangle, const char* form, const char* diagonal,     \
                     const int* m, const int* n, const T* alpha, const T* a, const int* a_columns, T* b, \
                     const int* b_columns) {                                                             \
    trsm(side, triangle, form, diagonal, *m, *n, *alpha, a, *a_columns, b, *b_columns);                  \
  }                                                                                                      \
  void letter##trmm_(const char* side, const char* triangle, const char* form, const char* diagonal,     \
                     const int* m, const int* n, const T* alpha, const T* a, const int* a_columns, T* b, \
                     const int* b_columns) {                                                             \
    trmm(side, triangle, form, diagonal, *m, *n, *alpha, a, *a_columns, b, *b_columns);                  \
  }

extern "C" {

ASHLAR_BLAS(s, float)
ASHLAR_BLAS(d, double)

void dtrsv_(const char* triangle, const char* form, const char* diagonal, const int* n, const double* a,
            const int* a_columns, double* x, const int* step) {
  require(*step > 0);
  Vector<double> result(x, *n, Eigen::InnerStride<>(*step));
  with_triangle(triangle, form, diagonal, *n, a, *a_columns,
                [&](const auto& divisor) { divisor.solveInPlace(result); });
}

/// @param info 0, or the number of the first column whose diagonal is not positive
int dpotrf_(const char* triangle, const int* n, double* a, const int* a_columns, int* info) {
  require(*triangle == 'L');
  Matrix<double> matrix(a, *n, *n, Eigen::OuterStride<>(*a_columns));
  *info = static_cast<int>(Eigen::internal::llt_inplace<double, Eigen::Lower>::blocked(matrix)) + 1;
  for (int k = 0; k < *n && *info == 0; ++k)
    if (!(matrix(k, k) > 0.0)) *info = k + 1;
  return 0;
}

}  // extern "C"
