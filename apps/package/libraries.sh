# For scripts that build libraries for another system (windows/build_libraries.sh, browser/build_libraries.sh), which set
# before they read this: root, the folder to fill; here, their own folder; jobs; and
#   host            arguments of configure that name the system, CFLAGS and LDFLAGS among them
#   build_compilers those of make, where they differ from the ones of configure
#   compile         the C compiler with its options
#   archiver        ar for its objects
#   cmake_options   what CMake needs besides the toolchain file
#   gmp_options, qd_flags, metis_edit, cholmod_flags, cholmod_sources: of these libraries on that system
# Each library has a function build_NAME; build_all calls those that have not succeeded yet.

stop() { printf 'build_libraries.sh: %s\n' "$*" >&2; exit 1; }

# The sources of a package, with Debian's changes, in sources/NAME.
unpack() {
  [[ ! -e $root/sources/$1 ]] || return 0
  local found=("$root/sources/$1"_*.dsc)
  if [[ ! -e ${found[-1]} ]]; then
    (cd "$root/sources" && apt-get source --download-only "$1") || stop "apt-get cannot get the sources of $1"
    found=("$root/sources/$1"_*.dsc)
  fi
  dpkg-source --no-check -x "${found[-1]}" "$root/sources/$1"
}

# use: configured NAME OPTION...: by autotools.
configured() {
  local name=$1
  shift
  cd "$root/sources/$name"
  ./configure --build=x86_64-linux-gnu --prefix="$root" --disable-shared --enable-static "${host[@]}" "$@"
  make -j"$jobs" "${build_compilers[@]}"
  make install
}

# use: by_cmake NAME FOLDER OPTION...: in the build's folder, where HDF5 looks for what its own programs write.
by_cmake() {
  local name=$1 source=$root/sources/$1/$2
  shift 2
  mkdir -p "$root/sources/$name-build"
  cd "$root/sources/$name-build"
  cmake -S "$source" -B . -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE="$here/toolchain.cmake" "${cmake_options[@]}" \
    -DCMAKE_INSTALL_PREFIX="$root" -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=OFF "$@"
  cmake --build . -j"$jobs"
  cmake --install .
}

