#!/usr/bin/env bash
# Commands under limits of address space end: with their result, or with a message and exit status 1.
# Use: address_space.sh PROGRAM SCENE
set -u
program=$1
scene=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
faults=0

# @param limit in kB, name, exit statuses that are allowed, command
try() {
  local limit=$1 allowed=$2
  shift 2
  (ulimit -v "$limit" && exec timeout -k 5 60 "$@") >"$folder/out" 2>"$folder/err"
  local status=$?
  if [[ " $allowed " != *" $status "* ]]; then
    echo "exit status $status at $limit kB: $*"
    cat "$folder/err"
    faults=1
  elif ((status == 1)) && ! grep -q "out of memory" "$folder/err"; then
    echo "no word of memory at $limit kB: $*"
    cat "$folder/err"
    faults=1
  fi
}

try 200000 "0" "$program" --version
# Below some limit the system cannot even load the program's libraries (127).
for limit in 400000 300000 200000 170000 150000 130000 120000 110000; do
  try "$limit" "0 1 127" "$program" check "$scene"
  rm -rf "$folder/run"
  try "$limit" "0 1 127" "$program" run "$scene" --set analysis.end_time=0.02 --out "$folder/run" --quiet
done
exit $faults
