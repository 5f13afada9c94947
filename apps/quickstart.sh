#!/usr/bin/env bash
# From a bare Debian 12 to a first result: installs what is missing, builds ashlar, runs the falling block.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

# What only tests and checks need is half of all that would be downloaded.
bash apps/install_packages.sh --except '^clang|vtk|^chromium|^pybind11|^python3-|^furo|^doxygen|^mypy|^pkg-config'
cmake --preset release
cmake --build --preset release --target ashlar -j"$(bash apps/build_jobs.sh)"

program=build/release/apps/ashlar
scene=data/scenes/falling_block.toml
results=falling_block.out
"$program" run "$scene" --out "$results" --view --force

cat <<END

Done. A block fell on a cantilever; the results are in $root/$results:
  view.html                  look at it: open this file in any browser
  blocks.pvd, contacts.pvd   the moving blocks and their contacts: open them in ParaView
  history.csv                positions, energies and contacts, a row for each step
  summary.json               steps, times, energy error
Next: change the scene and run it again,
  $root/$program run $root/$scene --out my.out --set 'analysis.time_step=5e-4'
END
