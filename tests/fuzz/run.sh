#!/usr/bin/env bash
# Runs fuzzers of the preset `fuzz`, one after the other, from the committed corpus and additions of earlier runs.
# Use: run.sh [INPUTS] [TARGET]..., by default 100000 inputs for each target
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
programs="$root/build/fuzz/tests/fuzz"
inputs=${1:-100000}
shift || true
targets=("$@")
((${#targets[@]} > 0)) || targets=(scene include formula record off obj stl ply groups gltf glb dxf package model checkpoint vtu pvd summary)

status=0
for target in "${targets[@]}"; do
  grown="$root/build/fuzz/corpus/$target"
  finds="$root/build/fuzz/finds/$target"
  mkdir -p "$grown" "$finds"
  # From the present program: stored states of another version are refused at once.
  [[ $target != checkpoint ]] || "$programs/replay_corpus" --seeds "$grown"
  echo "$target: $inputs inputs"
  nice "$programs/fuzz_$target" -runs="$inputs" -seed=1 -timeout=5 -rss_limit_mb=1024 -max_len=65536 -print_final_stats=1 \
    -verbosity=0 -artifact_prefix="$finds/" "$grown" "$root/tests/fuzz/corpus/$target" || status=1
done
exit $status
