#!/usr/bin/env bash
# Makes the page that runs Ashlar in a browser with one command: see usage.
usage='use: apps/package/browser/make_browser.sh [OPTION]...
Builds the libraries (build_libraries.sh), then the program for WebAssembly, and packs
build/ashlar-VERSION-browser.html: program, scenes and editor in one file, which needs no network.

  --tests    build the tests too that tests/browser runs in node'
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
cd "$root"
targets=(ashlar)
while (($#)); do
  case $1 in
    --tests) targets+=(oracle_tests oracle_comparison_tests) ;;
    --help) echo "$usage"; exit 0 ;;
    *) printf 'error: unknown option %s\n%s\n' "$1" "$usage" >&2; exit 2 ;;
  esac
  shift
done

jobs=${ASHLAR_JOBS:-$(bash apps/build_jobs.sh)}
ASHLAR_JOBS=$jobs bash apps/package/browser/build_libraries.sh build/browser-libraries
cmake --preset browser
cmake --build --preset browser -j"$jobs" --target "${targets[@]}"
python3 apps/package/browser/make_page.py
