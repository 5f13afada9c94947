# BLAS as build_libraries.sh makes it. CMake's own module asks for functions that it has not.
find_library(BLAS_LIBRARY blas)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BLAS DEFAULT_MSG BLAS_LIBRARY)
if(BLAS_FOUND AND NOT TARGET BLAS::BLAS)
  add_library(BLAS::BLAS UNKNOWN IMPORTED)
  set_target_properties(BLAS::BLAS PROPERTIES IMPORTED_LOCATION "${BLAS_LIBRARY}")
endif()
