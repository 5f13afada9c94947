"""Functions, files and folders keep sizes that a reader can survey.

    sizes.py PROJECT      exit status 1, with a line for each function, file and folder that is too large
    sizes.py --self-test  each of them is found, whatever else is in its C++

A function has at most 60 lines, from the first line of its declaration to its closing brace; its lambdas and local classes are a part
of it. The same holds for a lambda outside functions. Functions of tests are not measured. A file has at most 400 lines, and a folder
directly at most 40 sources of C++.
"""
import collections
import pathlib
import re
import sys
import tempfile

LONGEST_FUNCTION = 60
LONGEST_FILE = 400
FULLEST_FOLDER = 40
LAYERS = ("geometry", "mechanics", "solver", "apps")
CPP = (".cpp", ".hpp")
SOURCES = (*CPP, ".py", ".js", ".cmake", ".sh")
SKIPPED = {"build", "__pycache__"}

STRING = r'"(?:\\.|[^"\\\n])*"'
LITERAL_OR_COMMENT = re.compile(
    r'(?P<raw>(?<!\w)(?:u8|[uUL])?R"(?P<end>[^\s()\\]*)\(.*?\)(?P=end)")'
    rf"|(?P<string>{STRING})"
    r"|(?P<number>(?<!\w)\.?\d(?:[eEpP][+-]|'\w|[\w.])*)"
    r"|(?P<letter>'(?:\\.|[^'\\\n])+')"
    r"|(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)"
    rf"|(?P<directive>^[ \t]*#(?:\\\n|{STRING}|//[^\n]*|/\*.*?\*/|[^\n])*)",
    re.S | re.M)
CONDITION = re.compile(r"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif)\b")
TOKEN = re.compile(r"\w+|::|->|\[\[|[^\s\w]")
CLOSING = {"(": ")", "{": "}", "[": "]", "[[": "]"}
# Before one of these a closing brace is that of an initialiser or of a value in an expression, not that of a function.
AFTER_INITIALISER = set(",;{(.>&|?+-*/=<!%^)[:") | {"catch"}
AFTER_PARAMETERS = {"const", "volatile", "noexcept", "override", "final", "mutable", "&", "try"}
NO_FUNCTIONS = {"alignas", "decltype", "explicit", "noexcept", "requires"}

Token = collections.namedtuple("Token", "text line")


class Unbalanced(Exception):
    """A bracket lacks its counterpart."""


def without_literals(text):
    """C++ with a number in place of each literal and without comments. Of the preprocessor's lines the conditions are left. Lines
    keep their numbers."""
    def replaced(found):
        words = "" if found["comment"] else " 0"
        if found["directive"]:
            condition = CONDITION.match(found[0])
            words = "#" + condition[1] if condition else ""
        return words + " " + "\n" * found[0].count("\n")
    return LITERAL_OR_COMMENT.sub(replaced, text)


def variants(code):
    """The code with the first branch of each condition of the preprocessor, with the second one, and so on; a condition with fewer
    branches takes part with its last one."""
    lines = code.split("\n")
    counts = []  # of branches by condition
    places = []  # by line: (condition, branch) of all conditions that it is in; None: the line is of a condition itself
    within = []
    for line in lines:
        found = CONDITION.match(line)
        if found and found[1].startswith("if"):
            within.append((len(counts), 0))
            counts.append(1)
        elif found and within:
            condition, branch = within.pop()
            if found[1] != "endif":
                within.append((condition, branch + 1))
                counts[condition] += 1
        places.append(None if found else tuple(within))
    for variant in range(max(counts, default=1)):
        yield "\n".join(
            line if place is not None and all(branch == min(variant, counts[condition] - 1) for condition, branch in place) else ""
            for line, place in zip(lines, places))


def tokens_of(code):
    return [Token(found[0], number) for number, line in enumerate(code.split("\n"), 1) for found in TOKEN.finditer(line)]


def end_of(tokens, begin):
    """Index of the bracket that closes the one at `begin`. @throws Unbalanced"""
    expected = []
    for place in range(begin, len(tokens)):
        text = tokens[place].text
        if text in CLOSING:
            expected += [CLOSING[text]] * len(text)
        elif text in (")", "}", "]"):
            if expected.pop() != text:
                break
            if not expected:
                return place
    raise Unbalanced(f"{tokens[begin].line}: {tokens[begin].text} is not closed")


