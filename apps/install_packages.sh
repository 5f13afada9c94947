#!/usr/bin/env bash
# Installs the missing Debian packages of packages.txt; needs no rights if none is missing.
# Use: install_packages.sh [--except PATTERN], an extended regular expression of packages to leave out
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
except='^$'
if [[ ${1:-} == --except ]]; then
  except=$2
fi

missing=()
while read -r package; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done < <(grep -Ev "^ *$|$except" "$root/packages.txt")
if ((${#missing[@]} == 0)); then
  exit 0
fi

echo "Installing ${#missing[@]} missing packages: ${missing[*]}"
as_root=(env)
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "error: no right to install packages and no sudo; as root, run: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo env)
fi
apt_get=("${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300)
"${apt_get[@]}" update </dev/null
"${apt_get[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null
