"""How soon a run can be ended: the longest times between two questions whether to go on, in milliseconds of
processor time of the calling thread, with the stage that the run was in.

usage: cancelling.py [--subdivide N] [--goals A,B] [--shapes A,B] MODEL...

A question is a call of `progress`, after which Ctrl-C or an exception ends the run. The program `massprops` asks
nobody: a signal ends it at once.
"""
import argparse
import time

import meshio
import numpy as np

import massprops

SHAPES = ["Best possible", "Offset surface"]


def subdivided(vertices, faces):
    """Every triangle cut in four."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    ends, number = np.unique(edges, axis=0, return_inverse=True)
    middle = len(vertices) + number.reshape(-1, 3)
    corner = [np.column_stack([faces[:, k], middle[:, k], middle[:, k - 1]]) for k in range(3)]
    return np.concatenate([vertices, vertices[ends].mean(axis=1)]), np.concatenate([*corner, middle])


class Questions:
    """Written down as they come."""

    def __init__(self):
        self.last, self.stage = time.thread_time(), "Making arrays ready"
        self.longest = {}

    def __call__(self, _, stage):
        now = time.thread_time()
        self.longest[self.stage] = max(now - self.last, self.longest.get(self.stage, 0.0))
        self.stage, self.last = stage, time.thread_time()


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--subdivide", type=int, default=0, help="times")
    parser.add_argument("--goals")
    parser.add_argument("--shapes")
    options = parser.parse_args()
    entries = {row["name"]: row["entries"] for row in massprops.parameters()}
    goals = options.goals.split(",") if options.goals else entries["goal"]
    shapes = options.shapes.split(",") if options.shapes else SHAPES
    print(f"{'model':30} {'triangles':>9} {'goal':22} {'shape':14} {'longest':>7}  ms, stage")
    for path in options.models:
        model = meshio.read(path)
        vertices, faces = np.asarray(model.points, float), model.cells_dict["triangle"]
        for _ in range(options.subdivide):
            vertices, faces = subdivided(vertices, faces)
        for goal in goals:
            for shape in shapes:
                questions = Questions()
                try:
                    massprops.hollow(vertices, faces, goal=goal, cavity_shape=shape, progress=questions)
                    end = ""
                except (massprops.InvalidInput, RuntimeError) as refusal:
                    end = f"  ({str(refusal)[:50]})"
                questions(100, "")
                worst = sorted(questions.longest.items(), key=lambda entry: -entry[1])[:2]
                said = ", ".join(f"{stage} {1000.0 * t:.0f}" for stage, t in worst)
                print(f"{path.split('/')[-1][:30]:30} {len(faces):9} {goal:22} {shape:14} "
                      f"{1000.0 * worst[0][1]:7.0f}  {said}{end}", flush=True)


main()
