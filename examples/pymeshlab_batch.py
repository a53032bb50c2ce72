#!/usr/bin/env python3
"""Hollows every model of a folder with PyMeshLab and writes what came out into a table.

    pymeshlab_batch.py libfilter_massprops.so models/ hollowed/ --goal Stand --wall 1.5

For each model hollowed/ gets <name>.stl, the outer and the inner surface together, ready for a
slicer, and report.csv a line: whether the goal is reached and every number of the report, or the
reason why the model was refused. The table is complete after each model. Exit status 1 if any model
was refused, 2 if nothing could be done at all.

The plugin must be built for the PyMeshLab that runs it: docs/hosts.md.
"""
import argparse
import collections
import csv
import os
import pathlib
import sys
import time

FORMATS = {".ply", ".stl", ".obj", ".off"}
OUTER, INNER = " outer offset surface", " inner offset surface"


class CannotBegin(Exception):
    """What was asked for cannot work for any model; the text says why."""


def jobs(models, results):
    """Pairs of a model and the file for its result, sorted by name. All paths absolute: while
    MeshLab reads a file it works in that file's folder, and stays there if it cannot read it."""
    models, results = pathlib.Path(models).resolve(), pathlib.Path(results).resolve()
    if not models.is_dir():
        raise CannotBegin(f"{models} is no folder")
    if results == models:
        raise CannotBegin(f"{results} holds the models, which results could overwrite: "
                          "name another folder for them")
    files = sorted(p for p in models.iterdir() if p.suffix.lower() in FORMATS)
    if not files:
        raise CannotBegin(f"{models} holds no models ({', '.join(sorted(FORMATS))})")
    stems = collections.Counter(p.stem.lower() for p in files)
    # horse.ply and horse.stl are two models.
    return [(p, results / ((p.stem if stems[p.stem.lower()] == 1 else p.name) + ".stl"))
            for p in files]


def bounding_layers(labels):
    """Places of the layers that bound the material: the model, or the outer surface that takes its
    place, and the cavity if there is one. `labels`: of all layers, the model's first."""
    made = [i for i, label in enumerate(labels) if i > 0 and label.endswith((OUTER, INNER))]
    replaced = any(labels[i].endswith(OUTER) for i in made)
    return made if replaced else [0] + made


def reason_of(error):
    """The sentence in an exception of PyMeshLab's, which names the filter before it."""
    text = str(error).partition("Details: ")[2] or str(error)
    return " ".join(text.split()) or type(error).__name__


def row_of(report):
    """Points and matrices become one column a number."""
    row = {}
    for key, value in report.items():
        shape = getattr(value, "shape", ())
        if len(shape) == 1:
            row.update((key + "_" + "xyz"[i], value[i]) for i in range(shape[0]))
        elif len(shape) == 2:
            row.update((key + "_" + "xyz"[i] + "xyz"[j], value[i, j])
                       for i in range(shape[0]) for j in range(shape[1]))
        else:
            row[key] = value
    return row


def write_table(rows, path):
    """The whole table, or the one before stays. Models differ in their keys, so that a line can add
    columns."""
    columns = list(dict.fromkeys(key for row in rows for key in row)) or ["model"]
    unfinished = path.with_name(path.name + ".part")
    with open(unfinished, "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(rows)
    os.replace(unfinished, path)


def run(work, hollow, table, fatal=(), say=print):
    """Calls hollow(model, target) for each pair of `work`, which returns a report; returns how many
    models failed. What a model raises ends up in its line of the table, but for exceptions of the
    types `fatal`, which would be the same for every model."""
    rows, refused = [], 0
    for number, (model, target) in enumerate(work, 1):
        say(f"[{number}/{len(work)}] {model.name}: ", end="", flush=True)
        start = time.monotonic()
        try:
            report = hollow(model, target)
        except fatal as error:
            raise CannotBegin(reason_of(error)) from error
        except Exception as error:  # pylint: disable=broad-except
            refused += 1
            rows.append({"model": model.name, "error": reason_of(error)})
            say("refused: " + reason_of(error))
        else:
            rows.append({"model": model.name, "solved": report["solved"], "error": "",
                         **row_of(report)})
            say(f"{'solved' if report['solved'] else 'NOT solved'}, "
                f"{report['mass_before']:.1f} g -> {report['mass_after']:.1f} g, "
                f"{time.monotonic() - start:.1f} s")
        write_table(rows, table)
    return refused


def hollow_with(pymeshlab, plugin, goal, up, wall):
    """The function that `run` calls."""
    try:
        pymeshlab.load_plugin(str(plugin))
    except pymeshlab.PyMeshLabException as error:
        raise CannotBegin(reason_of(error)) from error
    parameters = {"goal": goal, "up_axis": up}
    if wall is not None:
        # A length must be one of PyMeshLab's own objects. Its name in 2022.2 was another.
        absolute = getattr(pymeshlab, "PureValue", None) or pymeshlab.AbsoluteValue
        parameters["inner_lower_bound"] = absolute(wall)
    # One for all: PyMeshLab up to 2025.7 still writes to the log of a set in which any filter failed.
    meshes = pymeshlab.MeshSet()

    def hollow(model, target):
        meshes.clear()
        meshes.load_new_mesh(str(model))
        report = meshes.apply_filter("mass_property_optimization", **parameters)
        layers = [(mesh.id(), mesh.label()) for mesh in meshes]
        kept = bounding_layers([label for _, label in layers])
        for place, (number, _) in enumerate(layers):
            if place not in kept:
                meshes.set_current_mesh(number)
                meshes.delete_current_mesh()
        meshes.generate_by_merging_visible_meshes()
        meshes.save_current_mesh(str(target))
        return report

    return hollow


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("plugin", type=pathlib.Path)
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--goal", default="Stand", help="entry of the filter's list of goals")
    parser.add_argument("--wall", type=float, help="minimum wall in mm; default: 1 %% of the diagonal")
    parser.add_argument("--up", default="+Z", help="up axis")
    arguments = parser.parse_args(words)
    try:
        work = jobs(arguments.models, arguments.results)
        results = arguments.results.resolve()
        results.mkdir(parents=True, exist_ok=True)
        plugin = arguments.plugin.resolve()
        import pymeshlab  # pylint: disable=import-outside-toplevel
        hollow = hollow_with(pymeshlab, plugin, arguments.goal, arguments.up, arguments.wall)
        # Goals and axes that are not in the filter's lists.
        refused = run(work, hollow, results / "report.csv", pymeshlab.InvalidEnumException)
    except CannotBegin as reason:
        print(f"{parser.prog}: {reason}", file=sys.stderr)
        return 2
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
