"""Writes the generated parts of the book from the program, and checks that they are up to date.

    generate.py PROGRAM                    rewrites the pages
    generate.py PROGRAM --peers FOLDER     too the numbers of tests/peers: FOLDER has what their first lines say; they need the
                                           Python module
    generate.py PROGRAM --check            writes nothing; exit status 1 if a page differs from the program

    reference/commands.md   the help of each command, in the block after `<!-- ashlar NAME --help -->`
    reference/scene.md      the tables of keys, in the block after `<!-- keys: HEADING -->` ("top": outside of tables)
    reference/results.md    the tables of columns, in the block after `<!-- columns: FILE -->`
    validation.md           the table of `ashlar verify`, with references and sources from verify_sources.toml. --check runs
                            the cases that take less than a second or two. Below it our numbers beside those of others
                            (peer_results.toml)
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tomllib

DOCS = pathlib.Path(__file__).resolve().parent
PROJECT = DOCS.parents[1]


def output_of(program, *arguments, **more):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False, **more).stdout


# The help of commands.

def with_help(program, text):
    def block(match):
        told = output_of(program, *match[1].split()).strip()
        return f"{match[0].split(chr(10))[0]}\n```text\n{told}\n```"

    return re.sub(r"<!-- ashlar ([^\n]*) -->\n```text\n.*?```", block, text, flags=re.DOTALL)


# Keys of a scene.

KEYS = re.compile(r"(<!-- keys: (\S+) -->\n).*?(<!-- end of keys -->)", re.DOTALL)


def with_keys(program, text):
    tables = json.loads(output_of(program, "schema", "--keys"))

    def table(match):
        lines = ["| key | value | default | meaning |", "|---|---|---|---|"]
        for row in tables["" if match[2] == "top" else match[2]]:
            meaning = ", ".join(part for part in (row["unit"], row["meaning"]) if part)
            lines.append(f"| `{row['key']}` | {row['value']} | {row['default']} | {meaning + ' ' if meaning else ''}|")
        return match[1] + "\n".join(lines) + "\n" + match[3]

    return KEYS.sub(table, text)


# The tables of columns of results.md.

COLUMNS = re.compile(r"(<!-- columns: (\S+) -->\n).*?(<!-- end of columns -->)", re.DOTALL)
OF_MEASURES = {"": "", "block": "of a measure of a block, at its centroid: ", "point": "of a measure of a point: ",
               "pair": "of a measure of a pair: ", "bolt": "of a measure of a bolt or prop: ",
               "drift": "of a measure of a drift: ", "crack": "of a measure of cracks: "}


def column_rows(columns, start=""):
    """A row for each unit and meaning."""
    rows = {}
    for column in columns:
        rows.setdefault((column["unit"], column["meaning"]), []).append(f"`{column['name']}`")
    return [f"| {', '.join(names)} | {unit} | {start}{meaning} |" for (unit, meaning), names in rows.items()]


def with_columns(program, text):
    schema = json.loads(output_of(program, "schema", "--results"))

    def table(match):
        name = match[2]
        if name == "frames":
            lines = ["| file | field | unit | meaning |", "|---|---|---|---|"]
            for series, fields in schema["frames"].items():
                rows = column_rows(fields)
                lines += [f"| `{series}.pvd` {row}" if k == 0 else f"| {row}" for k, row in enumerate(rows)]
        else:
            lines = ["| column | unit | meaning |", "|---|---|---|"]
            kinds = schema[name] if name == "history.csv" else {"": schema[name]}
            for kind, columns in kinds.items():
                lines += column_rows(columns, OF_MEASURES[kind])
        return match[1] + "\n".join(lines) + "\n" + match[3]

    return COLUMNS.sub(table, text)


# The table of `ashlar verify`.

def rounded(value):
    return f"{value:.0e}".replace("e-0", "e-").replace("e+0", "e+")


def tolerances(case):
    values = {check["tolerance"] for check in case["checks"]}
    words = ["exact"] if 0.0 in values else []
    words += [rounded(value) for value in sorted(value for value in values if value)]
    return ", ".join(words + (["reported"] if None in values else []))


def error(case):
    """Of the comparison that is nearest to its tolerance."""
    checks = [check for check in case["checks"] if check["tolerance"]]
    if not checks:
        return "0" if 0.0 in {check["tolerance"] for check in case["checks"]} else \
            rounded(max(check["error"] for check in case["checks"]))
    worst = max(checks, key=lambda check: check["error"] / check["tolerance"])
    return "0" if worst["error"] == 0 else f"{rounded(worst['error'])} of {rounded(worst['tolerance'])}"


def group_of(entry, sources):
    """Folder of data/verification."""
    return entry["group"] if "group" in entry else sources["built_in"][entry["name"]]["group"]


def validation_rows(cases, listed, sources, errors):
    """The table's lines; `errors` are those of the page where a case has not been run."""
    lines = []
    by_name = {case["name"]: case for case in cases}
    for group, heading in sources["groups"].items():
        lines += ["", f"### {heading}", "", "| case | what | reference | source | tolerance | largest error |",
                  "|---|---|---|---|---|---|"]
        for entry in listed:
            name = entry["name"]
            if group_of(entry, sources) != group:
                continue
            about = entry if "scene" in entry else sources["built_in"][name]
            scene = "/".join(pathlib.Path(os.path.normpath(entry.get("scene", ""))).parts[-2:])
            shown = f"[`{name}`](../../data/verification/{scene})" if scene else f"`{name}`"
            case = by_name.get(name)
            rest = f"{tolerances(case)} | {error(case)}" if case else errors.get(name, "? | ?")
            lines.append(f"| {shown} | {entry['description']} | {about['reference']} | {about['source']} | {rest} |")
    return "\n".join(lines[1:]) + "\n"


