"""Uses the archive of a build where nothing else is.
use: archive.py BUILD [--files FOLDER] [--python]     exit 77: there is no patchelf
FOLDER has the files of a release (release.py --keep); without them the archive is made."""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("build")
parser.add_argument("--files", type=Path)
parser.add_argument("--python", action="store_true")
options = parser.parse_args()
if not all(shutil.which(tool) for tool in ("patchelf", "dpkg-query", "ldd")):
    print("no patchelf or dpkg")
    sys.exit(77)
MAKE = Path(__file__).resolve().parents[2] / "apps" / "package" / "make_archive.py"
PLAIN = {"PATH": "/usr/bin:/bin:/usr/sbin:/sbin", "LC_ALL": "C"}


def output_of(command, **more):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True,
                          **{"env": PLAIN, **more}).stdout


class Archive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = Path(cls.folder.name)
        if not options.files or not options.files.exists():
            options.files = cls.work / "files"
            output_of([sys.executable, MAKE, options.build, "--out", options.files], env=os.environ)
            (sums,) = options.files.glob("*.sha256")
            sums.rename(options.files / "SHA256SUMS")
        (cls.archive,) = options.files.glob("*-linux-*.tar.gz")
        cls.bare = cls.work / "bare"
        place = cls.bare / "a folder"
        place.mkdir(parents=True)
        output_of(["tar", "-xzf", cls.archive, "-C", place])
        (cls.root,) = place.iterdir()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_arch(self, start, scene, out):
        return [*start, "run", scene, "--out", out, "--quiet"]

    def assert_stands(self, out):
        self.assertEqual(json.loads((out / "summary.json").read_text())["status"], "equilibrium")

    def test_starts_from_anywhere_and_through_links(self):
        link = self.work / "ashlar link"
        link.symlink_to(self.root / "bin" / "ashlar")
        out = self.work / "linked.out"
        output_of(self.run_arch([link], self.root / "share/ashlar/scenes/arch_stands.toml", out), cwd="/")
        self.assert_stands(out)

    def test_libraries_come_from_the_archive(self):
        for line in output_of(["ldd", self.root / "libexec" / "ashlar"]).splitlines():
            name, _, rest = line.strip().partition(" => ")
            if rest and not re.match(r"lib(c|m|resolv)\.so", name):
                self.assertTrue(rest.startswith(str(self.root / "lib")), line)

    def test_runs_where_nothing_else_is(self):
        as_root = [] if os.geteuid() == 0 else ["unshare", "-r"]
        if subprocess.run([*as_root, "chroot", self.bare, "/none"], capture_output=True, check=False).returncode != 127:
            self.skipTest("chroot is not allowed")
        (self.bare / "out").mkdir()
        inside = Path("/") / self.root.relative_to(self.bare)
        (loader,) = (self.root / "lib" / "glibc").glob("ld-linux*")
        start = [*as_root, "chroot", self.bare, inside / "lib/glibc" / loader.name, "--library-path",
                 f"{inside}/lib:{inside}/lib/glibc", inside / "libexec/ashlar"]
        output_of(self.run_arch(start, inside / "share/ashlar/scenes/arch_stands.toml", "/out/arch.out"))
        self.assert_stands(self.bare / "out" / "arch.out")

    def test_sums_and_packages_are_told(self):
        output_of(["sha256sum", "--quiet", "--check", "SHA256SUMS"], cwd=self.root)
        self.assertIn(f"{self.archive.name}: OK", output_of(["sha256sum", "--check", "SHA256SUMS"], cwd=options.files))
        packages = json.loads((self.root / "sbom.spdx.json").read_text())["packages"]
        names = {package["name"] for package in packages}
        self.assertLessEqual({"ashlar", "libgmp10", "libcholmod3", "libc6"}, names)
        for name in names - {"ashlar"}:
            self.assertTrue((self.root / "share/licences" / name).is_file(), name)

    @unittest.skipUnless(options.python, "no Python module")
    def test_the_wheel_needs_no_compiler(self):
        target = self.work / "venv"
        output_of(["/usr/bin/python3", "-m", "venv", "--system-site-packages", target])
        (wheel,) = (self.root / "wheel").iterdir()
        output_of([target / "bin/pip", "install", "--no-index", "--no-deps", wheel])
        code = ("import ashlar, sys; s = ashlar.Scene.load(sys.argv[1]).simulation(); s.run(); "
                "print(ashlar.__file__, s.summary['status'])")
        place, status = output_of([target / "bin/python3", "-c", code,
                                   self.root / "share/ashlar/scenes/arch_stands.toml"], cwd="/").split()
        self.assertTrue(place.startswith(str(target)))
        self.assertEqual(status, "equilibrium")
        for line in output_of(["ldd", next(target.rglob("_core*.so"))]).splitlines():
            name, _, rest = line.strip().partition(" => ")
            if rest and not re.match(r"lib(c|m|resolv)\.so", name):
                self.assertIn("ashlar.libs", rest)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
