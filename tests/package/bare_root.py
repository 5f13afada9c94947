"""Installs the wheel of a build by pip where nothing but Python, NumPy and the C library is: a root folder made of the files of
their Debian packages, and runs a scene there.
use: bare_root.py BUILD [--files FOLDER]    exit 77: there is no patchelf, dpkg or chroot, or this machine lacks the packages
FOLDER has the files of a release (release.py --keep); without them the wheel is made."""
import argparse
import fnmatch
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("build")
parser.add_argument("--files", type=Path)
options = parser.parse_args()
PROJECT = Path(__file__).resolve().parents[2]
PLAIN = {"PATH": "/usr/bin:/bin:/usr/sbin:/sbin", "LC_ALL": "C.UTF-8"}
WANTED = ("libc6", "libc-bin", "python3", "python3-numpy", "python3-pip-whl", "libblas3", "liblapack3")
LEFT_OUT = ("/usr/share/doc/*", "/usr/share/man/*", "/usr/share/locale/*", "/usr/share/perl*", "/usr/lib/*/perl*")
# Libraries of the module that Python and NumPy do not bring.
OURS = ("libcholmod*", "libgmp*", "libmpfr*", "libtbb*", "libopenblas*", "libfmt*", "libmuparser*")


def output_of(command, **more):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **{"env": PLAIN, **more})
    if done.returncode != 0:
        raise AssertionError(f"{command}: exit status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def installed_packages():
    """Dependencies of each installed package, and of what it provides, as lists of alternatives."""
    needs = {}
    form = "${Package}\t${Provides}\t${Pre-Depends}, ${Depends}\n"
    for line in output_of(["dpkg-query", "-W", "-f", form]).splitlines():
        name, provided, depends = line.split("\t")
        alternatives = [[re.sub(r"[(:].*", "", word).strip() for word in entry.split("|")]
                        for entry in depends.split(",") if entry.strip()]
        needs[name] = name, alternatives
        for virtual in provided.split(","):
            needs.setdefault(re.sub(r"[(:].*", "", virtual).strip(), (name, alternatives))
    return needs


def closure_of(wanted):
    """Names of packages, with all that they depend on."""
    needs, found, open_names = installed_packages(), set(), list(wanted)
    while open_names:
        name, alternatives = needs[open_names.pop()]
        if name in found:
            continue
        found.add(name)
        for entry in alternatives:
            present = [word for word in entry if word in needs]
            if not any(needs[word][0] in found for word in present):
                open_names += present[:1]
    return found


def copy_package(name, root):
    for line in output_of(["dpkg-query", "-L", name]).splitlines():
        source = Path(line)
        if any(fnmatch.fnmatch(line, pattern) for pattern in LEFT_OUT) or not os.path.lexists(source):
            continue
        target = root / line.lstrip("/")
        if source.is_dir() and not source.is_symlink():
            target.mkdir(parents=True, exist_ok=True)
        elif not os.path.lexists(target):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, target, follow_symlinks=False)


def make_root(root):
    # As in Debian: /lib and others are links into /usr.
    for name in ("bin", "sbin", "lib", "lib64"):
        (root / "usr" / name).mkdir(parents=True, exist_ok=True)
        (root / name).symlink_to(f"usr/{name}")
    (root / "tmp").mkdir()
    for name in closure_of(WANTED):
        copy_package(name, root)
    # Links that the packages' scripts would make.
    machine = root / "usr/lib" / output_of(["gcc", "-print-multiarch"]).strip()
    for library in ("blas", "lapack"):
        (machine / f"lib{library}.so.3").symlink_to(f"{library}/lib{library}.so.3")


class BareRoot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name) / "root"
        cls.root.mkdir()
        make_root(cls.root)
        if options.files and options.files.exists():
            (cls.root / "wheel").mkdir()
            (wheel,) = options.files.glob("*.whl")
            shutil.copy(wheel, cls.root / "wheel")
        else:
            output_of([sys.executable, PROJECT / "apps/package/make_wheel.py", options.build, "--out", cls.root / "wheel"],
                      env=os.environ)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def inside(self, *command, **variables):
        as_root = [] if os.geteuid() == 0 else ["unshare", "-r"]
        return output_of([*as_root, "chroot", self.root, *command], env={**PLAIN, **variables})

    def test_it_is_bare(self):
        names = {path.name for path in self.root.rglob("*.so*")}
        for pattern in OURS:
            self.assertEqual(fnmatch.filter(names, pattern), [])
        self.assertFalse((self.root / "usr/bin/gcc").exists())

    def test_pip_installs_it_and_it_runs(self):
        (wheel,) = (self.root / "wheel").iterdir()
        (pip,) = (self.root / "usr/share/python-wheels").glob("pip-*.whl")
        begin = time.monotonic()
        self.inside("/usr/bin/python3", "-m", "pip", "install", "--no-index", "--no-deps", "--target", "/site",
                    f"/wheel/{wheel.name}", PYTHONPATH=f"/usr/share/python-wheels/{pip.name}")
        self.inside("/usr/bin/python3", "-c", "import ashlar", PYTHONPATH="/site")
        print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.0f} MB, installed and imported in {time.monotonic() - begin:.1f} s")
        shutil.copy(PROJECT / "data/scenes/arch_stands.toml", self.root / "tmp")
        code = ("import ashlar, json; s = ashlar.Scene.load('/tmp/arch_stands.toml').simulation(); s.run(); "
                "print(json.dumps([ashlar.__file__, s.summary['status']]))")
        place, status = json.loads(self.inside("/usr/bin/python3", "-c", code, PYTHONPATH="/site"))
        self.assertEqual((place, status), ("/site/ashlar/__init__.py", "equilibrium"))

    def test_its_name_is_what_it_needs(self):
        (wheel,) = (self.root / "wheel").iterdir()
        major, minor = map(int, re.search(r"manylinux_(\d+)_(\d+)_", wheel.name).groups())
        tree = Path(self.folder.name) / "tree"
        shutil.unpack_archive(wheel, tree, "zip")
        needed = {(2, 0)}
        for binary in (*tree.rglob("*.so"), *tree.rglob("*.so.*")):
            # By another tool than the one that makes the name.
            for version in re.findall(r"Name: GLIBC_(\d+)\.(\d+)", output_of(["readelf", "-W", "-V", binary])):
                needed.add(tuple(map(int, version)))
        self.assertEqual(max(needed), (major, minor))
        document = json.loads(next(tree.rglob("ashlar.spdx.json")).read_text())
        names = {package["name"] for package in document["packages"]} - {"ashlar"}
        self.assertIn("libgmp10", names)
        self.assertLessEqual(names, {path.name for path in next(tree.rglob("licenses")).iterdir()})


def has_all():
    if not all(shutil.which(tool) for tool in ("patchelf", "dpkg-query", "readelf", "objdump", "chroot", "gcc")):
        return False
    asked = subprocess.run(["dpkg-query", "-W", *WANTED], capture_output=True, check=False)
    as_root = [] if os.geteuid() == 0 else ["unshare", "-r"]
    entered = subprocess.run([*as_root, "chroot", "/", "/bin/true"], capture_output=True, check=False)
    return asked.returncode == 0 and entered.returncode == 0


if __name__ == "__main__":
    if not has_all():
        print("no patchelf, dpkg or chroot, or not all of", *WANTED)
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
