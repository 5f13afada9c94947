"""Builds the documentation site: pages of this folder, the reference from data/, the API from headers and the module.

    build_docs.py PROJECT OUTPUT --module FOLDER_OF_THE_PYTHON_MODULE

Everything goes below OUTPUT, the site to OUTPUT/html. Warnings are errors, a link within the site that leads nowhere
too. Exit status 77: Sphinx, Breathe, MyST, Furo or Doxygen is not there.
"""
import argparse
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys

# Umbrella headers, as CMakeLists.txt has them.
UMBRELLAS = ("geometry/geometry.hpp", "mechanics/mechanics.hpp", "solver/solver.hpp", "apps/scene/scene_library.hpp",
             "apps/results/results_library.hpp")
# Where links to data/README.md's sections lead on the site.
SECTIONS = {"#scene-reference": "scene.md", "#result-reference": "results.md", "glossary.md": "glossary.md",
            "limits.md": "limits.md", "stability.md": "stability.md"}


def missing_tools():
    missing = [name for name in ("sphinx", "breathe", "myst_parser", "furo") if importlib.util.find_spec(name) is None]
    return missing + [tool for tool in ("doxygen", "cmake") if shutil.which(tool) is None]


def with_links_of_the_site(text):
    """Pictures go; links to what is not on the site become their text."""
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)

    def link(match):
        words, target = match[1], match[2].removeprefix("README.md").removeprefix("data/README.md")
        if target.startswith("http"):
            return match[0]
        return f"[{words}]({SECTIONS[target]})" if target in SECTIONS else words

    return re.sub(r"\[([^\]]*)\]\(([^)]*)\)", link, text)


def section(text, title):
    """The section `## title` as a page of its own."""
    body = text.split(f"\n## {title}\n", 1)[1].split("\n## ", 1)[0]
    body = re.sub(r"^###", "##", body, flags=re.MULTILINE)
    return f"# {title}\n\n{with_links_of_the_site(body)}"


def write_reference(project, source):
    folder = source / "reference"
    folder.mkdir()
    text = (project / "data" / "README.md").read_text(encoding="utf-8")
    (folder / "scene.md").write_text(section(text, "Scene reference"), encoding="utf-8")
    (folder / "results.md").write_text(section(text, "Result reference"), encoding="utf-8")
    for name in ("glossary.md", "limits.md", "stability.md"):
        page = (project / "data" / name).read_text(encoding="utf-8")
        (folder / name).write_text(with_links_of_the_site(page), encoding="utf-8")


def write_doxygen(project, output):
    """The XML that Breathe reads, of the headers that are installed."""
    headers = output / "headers"
    subprocess.run(["cmake", f"-DSOURCE={project}", f"-DOUTPUT={headers}", "-DUMBRELLAS=" + ";".join(UMBRELLAS), "-P",
                    project / "solver" / "cmake" / "CollectPublicHeaders.cmake"], check=True)
    for header in headers.rglob("*.hpp"):
        text = header.read_text(encoding="utf-8")
        # Breathe has one name for each exception, and cannot read a lambda as a default value.
        header.write_text(re.sub(r"= \[\] \{ return true; \}", "= always", text.replace("@throws", "Throws")),
                          encoding="utf-8")
    settings = {"INPUT": headers, "STRIP_FROM_PATH": headers, "OUTPUT_DIRECTORY": output / "doxygen", "RECURSIVE": "YES",
                "FILE_PATTERNS": "*.hpp", "GENERATE_XML": "YES", "GENERATE_HTML": "NO", "GENERATE_LATEX": "NO",
                "EXTRACT_ALL": "YES", "JAVADOC_AUTOBRIEF": "YES", "QUIET": "YES", "WARN_IF_DOC_ERROR": "NO",
                "WARN_IF_INCOMPLETE_DOC": "NO", "XML_PROGRAMLISTING": "NO"}
    text = "".join(f'{key} = "{value}"\n' for key, value in settings.items())
    (output / "doxygen").mkdir()
    subprocess.run(["doxygen", "-"], input=text, text=True, check=True, cwd=output)
    return output / "doxygen" / "xml"


def version_of(project):
    return re.search(r"project\(ashlar VERSION ([0-9.]+)", (project / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("project", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--module", type=pathlib.Path, required=True)
    options = parser.parse_args()
    if missing := missing_tools():
        print("no", ", ".join(missing))
        return 77
    project, output = options.project.resolve(), options.output.resolve()
    shutil.rmtree(output, ignore_errors=True)
    source = output / "source"
    shutil.copytree(project / "apps" / "docs", source)
    shutil.copy(project / "tests" / "package" / "consumer" / "pier.cpp", source / "api")
    shutil.copy(project / "tests" / "package" / "consumer" / "pier.toml", source / "api")
    write_reference(project, source)
    environment = {**os.environ, "ASHLAR_VERSION": version_of(project),
                   "ASHLAR_DOXYGEN_XML": str(write_doxygen(project, output)),
                   "PYTHONPATH": os.pathsep.join([str(options.module.resolve()), os.environ.get("PYTHONPATH", "")])}
    done = subprocess.run([sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "-d",
                           output / "doctrees", source, output / "html"], env=environment, check=False)
    if done.returncode == 0:
        print(output / "html" / "index.html")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
