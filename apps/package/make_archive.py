#!/usr/bin/env python3
"""Makes a relocatable archive of a build: program, Python wheel and all libraries they need, for machines without packages
or a compiler.

use: make_archive.py BUILD [--out DIR] [--wheel] [--debian]

    ashlar-VERSION-linux-ARCH.tar.gz
      bin/ashlar             starts libexec/ashlar with the libraries of lib/, wherever the folder lies
      lib/                   libraries; lib/glibc/ the C library and its loader, used where the system's is older
      wheel/ashlar-*.whl     Python module for the interpreter of the build, with its libraries inside (needs NumPy)
      share/                 scenes, schema, man page, completion, licences; the book as Markdown
      sbom.spdx.json         packages that the libraries come from, with versions and licence files (SPDX 2.3)
      SHA256SUMS             of every file; beside the archive one of itself

--wheel writes the wheel beside the archive too, --debian the packages of cpack. Needs patchelf, and dpkg-query for the list of packages.
"""
import argparse
import os
import platform
import shutil
import sys
import tarfile
import tempfile
from pathlib import Path

from bundle import (GLIBC, ROOT, copy_library, install, libraries_of, needed_glibc, project_version, require, run, sbom_of,
                    sha256, write_json)
from make_wheel import write_wheel

EPOCH = int(os.environ.get("SOURCE_DATE_EPOCH", "1767225600"))  # equal builds make equal archives

START = """#!/bin/sh
# Starts Ashlar with the libraries of this folder, and with its C library where the system's is older.
self=$(readlink -f -- "$0")
root=$(dirname -- "$(dirname -- "$self")")
have=$(getconf GNU_LIBC_VERSION 2>/dev/null | sed 's/^glibc //')
oldest=$(printf '%s\\n%s\\n' "${have:-0}" "@GLIBC@" | sort -V | head -n 1)
if [ "$oldest" = "@GLIBC@" ]; then
  exec "$root/libexec/ashlar" "$@"
fi
exec "$root/lib/glibc/@LOADER@" --library-path "$root/lib:$root/lib/glibc" "$root/libexec/ashlar" "$@"
"""


def collect_program(build, root):
    """Program and libraries. Returns the files that were copied, by their name."""
    install(build, "program", root)
    (root / "libexec").mkdir()
    program = root / "libexec" / "ashlar"
    (root / "bin" / "ashlar").rename(program)
    glibc = root / "lib" / "glibc"
    glibc.mkdir(parents=True, exist_ok=True)
    used = libraries_of(program)
    for name, source in used.items():
        if GLIBC.match(name):
            copy_library(source, glibc / name, None)
        else:
            copy_library(source, root / "lib" / name, "$ORIGIN")
    run("patchelf", "--set-rpath", "$ORIGIN/../lib", program)
    loader = next(name for name in used if name.startswith("ld-linux"))
    version = "{}.{}".format(*needed_glibc([program, *(root / "lib").glob("*.so*")]))
    start = root / "bin" / "ashlar"
    start.write_text(START.replace("@GLIBC@", version).replace("@LOADER@", loader), encoding="utf-8")
    start.chmod(0o755)
    return used


def write_sums(root):
    files = sorted(path for path in root.rglob("*") if path.is_file() and not path.is_symlink())
    (root / "SHA256SUMS").write_text(
        "".join(f"{sha256(file)}  {file.relative_to(root).as_posix()}\n" for file in files), encoding="utf-8")


def pack(root, archive):
    def plain(entry):
        entry.uid = entry.gid = 0
        entry.uname = entry.gname = ""
        entry.mtime = EPOCH
        return entry

    with tarfile.open(archive, "w:gz", compresslevel=9) as tar:
        tar.add(root, root.name, recursive=False, filter=plain)
        for path in sorted(root.rglob("*")):
            tar.add(path, f"{root.name}/{path.relative_to(root).as_posix()}", recursive=False, filter=plain)
    archive.with_name(archive.name + ".sha256").write_text(f"{sha256(archive)}  {archive.name}\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder of a release build")
    parser.add_argument("--out", type=Path, default=Path("."), help="folder of the archive (default: here)")
    parser.add_argument("--wheel", action="store_true", help="the wheel beside the archive too")
    parser.add_argument("--debian", action="store_true", help="Debian packages too")
    options = parser.parse_args()
    require("make_archive.py", "cmake", "ldd", "objdump", "patchelf", "dpkg-query")
    version = project_version()
    name = f"ashlar-{version}-linux-{platform.machine()}"
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        root = Path(work) / name
        libraries = collect_program(options.build, root)
        wheel = write_wheel(options.build, root / "wheel")
        if wheel is None and options.wheel:
            sys.exit(f"make_archive.py: {options.build} has no Python module; configure it with -DASHLAR_PYTHON=ON and build it")
        libraries |= wheel.libraries if wheel else {}
        if options.wheel:
            print(shutil.copy(wheel.file, options.out))
        shutil.copytree(ROOT / "apps" / "docs", root / "share" / "doc" / "ashlar" / "book",
                        ignore=shutil.ignore_patterns("*.py", "*.txt", "*.toml", "__pycache__", "api"))
        shutil.copyfile(ROOT / "LICENSE", root / "LICENSE")
        write_json(root / "sbom.spdx.json", sbom_of(version, libraries, root / "share" / "licences"))
        write_sums(root)
        archive = options.out / f"{name}.tar.gz"
        pack(root, archive)
    print(f"{archive}: {archive.stat().st_size / 1e6:.1f} MB, {len(libraries)} libraries")
    if options.debian:
        with tempfile.TemporaryDirectory() as stage:
            run("cpack", "-G", "DEB", "-B", stage, cwd=options.build)
            made = sorted(Path(stage).glob("*.deb"))
            packages = [Path(shutil.copy(package, options.out)) for package in made]
        for package in packages:
            print(f"{package}: {package.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
