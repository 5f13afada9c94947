// Dense kernels of a Cholesky factor in single or double precision, matrices by columns: BLAS with the types of its
// arguments, and small triangles, for which calls of a library take longer than the work.
#pragma once

namespace ashlar {

/// C -= A B'. @param a (m, k), b (n, k), c (m, n), each with the distance of its columns
template <class T>
void subtract_product(int m, int n, int k, const T* a, int a_columns, const T* b, int b_columns, T* c,
                      int c_columns);
/// Lower triangle of C = beta C - A A'. @param a (n, k), c (n, n)
template <class T>
void subtract_square(int n, int k, const T* a, int a_columns, T beta, T* c, int c_columns);
/// B = B / L', or with `transposed` B / L. @param b (m, n), l (n, n) lower triangle
template <class T>
void divide_by_triangle(int m, int n, const T* l, int l_columns, bool transposed, T* b, int b_columns);
/// y = beta y + A x, or with `transposed` A' x. @param a (m, n). @param beta 0: y has no values yet
template <class T>
void times_vector(int m, int n, const T* a, int a_columns, bool transposed, const T* x, T beta, T* y);

/// Replaces the lower triangle of a symmetric matrix by its Cholesky factor. The upper one is not used.
/// @param a (n, n). @return false if it is not positive definite; it is then partly overwritten
template <class T>
[[nodiscard]] bool factorize_triangle(int n, T* a, int a_columns);
/// Replaces a lower triangle by its inverse. The upper triangle is not used.
template <class T>
void invert_triangle(int n, T* l, int l_columns);

}  // namespace ashlar
