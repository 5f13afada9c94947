#!/usr/bin/env python3
"""Makes a relocatable archive of a build: program, Python wheel and all libraries they need, for machines without packages
or a compiler.

use: make_archive.py BUILD [--out DIR] [--debian]

    ashlar-VERSION-linux-ARCH.tar.gz
      bin/ashlar             starts libexec/ashlar with the libraries of lib/, wherever the folder lies
      lib/                   libraries; lib/glibc/ the C library and its loader, used where the system's is older
      wheel/ashlar-*.whl     Python module for the interpreter of the build, with its libraries inside (needs NumPy)
      share/                 scenes, schema, man page, completion, licences; the book as Markdown
      sbom.spdx.json         packages that the libraries come from, with versions and licence files (SPDX 2.3)
      SHA256SUMS             of every file; beside the archive one of itself

--debian makes the packages of cpack too. Needs patchelf, and dpkg-query for the list of packages.
"""
import argparse
import base64
import hashlib
import json
import os
import platform
import re
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Parts of the C library: together with its loader, or not at all.
GLIBC = re.compile(r"^(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util|mvec)\.so.*)$")
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


def output_of(*command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


def run(*command, **more):
    subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL, **more)


def libraries_of(binary):
    """Names and files of all libraries that a binary loads."""
    found = {}
    for line in output_of("ldd", binary).splitlines():
        words = line.split()
        if "not found" in line:
            sys.exit(f"make_archive.py: {binary}: {words[0]} was not found; build on a machine that has it")
        if "=>" in words:
            found[words[0]] = Path(words[2]).resolve()
        elif words[0].startswith("/"):
            found[Path(words[0]).name] = Path(words[0]).resolve()
    return found


def copy_library(source, target, run_path):
    shutil.copyfile(source, target)
    target.chmod(0o755)
    if run_path:
        run("patchelf", "--set-rpath", run_path, target)


def install(build, component, prefix):
    run("cmake", "--install", build, "--component", component, "--strip", "--prefix", prefix)


def package_of(file):
    """Name, version and licence file of the Debian package that a file belongs to."""
    for path in {str(file), str(file).removeprefix("/usr"), "/usr" + str(file)}:
        answer = subprocess.run(["dpkg-query", "-S", path], capture_output=True, text=True, check=False)
        if answer.returncode == 0:
            name = answer.stdout.split(":")[0]
            version = output_of("dpkg-query", "-W", "-f", "${Version}\n", name).splitlines()[0]
            return name, version, Path("/usr/share/doc") / name / "copyright"
    return None


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
    version = re.search(r"(\d+\.\d+)", output_of("getconf", "GNU_LIBC_VERSION"))[1]
    start = root / "bin" / "ashlar"
    start.write_text(START.replace("@GLIBC@", version).replace("@LOADER@", loader), encoding="utf-8")
    start.chmod(0o755)
    return used


def collect_wheel(build, folder, version):
    """A wheel with its libraries inside. Returns the files that were copied, by their name; none without the module."""
    with tempfile.TemporaryDirectory() as stage:
        stage = Path(stage)
        install(build, "python", stage)
        modules = list(stage.rglob("_core*.so"))
        if not modules:
            return {}
        package = stage / "wheel" / "ashlar"
        shutil.copytree(modules[0].parent, package)
        core = package / modules[0].name
        inside = stage / "wheel" / "ashlar.libs"
        inside.mkdir()
        used = {name: file for name, file in libraries_of(core).items() if not GLIBC.match(name)}
        for name, source in used.items():
            copy_library(source, inside / name, "$ORIGIN")
        run("patchelf", "--set-rpath", "$ORIGIN/../ashlar.libs", core)
        tag = re.search(r"cpython-(\d)(\d+)-(\w+)-linux", core.name)
        glibc = re.search(r"(\d+)\.(\d+)", output_of("getconf", "GNU_LIBC_VERSION"))
        python = f"cp{tag[1]}{tag[2]}"
        tags = f"{python}-{python}-manylinux_{glibc[1]}_{glibc[2]}_{tag[3]}"
        information = stage / "wheel" / f"ashlar-{version}.dist-info"
        information.mkdir()
        (information / "METADATA").write_text(
            f"Metadata-Version: 2.1\nName: ashlar\nVersion: {version}\n"
            "Summary: high-order 3-D discontinuous deformation analysis\n"
            f"Requires-Python: =={tag[1]}.{tag[2]}.*\nRequires-Dist: numpy\n", encoding="utf-8")
        (information / "WHEEL").write_text(
            f"Wheel-Version: 1.0\nGenerator: ashlar\nRoot-Is-Purelib: false\nTag: {tags}\n", encoding="utf-8")
        shutil.copy(ROOT / "LICENSE", information / "LICENSE")
        pack_wheel(stage / "wheel", folder / f"ashlar-{version}-{tags}.whl", information.name)
        return used


