#!/usr/bin/env bash
# A sweep that is killed leaves no run behind: killed_sweep.sh PROGRAM SCENE
set -euo pipefail
folder=$(mktemp -d)
trap 'pkill -KILL -f "$folder" || true; rm -rf "$folder"' EXIT
"$1" sweep "$2" --set analysis.end_time=100000 --vary contact.friction_angle=10,20 -j 2 -o "$folder/t.csv" &
sweep=$!
for _ in $(seq 200); do
  [[ $(find "$folder/t.runs" -name history.csv 2>/dev/null | wc -l) -lt 2 ]] || break
  sleep 0.1
done
[[ $(pgrep -cf "$folder") -ge 3 ]] || { echo "the sweep and two runs are not there"; exit 1; }
kill -KILL "$sweep"
for _ in $(seq 200); do
  pgrep -f "$folder" >/dev/null || exit 0
  sleep 0.1
done
echo "runs go on without their sweep"
exit 1
