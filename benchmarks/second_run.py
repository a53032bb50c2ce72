"""What a run on a prepared model costs: processor time of a second goal, and of a second wall, on `massprops.Model`
over that of the first run on it. Medians of three; one thread.

usage: second_run.py [--shape S] MODEL...
"""
import argparse
import statistics
import time

import meshio
import numpy as np

import massprops

FIRST = {"goal": "Stand", "inner_lower_bound": "1%"}
SECOND = {"goal": {"goal": "Mass", "inner_lower_bound": "1%"},
          "wall": {"goal": "Stand", "inner_lower_bound": "2%"}}


def seconds(run, **wishes):
    before = time.process_time()
    run(**wishes)
    return time.process_time() - before


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--shape", default="Automatic")
    parser.add_argument("--times", type=int, default=3)
    options = parser.parse_args()
    massprops.set_thread_count(1)
    print(f"{'model':30} {'triangles':>9} {'first':>6}"
          + "".join(f" {change:>6} {'fresh':>6} {'ratio':>6}" for change in SECOND))
    ratios = {change: [] for change in SECOND}
    for path in options.models:
        mesh = meshio.read(path)
        vertices, faces = np.asarray(mesh.points, float), mesh.cells_dict["triangle"]
        line = {}
        for _ in range(options.times):
            for change, wishes in SECOND.items():
                model = massprops.Model(vertices, faces)
                first = seconds(model.hollow, cavity_shape=options.shape, **FIRST)
                second = seconds(model.hollow, cavity_shape=options.shape, **wishes)
                fresh = seconds(massprops.Model(vertices, faces).hollow, cavity_shape=options.shape, **wishes)
                line.setdefault("first", []).append(first)
                line.setdefault(change, []).append(second)
                line.setdefault(change + " fresh", []).append(fresh)
        median = {key: statistics.median(values) for key, values in line.items()}
        print(f"{path.split('/')[-1][:30]:30} {len(faces):9} {median['first']:6.2f}" + "".join(
            f" {median[c]:6.2f} {median[c + ' fresh']:6.2f} {median[c] / median['first']:6.2f}" for c in SECOND),
            flush=True)
        for change in SECOND:
            ratios[change].append(median[change] / median["first"])
    print("median ratio: " + ", ".join(f"{c} {statistics.median(r):.2f}" for c, r in ratios.items()))


main()