def pack_wheel(tree, wheel, information):
    record = []
    wheel.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        def add(name, data, mode=0o644):
            entry = zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0))
            entry.external_attr = (stat.S_IFREG | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)

        for file in sorted(tree.rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                name, data = file.relative_to(tree).as_posix(), file.read_bytes()
                add(name, data, file.stat().st_mode & 0o777)
                digest = hashlib.sha256(data).digest()
                text = base64.urlsafe_b64encode(digest).rstrip(b"=").decode()
                record.append(f"{name},sha256={text},{len(data)}")
        record.append(f"{information}/RECORD,,")
        add(f"{information}/RECORD", "\n".join(record) + "\n")


def write_sbom(root, version, libraries):
    """The packages that the libraries come from, and copies of their licences."""
    packages = {}
    for file in libraries.values():
        known = package_of(file)
        name, of, licence = known or (file.name, "unknown", None)
        packages.setdefault((name, of), (licence, []))[1].append(file.name)
    static = Path("/usr/share/doc/libhdf5-dev/copyright")  # part of the program itself, if static libraries were found
    if static.is_file() and not any(file.name.startswith("libhdf5") for file in libraries.values()):
        of = output_of("dpkg-query", "-W", "-f", "${Version}\n", "libhdf5-dev").splitlines()[0]
        packages["libhdf5-dev", of] = (static, ["libhdf5_serial.a"])
    licences = root / "share" / "licences"
    licences.mkdir(parents=True)
    entries = [{"SPDXID": "SPDXRef-ashlar", "name": "ashlar", "versionInfo": version,
                "downloadLocation": "NOASSERTION", "licenseConcluded": "NOASSERTION"}]
    for (name, of), (licence, files) in sorted(packages.items()):
        if licence and licence.is_file():
            shutil.copyfile(licence, licences / name)
        entries.append({"SPDXID": f"SPDXRef-{re.sub('[^A-Za-z0-9.-]', '-', name)}", "name": name, "versionInfo": of,
                        "downloadLocation": "NOASSERTION", "licenseConcluded": "NOASSERTION",
                        "comment": "files: " + ", ".join(sorted(files)) + f"; licence: share/licences/{name}"})
    document = {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
                "name": f"ashlar-{version}", "documentNamespace": f"urn:ashlar:{version}",
                "creationInfo": {"created": "2026-01-01T00:00:00Z", "creators": ["Tool: make_archive.py"]},
                "packages": entries,
                "relationships": [{"spdxElementId": "SPDXRef-ashlar", "relationshipType": "DEPENDS_ON",
                                   "relatedSpdxElement": entry["SPDXID"]} for entry in entries[1:]]}
    (root / "sbom.spdx.json").write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def sha256(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


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
    parser.add_argument("--debian", action="store_true", help="Debian packages too")
    options = parser.parse_args()
    missing = [tool for tool in ("cmake", "ldd", "patchelf", "dpkg-query") if not shutil.which(tool)]
    if missing:
        sys.exit(f"make_archive.py: {', '.join(missing)} not found; `apt-get install {' '.join(missing)}`")
    version = re.search(r"project\(ashlar VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    name = f"ashlar-{version}-linux-{platform.machine()}"
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        root = Path(work) / name
        libraries = collect_program(options.build, root)
        libraries |= collect_wheel(options.build, root / "wheel", version)
        shutil.copytree(ROOT / "apps" / "docs", root / "share" / "doc" / "ashlar" / "book",
                        ignore=shutil.ignore_patterns("*.py", "*.txt", "*.toml", "__pycache__", "api"))
        shutil.copyfile(ROOT / "LICENSE", root / "LICENSE")
        write_sbom(root, version, libraries)
        write_sums(root)
        archive = options.out / f"{name}.tar.gz"
        pack(root, archive)
    print(f"{archive}: {archive.stat().st_size / 1e6:.1f} MB, {len(libraries)} libraries")
    if options.debian:
        run("cpack", "-G", "DEB", "-B", options.out.resolve(), cwd=options.build)
        for package in sorted(options.out.glob("*.deb")):
            print(f"{package}: {package.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
