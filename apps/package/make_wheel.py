#!/usr/bin/env python3
"""Makes a wheel of the Python module of a build, with all of its libraries but the C library inside: `pip install FILE` needs no
compiler.

use: make_wheel.py BUILD [--out DIR]

    ashlar-VERSION-cpXY-cpXY-manylinux_A_B_ARCH.whl    for Python X.Y, the interpreter of the build, and glibc A.B or newer,
                                                       which is what its binaries ask for

Inside are licences and a list of the packages that the libraries come from (SPDX 2.3), in ashlar-VERSION.dist-info. Equal builds
make equal wheels. Needs patchelf, and dpkg-query for the list of packages.
"""
import argparse
import base64
import dataclasses
import hashlib
import re
import shutil
import stat
import sys
import tempfile
import zipfile
from pathlib import Path

from bundle import (GLIBC, ROOT, copy_library, install, libraries_of, needed_glibc, project_version, require, run, sbom_of,
                    write_json)

METADATA = """Metadata-Version: 2.1
Name: ashlar
Version: {version}
Summary: high-order 3-D discontinuous deformation analysis
License: GPL-3.0-or-later
Requires-Python: =={python}.*
Requires-Dist: numpy
"""
WHEEL = """Wheel-Version: 1.0
Generator: ashlar
Root-Is-Purelib: false
Tag: {tag}
"""


@dataclasses.dataclass
class Wheel:
    file: Path
    libraries: dict  # files that were copied, by their names
    glibc: tuple  # the oldest that it works with


def copy_module(build, tree):
    """Module and libraries below a folder. Returns the extension, and the libraries' files by their names; None without a module."""
    with tempfile.TemporaryDirectory() as stage:
        install(build, "python", stage)
        modules = list(Path(stage).rglob("_core*.so"))
        if not modules:
            return None
        shutil.copytree(modules[0].parent, tree / "ashlar", ignore=shutil.ignore_patterns("__pycache__"))
    core = tree / "ashlar" / modules[0].name
    inside = tree / "ashlar.libs"
    inside.mkdir()
    libraries = {name: file for name, file in libraries_of(core).items() if not GLIBC.match(name)}
    for name, source in libraries.items():
        copy_library(source, inside / name, "$ORIGIN")
    run("patchelf", "--set-rpath", "$ORIGIN/../ashlar.libs", core)
    return core, libraries


def write_wheel(build, folder):
    """Writes the wheel into a folder. None: the build has no Python module."""
    version = project_version()
    with tempfile.TemporaryDirectory() as work:
        tree = Path(work)
        copied = copy_module(build, tree)
        if copied is None:
            return None
        core, libraries = copied
        major, minor, machine = re.search(r"cpython-(\d)(\d+)-(\w+)-linux", core.name).groups()
        glibc = needed_glibc([core, *(tree / "ashlar.libs").iterdir()])
        python = f"cp{major}{minor}"
        tag = f"{python}-{python}-manylinux_{glibc[0]}_{glibc[1]}_{machine}"
        information = tree / f"ashlar-{version}.dist-info"
        (information / "sboms").mkdir(parents=True)
        (information / "METADATA").write_text(METADATA.format(version=version, python=f"{major}.{minor}"), encoding="utf-8")
        (information / "WHEEL").write_text(WHEEL.format(tag=tag), encoding="utf-8")
        write_json(information / "sboms" / "ashlar.spdx.json", sbom_of(version, libraries, information / "licenses"))
        shutil.copy(ROOT / "LICENSE", information / "licenses" / "LICENSE")
        file = folder / f"ashlar-{version}-{tag}.whl"
        pack_wheel(tree, file, information.name)
        return Wheel(file, libraries, glibc)


def pack_wheel(tree, wheel, information):
    record = []
    wheel.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        def add(name, data, mode=0o644):
            entry = zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0))
            entry.external_attr = (stat.S_IFREG | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)

        for file in sorted(path for path in tree.rglob("*") if path.is_file()):
            name, data = file.relative_to(tree).as_posix(), file.read_bytes()
            add(name, data, file.stat().st_mode & 0o777)
            text = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={text},{len(data)}")
        record.append(f"{information}/RECORD,,")
        add(f"{information}/RECORD", "\n".join(record) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder of a release build")
    parser.add_argument("--out", type=Path, default=Path("."), help="folder of the wheel (default: here)")
    options = parser.parse_args()
    require("make_wheel.py", "cmake", "ldd", "objdump", "patchelf", "dpkg-query")
    wheel = write_wheel(options.build, options.out)
    if wheel is None:
        sys.exit(f"make_wheel.py: {options.build} has no Python module; configure it with -DASHLAR_PYTHON=ON and build it")
    print(f"{wheel.file}: {wheel.file.stat().st_size / 1e6:.1f} MB, {len(wheel.libraries)} libraries, "
          f"glibc {wheel.glibc[0]}.{wheel.glibc[1]} or newer")


if __name__ == "__main__":
    main()
