"""Numbers of the methods are not in the middle of functions: they are in settings.hpp, or stand beside their method with a name.

    method_numbers.py PROJECT      exit status 1, with a line for each number in a function of mechanics or solver
    method_numbers.py --self-test  each kind of them is found, and nothing else

A function declares no constant with a number. Its expressions have no number in scientific notation and no decimal fraction but
multiples of an eighth: those are of formulas (a half, three quarters), the others are tolerances, shares and factors, which have
a name, a unit and a consequence.
"""
import pathlib
import re
import sys

import sizes

LAYERS = ("mechanics", "solver")
# Folders and sources that still have such numbers.
NOT_YET = ("mechanics/contact/", "solver/contact/", "solver/linear/", "solver/statics/rigid_verdict.cpp", "solver/step/island/",
           "solver/step/solve/")

NUMBER = re.compile(r"(?<![\w.'])(?:0[xX][\da-fA-F.']+(?:[pP][+-]?\d+)?|\.?\d(?:[eE][+-]|'\w|[\w.])*)")
ARITHMETIC = r"(?:unsigned |long )*(?:double|float|int|long|short|unsigned|bool|auto|(?:std::)?(?:size_t|u?int\d+_t|ptrdiff_t))"
CONSTANT = re.compile(
    rf"(?<!if )\bconstexpr\b(?P<any>[^;(){{}}]*[={{][^;]*);|\bconst {ARITHMETIC} (?P<name>\w+)(?: = |\{{)(?P<value>[^;{{}}]*)\}}?;")
WORD = re.compile(r"(?<![\w.])[A-Za-z_]\w*")


def without_text(text):
    """C++ without comments, strings and lines of the preprocessor. Lines keep their numbers."""
    def replaced(found):
        return found[0] if found["number"] else " " + "\n" * found[0].count("\n")
    return sizes.LITERAL_OR_COMMENT.sub(replaced, text)


def is_of_formula(number):
    """True for whole numbers, and for decimal fractions that are multiples of an eighth."""
    digits = number.replace("'", "").rstrip("uUlLfFzZ")
    if digits[:2] in ("0x", "0X"):
        return "p" not in digits.lower()
    return "e" not in digits.lower() and (float(digits) * 8).is_integer()


def constants_of(code):
    """(place, words) of constants that code of a function declares with a number."""
    for found in CONSTANT.finditer(code):
        value = found["any"].partition("=")[2] or found["any"].partition("{")[2] if found["any"] else found["value"]
        is_number = NUMBER.search(value) and (found["any"] or not WORD.search(value))
        if is_number:
            words = found["any"].partition("=")[0].split() if found["any"] else [found["name"]]
            yield found.start(), f"{words[-1].partition('{')[0]} is a number that is declared in a function"


def faults_of_text(text):
    """Lines for users without the path."""
    ranges = set()
    for variant in sizes.variants(sizes.without_literals(text)):
        ranges.update((first, last) for _, first, last in sizes.functions_of(sizes.tokens_of(variant)))
    lines = without_text(text).split("\n")
    faults = set()
    for first, last in ranges:
        code = "\n".join(lines[first - 1:last])
        places = [(found.start(), f"{found[0]} has no name") for found in NUMBER.finditer(code) if not is_of_formula(found[0])]
        constants = list(constants_of(code))
        places = [one for one in places if not any(begin < one[0] < code.index(";", begin) for begin, _ in constants)]
        faults.update((first + code.count("\n", 0, place), what) for place, what in places + constants)
    return [f"{line}: {what}" for line, what in sorted(faults)]


def faults_of(project):
    """Lines for users."""
    for layer in LAYERS:
        for path in sorted((project / layer).rglob("*.[ch]pp")):
            place = path.relative_to(project).as_posix()
            if place.startswith(NOT_YET):
                continue
            for fault in faults_of_text(path.read_text(encoding="utf-8")):
                yield f"{place}:{fault}: it belongs beside its method, with a note, or into settings.hpp"


# In a function, each of these is one fault.
NUMBERS = ("constexpr double a = 1;", "constexpr int a = 60, b = 40;", "static constexpr std::size_t a = 4;", "constexpr double a{1e-9};",
           "constexpr std::array a = {0.5, 0.75};", "constexpr double a = 0.5 * std::numeric_limits<double>::epsilon();",
           "const double a = 1e-9;", "const int a = 12;", "constexpr double a =\n    1.0 - 1e-6;", "if (a > 1e-9 * b) return;", "b *= 0.9;",
           "b = std::max(a, 1E+3);", "b = 0x1p-10 * a;", "return a(1'0.1);", "b = 1.e2;", "g(.3);")
# Neither of these is one.
NO_NUMBERS = ("if constexpr (a == 7) return;", "constexpr double a = std::numeric_limits<double>::infinity();", "b = 0.5 * a + 1.25;",
              "const double a = 0.5 * b;", "const auto a = g(3);", "// 1e-9\n", 'g("1e-9, 0.1");', "b = a / 12.0;", "for (int k = 0; k < 3; ++k) {}",
              "b = 0x1e5;", "constexpr std::size_t a = count<T>();", "/* constexpr int a = 1; */", "const int a = b[2];", "g(a1e5, b.e3);")


def self_test():
    for body in NUMBERS:
        for text in (f"int f(int a) {{\n  {body}\n}}", f"struct A {{\n  int f() const {{ {body} }}\n}};", f"const auto f = [] {{\n  {body}\n}};"):
            assert len(faults_of_text(text)) == 1, (text, faults_of_text(text))
    for body in NO_NUMBERS:
        assert not faults_of_text(f"int f(int a) {{\n  {body}\n}}"), body
    for text in ("constexpr double a = 1e-9;", "namespace {\nconstexpr int a = 60;\n}\nint f();", "struct A {\n  static constexpr int a = 3;\n"
                 "  double b = 1e-9;\n};", "double f(double a = 1e-3);", "inline constexpr double a = 0.1, b = 0.2;"):
        assert not faults_of_text(text), text
    assert faults_of_text("int g() {\n  return 1;\n}\n\nint f() {\n  g();\n  constexpr int most = 3;\n}") == [
        "7: most is a number that is declared in a function"]
    print(f"{len(NUMBERS)} kinds of numbers in functions are found")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    faults = list(faults_of(pathlib.Path(arguments[0]).resolve()))
    print("\n".join(faults) or "numbers of the methods stand beside them")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
