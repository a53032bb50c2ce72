#!/usr/bin/env python3
"""Hollows every model of a folder with PyMeshLab and writes what came out into a table.

    pymeshlab_batch.py libfilter_massprops.so models/ hollowed/ --goal Stand --wall 1.5

For each model hollowed/ gets <name>.stl, the outer and the inner surface together, ready for a
slicer, and a line in report.csv: whether the goal is reached and every number of the report, or the
reason why the model was refused. Exit status 1 if any model was refused.

The plugin must be built for the PyMeshLab that runs it: docs/hosts.md.
"""
import argparse
import csv
import pathlib
import sys
import time

import numpy as np
import pymeshlab

FORMATS = {".ply", ".stl", ".obj", ".off"}


def hollow(meshes, source, target, parameters):
    """Writes the hollow model; the report as a dictionary."""
    meshes.clear()
    meshes.load_new_mesh(str(source))
    report = meshes.apply_filter("mass_property_optimization", **parameters)
    if len(meshes) == 3:  # the input, an outer surface that takes its place, the cavity
        meshes.set_current_mesh(0)
        meshes.delete_current_mesh()
    meshes.generate_by_merging_visible_meshes()
    meshes.save_current_mesh(str(target))
    return report


def row_of(report):
    """Points and matrices become one column a number."""
    row = {}
    for key, value in report.items():
        if isinstance(value, np.ndarray):
            for index, number in np.ndenumerate(value):
                row[key + "_" + "".join("xyz"[i] for i in index)] = number
        else:
            row[key] = value
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("plugin", type=pathlib.Path)
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--goal", default="Stand", help="entry of the filter's list of goals")
    parser.add_argument("--wall", type=float, help="minimum wall in mm; default: 1 %% of the diagonal")
    parser.add_argument("--up", default="+Z", help="up axis")
    arguments = parser.parse_args()

    pymeshlab.load_plugin(str(arguments.plugin.resolve()))
    parameters = {"goal": arguments.goal, "up_axis": arguments.up}
    if arguments.wall is not None:
        # Its name in 2022.2 was another.
        absolute = getattr(pymeshlab, "PureValue", None) or pymeshlab.AbsoluteValue
        parameters["inner_lower_bound"] = absolute(arguments.wall)

    # One for all: PyMeshLab up to 2025.7 still writes to the log of a set in which any filter failed.
    meshes = pymeshlab.MeshSet()
    models = sorted(p for p in arguments.models.iterdir() if p.suffix.lower() in FORMATS)
    arguments.results.mkdir(parents=True, exist_ok=True)
    rows, refused = [], 0
    for number, model in enumerate(models, 1):
        print(f"[{number}/{len(models)}] {model.name}: ", end="", flush=True)
        start = time.monotonic()
        try:
            report = hollow(meshes, model, arguments.results / (model.stem + ".stl"), parameters)
            rows.append({"model": model.name, "solved": report["solved"], "error": "",
                         **row_of(report)})
            verdict = "solved" if report["solved"] else "NOT solved"
            print(f"{verdict}, {report['mass_before']:.1f} g -> {report['mass_after']:.1f} g, "
                  f"{time.monotonic() - start:.1f} s")
        except pymeshlab.PyMeshLabException as error:
            refused += 1
            reason = str(error).partition("Details: ")[2].strip() or str(error).strip()
            rows.append({"model": model.name, "error": reason})
            print("refused: " + reason)

    columns = list(dict.fromkeys(key for row in rows for key in row)) or ["model"]
    with open(arguments.results / "report.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(rows)
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