def without_template_heads(head):
    """The words of a declaration behind `template <...>` and its constraint."""
    while head[:2] == ["template", "<"]:
        depth = 0
        for place, text in enumerate(head):
            depth += {"<": 1, ">": -1}.get(text, 0)
            if text == ">" and depth == 0:
                break
        head = head[place + 1:]
    types = [place for place, text in enumerate(head) if text in ("class", "struct", "union")]
    return head[types[0]:] if head[:1] == ["requires"] and types else head


def opens_scope(head):
    """True if a brace after these words is that of a namespace or a type: declarations follow."""
    words = re.sub(r"\[\[.*?\] ?\]|alignas \(.*?\)", "", " ".join(without_template_heads(head))).strip()
    if re.match(r"(inline )?namespace\b|extern 0$", words):
        return True
    words = re.sub(r"^((typedef|static|inline|constexpr|const|friend) )+", "", words)
    name = words.split(" : ")[0]
    return bool(re.match(r"(class|struct|union|enum)\b", words)) and "=" not in words and ("(" not in name or name.endswith(">"))


def function_name(head):
    """For users."""
    head, angles, brackets = without_template_heads(head), 0, 0
    for place, text in enumerate(head):
        if text == "operator":
            end = head.index("(", place + 2)
            break
        if text == "(" and not angles and not brackets and re.match(r"\w", head[place - 1]) and head[place - 1] not in NO_FUNCTIONS:
            place, end = place - 1, place
            break
        angles += {"<": 1, ">": -1}.get(text, 0)
        brackets += (text in ("(", "{")) - (text in (")", "}"))
    else:
        return "a function"
    first = place
    while first and head[first - 1] in ("::", "~"):
        first -= 2 if head[first - 1] == "::" else 1
    return re.sub(r"\boperator(?=\w)", "operator ", "".join(head[first:end]))


def variable_name(head):
    """For users."""
    found = re.search(r"[\w>*&] ([A-Za-z_]\w*) (?:\[[^=]*\] )?[=({]", " ".join(head))
    return found[1] if found else "a variable"


def follows_parameters(tokens, brace):
    place = brace - 1
    while place >= 0 and tokens[place].text in AFTER_PARAMETERS:
        place -= 1
    return place >= 0 and tokens[place].text == ")"


def ends_function(tokens, start, brace, last):
    """True if the brace at `brace`, closed at `last`, is the body of the function whose declaration begins at `start`."""
    head = [token.text for token in tokens[start:brace]]
    following = tokens[last + 1].text if last + 1 < len(tokens) else ""
    if following == ";":
        return "=" not in head and follows_parameters(tokens, brace)
    is_constraint = re.search(r"\brequires( \([^()]*\))?$", " ".join(head))
    return following not in AFTER_INITIALISER and not is_constraint


def is_macro_alone(tokens, start, last):
    """True if the words from `start` to a parenthesis at `last` are a macro on lines of its own, without a semicolon."""
    return (re.fullmatch(r"[A-Z][A-Z0-9_]+", tokens[start].text) and end_of(tokens, start + 1) == last and last + 1 < len(tokens)
            and tokens[last + 1].line > tokens[last].line and re.match(r"\w", tokens[last + 1].text)
            and tokens[last + 1].text not in AFTER_PARAMETERS)


def lambdas_of(declaration):
    """(first line, last line) of lambdas in the declaration of a variable."""
    place = 1
    while place < len(declaration):
        before = declaration[place - 1].text
        if declaration[place].text == "[" and (before == "return" or not re.match(r"\w|[\])>]", before)):
            body = end_of(declaration, place) + 1
            while body < len(declaration) and declaration[body].text not in ("{", ";", ","):
                body = (end_of(declaration, body) if declaration[body].text == "(" else body) + 1
            if body < len(declaration) and declaration[body].text == "{":
                first, place = declaration[place].line, end_of(declaration, body)
                yield first, declaration[place].line
        place += 1


