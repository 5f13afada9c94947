"""Links of pages and code lead somewhere, and READMEs of layers name every header and note.

    links.py PROJECT        exit status 1, with a line for each fault
    links.py --self-test    that each kind of fault is found
"""
import fnmatch
import pathlib
import re
import sys
import tempfile

LAYERS = ("geometry", "mechanics", "solver", "apps")
SOURCES = (".hpp", ".cpp", ".py", ".js", ".txt", ".cmake", ".toml", ".sh")
SKIPPED = {"build", ".git", ".cache", "__pycache__"}
FENCE = re.compile(r"^```.*?^```[ ]*$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]+`")
# The words of a link may span lines and hold pictures: its end is enough.
LINK = re.compile(r"\]\(\s*<?([^()\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
HEADING = re.compile(r"^#{1,6} +(.*?) *#*$", re.MULTILINE)
SECTION = re.compile(r"^#{2,4} +(\d+(?:\.\d+)*)\.? ", re.MULTILINE)
CITED = re.compile(r"theory\.md,? (?:sections? )?(\d+(?:\.\d+)?(?:(?:, | and |, and )\d+(?:\.\d+)?)*)")


def files_of(project, suffixes):
    for path in sorted(project.rglob("*")):
        parts = path.relative_to(project).parts
        if path.suffix in suffixes and path.is_file() and not SKIPPED.intersection(parts) \
                and not any(part.endswith((".out", ".study", ".blocks")) for part in parts):
            yield path


def text_of(path):
    return path.read_text(encoding="utf-8", errors="replace")


def blanked(match):
    """Lines of code stay lines, so that those after them keep their numbers."""
    return "\n" * match[0].count("\n")


def anchors_of(page):
    """As GitHub and MyST make them: small letters, digits, `_` and `-`; a second one of the same name ends in -1."""
    anchors, seen = set(), {}
    for title in HEADING.findall(FENCE.sub(blanked, text_of(page))):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title).replace("`", "")
        anchor = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
        count = seen.get(anchor, 0)
        seen[anchor] = count + 1
        anchors.add(f"{anchor}-{count}" if count else anchor)
    return anchors


def broken_links(project):
    """Relative links of all pages whose file or heading is not there."""
    for page in files_of(project, (".md",)):
        text = CODE.sub("", FENCE.sub(blanked, text_of(page)))
        for match in LINK.finditer(text):
            target, _, anchor = match[1].partition("#")
            if re.match(r"[a-z]+:", match[1]):
                continue
            file = (page.parent / target).resolve() if target else page
            line = text.count("\n", 0, match.start()) + 1
            where = f"{page.relative_to(project)}:{line}: {match[1]}"
            if not file.exists():
                yield f"{where}: no such file"
            elif anchor and file.suffix == ".md" and anchor not in anchors_of(file):
                yield f"{where}: no such heading"


def unknown_sections(project):
    """Sections of the theory that code and notes cite, and that the book does not have."""
    theory = project / "apps" / "docs" / "theory.md"
    sections = set(SECTION.findall(text_of(theory))) if theory.exists() else set()
    for path in files_of(project, SOURCES + (".md",)):
        if path.relative_to(project).parts == ("tests", "docs", "links.py"):
            continue  # it has wrong ones for its self-test
        # A comment may break between the page and its number.
        text = re.sub(r"\n[ \t]*(?://+|#+|\*)?[ \t]*", " ", text_of(path))
        for match in CITED.finditer(text):
            for section in re.findall(r"\d+(?:\.\d+)?", match[1]):
                if section not in sections:
                    yield f"{path.relative_to(project)}: theory.md has no section {section}"


def names_in(text):
    """Names between backticks, without folders and suffixes; `a*` stands for many."""
    words = {word.strip() for code in re.findall(r"`([^`\n]+)`", text) for word in code.split(",")}
    return {pathlib.PurePath(word).name.removesuffix(".hpp").removesuffix(".cpp") for word in words if word}


