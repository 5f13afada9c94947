"""Calls of the operating system are in folders named `system`: a port to another system is those files.

    system_calls.py PROJECT      exit status 1, with a line for each other file that includes a header of POSIX or Linux,
                                 or calls one of its functions that come with standard headers
    system_calls.py --self-test  each of them is found

Functions of the C library whose last bit differs between systems are refused as well where they have part in results:
those of geometry/exact/rounded_functions.hpp stand for them.
"""
import pathlib
import re
import sys

# The law of rough joints is evaluated at each point in each iteration: rounded functions would take most of the time.
UNROUNDED = {"mechanics/contact/laws/rough_joint.cpp"}
# Figures, references and reports, which follow from the results of runs.
REPORTS = ("apps/program/",)
ROUNDED = re.compile(r"(?:std::(?:a?(?:sin|cos|tan)h?|atan2|cbrt|exp[2m1]*|log(?:10|2|1p)?|pow|hypot|[lt]gamma|erfc?)(?=\(|[,}])|"
                     r"Eigen::AngleAxis\w*)")
LAYERS = ["geometry", "mechanics", "solver", "apps"]
HEADERS = re.compile(
    r'^\s*#\s*include\s*<((?:sys|linux|net|netinet|arpa|asm|bits)/[\w/.]+|(?:unistd|fcntl|pthread|dlfcn|signal|spawn|poll|'
    r'sched|semaphore|termios|dirent|pwd|grp|glob|fnmatch|ftw|libgen|locale|execinfo|malloc|mqueue|syslog|utime|ucontext|'
    r'wordexp|regex|strings|stdlib|stdio|time|cpuid|immintrin|windows|io|process)\.h)>')
CALLS = re.compile(
    r"(?<![\w.>])(?:::)?((?:mk[od]?[a-z]*temps?|fork|vfork|execv\w*|waitpid|kill|getpid|gethostname|isatty|fileno|pipe2?|popen|pclose|setenv|"
    r"unsetenv|putenv|realpath|readlink|sysconf|getrusage|sigaction|clock_gettime|nanosleep|usleep|localtime_r|gmtime_r|"
    r"strerror_r|posix_\w+|flock|fsync|ftruncate|mmap|munmap|lstat|fstat|_exit|getenv_s|environ))\s*\(")
NOT_CODE = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|//[^\n]*|/\*.*?\*/', re.S)


def faults_of_text(text):
    """Headers and functions of the system in a source."""
    found = [match[1] for line in text.splitlines() if (match := HEADERS.match(line))]
    code = NOT_CODE.sub('""', text)
    return found + [match[1] for match in CALLS.finditer(code)]


def unrounded_of_text(text):
    """Functions of the C library, and Eigen's that call them, in a source."""
    return ROUNDED.findall(NOT_CODE.sub('""', text))


def faults_of(project):
    """Lines for users."""
    for layer in LAYERS:
        for path in sorted((project / layer).glob("**/*.[ch]pp")):
            place = path.relative_to(project)
            if "system" in place.parts:
                continue
            for name in faults_of_text(path.read_text(encoding="utf-8")):
                yield f"{place}: {name} is of the operating system: it belongs into a folder `system`"
            if str(place) in UNROUNDED or str(place).startswith(REPORTS):
                continue
            for name in unrounded_of_text(path.read_text(encoding="utf-8")):
                yield f"{place}: {name} differs between systems: geometry/exact/rounded_functions.hpp"


def self_test():
    for text in ("#include <unistd.h>", "#include <sys/stat.h>", "  # include <signal.h>", "x = ::fork();", "if (isatty(2))",
                 "const int file = mkstemp(name);", "posix_fallocate(a, b, c);", "::_exit(1);"):
        assert faults_of_text(text), text
    for text in ("#include <csignal>", "#include <ctime>", '#include "apps/results/system/lock_file.hpp"', "// fork()",
                 'print("kill(1)")', "child.kill();", "my_fork();", "lock.lock();", "std::getenv(name)", "pair->pipe()"):
        assert not faults_of_text(text), text
    for text in ("x = std::sin(y);", "{std::cbrt, 1}", "std::expm1(x)", "std::pow(2.0, n)", "Eigen::AngleAxisd turn(a, b);"):
        assert unrounded_of_text(text), text
    for text in ("correctly_rounded::sin(y)", "std::sqrt(y)", "// std::sin(y)", "std::abs(x)", "std::exponential", "std::fmod(x, y)",
                 "std::log_of(x)"):
        assert not unrounded_of_text(text), text


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        self_test()
        sys.exit(0)
    faults = list(faults_of(pathlib.Path(sys.argv[1])))
    print("\n".join(faults))
    sys.exit(1 if faults else 0)
