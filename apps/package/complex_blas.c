/* CHOLMOD calls these functions of BLAS and LAPACK for complex matrices. The program has none, and OpenBLAS is built
   without them: build_libraries.sh. */
#include <stdlib.h>

void zgemm_(void) { abort(); }
void zgemv_(void) { abort(); }
void zherk_(void) { abort(); }
void zpotrf_(void) { abort(); }
void ztrsm_(void) { abort(); }
void ztrsv_(void) { abort(); }
