"""Makes the files of a release of this build in a clone of the history, without pages of the book, and looks through them.
use: release.py PROJECT BUILD [--keep FOLDER]     exit 77: there is no history, git or patchelf"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("project", type=Path)
parser.add_argument("build", type=Path)
parser.add_argument("--keep", type=Path, help="folder for the files, for other tests; it is emptied at first")
options = parser.parse_args()
SETTINGS = {"GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1", "GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@localhost",
            "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@localhost"}


def git(folder, *words):
    return subprocess.run(["git", "-c", f"safe.directory={folder}", *words], cwd=folder, check=True, capture_output=True, text=True,
                          env={**os.environ, **SETTINGS}).stdout


class Release(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.work = Path(kept.name)
        self.clone = self.work / "clone"
        # The files as they are, committed or not, without the history's objects.
        files = git(options.project, "ls-files", "-z", "--cached", "--others", "--exclude-standard").split("\0")
        for name in files:
            if name and (options.project / name).is_file():
                (self.clone / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(options.project / name, self.clone / name)
        git(self.clone, "init", "-q")
        self.version = re.search(r"project\(ashlar VERSION ([0-9.]+)", (self.clone / "CMakeLists.txt").read_text())[1]

    def edit(self, name, pattern, text):
        file = self.clone / name
        file.write_text(re.sub(pattern, text, file.read_text(), count=1, flags=re.MULTILINE))

    def prepare(self):
        """What the list in contributing.md asks for."""
        self.edit("CHANGELOG.md", rf"^## {re.escape(self.version)}.*$", f"## {self.version} - 2026-01-31")
        if "date-released" not in (self.clone / "CITATION.cff").read_text():
            self.edit("CITATION.cff", r"^version:", "date-released: 2026-01-31\nversion:")

    def commit(self):
        git(self.clone, "add", "-A")
        git(self.clone, "commit", "-q", "-m", "all")

    def release(self, *more):
        return subprocess.run(["bash", "apps/package/release.sh", "--build", options.build.resolve(), "--out", self.work / "out",
                               *more], cwd=self.clone, capture_output=True, text=True, check=False, env={**os.environ, **SETTINGS})

    def expect_stop(self, words):
        done = self.release("--tag")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(words, done.stderr)
        self.assertEqual(git(self.clone, "tag"), "")

    def test_a_tree_that_is_not_ready_is_refused(self):
        self.edit("CHANGELOG.md", rf"^## {re.escape(self.version)}.*$", f"## {self.version} - in preparation")
        self.commit()
        self.edit("README.md", "^# ", "# A ")
        self.expect_stop("not committed")
        git(self.clone, "checkout", "README.md")
        self.expect_stop("heading" if "date-released" in (self.clone / "CITATION.cff").read_text() else "date-released")
        self.prepare()
        self.edit("CITATION.cff", r"^version:.*$", "version: 9.9.9")
        self.commit()
        self.expect_stop("CITATION.cff has another version")

    def test_all_files_are_made(self):
        self.prepare()
        self.commit()
        done = self.release("--tag")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        out = self.work / "out"
        subprocess.run(["sha256sum", "--quiet", "--check", "SHA256SUMS"], cwd=out, check=True)
        named = {line.split("  ")[1] for line in (out / "SHA256SUMS").read_text().splitlines()}
        self.assertEqual(named, {path.name for path in out.iterdir()} - {"SHA256SUMS"})
        for pattern in ("ashlar-{}.tar.gz", "ashlar-{}.zip", "ashlar-{}-linux-*.tar.gz", "ashlar-{}-*.whl", "ashlar_{}_*.deb",
                        "ashlar-{}-example.html"):
            self.assertEqual(len(list(out.glob(pattern.format(self.version)))), 1, pattern)
        inside = f"ashlar-{self.version}/CMakeLists.txt"
        with tarfile.open(out / f"ashlar-{self.version}.tar.gz") as archive:
            self.assertIn(inside, archive.getnames())
        with zipfile.ZipFile(out / f"ashlar-{self.version}.zip") as archive:
            self.assertIn(inside, archive.namelist())
        self.assertEqual(json.loads((out / "sbom.spdx.json").read_text())["spdxVersion"], "SPDX-2.3")
        self.assertEqual(git(self.clone, "tag").split(), [f"v{self.version}"])
        if options.keep:
            shutil.copytree(out, options.keep)
        again = self.release()
        self.assertIn("exists", again.stderr)
        self.assertEqual(again.returncode, 1)


if __name__ == "__main__":
    if options.keep:
        shutil.rmtree(options.keep, ignore_errors=True)
    tools = ("git", "patchelf", "dpkg-query", "objdump", "cpack", "sha256sum")
    if not all(map(shutil.which, tools)) or subprocess.run(["git", "-c", "safe.directory=*", "rev-parse"], cwd=options.project,
                                                           capture_output=True, check=False).returncode != 0:
        print("no history, or not all of", *tools)
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
