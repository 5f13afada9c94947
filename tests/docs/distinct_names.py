"""Sources can be joined to larger units: names of one source do not clash with those of another.

    distinct_names.py PROJECT      exit status 1, with a line for each clash
    distinct_names.py --self-test  each kind of clash is found

In the sources of a library a name in an unnamed namespace is one thing. Functions of the same name, those of headers and static ones too, differ in the
types of their parameters; types and aliases of the same name are the same alias, and a type of a header of any library has a name of
its own. A test has a namespace of its own, which ends
with the name of its file: helpers of tests are called cube and rock in many files. Sources in folders system/windows are not
joined, and stand for others.
"""
import collections
import pathlib
import re
import sys
import tempfile

# Folders whose sources are one library, the deepest first.
LIBRARIES = ["geometry", "mechanics", "solver/ranks/mpi", "solver", "apps/scene", "apps/results", "apps/run", "apps/python", "apps"]
TESTS = ["tests/unit", "tests/oracle"]
NAMED = r"^namespace ashlar \{"
NOT_CODE = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|//[^\n]*|/\*.*?\*/|^#[^\n]*',
                      re.S | re.M)
BODY_FOLLOWS = re.compile(r"^(?!.*= *\[).*\)\s*(const|noexcept)?\s*(->[^=]*)?$", re.S)


def statements(text, opening=r"^namespace \{"):
    """Declarations directly in unnamed namespaces, without bodies; `opening` of other namespaces."""
    code = NOT_CODE.sub(lambda found: '""' if found[0][0] in "\"R" else "", text)
    for namespace in re.finditer(opening, code, re.M):
        depth, words = 1, []
        for letter in code[namespace.end():]:
            if letter == "{":
                depth += 1
            elif letter == "}":
                depth -= 1
                if depth == 0:
                    break
                # A body ends a function; after an initialiser, a lambda or a type's body comes a semicolon.
                if depth == 1 and BODY_FOLLOWS.search("".join(words)):
                    yield " ".join("".join(words).split())
                    words = []
            elif depth == 1 and letter == ";":
                yield " ".join("".join(words).split())
                words = []
            elif depth == 1:
                words.append(letter)


