#!/usr/bin/env bash
# Runs the scenes and draws the pictures of data/pictures again; about five minutes, most of them for the wall.
# Use: bash data/make_pictures.sh [SCENE]...   (names without .toml; default: all)
# PROGRAM names another ashlar, RESULTS a folder that keeps the results of the runs; scenes that have some there are
# not run again.
set -euo pipefail
data=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=${PROGRAM:-$data/../build/release/apps/ashlar}
if [[ -n ${RESULTS:-} ]]; then
  results=$RESULTS
else
  results=$(mktemp -d)
  trap 'rm -rf "$results"' EXIT
fi

# Pictures: scene, file name without .png, and options of `ashlar picture`.
pictures() {
  cat <<'LIST'
falling_block   falling_block_0000  --frame 0 --from 0.4,-1,0.3 --color von_mises
falling_block   falling_block_0950  --frame 95 --from 0.4,-1,0.3 --color von_mises
falling_block   falling_block_1350  --frame 135 --from 0.4,-1,0.3 --color von_mises
slope           slope               --frame 60 --from front --color stone --vectors velocity
incline         incline             --frame 50 --from 0.6,-1,0.4 --no-arrows
wedge           wedge               --frame 50 --from 1,-0.2,0.5 --no-arrows
rock_slope      rock_slope          --frame 18 --from -1,-0.35,0.45 --contacts none
tunnel_roof     tunnel_roof         --from 0.15,-1,0.1 --contacts none
bolted_roof     bolted_roof         --from 0.15,-1,0.1 --contacts none
shaken_slope    shaken_slope        --frame 9 --from 0.4,-1,0.3 --color velocity --frame-range --contacts none --without supports
arch_stands     arch_stands         --from 0.1,-1,0.1 --color stone --thrust-line --contacts none
arch_collapses  arch_collapses      --frame 55 --from 0.1,-1,0.1 --frame-range --zoom 1.3
columns         columns             --frame 36 --from 0.3,-1,0.2 --frame-range --contacts none
dominoes        dominoes            --frame 60 --from 0.5,-1,0.4 --no-arrows --zoom 1.4 --at 2.2,0,0.1
shaken_tower    shaken_tower        --frame 88  --from 0.3,-1,0.2 --frame-range --contacts none
wall            wall                --frame 75 --from 0.6,-1,0.3 --contacts none --scale 30 --frame-range
rockfall        rockfall            --frame 45 --from 0.3,-1,0.4 --color velocity --frame-range --contacts none --zoom 1.8 --at 7,0,4.5
masonry_bridge  masonry_bridge      --from front --color stone --force-chain --contacts none
dome            dome                --from 0.6,-1,0.7 --color pressure --contacts none
lintel          lintel              --from 0.15,-1,0.2 --color stone --contacts none --scale 3 --at 0,0.15,0.05 --zoom 1.25
facade          facade              --from 0.3,-1,0.2 --contacts none
drums           drums               --frame 57 --from 0.4,-1,0.2
hertz           hertz               --from 0.2,-0.8,-0.7 --color pressure --hide table --zoom 2.2 --at 0,0,0.09 --contacts none
LIST
}

while read -r scene picture options; do
  if [[ $# -gt 0 && " $* " != *" $scene "* ]]; then continue; fi
  folder=$results/$scene.out
  [[ -f $folder/summary.json ]] || "$program" run "$data/scenes/$scene.toml" --out "$folder" --force
  # shellcheck disable=SC2086  # options are words
  "$program" picture "$folder" --size 640x420 --sharpness 2 $options -o "$data/pictures/$picture.png"
done < <(pictures)
