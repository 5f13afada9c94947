#!/usr/bin/env python3
"""Random landings: makes scenes (scenes.py), runs the program on them and audits the results (audit.py).

    python3 tests/landings/landings.py --program build/release/apps/ashlar --out /tmp/landings.out --seed 1 --count 300
    python3 tests/landings/landings.py --seed 1 --count 300 --list
    python3 tests/landings/landings.py --audit RESULT_FOLDER

Exit status: 0 all scenes pass, 1 some fail, 2 wrong usage.
"""
import argparse
import concurrent.futures
import os
import shutil
import subprocess
import sys
import time

import audit
import scenes

KINDS = {"deep": "a block is deeper in another than springs hold it and 1e-3 of its size",
         "said so": "the program ended as failed and says why",
         "energy": f"mechanical energy rises by more than {audit.ENERGY_RISE:g} of its span",
         "timeout": "longer than --limit", "refused": "bad input: a fault of the scene or of the reader",
         "crash": "a signal, or no summary.json", "unread": "the audit itself failed on the result"}


def run(scene, out, options):
    """Runs the program; returns its exit status (None: over the limit), its first error, and seconds."""
    begin = time.monotonic()
    command = [options.program, "run", scene, "--out", out, "--threads", "1", "--quiet"]
    if options.every:
        command += ["--set", f"output.every={options.every}"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors="replace",
                              timeout=options.limit, check=False)
    except subprocess.TimeoutExpired:
        return None, f"killed after {options.limit:g} s", time.monotonic() - begin
    with open(os.path.join(os.path.dirname(scene), "stderr.txt"), "w", encoding="utf-8") as file:
        file.write(done.stderr)
    lines = done.stderr.strip().splitlines()
    errors = [line for line in lines if "error" in line] or lines[-1:]
    return done.returncode, errors[0] if errors else "", time.monotonic() - begin


def land(index, options):
    """Makes, runs and audits scene `index`.

    @return dict: index, scene (a line), ground, kinds (list, empty if it passes), text (why), run and audit (s)
    """
    scene = scenes.make_scene(options.seed, index)
    folder = os.path.join(options.out, f"{options.seed}_{index:04d}")
    shutil.rmtree(folder, ignore_errors=True)
    path, result = scenes.write_scene(scene, folder), os.path.join(folder, "result")
    status, message, seconds = run(path, result, options)
    report = {"index": index, "scene": scenes.describe(scene), "ground": scene["ground"], "kinds": [], "text": [],
              "run": seconds, "audit": 0.0, "share": 0.0}
    begin = time.monotonic()
    if status in (None, 2):
        report["kinds"].append("timeout" if status is None else "refused")
        report["text"].append(message)
    else:
        judge(report, result, status, message)
    report["audit"] = time.monotonic() - begin
    if not report["kinds"] and not options.keep:
        shutil.rmtree(folder)
    return report


def judge(report, result, status, message):
    """Adds the findings of the audit to the report."""
    try:
        audit.summary_of(result)
    except (OSError, ValueError) as error:
        report["kinds"].append("crash")
        report["text"].append(f"exit status {status}: {message} ({error!r})")
        return
    try:
        findings = audit.audit(result)
    except Exception as error:  # one scene must not end the campaign, and must not look like a fault of the program
        report["kinds"].append("unread")
        report["text"].append(f"exit status {status}: {message} ({error!r})")
        return
    report["share"] = findings["found"]["share"]
    if findings["deep"]:
        report["kinds"].append("deep")
    if findings["status"] != "completed" or status != 0:
        report["kinds"].append("said so" if status == 1 else "crash")
        report["text"].append(f"{findings['status']} ({status}): {message}")
    if findings["energy"]:
        report["kinds"].append("energy")
    springs_yield = findings["found"]["share"] > audit.ALLOWED_SHARE
    if report["kinds"] or findings["disagreement"] or springs_yield:
        report["text"] += told(findings)


