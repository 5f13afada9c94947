"""Builds the documentation site: the pages of this folder, and the API from headers and the module.

    build_docs.py PROJECT OUTPUT --module FOLDER_OF_THE_PYTHON_MODULE

Everything goes below OUTPUT, the site to OUTPUT/html. Warnings are errors, a link within the site that leads nowhere
too. Where the page that runs scenes has been made (apps/package/browser/make_browser.sh) it is a part of the site, and scenes of
the tutorials have links to it. Exit status 77: Sphinx, Breathe, MyST, Furo or Doxygen is not there.
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
             "apps/results/results_library.hpp", "apps/run/run_library.hpp")
# Suffixes of files of the repository that the site takes along where a page links to them.
TAKEN_ALONG = (".png", ".toml", ".csv", ".py", ".cpp")
# Name in the site of the page that runs scenes.
RUN_PAGE = "ashlar-browser.html"
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")


def missing_tools():
    missing = [name for name in ("sphinx", "breathe", "myst_parser", "furo") if importlib.util.find_spec(name) is None]
    return missing + [tool for tool in ("doxygen", "cmake") if shutil.which(tool) is None]


class Site:
    """The pages of a folder as Sphinx reads them: they are written for the repository's own pages."""

    def __init__(self, project, source, runs=False):
        """runs: the site has the page that runs scenes"""
        self.project, self.docs, self.source, self.runs = project, project / "apps" / "docs", source, runs

    def link(self, page, match):
        """Links within the book stay; files of the repository are taken along, other pages of it become their words."""
        picture, words, target = match.groups()
        path = target.partition("#")[0]
        if "://" in target or not path:
            return match[0]
        file = (self.docs / page).parent.joinpath(path).resolve()
        if file.is_relative_to(self.docs) and file.is_file():
            return match[0]
        if file.suffix not in TAKEN_ALONG:
            return words
        copy = self.source / "files" / file.relative_to(self.project)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, copy)
        return f"{picture}[{words}]({os.path.relpath(copy, (self.source / page).parent)})"

    def text(self, page):
        """Also "```toml NAME" gets NAME as its caption; the index gets the tables of contents that Sphinx needs."""
        text = (self.docs / page).read_text(encoding="utf-8")
        if page == pathlib.Path("index.md"):
            text = with_contents(text)
        text = re.sub(r"^```(\w+) (\S+)$", r"```{code-block} \1\n:caption: \2", text, flags=re.MULTILINE)
        blocks = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
        return "".join(block + self.trial(page, block) if block.startswith("```") else LINK.sub(lambda match: self.link(page, match), block)
                       for block in blocks)

    def trial(self, page, block):
        """A link below a scene of a tutorial that opens it where it runs."""
        name = re.match(r"```\{code-block\} toml\n:caption: (\S+\.toml)\n", block)
        if not self.runs or not name or page.parent.name != "tutorial":
            return ""
        return f'\n\n<p><a href="../{RUN_PAGE}#scene={page.stem}/{name[1]}">Try it here</a>, in the browser.</p>'

    def write(self):
        for file in sorted(self.docs.rglob("*.md")):
            page = file.relative_to(self.docs)
            (self.source / page).write_text(self.text(page), encoding="utf-8")


def with_contents(text):
    """Each section of the index has a list of links to pages: Sphinx reads it as a table of contents."""
    head, *sections = re.split(r"^## ", text, flags=re.MULTILINE)
    for section in sections:
        pages = [re.sub(r"\.(md|rst)$", "", target) for _, _, target in LINK.findall(section) if "://" not in target]
        title = section.splitlines()[0]
        head += f"## {section.rstrip()}\n\n```{{toctree}}\n:caption: {title}\n:hidden:\n\n" + "\n".join(pages) + "\n```\n\n"
    return head


def write_doxygen(project, output):
    """The XML that Breathe reads, of the headers that are installed."""
    headers = output / "headers"
    subprocess.run(["cmake", f"-DSOURCE={project}", f"-DOUTPUT={headers}", "-DUMBRELLAS=" + ";".join(UMBRELLAS), "-P",
                    project / "apps" / "package" / "cmake" / "CollectPublicHeaders.cmake"], check=True)
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
    run_page = project / "build" / f"ashlar-{version_of(project)}-browser.html"
    Site(project, source, run_page.is_file()).write()
    environment = {**os.environ, "ASHLAR_VERSION": version_of(project),
                   "ASHLAR_DOXYGEN_XML": str(write_doxygen(project, output)),
                   "PYTHONPATH": os.pathsep.join([str(options.module.resolve()), os.environ.get("PYTHONPATH", "")])}
    done = subprocess.run([sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "-d",
                           output / "doctrees", source, output / "html"], env=environment, check=False)
    if done.returncode == 0:
        if run_page.is_file():
            shutil.copy(run_page, output / "html" / RUN_PAGE)
        print(output / "html" / "index.html")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
