#!/usr/bin/env python3
"""Hollows one model of any format that meshio reads and writes.

    hollow_with_meshio.py model.stl hollow.stl --goal Stand --wall 1.5

hollow.stl gets the outer and the inner surface together, ready for a slicer. Exit status 0 if the goal is
reached, 1 if it is missed, 2 if the model is refused.
"""
import argparse
import sys

import massprops
import meshio
import numpy as np


def read(path):
    """Vertices and triangles; STL repeats the vertices of every triangle, which become one."""
    mesh = meshio.read(path)
    vertices, place = np.unique(mesh.points, axis=0, return_inverse=True)
    return vertices, place.reshape(-1)[mesh.cells_dict["triangle"]]


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model")
    parser.add_argument("solid")
    parser.add_argument("--goal", default="Stand")
    parser.add_argument("--wall", help="mm, or % of the diagonal as in 1.5%%")
    arguments = parser.parse_args(words)
    vertices, faces = read(arguments.model)
    try:
        result = massprops.hollow(vertices, faces, goal=arguments.goal, inner_lower_bound=arguments.wall,
                                  single_precision=True)
    except massprops.InvalidInput as refusal:
        print(f"{arguments.model}: {refusal}", file=sys.stderr)
        return 2
    solid = result.solid
    meshio.Mesh(solid.vertices.astype(np.float32), [("triangle", solid.faces)]).write(arguments.solid)
    print(f"{arguments.model}: {result.report['mass_before']:.1f} g -> {result.report['mass_after']:.1f} g: "
          f"{result.report['message']}")
    return 0 if result.solved else 1


if __name__ == "__main__":
    sys.exit(main())