def told(findings):
    """Findings in words."""
    found, texts = findings["found"], []
    if found["depth"]:
        place = ", ".join(f"{x:.5g}" for x in found["place"])
        texts.append(f"{found['block']} {found['depth']:.3g} m ({found['share']:.2g} of its size) in {found['inside']}"
                     f" at t={found['time']:.4g} ({place}); allowed {findings['allowed']:.3g}")
    if findings["energy"]:
        texts.append(f"energy rises by {findings['rise']:.2g} of its span ({findings['rise_joule']:.2g} J)"
                     f" until t={findings['rise_time']:.4g}")
    if findings["disagreement"]:
        texts.append(findings["disagreement"])
    elif findings["deepest"]:
        texts.append(f"deepest agrees: {findings['deepest']}")
    return texts


def table(reports):
    """The summary: kinds of failure with their scenes, then grounds."""
    lines = []
    for kind, meaning in KINDS.items():
        hits = [str(r["index"]) for r in reports if kind in r["kinds"]]
        lines.append(f"{kind}: {len(hits)} of {len(reports)} ({meaning}){': ' if hits else ''}{' '.join(hits)}")
    for ground in scenes.GROUNDS:
        own = [r for r in reports if r["ground"] == ground]
        if own:
            counts = ", ".join(f"{kind} {sum(kind in r['kinds'] for r in own)}" for kind in KINDS
                               if any(kind in r["kinds"] for r in own))
            lines.append(f"{ground}: {sum(bool(r['kinds']) for r in own)} of {len(own)} fail"
                         f"{' (' + counts + ')' if counts else ''}, worst {max(r['share'] for r in own):.2g}")
    times = sorted(r["run"] for r in reports)
    lines.append(f"run: median {times[len(times) // 2]:.2g} s, longest {times[-1]:.3g} s, all {sum(times):.3g} s;"
                 f" audit: {sum(r['audit'] for r in reports) / len(reports):.2g} s a scene")
    lines.append(f"{sum(bool(r['kinds']) for r in reports)} of {len(reports)} scenes fail")
    return "\n".join(lines)


def campaign(options):
    """Runs all requested scenes, prints failures as they end, then the summary; returns the exit status."""
    wanted = [options.only] if options.only is not None else range(options.count)
    os.makedirs(options.out, exist_ok=True)
    reports = []
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        for report in pool.map(land, wanted, [options] * len(wanted)):
            reports.append(report)
            if report["kinds"] or report["text"]:
                kinds = ", ".join(report["kinds"]) or "passes"
                print(f"{report['scene']}\n     {kinds}: {'; '.join(report['text'])}", flush=True)
    print(table(reports))
    return int(any(r["kinds"] for r in reports))


def audit_only(folder):
    """Audits a result folder of any scene."""
    findings = audit.audit(folder)
    for name, value in findings.items():
        print(f"{name}: {value}")
    return int(findings["deep"] or findings["energy"] or findings["status"] != "completed")


def parse():
    parser = argparse.ArgumentParser(description="Random landings on concave ground, run and audited.")
    parser.add_argument("--program", default="build/release/apps/ashlar")
    parser.add_argument("--out", default="landings.out", help="a folder for each scene that fails is left here")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=60, help="scenes 0 to COUNT - 1")
    parser.add_argument("--only", type=int, metavar="INDEX", help="this scene alone")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--limit", type=float, default=120, help="seconds that a run may take")
    parser.add_argument("--every", type=int, metavar="STEPS", help="steps between the frames that are audited; 1: all")
    parser.add_argument("--keep", action="store_true", help="leave the folders of all scenes")
    parser.add_argument("--list", action="store_true", help="print the parameters of the scenes, run nothing")
    parser.add_argument("--audit", metavar="FOLDER", help="audit this result folder, run nothing")
    options = parser.parse_args()
    if min(options.count, options.jobs, options.every or 1) < 1:
        parser.error("--count, --jobs and --every are at least 1")
    if not (options.list or options.audit or os.access(options.program, os.X_OK)):
        parser.error(f"no program {options.program}")
    options.program, options.out = os.path.abspath(options.program), os.path.abspath(options.out)
    return options


def main():
    options = parse()
    if options.audit:
        return audit_only(options.audit)
    if options.list:
        for index in [options.only] if options.only is not None else range(options.count):
            print(scenes.describe(scenes.make_scene(options.seed, index)))
        return 0
    return campaign(options)


if __name__ == "__main__":
    sys.exit(main())