def functions_of(tokens):
    """(name, first line, last line) of functions, and of lambdas outside functions. @throws Unbalanced"""
    start, place, scopes = 0, 0, 0
    while place < len(tokens):
        text, after = tokens[place].text, place + 1
        head = [token.text for token in tokens[start:place]]
        if text in ("(", "[", "[["):
            after = end_of(tokens, place) + 1
            if text == "(" and place == start + 1 and is_macro_alone(tokens, start, after - 1):
                start = after
        elif text == "{" and opens_scope(head):
            scopes += 1
            start = after
        elif text == "{":
            last = end_of(tokens, place)
            after = last + 1
            if ends_function(tokens, start, place, last):
                yield function_name(head), tokens[start].line, tokens[last].line
                start = after
        elif text == ";":
            for first, last in lambdas_of(tokens[start:place]):
                yield f"a lambda of {variable_name(head)}", first, last
            start = after
        elif text == "}" or text == ":" and head in (["public"], ["private"], ["protected"]):
            scopes -= text == "}"
            start = after
        place = after
    if scopes:
        raise Unbalanced(f"{len(tokens) and tokens[-1].line}: braces do not balance")


def long_functions(text):
    """Lines for users without the path."""
    found = set()
    try:
        for code in variants(without_literals(text)):
            found.update(functions_of(tokens_of(code)))
    except Unbalanced as fault:
        return [str(fault)]
    return [f"{first}: {name} has {last - first + 1} lines; at most {LONGEST_FUNCTION} are allowed"
            for name, first, last in sorted(found, key=lambda one: one[1:]) if last - first >= LONGEST_FUNCTION]


def faults_of(project):
    """Lines for users."""
    in_folder = collections.Counter()
    for top in (*LAYERS, "tests"):
        for path in sorted((project / top).rglob("*")):
            place = path.relative_to(project)
            if path.suffix not in SOURCES or not path.is_file() or SKIPPED.intersection(place.parts):
                continue
            text = path.read_text(encoding="utf-8")
            in_folder[place.parent.as_posix()] += path.suffix in CPP
            if (count := len(text.splitlines())) > LONGEST_FILE:
                yield f"{place} has {count} lines; at most {LONGEST_FILE} are allowed"
            if path.suffix in CPP and top in LAYERS:
                yield from (f"{place}:{fault}" for fault in long_functions(text))
    for folder, count in in_folder.items():
        if count > FULLEST_FOLDER:
            yield f"{folder} has {count} sources; at most {FULLEST_FOLDER} are allowed"


# C++ with one function each, from the first $ to the second one; @ is for lines that fill it.
FUNCTIONS = (
    ("f", "$int f() {\n@\n}$"),
    ("f", "template <class T>\nvoid g() {}\n\n$template <class T, class U = decltype(T() -> a)>\n[[nodiscard]] int f(int a = g({1}),\n"
          "  A c = {}) noexcept(h({})) {\n@\n}$\nint g() {\n  return 1;\n}"),
    ("A::A", "$A::A(int a)\n    : Base<int>{a}, a_{[] { return 1; }()}, b_([] {\n        return 2;\n      }),\n      c_{} {\n@\n}$"),
    ("g", "namespace a {\nnamespace {\nclass alignas(8) A final : public B<sizeof(int)> {\n public:\n  A() = default;\n"
          "  $int g() const override {\n@\n  }$\n private:\n  int a_ = 1;\n};\n}\n}"),
    ("~A", "struct A {\n  enum class B : int { a, b };\n  $~A() {\n@\n  }$\n} a;"),
    ("operator bool", "struct A {\n  $explicit operator bool() const {\n@\n  }$\n};"),
    ("operator()", "template <class T>\n  requires C<T>\nstruct A {\n  $auto operator()(int a) const -> int {\n@\n  }$\n};"),
    ("A::operator<", "$bool A::operator<(const A& a) const& {\n@\n}$\nint b;"),
    ("operator new", "$void* operator new(std::size_t n) {\n@\n}$"),
    ("f", "$template <class T>\n  requires requires(T t) { t.a(); }\nvoid f(const T& t) {\n@\n}$"),
    ("f", "$void f() try {\n@\n} catch (...) {\n}$"),
    ("f", "$std::function<void(int)> f() {\n@\n}$;"),
    ("f", '$int f() {\n  g("}"); h(\'}\'); i("\\"}"); j(\'\\\'\', 1\'000\'000, \'}\');  // }\n  /* }\n  } */\n@\n}$'),
    ("f", '$int f() {\n  a = R"(\n}}" // )"; b = u8R"x(}\n)" })x"; c = "R"; d = "(}";\n@\n}$\nint g() {\n}'),
    ("f", "#define BEGIN {\n#define TWO(a) \\\n  int a() { \\\n  }\n$int f() {\n  // a comment \\\n  }\n@\n}$"),
    ("f", "#if A  // it's\n$int f(int a) {\n#elif B\nint f(int b) {\n#endif\n@\n}$"),
    ("f", "#ifdef A\nint g() {\n  return 1;\n}\n#else\n$int f() {\n@\n}$\n#endif"),
    ("f", 'extern "C" {\n$int f(void) {\n@\n}$\n}'),
    ("f", "$int f() {\n  struct A {\n    int g() {\n      return 1;\n    }\n  };\n  const auto h = [] {\n@\n  };\n}$"),
    ("f", "MACRO(a, b)\nnamespace a {\n$int f() {\n@\n}$\n}"),
    ("TEST", "$TEST(A, B) {\n@\n}$"),
    ("a lambda of f", "namespace a {\nconst auto f = $[](int a) -> int {\n@\n}$;\n}"),
    ("a lambda of table", 'const Row table[] = {{"a", [] { return 1; }},\n  {"b", $[&a](int b) {\n@\n}$}};'),
    ("a lambda of a", "struct A {\n  std::function<int()> a = $[] {\n@\n  }$;\n};"),
    ("a lambda of a", "const A a(1, $[] {\n@\n}$);"),
)
# @ is for many lines; none of these has a long function.
NO_LONG_FUNCTION = (
    "const int a[] = {\n@\n};", "const std::vector<int> a{\n@\n};", "enum A {\n@\n};", "struct A {\n@\n};\nint f() {\n}", "/*\n@\n*/",
    'const char* const a = R"(\nint f() {\n@\n}\n)";', "template <class T>\nconcept A = requires(T t) {\n@\n};",
    "#if A\n@\n#endif\nint f() {\n}", "namespace a {\n@\n}", "const struct {\n@\n} a[] = {{1}};",
    "template <>\nstruct A<decltype(f())> {\n@\n};")