TABLE = re.compile(r"(<!-- ashlar verify -->\n)(.*?)(<!-- end -->)", re.DOTALL)
ROW = re.compile(r"^\| \[?`([^`]+)`[^|]* \| .* \| ([^|]*) \| ([^|]*) \|$", re.MULTILINE)


def read_sources():
    return tomllib.loads((DOCS / "verify_sources.toml").read_text(encoding="utf-8"))


def with_verification(program, text, cases=None):
    """With all cases as they have been run, or without errors of a run: those of the page stay."""
    listed = json.loads(output_of(program, "verify", "--list", "--json"))
    sources = read_sources()
    built_in = {entry["name"] for entry in listed if "scene" not in entry}
    if built_in != set(sources["built_in"]):
        raise SystemExit("verify_sources.toml and `ashlar verify --list` differ: "
                         f"{sorted(built_in ^ set(sources['built_in']))}")
    if missing := {group_of(entry, sources) for entry in listed} - set(sources["groups"]):
        raise SystemExit(f"verify_sources.toml has no group for {sorted(missing)}")
    errors = {name: f"{tolerance} | {found}" for name, tolerance, found in ROW.findall(TABLE.search(text)[2])}
    rows = validation_rows(cases or [], listed, sources, errors)
    return TABLE.sub(lambda match: f"{match[1]}\n{rows}\n{match[3]}", text)


def changed_tolerances(program, text):
    """Quick cases that differ from the page, or fail."""
    slow = read_sources()["slow"]["cases"]
    listed = json.loads(output_of(program, "verify", "--list", "--json"))
    quick = [entry["name"] for entry in listed if entry["name"] not in slow]
    page = {name: tolerance for name, tolerance, _ in ROW.findall(TABLE.search(text)[2])}
    for case in json.loads(output_of(program, "verify", "--json", *quick))["cases"]:
        if not case["passed"]:
            yield f"{case['name']} does not pass"
        if tolerances(case) != page.get(case["name"]):
            yield f"{case['name']}: tolerance {tolerances(case)}, the page has {page.get(case['name'])}"