def parts(text):
    """What commas separate outside all brackets."""
    depth, begin = 0, 0
    for place, letter in enumerate(text + ","):
        depth += {"<": 1, "(": 1, "[": 1, "{": 1, ">": -1, ")": -1, "]": -1, "}": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            yield text[begin:place].strip()
            begin = place + 1


def parameters(statement, start):
    """Types of the parameters of a function; `start` is behind its parenthesis."""
    depth, end = 1, start
    while depth:
        depth += {"(": 1, ")": -1}.get(statement[end], 0)
        end += 1
    types = [part.split(" = ")[0] for part in parts(statement[start:end - 1])]
    return ", ".join(re.sub(r"(?<=[\w>&*]) \w+(\[\])?$", "", one) for one in types)


def names(statement):
    """(name, what tells it from others of the same name), none for what declares no name."""
    statement = re.sub(r"^(\[\[[\w:, ]+\]\] )+", "", re.sub(r"^template <[^()]*?> (?=[a-z\[A-Z])", "", statement))
    if re.match(r"(using namespace|using [\w:]+$|static_assert|friend)\b", statement) or not statement:
        return
    if re.search(r"(?<![\w:])(?!std::)\w+::~?\w+ ?\(", statement.split("=")[0]):  # a member of a class
        return
    kind = re.match(r"(?:struct|class|enum class|enum|union) (\w+)", statement)
    alias = re.match(r"(?:using|namespace) (\w+) = (.*)", statement)
    function = re.search(r"(?<![:\w])(operator\s*\S+?|[A-Za-z_]\w*) ?\((?!\*)", statement)
    if kind:
        yield kind[1], "a type"
    elif alias:
        yield alias[1], "alias of " + alias[2]
    elif function and "=" not in statement[:function.start()]:
        yield function[1], "(" + parameters(statement, function.end()) + ")"
    else:
        for part in parts(statement):
            name = re.search(r"(\w+)(?:\[[\w: ]*\])*$", part.split(" =")[0])
            if name:
                yield name[1], "a variable"


def functions_of(text, opening, starts=""):
    """(name, types of parameters by value) of each function that is declared directly in a namespace."""
    for statement in statements(text, opening):
        if not statement.startswith(starts):
            continue
        for name, rest in names(statement.removeprefix("static ")):
            if rest.startswith("("):
                yield name, re.sub(r"\bconst |&", "", rest)


def types_of(text, opening):
    """Names of types that are declared directly in a namespace."""
    for statement in statements(text, opening):
        yield from (name for name, rest in names(statement) if rest == "a type")


def clashes_with_headers(sources, headers):
    """Lines for users: a function of a source that a header, or a static one of another source, has too, or a type that a
    header has. They would be ambiguous where both are in view.
    @param sources, headers {path: text}"""
    declared = {}
    for path, text in headers.items():
        for function in functions_of(text, NAMED):
            declared.setdefault(function, path)
    own = collections.defaultdict(set)
    for path, text in sources.items():
        for function in (*functions_of(text, r"^namespace \{"), *functions_of(text, NAMED, "static ")):
            own[function].add(path)
    for (name, types), paths in own.items():
        others = ([declared[name, types]] if (name, types) in declared else []) + sorted(paths)
        if len(others) > 1:
            yield f"{others[1]}: {name}{types} is also in {others[0]}"
    types = {}
    for path, text in headers.items():
        for name in types_of(text, NAMED):
            types.setdefault(name, path)
    for path, text in sources.items():
        for name in types_of(text, r"^namespace \{"):
            if name in types:
                yield f"{path}: {name}, a type, is also in {types[name]}"


def clashes_of_library(sources):
    """Lines for users. @param sources {path: text}"""
    known = collections.defaultdict(lambda: collections.defaultdict(list))
    for path, text in sorted(sources.items()):
        for statement in statements(text):
            for name, rest in names(statement):
                if path not in known[name][rest]:
                    known[name][rest].append(path)
    for name, meanings in known.items():
        for rest, paths in meanings.items():
            if len(paths) > 1 and not rest.startswith("alias of"):
                yield f"{paths[1]}: {name}, {rest}, is also in {paths[0]}"
        kinds = {rest if rest.startswith("alias of") else rest.split(" (")[0][:1] for rest in meanings}
        if len({path for paths in meanings.values() for path in paths}) > 1 and len(kinds) > 1:
            paths = [paths[0] for paths in meanings.values()]
            yield f"{paths[1]}: {name} is something else in {paths[0]}"


def faults_of(project):
    """Lines for users."""
    of_library = collections.defaultdict(dict)
    for path in sorted(project.glob("**/*.cpp")):
        place = path.relative_to(project).as_posix()
        library = next((name for name in LIBRARIES if place.startswith(name + "/")), None)
        if library and "/system/windows/" not in place:
            of_library[library][place] = path.read_text(encoding="utf-8")
        elif any(place.startswith(name + "/") for name in TESTS) and path.stem.endswith("_test"):
            if not re.search(rf"^namespace ashlar(::\w+)*::{path.stem} \{{$", path.read_text(encoding="utf-8"), re.M):
                yield f"{place}: its namespace does not end with ::{path.stem}"
    headers = {path.relative_to(project).as_posix(): path.read_text(encoding="utf-8")
               for path in sorted(project.glob("**/*.hpp")) if path.relative_to(project).parts[0] in LIBRARIES}
    for sources in of_library.values():
        yield from clashes_of_library(sources)
        yield from clashes_with_headers(sources, headers)


def self_test():
    """Exit status."""
    in_unnamed = "namespace ashlar {{\nnamespace {{\n\n{}\n\n}}  // namespace\n}}  // namespace ashlar\n".format
    first = in_unnamed("struct Side {\n  int from;\n};\nusing Json = A;\nconstexpr double low = 1.0, high = 2.0;\n"
                       "int sum(const Side& a, int b) {\n  return b;\n}\nvoid print(int a);\n"
                       "int Side::high(int a) const {\n  return a;\n}")
    cases = {
        "struct Side {\n  int to;\n};": 1,
        "using Side = int;": 1,
        "using Json = A;": 0,
        "using Json = B;": 1,
        "constexpr int high = 3;": 1,
        "int sum(const Side& x, int y = 3) {\n  return 1;\n}": 1,
        "int sum(const Side& x, double y) {\n  return 1;\n}": 0,
        "int low() {\n  return 1;\n}": 1,
        "int other(int sum) {\n  const int low = 1;\n  return low;\n}": 0,
        "template <class T>\nvoid print(T a) {}": 0,
        'const char* text = "int low = 1;";': 0,
        "int Side::low(int a) const {\n  return a;\n}": 0,
    }
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        project = pathlib.Path(folder)
        (project / "solver").mkdir()
        (project / "tests" / "unit").mkdir(parents=True)
        (project / "solver" / "a.cpp").write_text(first, encoding="utf-8")
        for second, expected in cases.items():
            (project / "solver" / "b.cpp").write_text(in_unnamed(second), encoding="utf-8")
            found = list(faults_of(project))
            if min(len(found), 1) != expected:
                print(f"{second!r}: {found}")
                wrong = 1
        (project / "solver" / "c.hpp").write_text("namespace ashlar {\nstruct Whole {\n  int size;\n};\nint half(double whole);\n}\n", encoding="utf-8")
        for second, expected in (("int half(const double& all) {\n  return 1;\n}", 1), ("int half(int all) {\n  return 1;\n}", 0),
                                 ("struct Whole {\n  int length;\n};", 1)):
            (project / "solver" / "b.cpp").write_text(in_unnamed(second), encoding="utf-8")
            if min(len(list(faults_of(project))), 1) != expected:
                print(f"{second!r} beside a header")
                wrong = 1
        (project / "solver" / "b.cpp").write_text("", encoding="utf-8")
        for stem, expected in (("a_test", 0), ("b_test", 1)):
            (project / "tests" / "unit" / (stem + ".cpp")).write_text("namespace ashlar::a_test {\n", encoding="utf-8")
            if len(list(faults_of(project))) != expected:
                print(f"{stem}: {list(faults_of(project))}")
                wrong = 1
    return wrong


def main():
    """Exit status."""
    if sys.argv[1] == "--self-test":
        return self_test()
    faults = list(faults_of(pathlib.Path(sys.argv[1]).resolve()))
    print("".join(fault + "\n" for fault in faults), end="")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
