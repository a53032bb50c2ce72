#!/usr/bin/python3
"""Two versions of the program over a folder of models: processor time, gaps and verdicts.

usage: foreign.py [--shape SHAPE] [--other-shape SHAPE] [--repeat N] [--limit SECONDS] <program> <other> <folder>

Every model is run once with one of *Stand* and *Mass* and a wall of 1 or 2 % of its diagonal, in
turn, by both programs one after the other. Prints a line for each model, then a table.
"""
import argparse
import json
import math
import pathlib
import resource
import statistics
import subprocess
import tempfile

CASES = [("Stand", 1), ("Mass", 1), ("Stand", 2), ("Mass", 2)]


def run(program, model, case, shape, limit):
    """Processor seconds and the report, empty where the program failed or was stopped."""
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))

    goal, wall = case
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([program, model, "--goal", goal, "--wall", f"{wall}%", "--cavity-shape", shape,
                        "--report", report, "--quiet"], cwd=folder, preexec_fn=limited,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return seconds, json.loads(report.read_text()) if report.exists() else {}


def measured(programs, model, case, options):
    """Of each program the median of its times, and its last report."""
    seconds = [[], []]
    reports = [{}, {}]
    for _ in range(options.repeat):
        for i, (program, shape) in enumerate(programs):
            spent, reports[i] = run(program, model, case, shape, options.limit)
            seconds[i].append(spent)
    return [statistics.median(each) for each in seconds], reports


def quantile(values, share):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def times_its_size(rows):
    """The longest time over the median of files as large, by powers of four."""
    classes = {}
    for seconds, model in rows:
        classes.setdefault(int(math.log(model.stat().st_size, 4)), []).append(seconds)
    return max(max(each) / statistics.median(each) for each in classes.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("other")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--shape", default="Automatic")
    parser.add_argument("--other-shape")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--limit", type=int, default=300)
    options = parser.parse_args()
    programs = [(options.program, options.shape),
                (options.other, options.other_shape or options.shape)]
    models = sorted(options.folder.iterdir())
    times, gaps, changed = [], [[], []], []
    for number, model in enumerate(models):
        case = CASES[number % len(CASES)]
        seconds, both = measured(programs, model.resolve(), case, options)
        times.append(seconds)
        for each, report in zip(gaps, both):
            if report.get("cavity_triangles") and report.get("gap_to_limit") is not None:
                each.append(100 * report["gap_to_limit"])
        solved = [report.get("solved") for report in both]
        if solved[0] != solved[1]:
            changed.append(model.name)
        print(f"{seconds[0]:8.2f} {seconds[1]:8.2f} {model.name} {case} {solved}", flush=True)
    ratios = [new / old for new, old in times]
    print(f"\n| {len(times)} models | program | other |\n|---|---|---|")
    print(f"| processor time over the other's, median | {statistics.median(ratios):.2f} | 1 |")
    print(f"| nine tenths below | {quantile(ratios, 0.9):.2f} | |")
    for name, of in (("median, s", statistics.median), ("longest, s", max)):
        print(f"| {name} | {of(t[0] for t in times):.2f} | {of(t[1] for t in times):.2f} |")
    print("| longest over the median of files of its size | "
          f"{times_its_size([(t[0], model) for t, model in zip(times, models)]):.1f} | |")
    for name, of in (("gap, median, %", statistics.median),
                     ("gap, 95 of 100, %", lambda each: quantile(each, 0.95)), ("worst, %", max)):
        print(f"| {name} | " + " | ".join(f"{of(each):.2f}" if each else "" for each in gaps) + " |")
    print(f"\nAnother verdict: {', '.join(changed) or 'none'}")


if __name__ == "__main__":
    main()
