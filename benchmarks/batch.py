#!/usr/bin/python3
"""What a batch costs against single runs: processor seconds (user and system) a model, each way in turn.

usage: batch.py <build folder> <rounds> <model> ...

Prints the medians over the rounds as a table, and the least and the greatest.
"""
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

EXAMPLE = pathlib.Path(__file__).resolve().parents[1] / "examples" / "batch_with_dask.py"
TASK = f"""import importlib.util, pathlib, sys
spec = importlib.util.spec_from_file_location("batch", "{EXAMPLE}")
batch = importlib.util.module_from_spec(spec)
spec.loader.exec_module(batch)
for model, target in batch.work_in(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])):
    batch.hollow(str(model), str(target), {{"goal": "Stand"}})
"""


def run(*words):
    """Exit status 1 and 2 are models whose goal is missed, or that are refused."""
    done = subprocess.run([str(word) for word in words], stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, check=False)
    assert done.returncode in (0, 1, 2), f"{words[0]} ended with {done.returncode}"


def ways(build, models):
    program = build / "command_line" / "massprops"
    asked = ["--goal", "Stand", "--solid", "{name}.stl", "--report", "{name}.json"]
    files = sorted(models.iterdir())

    def single():
        for model in files:
            run(program, model, *asked)

    return {
        "`massprops`, a process for each model": single,
        "`massprops --jobs 1`": lambda: run(program, *files, "--jobs", "1", *asked),
        "`massprops --jobs 2`": lambda: run(program, *files, "--jobs", "2", *asked),
        "the task of the example with Dask, in one process without Dask":
            lambda: run(sys.executable, "-c", TASK, models, "."),
        "`examples/batch_with_dask.py --workers 2`":
            lambda: run(sys.executable, EXAMPLE, models, "out", "--workers", "2", "--goal", "Stand"),
    }


def spent(way):
    """Processor seconds of what `way` started and waited for."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        way()
        os.chdir("/")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(build, rounds, *models):
    build = pathlib.Path(build).resolve()
    os.environ["PYTHONPATH"] = str(build / "python")
    with tempfile.TemporaryDirectory() as folder:
        linked = pathlib.Path(folder)
        for model in map(pathlib.Path, models):
            (linked / model.name).symlink_to(model.resolve())
        tried = ways(build, linked)
        seconds = {name: [] for name in tried}
        for _ in range(int(rounds)):
            for name, way in tried.items():
                seconds[name].append(spent(way) / len(models))
                print(f"{seconds[name][-1]:.3f} {name}", file=sys.stderr, flush=True)
    print("| way | processor seconds a model | least | greatest |\n|---|---|---|---|")
    for name, each in seconds.items():
        print(f"| {name} | {statistics.median(each):.3f} | {min(each):.3f} | {max(each):.3f} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
