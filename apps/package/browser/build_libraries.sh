#!/usr/bin/env bash
# Builds what the program needs, for WebAssembly, from Debian's source packages: see usage.
usage='use: apps/package/browser/build_libraries.sh FOLDER
Fills FOLDER with static libraries for WebAssembly, and with the headers that are the same for all systems. Needs
Debian 12 with the packages emscripten, clang, lld, ccache and dpkg-dev, those of apps/install_packages.sh, and a line
"deb-src" in the sources of apt. A library that is there is not built again. Takes 10 minutes with two processors.'
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if (($# != 1)) || [[ $1 == --help ]]; then
  echo "$usage"
  (($# == 1)) && exit 0 || exit 2
fi
mkdir -p "$1/sources" "$1/done" "$1/logs" "$1/include" "$1/lib/cmake"
root=$(cd "$1" && pwd)
jobs=${ASHLAR_JOBS:-$(nproc)}
archiver=llvm-ar
# The compiler that emcc calls, with emcc's options; emcc itself, which is a program in Python, takes longer than most
# sources. Exceptions are those of WebAssembly.
sysroot=/usr/share/emscripten/cache/sysroot
system_libraries=$sysroot/lib/wasm32-emscripten
flags=(--target=wasm32-unknown-emscripten "--sysroot=$sysroot" -mllvm -combiner-global-alias-analysis=false
  -mllvm -enable-emscripten-sjlj -mllvm -disable-lsr -Xclang "-iwithsysroot/include/compat" -ffp-contract=off)
cc="ccache clang ${flags[*]}"
cxx="ccache clang++ ${flags[*]} -D_LIBCPP_ABI_VERSION=2 -fno-threadsafe-statics -fwasm-exceptions"
# Programs that configure links, to find out what there is, are never run: functions of emscripten in JavaScript may be
# missing in them.
defined() { llvm-nm --defined-only "$system_libraries/libc.a" 2>/dev/null | awk 'NF == 3 { print $3 }' | sort -u; }
needed() { llvm-nm --undefined-only "$system_libraries/libc.a" 2>/dev/null | awk 'NF == 2 { print $2 }' | sort -u; }
comm -23 <(needed) <(defined) >"$root/javascript_functions"
# Options of the linker are the compiler's, since some checks pass no others. It links without an optimiser (-O0), which cannot
# read the programs that declare a function with a type that is not its own, as those of checks do.
link="-Qunused-arguments -nostdlib -L$system_libraries -Wl,--entry=main -lc -lcompiler_rt"
link="$link -Wl,--allow-undefined-file=$root/javascript_functions"
host=(--host=none CC="$cc $link" CXX="$cxx $link -lc++-except -lc++abi-except" AR="$archiver" RANLIB=llvm-ranlib CFLAGS=-O2 LDFLAGS=-O0)
build_compilers=()
read -ra compile <<<"$cc"
cmake_options=(-DASHLAR_BROWSER_LIBRARIES="$root" -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
# As in toolchain.cmake.
vectors=(-msimd128 -fno-vectorize -fno-slp-vectorize -DEIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS=16)
gmp_options=(--disable-assembly)
qd_flags='-O2 -ffp-contract=off'
metis_edit=''
cholmod_flags=(-Ddpotrf_=dpotrf_without_result)
cholmod_sources=("$here/lapack.c")
source "$here/../libraries.sh"

# Eigen takes the vectors of WebAssembly for those of SSE2, so that its sums have the order, and the bits, that they have on
# processors of PCs. Its choice of an old GCC, for which it has instructions in assembler, is clang's other name. clang 14 moves
# the load of a number that fills a vector behind a store to the same place, unless it does not see where the number is from.
build_eigen_with_vectors() {
  local eigen=$root/include/eigen3/Eigen/src/Core
  rm -rf "$root/include/eigen3" # the link to that of Linux
  cp -rT /usr/include/eigen3 "$root/include/eigen3"
  sed -i -e 's/#if (defined __SSE2__) &&/#if (defined __wasm_simd128__) \&\&/' \
    -e 's/#include <mmintrin.h>/#define __SSE__ 1\n#define __SSE2__ 1/' \
    -e 's/#include <xmmintrin.h>/&\n#undef __SSE__\n#undef __SSE2__/' "$eigen/util/ConfigureVectorization.h"
  sed -i -e 's/#if EIGEN_COMP_GNUC && EIGEN_COMP_GNUC < 63/#if 0/' \
    -e 's/{ return \(_mm_set1_pd\|_mm_set_ps1\|_mm_set1_epi32\)(from); }/{ auto value = from; asm("" : "+r"(value)); return \1(value); }/' \
    "$eigen/arch/SSE/PacketMath.h"
  grep -qF '__wasm_simd128__' "$eigen/util/ConfigureVectorization.h" && grep -qF '"+r"(value)' "$eigen/arch/SSE/PacketMath.h" ||
    { echo 'error: vectors of Eigen are not where they were in version 3.4.0' >&2; return 1; }
}

# Limbs of 64 bits, which CGAL's Mpzf needs; configure has them for processors that it knows.
build_gmp_64() {
  unpack gmp
  sed -i 's/^case \$limb_chosen in/limb_chosen=longlong\n&/' "$root/sources/gmp/configure"
  build_gmp
}

build_zlib() {
  unpack zlib
  cd "$root/sources/zlib"
  compiled z -D_LARGEFILE64_SOURCE=1 -DHAVE_UNISTD_H -- {adler32,crc32,deflate,infback,inffast,inflate,inftrees,trees,zutil,compress,uncompr}.c
  cp zlib.h zconf.h "$root/include"
}

# Eigen's kernels behind the names of BLAS.
build_blas() {
  mkdir -p "$root/sources/blas-objects"
  $cxx -std=c++17 -O2 -DNDEBUG "${vectors[@]}" -isystem "$root/include/eigen3" -c "$here/blas.cpp" -o "$root/sources/blas-objects/blas.o"
  "$archiver" rcs "$root/lib/libblas.a" "$root/sources/blas-objects/blas.o"
}

build_all headers eigen_with_vectors zlib gmp_64 mpfr googletest fmt qd metis suitesparse blas muparser expat
