#!/usr/bin/env bash
# Builds ashlar with warnings as errors and runs all its tests.
usage='use: tests/run.sh [OPTION]...
  (nothing)      the release build, warnings as errors, and all its tests; then the program with MPI and its tests
  --format       also check that all sources are formatted
  --lint         also --format, and clang-tidy on all sources
  --clang        also build and test with clang
  --geometry     also the tests of geometry, readers of meshes among them, with the address and undefined
                 sanitizers
  --sanitizers   also build and test with the address and undefined sanitizers, then with the thread sanitizer
  --windows      also build the program for Windows, and test it in Wine; skipped where its compiler or Wine is missing
  --browser      also build the program for browsers, and test it in node and Chromium; skipped where emscripten is missing
  --all          all of these but --windows and --browser
  --only PRESET  build and test this preset of CMakePresets.json instead of release'
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

presets=(release)
format=no
lint=no
geometry=no
windows=no
browser=no
while (($#)); do
  case $1 in
    --format) format=yes ;;
    --lint) format=yes lint=yes ;;
    --clang) presets+=(clang) ;;
    --geometry) geometry=yes ;;
    --sanitizers) presets+=(asan tsan) ;;
    --windows) windows=yes ;;
    --browser) browser=yes ;;
    --all) format=yes lint=yes presets+=(clang asan tsan) ;;
    --only) presets=("${2:?--only needs the name of a preset}"); shift ;;
    --help) echo "$usage"; exit 0 ;;
    *) printf 'error: unknown option %s\n%s\n' "$1" "$usage" >&2; exit 2 ;;
  esac
  shift
done

say() { printf '\n=== %s\n' "$*"; }

sources() { find geometry mechanics solver apps tests \( -name '*.cpp' -o -name '*.hpp' \) -print0 | sort -z; }

# Skipped without a history, as in an archive of the sources.
check_subjects() {
  say 'subjects of commits'
  /usr/bin/python3 tests/docs/commit_subjects.py . || (($? == 77))
}

check_format() {
  say 'format'
  sources | xargs -0 clang-format --dry-run -Werror
}

# clang-tidy understands the command lines of the clang build; they need no compiled files.
run_clang_tidy() {
  say 'clang-tidy'
  cmake --preset clang
  sources | grep -z '\.cpp$' | grep -zEv '^tests/(package/|fuzz/fuzz_main)' |
    xargs -0 -n 1 -P "$jobs" clang-tidy --quiet -p build/clang
}

build_and_test() {
  say "$1: build"
  cmake --preset "$1"
  cmake --build --preset "$1" -j"$jobs"
  say "$1: tests"
  ctest --preset "$1" -j"$(nproc)"
}

# The program with MPI from the objects of the release build, which gets its own program back.
check_mpi() {
  build_and_test mpi
  cmake --preset release >/dev/null
  cmake --build --preset release -j"$jobs" --target ashlar
}

# A part of the sanitizers' runs that is done in minutes.
check_geometry() {
  say 'asan: geometry'
  cmake --preset asan
  cmake --build --preset asan -j"$jobs" --target geometry_tests
  build/asan/tests/geometry_tests --gtest_brief=1 --gtest_filter='-*FiftyThousandPairs*:*MillionVariants*'
}

# The program for Windows beside that of the release build, which it is compared with.
check_windows() {
  say 'windows'
  local tool
  for tool in x86_64-w64-mingw32-g++-posix wine; do
    command -v "$tool" >/dev/null || { printf 'skipped: there is no %s (apps/docs/howto/windows.md)\n' "$tool"; return 0; }
  done
  ASHLAR_JOBS=$jobs bash apps/package/windows/make_windows.sh --tests
  local test
  for test in oracle_tests oracle_comparison_tests geometry_tests mechanics_tests; do
    find build/windows/tests -name "$test.exe" -exec env WINEDEBUG=-all wine {} --gtest_brief=1 \;
  done
  /usr/bin/python3 tests/windows/windows_test.py build/windows/apps/ashlar.exe build/release/apps/ashlar
}

# The same for browsers.
check_browser() {
  say 'browser'
  local tool status
  for tool in em++ node; do
    command -v "$tool" >/dev/null || { printf 'skipped: there is no %s (apps/docs/howto/browser.md)\n' "$tool"; return 0; }
  done
  ASHLAR_JOBS=$jobs bash apps/package/browser/make_browser.sh --tests
  /usr/bin/python3 tests/browser/program_test.py build/browser build/release/apps/ashlar
  status=0
  /usr/bin/python3 tests/browser/run_page_test.py build/ashlar-*-browser.html || status=$?
  ((status == 0 || status == 77))
}

bash apps/install_packages.sh
jobs=$(bash apps/build_jobs.sh)
if command -v ccache >/dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$root
  export CCACHE_SLOPPINESS=pch_defines,time_macros # without it ccache keeps nothing that uses precompiled headers
fi

check_subjects
[[ $format == no ]] || check_format
for preset in "${presets[@]}"; do
  build_and_test "$preset"
  [[ $preset != release ]] || check_mpi
done
[[ $geometry == no ]] || check_geometry
[[ $windows == no ]] || check_windows
[[ $browser == no ]] || check_browser
[[ $lint == no ]] || run_clang_tidy
say "passed: ${presets[*]}$([[ $format == no ]] || echo ' format')$([[ $lint == no ]] || echo ' clang-tidy')"
