#!/usr/bin/env bash
# Builds what the program needs, for Windows, from Debian's source packages: see usage.
usage='use: apps/package/windows/build_libraries.sh FOLDER
Fills FOLDER with static libraries for 64-bit Windows, and with the headers that are the same for all systems. Needs
Debian 12 with the packages g++-mingw-w64-x86-64-posix, libz-mingw-w64-dev, wine64 and dpkg-dev, those of
apps/install_packages.sh, and a line "deb-src" in the sources of apt. A library that is there is not built again.
Takes 20 minutes with two processors.'
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if (($# != 1)) || [[ $1 == --help ]]; then
  echo "$usage"
  (($# == 1)) && exit 0 || exit 2
fi
mkdir -p "$1/sources" "$1/done" "$1/logs" "$1/include" "$1/lib/cmake"
root=$(cd "$1" && pwd)
triple=x86_64-w64-mingw32
jobs=${ASHLAR_JOBS:-$(nproc)}
archiver=$triple-gcc-ar-posix
host=(--host=$triple CC=$triple-gcc-posix CXX=$triple-g++-posix AR="$archiver" RANLIB=$triple-gcc-ranlib-posix
  CFLAGS=-O2)
build_compilers=()
compile=($triple-gcc-posix)
cmake_options=(-DASHLAR_WINDOWS_LIBRARIES="$root")
gmp_options=(--enable-fat)
qd_flags='-O2 -ffp-contract=off'
metis_edit='/sys\/resource.h/d' # a header that Windows has not
cholmod_flags=()
cholmod_sources=()
source "$here/../libraries.sh"

# The kernels are chosen when the program starts: those for AVX2, or those that all 64-bit processors can run.
build_openblas() {
  unpack openblas
  # Debian's compiler says "12-posix" for its version, which would count as older than 4.7, without AVX2.
  (cd "$root/sources/openblas" && sed -i 's/-dumpversion\( |\|`\)/-dumpversion | cut -f1 -d-\1/' c_check Makefile.{system,x86_64})
  openblas CC=$triple-gcc-posix FC=true AR="$archiver" RANLIB=$triple-gcc-ranlib-posix \
    TARGET=PRESCOTT DYNAMIC_ARCH=1 DYNAMIC_LIST=HASWELL BINARY=64 USE_LOCKING=1 NUM_THREADS=64
}

build_tbb() {
  unpack onetbb
  by_cmake onetbb . -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
}

build_all headers fmt muparser expat metis openblas tbb suitesparse gmp mpfr qd hdf5 googletest
