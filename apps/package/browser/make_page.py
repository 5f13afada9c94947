#!/usr/bin/env python3
"""Makes the page that runs Ashlar in a browser: one file, which needs no network.

    make_page.py [--program build/browser/apps/ashlar.js] [--out FILE]

--program is the program as preset `browser` builds it; its .wasm is beside it. --out: build/ashlar-VERSION-browser.html.
In the page are the program, the example scenes, those of the tutorials, and the sources of folder `page`.
"""
import argparse
import base64
import gzip
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
SCENES = PROJECT / "data" / "scenes"
BOOK = PROJECT / "apps" / "docs"
# Parts of the page's script, in the order in which one reads them.
SCRIPTS = ("program", "keys", "editor", "zip", "start")
LARGEST_BYTES = 15_000_000
FENCE = re.compile(r"^```(toml|python)(?: (\S+\.toml))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def files_of(text, folder):
    """Tables that a scene names, by name."""
    return {path.name: path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.csv")) if f'"{path.name}"' in text}


def scene(name, group, text, files):
    """An entry of the list of scenes."""
    return {"name": name, "group": group, "title": tomllib.loads(text).get("title", name), "text": text, "files": files}


def example_scenes():
    """Those of data/scenes."""
    for path in sorted(SCENES.glob("*.toml")):
        text = path.read_text(encoding="utf-8")
        yield scene(path.name, "examples", text, files_of(text, SCENES))


def tutorial_scenes():
    """Those of the tutorials. Their names begin with that of the page. Beside them are scenes that they include, and tables
    that blocks of Python on the page write."""
    for page in sorted((BOOK / "tutorial").glob("*.md")):
        with tempfile.TemporaryDirectory() as folder:
            texts = {}
            for language, name, text in FENCE.findall(page.read_text(encoding="utf-8")):
                if language == "python" and '.csv", "w"' in text:
                    subprocess.run([sys.executable, "-c", text], cwd=folder, check=True)
                if language == "toml" and name:
                    texts[name] = text
                    included = {other: texts[other] for other in tomllib.loads(text).get("include", [])}
                    files = files_of(text, pathlib.Path(folder)) | included
                    yield scene(f"{page.stem}/{name}", "tutorials", text, files)


def packed(path):
    """A file, compressed, as text."""
    return base64.b64encode(gzip.compress(path.read_bytes(), 9, mtime=0)).decode("ascii")


def inside_script(text):
    """Text that does not end the element it is in."""
    return text.replace("</script", "<\\/script")


def page_of(program):
    """The whole page."""
    def read(name):
        return (HERE / "page" / name).read_text(encoding="utf-8")

    parts = {
        "STYLE": read("page.css"),
        "PROGRAM": packed(program.with_suffix(".wasm")),
        "GLUE": inside_script(program.read_text(encoding="utf-8")),
        "WORKER": inside_script(read("worker.js")),
        "SCENES": inside_script(json.dumps([*example_scenes(), *tutorial_scenes()], ensure_ascii=False)),
        "SCRIPT": inside_script("\n".join(read(f"{name}.js") for name in SCRIPTS)),
    }
    return re.sub("|".join(f"@{name}@" for name in parts), lambda found: parts[found[0].strip("@")], read("page.html"))


def main():
    version = re.search(r"^project\(ashlar VERSION ([0-9.]+)", (PROJECT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=PROJECT / "build" / "browser" / "apps" / "ashlar.js")
    parser.add_argument("--out", type=pathlib.Path, default=PROJECT / "build" / f"ashlar-{version}-browser.html")
    options = parser.parse_args()
    page = page_of(options.program).encode("utf-8")
    if len(page) > LARGEST_BYTES:
        sys.exit(f"error: the page has {len(page)} bytes, at most {LARGEST_BYTES} are allowed: browsers open larger ones slowly")
    options.out.write_bytes(page)
    print(f"{options.out}: {len(page) / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
