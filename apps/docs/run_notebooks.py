"""Runs the notebooks of the book in a kernel, and checks that they are stored without outputs.

    run_notebooks.py MODULE_FOLDER [NOTEBOOK]...        without notebooks: all of notebooks/

The notebooks compare their numbers with values by hand. Exit status 77: nbconvert, a kernel for Python or Chromium, which
draws their pictures, is not there.
"""
import concurrent.futures
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def missing_tools():
    missing = [name for name in ("nbconvert", "ipykernel", "matplotlib") if importlib.util.find_spec(name) is None]
    return missing + ([] if any(map(shutil.which, BROWSERS)) else ["chromium"])


def has_outputs(notebook):
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return any(cell.get("outputs") or cell.get("execution_count") for cell in cells)


def run(notebook, environment):
    """What is wrong with a notebook; empty: nothing."""
    if has_outputs(notebook):
        return "it is stored with outputs: jupyter nbconvert --clear-output --inplace removes them\n"
    with tempfile.TemporaryDirectory() as folder:
        own = {**environment, "IPYTHONDIR": folder, "JUPYTER_RUNTIME_DIR": folder}
        done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", folder,
                               "--ExecutePreprocessor.kernel_name=python3", notebook], cwd=folder, env=own,
                              capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def main(arguments):
    module, *notebooks = arguments
    if missing := missing_tools():
        print("no", ", ".join(missing))
        return 77
    notebooks = [pathlib.Path(path).resolve() for path in notebooks] or sorted((HERE / "notebooks").glob("*.ipynb"))
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(module).resolve()), "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    environment.pop("MPLBACKEND", None)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        faults = list(pool.map(lambda notebook: run(notebook, environment), notebooks))
    for notebook, fault in zip(notebooks, faults, strict=True):
        print(f"{os.path.relpath(notebook, HERE)}: {'failed' if fault else 'good'}\n{fault}", end="")
    return 1 if any(faults) or not notebooks else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