def unnamed_files(project):
    """Headers and notes that the README of their layer does not name, and names in its file tables without a file."""
    for layer in LAYERS:
        page = project / layer / "README.md"
        if not page.exists():
            continue
        text = text_of(page)
        names = names_in(text)
        for header in files_of(project / layer, (".hpp",)):
            if not any(fnmatch.fnmatchcase(header.stem, name) for name in names):
                yield f"{layer}/README.md does not name {header.relative_to(project)}"
        for note in sorted((project / layer / "notes").glob("*.md")):
            if f"](notes/{note.name})" not in text:
                yield f"{layer}/README.md does not link {note.relative_to(project)}"
        there = {path.stem for path in (project / layer).rglob("*")} | {path.name for path in (project / layer).rglob("*")}
        # Tables `| folder | files | what they do |`.
        for cell in re.findall(r"^\| [^|]*\| ([^|]*)\| [^|]*\|$", text, re.MULTILINE):
            for name in names_in(re.sub(r"\[[^\]]*\]\([^)]*\)", "", cell)):
                if "*" not in name and name not in there:
                    yield f"{layer}/README.md names {name}, which is no file of the layer"


def unlinked_pages(project):
    """Pages of the book that its index does not link."""
    docs = project / "apps" / "docs"
    index = docs / "index.md"
    linked = {(docs / target).resolve() for target in LINK.findall(text_of(index))} if index.exists() else set()
    for page in files_of(docs, (".md", ".rst")):
        if page != index and page not in linked:
            yield f"apps/docs/index.md does not link {page.relative_to(docs)}"


CHECKS = (broken_links, unknown_sections, unnamed_files, unlinked_pages)


def faults_of(project):
    return [fault for check in CHECKS for fault in check(project)]


GOOD = {
    "README.md": "[book](apps/docs/theory.md#1-motion) [again](#read-me)\n# Read me\n`[0](no link)`\n```\n[x](none.md)\n```\n",
    "apps/docs/index.md": "# Book\n[theory](theory.md)\n",
    "apps/docs/theory.md": "# Theory\n## 1. Motion\n### 1.2 Rigid `motion`\n## 3. Time\n",
    "geometry/README.md": "| folder | files | what |\n|---|---|---|\n| . | `box`, `far_*` | [why](notes/why.md) |\n",
    "geometry/notes/why.md": "# Why\n[back](../README.md)\n",
    "geometry/box.hpp": "// A box (theory.md section 1.2,\n// see also theory.md\n// sections 1 and 3): more.\n",
    "geometry/far_box.hpp": "// theory.md section 1, equation (5)\n",
}
BAD = (
    ("README.md", "[book](apps/docs/theory.md#2-time)\n", "README.md:1: apps/docs/theory.md#2-time: no such heading"),
    ("README.md", "one\n[book\nof](gone.md)\n", "README.md:3: gone.md: no such file"),
    ("README.md", "[![picture](gone.png)](gone.md)\n", "README.md:1: gone.png: no such file"),
    ("geometry/box.hpp", "// theory.md sections 1 and 4\n", "geometry/box.hpp: theory.md has no section 4"),
    ("geometry/box.hpp", "// So (theory.md\n  // section 1.3).\n", "geometry/box.hpp: theory.md has no section 1.3"),
    ("geometry/ball.hpp", "", "geometry/README.md does not name geometry/ball.hpp"),
    ("geometry/notes/how.md", "# How\n", "geometry/README.md does not link geometry/notes/how.md"),
    ("geometry/README.md", GOOD["geometry/README.md"].replace("`box`", "`box`, `cube`"),
     "geometry/README.md names cube, which is no file of the layer"),
    ("apps/docs/limits.md", "# Limits\n", "apps/docs/index.md does not link limits.md"),
)


def self_test():
    """A good tree has no fault, and each change of it the one that is expected."""
    for file, text, expected in ((None, None, None), *BAD):
        with tempfile.TemporaryDirectory() as folder:
            project = pathlib.Path(folder).resolve()
            for name, content in {**GOOD, **({file: text} if file else {})}.items():
                (project / name).parent.mkdir(parents=True, exist_ok=True)
                (project / name).write_text(content, encoding="utf-8")
            faults = faults_of(project)
        if (expected is None and faults) or (expected and expected not in faults):
            print(f"self-test, {file}: expected {expected}, found {faults}")
            return 1
    print(f"{len(BAD)} kinds of faults are found")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    faults = faults_of(pathlib.Path(arguments[0]).resolve())
    print("\n".join(faults) or "all links lead somewhere")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