UNBALANCED = ("int f() {", "namespace a {\nint f();", "int f() {\n}\n}", "int f(int a {\n}")
FILES = (  # path, lines, fault
    ("geometry/a.cpp", 400, None), ("geometry/a.cpp", 401, "geometry/a.cpp has 401 lines; at most 400 are allowed"),
    ("tests/docs/a.py", 401, "tests/docs/a.py has 401 lines; at most 400 are allowed"), ("apps/build/a.cpp", 401, None),
    ("data/a.cpp", 401, None), ("solver/a.md", 401, None))


def faulty_text():
    """C++ in which long_functions finds too little or too much, or None."""
    for name, text in FUNCTIONS:
        before, inside, behind = text.split("$")
        for lines in (LONGEST_FUNCTION, LONGEST_FUNCTION + 1):
            filled = inside.replace("@", "\n".join(["  ++a;"] * (lines - inside.count("\n"))))
            fault = f"{before.count(chr(10)) + 1}: {name} has {lines} lines; at most {LONGEST_FUNCTION} are allowed"
            if (found := long_functions(before + filled + behind)) != [fault][:lines - LONGEST_FUNCTION]:
                return filled, found
    for text in NO_LONG_FUNCTION:
        if found := long_functions(text.replace("@", "  int a;\n" * LONGEST_FUNCTION)):
            return text, found
    return next((text for text in UNBALANCED if not long_functions(text)), None)


def faulty_tree():
    """A tree in which faults_of finds too little or too much, or None."""
    function = "int f() {\n" + "  ++a;\n" * LONGEST_FUNCTION + "}\n"
    cases = [({path: "\n" * lines}, fault) for path, lines, fault in FILES]
    cases += [({"solver/a.cpp": function}, "solver/a.cpp:1: f has 62 lines; at most 60 are allowed"), ({"tests/a.cpp": function}, None)]
    for count in (FULLEST_FOLDER, FULLEST_FOLDER + 1):
        full = {f"tests/unit/a{number}.{'ch'[number % 2]}pp": "" for number in range(count)} | {"tests/unit/in/a.cpp": ""}
        cases.append((full, f"tests/unit has {count} sources; at most {FULLEST_FOLDER} are allowed" if count > FULLEST_FOLDER else None))
    for files, fault in cases:
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            found = list(faults_of(pathlib.Path(folder)))
        if found != ([fault] if fault else []):
            return fault, found
    return None


def self_test():
    if wrong := faulty_text() or faulty_tree():
        print(f"self-test: {wrong}")
        return 1
    print(f"functions in {len(FUNCTIONS)} kinds of C++ are measured")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    faults = list(faults_of(pathlib.Path(arguments[0]).resolve()))
    print("\n".join(faults) or "functions, files and folders have sizes as they should be")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
