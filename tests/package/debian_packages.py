"""Unpacks the Debian packages of a build into an empty folder and uses their contents.
use: debian_packages.py BUILD [--files FOLDER] [--python]     exit 77: there are no tools for packages
FOLDER has the files of a release (release.py --keep); without them the packages are made."""
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
if not all(shutil.which(tool) for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps")):
    print("no cpack or dpkg")
    sys.exit(77)


def output_of(command, **more):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True, **more).stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        work = Path(cls.folder.name)
        if not options.files or not options.files.exists():
            options.files = work
            output_of(["cpack", "-G", "DEB", "-B", work], cwd=options.build)
        cls.packages = {output_of(["dpkg-deb", "-f", file, "Package"]).strip(): file for file in options.files.glob("*.deb")}
        cls.root = work / "root"
        for file in cls.packages.values():
            output_of(["dpkg-deb", "-x", file, cls.root])
        cls.program = cls.root / "usr/bin/ashlar"
        cls.commands = re.findall(r"^  ([a-z]+) ", output_of([cls.program, "--help"]).split("Subcommands:")[1], re.M)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_each_has_what_it_needs(self):
        expected = {"ashlar": "libgmp10", "libashlar-dev": "libcgal-dev"}
        if options.python:
            expected["python3-ashlar"] = "python3-numpy"
        self.assertEqual(set(self.packages), set(expected))
        for package, needed in expected.items():
            self.assertIn(needed, output_of(["dpkg-deb", "-f", self.packages[package], "Depends"]))
            self.assertTrue((self.root / "usr/share/doc" / package / "copyright").is_file())

    def test_the_program_runs_the_scenes_it_brings(self):
        out = Path(self.folder.name) / "arch.out"
        output_of([self.program, "run", self.root / "usr/share/ashlar/scenes/arch_stands.toml", "--out", out])
        self.assertEqual(json.loads((out / "summary.json").read_text())["status"], "equilibrium")
        schema = json.loads((self.root / "usr/share/ashlar/scene.schema.json").read_text())
        self.assertIn("block", schema["properties"])

    def test_the_man_page_has_every_command(self):
        page = (self.root / "usr/share/man/man1/ashlar.1").read_text().split(".SH COMMANDS")[1].split(".SH EXIT")[0]
        for command in self.commands:
            self.assertRegex(page, rf"\b{command}\b")
        self.assertGreater(len(self.commands), 10)

    def test_the_shell_completes_commands_and_options(self):
        def complete(*words):
            script = ('given=("$@"); _filedir() { :; }; '
                      '_init_completion() { words=("${given[@]}"); cword=$((${#given[@]} - 1)); cur=${words[cword]}; }; '
                      f'source {self.root}/usr/share/bash-completion/completions/ashlar; '
                      '_ashlar "$1"; printf "%s\\n" "${COMPREPLY[@]}"')
            return output_of(["bash", "-c", script, "bash", self.program, *words]).split()
        self.assertEqual(complete("sc"), ["schema"])
        self.assertEqual(set(complete("")) & set(self.commands), set(self.commands))
        self.assertIn("--resume", complete("run", "--re"))
        self.assertIn("error-time", complete("study", "e"))

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh_completes(self):
        def complete(*words):
            script = ('words=("$@"); CURRENT=$#; compadd() { shift; print -l -- "$@"; }; _files() { :; }; '
                      f'source {self.root}/usr/share/zsh/vendor-completions/_ashlar')
            return output_of(["zsh", "-f", "-c", script, "zsh", self.program, *words]).split()
        self.assertLessEqual(set(self.commands), set(complete("")))
        self.assertIn("--resume", complete("run", "--re"))
        self.assertIn("error-time", complete("study", "e"))

    @unittest.skipUnless(shutil.which("fish"), "no fish")
    def test_fish_completes(self):
        def complete(line):
            place = f"{self.root}/usr/share/fish/vendor_completions.d/ashlar.fish"
            script = f'set -gx PATH {self.program.parent} $PATH; source {place}; complete -C "{line}"'
            return output_of(["fish", "--no-config", "-c", script]).split()
        self.assertLessEqual(set(self.commands), set(complete("ashlar ")))
        self.assertIn("--resume", complete("ashlar run --re"))
        self.assertIn("error-time", complete("ashlar study e"))

    @unittest.skipUnless(options.python, "built without Python")
    def test_the_module_is_found(self):
        place = self.root / "usr/lib/python3/dist-packages"
        code = "import ashlar; print(ashlar.__file__)"
        found = output_of(["/usr/bin/python3", "-c", code], env={**os.environ, "PYTHONPATH": str(place)})
        self.assertTrue(found.startswith(str(place)))

    @unittest.skipUnless(options.python, "built without Python")
    def test_an_example_it_brings_makes_a_plot(self):
        place = self.root / "usr/lib/python3/dist-packages"
        example = self.root / "usr/share/doc/python3-ashlar/examples/falling_block.py"
        picture = Path(self.folder.name) / "height.png"
        output_of(["/usr/bin/python3", example, picture],
                  env={**os.environ, "PYTHONPATH": str(place), "MPLBACKEND": "Agg"})
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")


unittest.main(argv=sys.argv[:1])
