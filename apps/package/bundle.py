"""Shared by make_archive.py and make_wheel.py: libraries of binaries, the packages that they come from, the C library that they
need."""
import hashlib
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Parts of the C library: together with its loader, or not at all.
GLIBC = re.compile(r"^(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util|mvec)\.so.*)$")


def require(caller, *tools):
    """Ends the program if a tool is missing."""
    if missing := [tool for tool in tools if not shutil.which(tool)]:
        sys.exit(f"{caller}: {', '.join(missing)} not found; `apt-get install {' '.join(missing)}`")


def project_version():
    return re.search(r"project\(ashlar VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


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
            sys.exit(f"{binary}: {words[0]} was not found; build on a machine that has it")
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


def needed_glibc(binaries):
    """(major, minor) of the oldest C library that has all symbols of the binaries."""
    versions = {(2, 0)}
    for binary in binaries:
        table = output_of("objdump", "-T", binary)
        versions |= {(int(a), int(b)) for a, b in re.findall(r"GLIBC_(\d+)\.(\d+)", table)}
    return max(versions)


def sbom_of(version, libraries, licences):
    """A document in SPDX 2.3 of the packages that the libraries come from. Their licences are copied to a folder."""
    packages = {}
    for file in libraries.values():
        known = package_of(file)
        name, of, licence = known or (file.name, "unknown", None)
        packages.setdefault((name, of), (licence, []))[1].append(file.name)
    static = Path("/usr/share/doc/libhdf5-dev/copyright")  # part of the program itself, if static libraries were found
    if static.is_file() and not any(file.name.startswith("libhdf5") for file in libraries.values()):
        of = output_of("dpkg-query", "-W", "-f", "${Version}\n", "libhdf5-dev").splitlines()[0]
        packages["libhdf5-dev", of] = (static, ["libhdf5_serial.a"])
    licences.mkdir(parents=True)
    entries = [{"SPDXID": "SPDXRef-ashlar", "name": "ashlar", "versionInfo": version,
                "downloadLocation": "NOASSERTION", "licenseConcluded": "NOASSERTION"}]
    for (name, of), (licence, files) in sorted(packages.items()):
        if licence and licence.is_file():
            shutil.copyfile(licence, licences / name)
        entries.append({"SPDXID": f"SPDXRef-{re.sub('[^A-Za-z0-9.-]', '-', name)}", "name": name, "versionInfo": of,
                        "downloadLocation": "NOASSERTION", "licenseConcluded": "NOASSERTION",
                        "comment": "files: " + ", ".join(sorted(files)) + f"; licence: {licences.name}/{name}"})
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": f"ashlar-{version}", "documentNamespace": f"urn:ashlar:{version}",
            "creationInfo": {"created": "2026-01-01T00:00:00Z", "creators": ["Tool: apps/package"]},
            "packages": entries,
            "relationships": [{"spdxElementId": "SPDXRef-ashlar", "relationshipType": "DEPENDS_ON",
                               "relatedSpdxElement": entry["SPDXID"]} for entry in entries[1:]]}


def write_json(file, document):
    file.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def sha256(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()
