"""Subjects of new commits have the form `area: what` and at most 72 characters.

    commit_subjects.py PROJECT      exit status 1, with a line for each fault; 77 where there is no history to read
    commit_subjects.py --self-test  each kind of fault is found, also in a shallow clone

Commits from before FIRST and merges are not judged. A shallow clone is judged by the commits that it has.
"""
import datetime
import os
import pathlib
import re
import subprocess
import sys
import tempfile

FIRST = datetime.datetime(2026, 11, 27, 12, 0, tzinfo=datetime.timezone.utc)  # committer date
LONGEST = 72
# Areas are folders, layers or topics, several of them with commas: "apps/run, solver: ...".
FORM = re.compile(r"[a-z][a-z0-9_./-]*(?:, [a-z][a-z0-9_./-]*)*: \S.*")
SKIPPED = 77
OF_A_HOOK = {"GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_OBJECT_DIRECTORY", "GIT_COMMON_DIR", "GIT_PREFIX"}


def fault_of(subject):
    """The fault of a subject in words, or None."""
    if len(subject) > LONGEST:
        return f"has {len(subject)} characters; at most {LONGEST} are allowed"
    if not FORM.fullmatch(subject):
        return 'is not of the form "area: what"'
    return None


def git(folder, *arguments, date=None):
    """Standard output of git in a folder, or None where git fails or is missing."""
    # In a hook, variables would lead git to another repository than the one in the folder.
    environment = {name: value for name, value in os.environ.items() if name not in OF_A_HOOK} | {"LC_ALL": "C"}
    if date:
        environment |= {"GIT_AUTHOR_DATE": date, "GIT_COMMITTER_DATE": date}
    try:
        done = subprocess.run(["git", "-C", str(folder), *arguments], env=environment, capture_output=True,
                              text=True, encoding="utf-8", errors="replace", check=False)
    except OSError:
        return None
    return done.stdout if done.returncode == 0 else None


def commits_of(project):
    """(committer time in seconds, short hash, subject) of commits that are no merges, or None without a history."""
    top = git(project, "rev-parse", "--show-toplevel")
    # Sources unpacked inside another project's repository have no history of their own.
    if top is None or pathlib.Path(top.rstrip("\n")).resolve() != project:
        return None
    log = git(project, "-c", "log.showSignature=false", "log", "--no-merges", "--format=%ct%x09%h%x09%s")
    return None if log is None else [line.split("\t", 2) for line in log.splitlines()]


def faults_of(project):
    """Lines for users, newest commit first, or None without a history."""
    commits = commits_of(project)
    if commits is None:
        return None
    new = [(name, subject) for time, name, subject in commits if int(time) > FIRST.timestamp()]
    return [f"commit {name}: subject {fault}: {subject}" for name, subject in new if (fault := fault_of(subject))]


GOOD = ("solver: stop Newton when the residual stalls", "apps/run, geometry: a: b", "a: " + "b" * 69)
BAD = ("a: " + "b" * 70, "Stop Newton", "solver:stop", "solver: ", "Solver: stop", "solver : stop", "solver, : stop",
       "fixup! solver: stop")


def commit(folder, subject, date):
    git(folder, "-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgSign=false", "commit", "--no-verify",
        "--allow-empty", "-m", subject, date=date)


def repository_faults():
    """A fault of this script in a repository, whole and shallow, with a bad commit before FIRST and one after it, or None."""
    with tempfile.TemporaryDirectory() as folder:
        whole, shallow = pathlib.Path(folder).resolve() / "whole", pathlib.Path(folder).resolve() / "shallow"
        whole.mkdir()
        if faults_of(whole) is not None:
            return "a folder without a history has one"
        if git(whole, "init") is None:
            return None  # no git on this machine
        commit(whole, "An old one", "2026-11-27T11:59:59+00:00")
        commit(whole, "A new one", "2026-11-27T12:00:01+00:00")
        commit(whole, "solver: a good one", "2026-11-27T12:00:02+00:00")
        (whole / "inside").mkdir()
        git(folder, "clone", "--depth", "2", whole.as_uri(), str(shallow))
        for project in (whole, shallow):
            faults = faults_of(project)
            if faults is None or len(faults) != 1 or not faults[0].endswith("A new one"):
                return f"{project.name}: expected one fault, found {faults}"
        return "a folder inside a repository has its history" if faults_of(whole / "inside") is not None else None


def self_test():
    wrong = [subject for subject in GOOD if fault_of(subject)] + [subject for subject in BAD if not fault_of(subject)]
    if wrong or (wrong := repository_faults()):
        print(f"self-test: {wrong}")
        return 1
    print(f"{len(BAD)} bad subjects are found")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    faults = faults_of(pathlib.Path(arguments[0]).resolve())
    if faults is None:
        print("skipped: no history of commits here")
        return SKIPPED
    print("\n".join(faults) or f"subjects of commits since {FIRST:%Y-%m-%d %H:%M} UTC are as they should be")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
