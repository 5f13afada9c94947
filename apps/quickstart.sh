#!/usr/bin/env bash
# From a bare Debian 12 to a first result: installs missing packages, builds program and Python module in one build,
# runs the falling block and puts `ashlar` on the PATH, or prints the line that does.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

# Packages that only tests and checks need are half of the download.
tests_only='^clang|mpi|petsc|ptscotch|vtk|^chromium|^furo|^doxygen|^jupyter|^mypy|^pkg-config'
tests_only+='|^python3-(breathe|cvxopt|h5py|ipykernel|jsonschema|matplotlib|meshio|myst-parser|pip|pytest|setuptools|sphinx|venv|wheel)'
bash apps/install_packages.sh --except "$tests_only"
cmake --preset release
cmake --build --preset release --target ashlar ashlar_python -j"$(bash apps/build_jobs.sh)"

program=$root/build/release/apps/ashlar
scene=data/scenes/tunnel_roof.toml
results=tunnel_roof.out
"$program" run "$scene" --out "$results" --view --force

# A link in the user's own folder of programs, unless something else has its name.
bin=$HOME/.local/bin
if [[ ":$PATH:" == *":$bin:"* && ( -L $bin/ashlar || ! -e $bin/ashlar ) ]]; then
  mkdir -p "$bin"
  ln -sfn "$program" "$bin/ashlar"
  path="\`ashlar\` is on the PATH: $bin/ashlar."
else
  path="To have \`ashlar\` on the PATH, run this line, and add it to ~/.bashrc:
  export PATH=\"$root/build/release/apps:\$PATH\""
fi

cat <<END

Done. A tunnel was excavated, and the wedge of its roof fell; the results are in $root/$results:
  view.html                  open this file in any browser
  blocks.pvd, contacts.pvd   the moving blocks and their contacts, for ParaView
  history.csv                positions, energies and contacts, a row for each step
  summary.json               who fell and when, times, energy error
$path
For Python:
  export PYTHONPATH="$root/build/release/apps/python"
  /usr/bin/python3 apps/python/examples/falling_block.py
Next: change the scene and run it again,
  ashlar run $root/$scene --out my.out --set 'analysis.time_step=5e-4'
END
