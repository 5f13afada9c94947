#!/usr/bin/env bash
# Makes all files of a release with one command: see usage.
usage='use: apps/package/release.sh [OPTION]...
Checks that the tree is ready, builds and tests it, and writes the files of a release:

  ashlar-VERSION.tar.gz, .zip            the sources, as committed
  ashlar-VERSION-linux-ARCH.tar.gz       the program, its libraries, the wheel: runs without packages
  ashlar-VERSION-windows-x86_64.zip      the program for Windows, with --windows
  ashlar-VERSION-cp*-manylinux_*.whl     the Python module, for pip
  *.deb                                  Debian packages
  ashlar-VERSION-book.zip                the documentation site, where Sphinx and Doxygen are
  ashlar-VERSION-example.html            the page of results of a tunnel roof, for any browser
  ashlar-VERSION-browser.html            the program as a page, where build/ has it (apps/package/browser/make_browser.sh)
  sbom.spdx.json                         packages that the libraries come from
  SHA256SUMS                             of all of these

  --out DIR      folder of the files, new or empty (default: build/release-files)
  --build DIR    use this build as it is, without building and testing
  --skip-tests   build, but do not test
  --windows      the archive for Windows too; needs what apps/docs/howto/windows.md lists, and builds its libraries once
  --tag          at the end, tag the commit as vVERSION (nothing is pushed)'
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"

out=$root/build/release-files
build=
given=no
tests=yes
windows=no
tag=no
while (($#)); do
  case $1 in
    --out) out=$(realpath -m -- "${2:?--out needs a folder}"); shift ;;
    --build) build=$(realpath -- "${2:?--build needs a folder}"); given=yes; tests=no; shift ;;
    --skip-tests) tests=no ;;
    --windows) windows=yes ;;
    --tag) tag=yes ;;
    --help) echo "$usage"; exit 0 ;;
    *) printf 'error: unknown option %s\n%s\n' "$1" "$usage" >&2; exit 2 ;;
  esac
  shift
done

say() { printf '\n=== %s\n' "$*"; }
stop() { printf 'release.sh: %s\n' "$*" >&2; exit 1; }

version=$(sed -n 's/^project(ashlar VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
name=ashlar-$version

# Steps that are easily forgotten: each line says what to do.
check_tree() {
  say "checks of $version"
  git rev-parse --git-dir >/dev/null 2>&1 || stop 'there is no history; a release is made in a clone'
  [[ -z $(git status --porcelain) ]] || stop 'the tree has changes that are not committed; commit or remove them'
  [[ -z $(git tag --list "v$version") ]] || stop "v$version exists; give CMakeLists.txt and CITATION.cff a new version"
  grep -q "^version: \"\?$version\"\?$" CITATION.cff || stop "CITATION.cff has another version than CMakeLists.txt ($version)"
  grep -q "^date-released: " CITATION.cff || stop 'CITATION.cff has no date-released'
  grep -q "^## .*$version.*[0-9]\{4\}-[0-9]\{2\}-[0-9]\{2\}" CHANGELOG.md ||
    stop "CHANGELOG.md has no heading with $version and its date"
  [[ ! -e $out || -z $(ls -A "$out") ]] || stop "$out is not empty; give another folder by --out"
  mkdir -p "$out"
}

build_and_test() {
  say 'build'
  build=$root/build/release
  cmake --preset release
  cmake --build --preset release -j"$(bash apps/build_jobs.sh)"
  [[ $tests == no ]] && return
  say 'tests'
  ctest --preset release -j"$(nproc)"
}

write_sources() {
  say 'sources'
  git archive --prefix="$name/" -o "$out/$name.tar.gz" HEAD
  git archive --prefix="$name/" -o "$out/$name.zip" HEAD
}

write_binaries() {
  say 'archive, wheel, Debian packages'
  python3 apps/package/make_archive.py "$build" --out "$out" --wheel --debian
  rm "$out"/*.tar.gz.sha256
  tar -xzf "$out/$name-linux-$(uname -m).tar.gz" -C "$out" --strip-components=1 --wildcards '*/sbom.spdx.json'
}

write_windows() {
  say 'archive for Windows'
  bash apps/package/windows/make_windows.sh
  cp "build/$name-windows-x86_64.zip" "$out"
  [[ $tests == no ]] || /usr/bin/python3 tests/windows/windows_test.py build/windows/apps/ashlar.exe "$build/apps/ashlar"
}

write_pages() {
  say 'pages'
  local work
  work=$(mktemp -d)
  trap 'rm -rf "$work"' RETURN
  "$build/apps/ashlar" run data/scenes/tunnel_roof.toml --out "$work/roof" --quiet
  "$build/apps/ashlar" view "$work/roof" --out "$out/$name-example.html"
  if [[ $given == no ]] && cmake --build "$build" --target help | grep '^docs\b' >/dev/null; then
    cmake --build "$build" --target docs
  fi
  if [[ -f $build/docs/html/index.html ]]; then
    python3 -c 'import shutil, sys; shutil.make_archive(sys.argv[1], "zip", sys.argv[2])' "$out/$name-book" "$build/docs/html"
  else
    echo 'no site: Sphinx or Doxygen is not there, or the build has none'
  fi
}

write_browser() {
  local page=build/$name-browser.html
  [[ -f $page ]] || { echo 'no page that runs the program: apps/package/browser/make_browser.sh makes it'; return 0; }
  cp "$page" "$out"
}

check_tree
[[ -n $build ]] || build_and_test
write_sources
write_binaries
[[ $windows == no ]] || write_windows
write_pages
write_browser
(cd "$out" && sha256sum -- * >SHA256SUMS.new && mv SHA256SUMS.new SHA256SUMS)
[[ $tag == no ]] || git tag -a "v$version" -m "Ashlar $version"
say "$name: $out"
cat "$out/SHA256SUMS"
