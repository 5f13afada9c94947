#!/usr/bin/env bash
# Makes the archive for Windows with one command: see usage.
usage='use: apps/package/windows/make_windows.sh [OPTION]...
Builds the libraries (build_libraries.sh), then the program for 64-bit Windows, and packs
build/ashlar-VERSION-windows-x86_64.zip: the program, which needs no other file, scenes, meshes, cases, licences.

  --tests    build the tests too that tests/windows runs'
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
cd "$root"
targets=(ashlar)
while (($#)); do
  case $1 in
    --tests) targets+=(geometry_tests mechanics_tests oracle_tests oracle_comparison_tests) ;;
    --help) echo "$usage"; exit 0 ;;
    *) printf 'error: unknown option %s\n%s\n' "$1" "$usage" >&2; exit 2 ;;
  esac
  shift
done

version=$(sed -n 's/^project(ashlar VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
name=ashlar-$version-windows-x86_64
jobs=${ASHLAR_JOBS:-$(bash apps/build_jobs.sh)}
libraries=build/windows-libraries

ASHLAR_JOBS=$jobs bash apps/package/windows/build_libraries.sh "$libraries"
cmake --preset windows
cmake --build --preset windows -j"$jobs" --target "${targets[@]}"

stage=build/windows/archive
rm -rf "$stage"
mkdir -p "$stage/$name/bin" "$stage/$name/share/ashlar" "$stage/$name/licences"
x86_64-w64-mingw32-strip -o "$stage/$name/bin/ashlar.exe" build/windows/apps/ashlar.exe
cp -r data/scenes data/meshes data/verification "$stage/$name/share/ashlar"
cp LICENSE "$stage/$name/licences/ashlar"
cp apps/docs/howto/windows.md "$stage/$name/README.md"
# Everything that is inside the program: what is built here, and headers and compiler of Debian.
for source in "$libraries"/sources/*/debian/copyright; do
  cp "$source" "$stage/$name/licences/$(basename "$(dirname "$(dirname "$source")")")"
done
for package in libcgal-dev libboost1.74-dev libeigen3-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev \
  libz-mingw-w64 libjs-three libjs-chart.js gcc-mingw-w64-base mingw-w64-common; do
  [[ ! -e /usr/share/doc/$package/copyright ]] || cp "/usr/share/doc/$package/copyright" "$stage/$name/licences/$package"
done
(cd "$stage" && cmake -E tar cf "$root/build/$name.zip" --format=zip "$name")
printf '%s\n' "build/$name.zip"
