"""Runs the examples of the pages: every page in a separate folder, its blocks one after the other.

    run_pages.py PROGRAM MODULE_FOLDER [PAGE]...        without pages: all of tutorial/ and howto/, and the README

    toml NAME             (or with a caption) is written to a file of that name; `ashlar check` must find no error in it
    toml                  must be TOML
    sh                    is run by bash; the program is in the PATH
    python                is run, with the names of the blocks before
    text after sh, python must be what that has printed: words as they are, numbers to a part in 100, where a line
                          `...` stands for any lines
"""
import concurrent.futures
import contextlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
FENCE = re.compile(r"^```(?:\{code-block\} )?(\w+)(?: (\S+))?\n((?::\w+:[^\n]*\n)*)(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")


def blocks_of(page):
    """(line, language, file name or None, code) of each block."""
    text = page.read_text(encoding="utf-8")
    for match in FENCE.finditer(text):
        caption = re.search(r":caption: (.*)", match[3])
        name = match[2] or (caption and caption[1].strip())
        yield text.count("\n", 0, match.start()) + 1, match[1], name, match[4]


def agree(expected, seen):
    """True if two lines are equal apart from numbers, and their numbers nearly equal."""
    if NUMBER.sub("#", expected).split() != NUMBER.sub("#", seen).split():
        return False
    pairs = zip(NUMBER.findall(expected), NUMBER.findall(seen), strict=True)
    return all(abs(float(a) - float(b)) <= 1e-2 * abs(float(a)) + 1e-12 for a, b in pairs)


def printed(expected, seen):
    """True if lines are the expected ones; `...` matches any."""
    if not expected:
        return not seen
    if expected[0].strip() == "...":
        return any(printed(expected[1:], seen[k:]) for k in range(len(seen) + 1))
    return bool(seen) and agree(expected[0], seen[0]) and printed(expected[1:], seen[1:])


def run_shell(code):
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", code], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"exit status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def run_python(code, names):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(code, "block", "exec"), names)  # what a page shows is what is tested
    return out.getvalue()


def run_page(page):
    names, last = {}, ""
    for line, language, caption, code in blocks_of(page):
        try:
            if language == "toml" and caption:
                pathlib.Path(caption).write_text(code, encoding="utf-8")
                run_shell(f"ashlar check '{caption}'")
            elif language == "toml":
                tomllib.loads(code)
            elif language == "sh":
                last = run_shell(code)
            elif language == "python":
                last = run_python(code, names)
            elif language == "text" and not printed(code.splitlines(), last.splitlines()):
                raise AssertionError(f"printed:\n{last}")
        except BaseException as fault:
            print(f"{page}:{line}: {language}: {type(fault).__name__}: {fault}", flush=True)
            return 1
    return 0


def run_in_own_process(page, environment):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, __file__, "--page", page], cwd=folder, env=environment, capture_output=True,
                              text=True, check=False)
    return page, done.returncode, done.stdout + done.stderr


def main(arguments):
    if arguments[0] == "--page":
        return run_page(pathlib.Path(arguments[1]))
    program, module, *pages = arguments
    pages = [pathlib.Path(page).resolve() for page in pages] or [HERE.parents[1] / "README.md"] + sorted(
        page for folder in ("tutorial", "howto") for page in (HERE / folder).glob("*.md"))
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(module).resolve()), "MPLBACKEND": "Agg",
                   "PATH": f"{pathlib.Path(program).resolve().parent}{os.pathsep}{os.environ['PATH']}"}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda page: run_in_own_process(page, environment), pages))
    for page, status, said in results:
        print(f"{os.path.relpath(page, HERE)}: {'good' if status == 0 else 'failed'}\n{said}", end="")
    return max(status for _, status, _ in results)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