# Our numbers beside those of others.

PEERS = re.compile(r"(<!-- peer_results.toml -->\n)(.*?)(<!-- end of peers -->)", re.DOTALL)
PEER_ROW = re.compile(r"^\| (.*?) \| .*? \| ([^|]*) \| ([^|]*) \| [^|]* \|$", re.MULTILINE)
PEER_HEAD = "| what | by | their number | ours | difference | command |\n|---|---|---|---|---|---|\n"


def shown(value):
    """Six digits; nothing below a millionth is more than rounding here."""
    return "0" if abs(value) < 1e-6 else f"{value:.6g}"


def ours_of(result, case):
    """Our numbers, and their largest difference from those of others, as the table shows them."""
    by_name = {check["what"]: check for check in case["checks"]}
    checks = [by_name[name] for name in result["checks"]]
    if "verdict" in result:
        same = result["verdict"] == result["told"]
        return (result["verdict"] if checks[0]["passed"] else "FAILS"), "none" if same else "theirs is wrong"
    values = [check["measured"] * result.get("scale", 1) for check in checks]
    theirs = result["numbers"]
    if result.get("apart"):
        difference = "theirs is wrong"
    else:
        difference = f"{max(abs(our / their - 1) for our, their in zip(values, theirs, strict=True)):.0e}"
    return with_unit(values, result), difference


def with_unit(values, result):
    """The first and the last of some numbers."""
    ends = [shown(value) for value in (values[0], values[-1])]
    return " to ".join(dict.fromkeys(ends)) + (f" {result['unit']}" if "unit" in result else "")


def command_of(result):
    return f"python3 {result['script']} FOLDER" if "script" in result else f"ashlar verify {result['case']}"


def script_cases(folder):
    """What the scripts of tests/peers find with the files of others, as cases by the names of the scripts."""
    names = {result["script"] for result in read_peers() if "script" in result}
    return [{**json.loads(output_of(sys.executable, PROJECT / name, folder, "--json")), "name": name} for name in sorted(names)]


def read_peers():
    return tomllib.loads((DOCS / "peer_results.toml").read_text(encoding="utf-8"))["result"]


def with_peers(_, text, cases=None):
    """With our numbers of these cases; those of the page where a case has not been run."""
    by_name = {case["name"]: case for case in cases or []}
    page = {what: (ours, difference) for what, ours, difference in PEER_ROW.findall(PEERS.search(text)[2])}
    rows = ""
    for result in read_peers():
        case = by_name.get(result.get("case", result.get("script")))
        ours, difference = ours_of(result, case) if case else page.get(result["what"], ("?", "?"))
        theirs = result.get("told") or with_unit(result["numbers"], result)
        rows += (f"| {result['what']} | {result['by']} ({result['source']}) | {theirs} | {ours} | {difference} "
                 f"| `{command_of(result)}` |\n")
    return PEERS.sub(lambda match: f"{match[1]}\n{PEER_HEAD}{rows}\n{match[3]}", text)


def with_validation(program, text, cases=None):
    return with_peers(program, with_verification(program, text, cases), cases)


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--peers", type=pathlib.Path)
    options = parser.parse_args(arguments)
    program = str(pathlib.Path(options.program).resolve())
    faults = []
    for name, write in (("reference/commands.md", with_help), ("reference/scene.md", with_keys),
                        ("reference/results.md", with_columns),
                        ("validation.md", with_validation)):
        page = DOCS / name
        old = page.read_text(encoding="utf-8")
        if options.check:
            new = write(program, old)
            faults += [f"{name} differs from the program: generate.py rewrites it"] if new != old else []
            if write is with_validation:
                faults += changed_tolerances(program, old)
            continue
        more = [json.loads(output_of(program, "verify", "--json"))["cases"]] if write is with_validation else []
        if more and options.peers:
            more[0] += script_cases(options.peers)
        page.write_text(write(program, old, *more), encoding="utf-8")
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
