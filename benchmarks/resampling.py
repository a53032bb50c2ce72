#!/usr/bin/python3
"""The program against MeshLab's *Uniform Mesh Resampling*, which offsets a surface by a wall as well.

usage: resampling.py [--repeat N] [--memory GB] <program> <model> ...

Processor time of whole processes, medians; *Mass* and a wall of 1 % of the diagonal, cells of 1/128 of
it. Models on which the resampling fails, an assertion of vcglib's as a rule, are told and not counted.
"""
import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import tempfile

SERVER = pathlib.Path(__file__).resolve().parents[1] / "scripts" / "meshlabserver.sh"
SCRIPT = """<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Uniform Mesh Resampling">
  <Param type="RichAbsPerc" name="CellSize" value="{cell}" min="0" max="{diagonal}"/>
  <Param type="RichAbsPerc" name="Offset" value="{offset}" min="-{diagonal}" max="{diagonal}"/>
  <Param type="RichBool" name="mergeCloseVert" value="false"/>
  <Param type="RichBool" name="discretize" value="false"/>
  <Param type="RichBool" name="multisample" value="false"/>
  <Param type="RichBool" name="absDist" value="false"/>
 </filter>
</FilterScript>
"""


def spent(words, memory):
    """Processor seconds."""
    def limited():
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(word) for word in words], preexec_fn=limited, check=False,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measured(options, model, folder):
    report = folder / "report.json"
    inner, resampled = folder / "inner.ply", folder / "resampled.ply"
    hollow = [options.program, model, "--goal", "Mass", "--wall", "1%", "-o", inner, "--report", report,
              "--quiet"]
    spent(hollow, options.memory)
    diagonal = 100 * json.loads(report.read_text())["min_wall"]
    script = folder / "resample.mlx"
    script.write_text(SCRIPT.format(cell=diagonal / 128, offset=-diagonal / 100, diagonal=diagonal))
    resample = [SERVER, "-i", model, "-o", resampled, "-s", script]
    times = [], []
    for _ in range(options.repeat):
        times[0].append(spent(hollow, options.memory))
        times[1].append(spent(resample, options.memory))
    is_done = resampled.exists()
    # What the host takes to read and write, and the screen to start, is not resampling.
    script.write_text("<!DOCTYPE FilterScript>\n<FilterScript/>\n")
    alone = statistics.median(spent(resample, options.memory) for _ in range(options.repeat))
    return statistics.median(times[0]), statistics.median(times[1]), alone, is_done


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("models", type=pathlib.Path, nargs="+")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--memory", type=lambda gb: int(float(gb) * 2**30), default=8 * 2**30)
    options = parser.parse_args()
    ratios = []
    print("| model | program, s | resampling, s | host alone, s | ratio |\n|---|---|---|---|---|")
    for model in options.models:
        with tempfile.TemporaryDirectory() as folder:
            ours, other, alone, is_done = measured(options, model.resolve(), pathlib.Path(folder))
        ratio = f"{ours / other:.2f}" if is_done else "failed"
        if is_done:
            ratios.append(ours / other)
        print(f"| {model.stem} | {ours:.2f} | {other:.2f} | {alone:.2f} | {ratio} |", flush=True)
    print(f"\nMedian of {len(ratios)}: {statistics.median(ratios):.2f}, greatest {max(ratios):.2f}.")


if __name__ == "__main__":
    main()
