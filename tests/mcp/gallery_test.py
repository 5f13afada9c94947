"""Runs gallery.mjs: jobs of the gallery through `ashlar mcp`, by the protocol's reference library.

Use: gallery_test.py ASHLAR FOLDER      FOLDER keeps the library, which npm fetches once

Exit status 77: there is no Node.js, or npm cannot fetch the library.
"""
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
FETCH_SECONDS = 180
LIBRARY = pathlib.Path("node_modules") / "@modelcontextprotocol" / "sdk" / "package.json"


def fetched(folder):
    """True if the library is in the folder."""
    wanted = (HERE / "package.json").read_bytes()
    folder.mkdir(parents=True, exist_ok=True)
    kept = folder / "package.json"
    if (folder / LIBRARY).is_file() and kept.is_file() and kept.read_bytes() == wanted:
        return True
    kept.write_bytes(wanted)
    try:
        done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=folder,
                              timeout=FETCH_SECONDS, capture_output=True, text=True, check=False)
    except subprocess.TimeoutExpired:
        return False
    print(done.stdout + done.stderr)
    return done.returncode == 0


def main(program, folder):
    folder = pathlib.Path(folder).resolve()
    if not (shutil.which("node") and shutil.which("npm") and fetched(folder)):
        print("no Node.js, or npm cannot fetch the library")
        return 77
    shutil.copy(HERE / "gallery.mjs", folder)
    browser = any(map(shutil.which, ("chromium", "chromium-browser", "google-chrome")))
    return subprocess.run(["node", "gallery.mjs", str(pathlib.Path(program).resolve()),
                           *([] if browser else ["--without-pictures"])], cwd=folder, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