# use: compiled ARCHIVE FLAG... -- SOURCE...
compiled() {
  local archive=$1 flags=() source object
  shift
  while [[ $1 != -- ]]; do flags+=("$1"); shift; done
  shift
  mkdir -p "$root/sources/$archive-objects"
  for source in "$@"; do
    object=$root/sources/$archive-objects/${source//\//_}.o
    printf '%s\0' -c "$source" -o "$object"
  done | xargs -0 -n 4 -P "$jobs" "${compile[@]}" -O2 "${flags[@]}"
  "$archiver" rcs "$root/lib/lib$archive.a" "$root/sources/$archive-objects"/*.o
}

# Headers of libraries without code, and CMake files of some. /usr/include itself would bring those of Linux.
build_headers() {
  local name
  for name in CGAL boost eigen3 CLI toml++ nlohmann; do ln -sfn "/usr/include/$name" "$root/include/$name"; done
  mkdir -p "$root/share/cmake" "$root/share/eigen3"
  cp -rT /usr/share/eigen3/cmake "$root/share/eigen3/cmake"
  cp -rT /usr/share/cmake/CLI11 "$root/share/cmake/CLI11"
  cp -rT /usr/share/cmake/nlohmann_json "$root/share/cmake/nlohmann_json"
}

build_gmp() {
  unpack gmp
  mkdir -p "$root/sources/gmp/doc" # Debian's sources have no manual, which configure expects
  printf 'all install:\n' >"$root/sources/gmp/doc/Makefile.in"
  configured gmp --enable-cxx CC_FOR_BUILD=gcc "${gmp_options[@]}"
}

build_mpfr() {
  unpack mpfr4
  configured mpfr4 --with-gmp="$root" --enable-thread-safe
}

# Debian's changes of this package are about Fortran, which is not built.
build_qd() {
  if [[ ! -e $root/sources/qd ]]; then
    [[ -e $(echo "$root"/sources/qd_*.orig.tar.*) ]] || (cd "$root/sources" && apt-get source --tar-only --download-only qd)
    mkdir "$root/sources/qd"
    tar -xf "$root"/sources/qd_*.orig.tar.* -C "$root/sources/qd" --strip-components=1
  fi
  cd "$root/sources/qd"
  [[ -x configure ]] || autoreconf -fi
  touch docs/qd.pdf # its manual needs TeX
  configured qd --disable-fortran CXXFLAGS="$qd_flags"
}

# Its random numbers are its own: those of the C library of Windows have 15 bits.
build_metis() {
  unpack metis
  cd "$root/sources/metis"
  sed -i "$metis_edit" GKlib/gk_arch.h
  compiled metis -w -Iinclude -Ilibmetis -IGKlib -DUSE_GKREGEX -DUSE_GKRAND -DNDEBUG -DNDEBUG2 -- libmetis/*.c \
    GKlib/{blas,error,gkregex,memory,mcore,random,sort,util,timers,pqueue,string}.c
  cp include/metis.h "$root/include"
}

# CHOLMOD for indices of 32 bits, with the orderings that it calls.
build_suitesparse() {
  unpack suitesparse
  cd "$root/sources/suitesparse"
  local parts=(SuiteSparse_config AMD/Include COLAMD/Include CAMD/Include CCOLAMD/Include CHOLMOD/Include)
  mkdir -p "$root/include/suitesparse"
  cp SuiteSparse_config/*.h {AMD,COLAMD,CAMD,CCOLAMD,CHOLMOD}/Include/*.h "$root/include/suitesparse"
  compiled cholmod "${parts[@]/#/-I}" -DDINT -DNTIMER "${cholmod_flags[@]}" -I"$root/include" -- \
    "$here/../complex_blas.c" "${cholmod_sources[@]}" \
    SuiteSparse_config/SuiteSparse_config.c \
    {AMD,COLAMD,CAMD,CCOLAMD}/Source/*.c CHOLMOD/{Check,Cholesky,Core,MatrixOps,Modify,Partition,Supernodal}/cholmod_*.c
}

# use: openblas OPTION...: real numbers alone; its own versions of the few functions of LAPACK that CHOLMOD calls are enough.
openblas() {
  unpack openblas
  cd "$root/sources/openblas"
  make libs HOSTCC=gcc CROSS=1 NOFORTRAN=1 NO_SHARED=1 USE_THREAD=0 NO_CBLAS=1 NO_LAPACKE=1 BUILD_SINGLE=1 BUILD_DOUBLE=1 \
    SMALL_MATRIX_OPT=0 MAKE_NB_JOBS="$jobs" "$@"
  cp libopenblas*-r*.a "$root/lib/libopenblas.a"
}

build_hdf5() {
  unpack hdf5
  sed -i '/sys\/wait.h/d' "$root/sources/hdf5/src/H5private.h"
  by_cmake hdf5 . -DHDF5_BUILD_TOOLS=OFF -DHDF5_BUILD_EXAMPLES=OFF -DHDF5_BUILD_HL_LIB=OFF -DBUILD_TESTING=OFF \
    -DHDF5_BUILD_CPP_LIB=OFF -DHDF5_ENABLE_Z_LIB_SUPPORT=ON -DHDF5_ENABLE_SZIP_SUPPORT=OFF
}

build_fmt() { unpack fmtlib; by_cmake fmtlib . -DFMT_TEST=OFF -DFMT_DOC=OFF; }
build_muparser() { unpack muparser; by_cmake muparser . -DENABLE_SAMPLES=OFF -DENABLE_OPENMP=OFF; }
build_googletest() { unpack googletest; by_cmake googletest .; }

# Debian's corrections compare with 1 what CMake's settings define without a value.
build_expat() {
  unpack expat
  sed -i 's/^#cmakedefine XML_DTD$/& 1/' "$root/sources/expat/expat/expat_config.h.cmake"
  by_cmake expat expat -DEXPAT_BUILD_TOOLS=OFF -DEXPAT_BUILD_EXAMPLES=OFF -DEXPAT_BUILD_TESTS=OFF \
    -DEXPAT_SHARED_LIBS=OFF -DEXPAT_BUILD_DOCS=OFF
}

# use: build_all LIBRARY...
build_all() {
  local library status
  for library in "$@"; do
    [[ ! -e $root/done/$library ]] || continue
    printf '%s\n' "$library"
    # Not as a condition: the shell would go on after a command that fails.
    set +e
    (set -e; "build_$library") >"$root/logs/$library" 2>&1
    status=$?
    set -e
    ((status == 0)) || stop "$library is not built; the last lines of $root/logs/$library:
$(tail -n 20 "$root/logs/$library")"
    touch "$root/done/$library"
  done
}
