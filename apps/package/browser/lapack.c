/* CHOLMOD declares this function of LAPACK without a result, which it has there, and in blas.cpp: in WebAssembly a call of
   another type does not work. It is compiled with -Ddpotrf_=dpotrf_without_result (build_libraries.sh). */
#undef dpotrf_
int dpotrf_(char *triangle, int *size, double *matrix, int *columns, int *info);

void dpotrf_without_result(char *triangle, int *size, double *matrix, int *columns, int *info) {
  (void)dpotrf_(triangle, size, matrix, columns, info);
}
