#!/usr/bin/env python3
"""Hollows every model of a folder, on this machine or on a cluster, and writes what came out into a table.

    batch_with_dask.py models/ hollowed/ --goal Stand --inner_lower_bound 1.2
    batch_with_dask.py models/ hollowed/ --scheduler tcp://head:8786 --goal Stand

Without --scheduler the workers are processes of this machine, one a core. With it they are those of a
Dask cluster, where the package massprops is installed and both folders have the same path:
`dask scheduler` on one machine, `dask worker --nthreads 1 --nworkers auto tcp://head:8786` on each.

For each model hollowed/ gets <name>.stl, outer and inner surface together, and <name>.json, the report or the
reason why the model was refused; table.csv has a line a model. What is done already with the same parameters
is not done again: after an interruption call the same once more. A model that is refused, or that crashes its
worker, stops no other. Exit status 0 if every goal is reached, 1 if not, 2 if nothing could be done at all.
"""
import argparse
import csv
import json
import os
import pathlib
import sys

import dask
import numpy as np
from dask.distributed import Client, LocalCluster, as_completed

FORMATS = {".stl", ".ply", ".obj", ".off"}


def hollow(model, target, parameters):
    """On a worker: writes the solid and then the report; returns the report."""
    import massprops  # pylint: disable=import-outside-toplevel
    import meshio  # pylint: disable=import-outside-toplevel

    massprops.set_thread_count(1)  # the other cores have models of their own
    try:
        mesh = meshio.read(model)
        # STL repeats the vertices of every triangle.
        vertices, place = np.unique(mesh.points, axis=0, return_inverse=True)
        faces = place.reshape(-1)[mesh.cells_dict["triangle"]]
        result = massprops.hollow(vertices, faces, single_precision=True, **parameters)
    except (Exception, SystemExit) as refusal:  # meshio ends the program where it cannot read
        return {"refused": " ".join(str(refusal).split()) or type(refusal).__name__}
    solid = result.solid
    unfinished = f"{target}.part.stl"
    # As text, which is meshio's default, writing takes up to a fifth of the time.
    mesh = meshio.Mesh(solid.vertices.astype(np.float32), [("triangle", solid.faces)])
    mesh.write(unfinished, binary=True)
    os.replace(unfinished, f"{target}.stl")
    return {key: getattr(value, "tolist", lambda value=value: value)()
            for key, value in result.report.items()}


def write_whole(path, text):
    """The whole file, or the one before stays."""
    unfinished = path.with_name(path.name + ".part")
    unfinished.write_text(text, encoding="utf-8")
    os.replace(unfinished, path)


def work_in(models, results):
    """Pairs of a model and the beginning of the names of its results."""
    files = sorted(p.resolve() for p in models.iterdir() if p.suffix.lower() in FORMATS)
    stems = [p.stem for p in files]
    return [(p, results.resolve() / (p.stem if stems.count(p.stem) == 1 else p.name)) for p in files]


def done_before(model, target, parameters):
    """The finished result of the same model with the same parameters, or None."""
    try:
        done = json.loads(pathlib.Path(f"{target}.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    same = done["parameters"] == parameters and done["modified"] == model.stat().st_mtime_ns
    return done["report"] if same else None


def write_table(reports, path):
    """One line a model, one column a number; models differ in their keys."""
    rows = []
    for model, report in reports:
        row = {"model": model.name}
        for key, value in report.items():
            if isinstance(value, list):
                flat = np.ravel(value)
                names = ["x", "y", "z"] if len(flat) == 3 else [a + b for a in "xyz" for b in "xyz"]
                row.update((f"{key}_{name}", number) for name, number in zip(names, flat))
            else:
                row[key] = value
        rows.append(row)
    columns = list(dict.fromkeys(["model", "solved", "refused"] + [k for row in rows for k in row]))
    with open(f"{path}.part", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(rows)
    os.replace(f"{path}.part", path)


def run(client, work, parameters, say=print):
    """Pairs of a model and its report, in the order of `work`."""
    reports, pending = {}, {}
    for model, target in work:
        before = done_before(model, target, parameters)
        if before is not None:
            reports[model] = before
            continue
        pending[client.submit(hollow, str(model), str(target), parameters, pure=False,
                              key=str(model))] = (model, target)
    say(f"{len(work)} models, {len(reports)} of them done before")
    for future in as_completed(list(pending)):
        model, target = pending[future]
        if future.status == "finished":
            report = future.result()
        else:
            report = {"refused": "the worker crashed on this model"}
        reports[model] = report
        write_whole(pathlib.Path(f"{target}.json"),
                    json.dumps({"parameters": parameters, "modified": model.stat().st_mtime_ns,
                                "report": report}, indent=1))
        say(f"[{len(reports)}/{len(work)}] {model.name}: "
            + ("refused: " + report["refused"] if "refused" in report else report["message"]))
    return [(model, reports[model]) for model, _ in work]


def main(words=None):
    import massprops  # pylint: disable=import-outside-toplevel
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--scheduler", help="address of a Dask scheduler")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="on this machine")
    for row in massprops.parameters():
        parser.add_argument("--" + row["name"], help=argparse.SUPPRESS)  # texts, as massprops takes them
    arguments = vars(parser.parse_args(words))
    models, results = arguments.pop("models"), arguments.pop("results")
    scheduler, workers = arguments.pop("scheduler"), arguments.pop("workers")
    parameters = {name: value for name, value in arguments.items() if value is not None}
    work = work_in(models, results) if models.is_dir() else []
    if not work or results.resolve() == models.resolve():
        print(f"{parser.prog}: {models} holds no models, or the results would go among them",
              file=sys.stderr)
        return 2
    results.mkdir(parents=True, exist_ok=True)
    # A worker gets no model before it has a core for it: one that crashes takes no other down with it. And nobody
    # looks at what Dask measures of itself a hundred times a second.
    dask.config.set({"distributed.scheduler.worker-saturation": 1.0,
                     "distributed.scheduler.allowed-failures": 1,
                     "distributed.worker.profile.interval": "10s",
                     "distributed.worker.profile.cycle": "100s",
                     "distributed.admin.tick.interval": "500ms"})
    cluster = scheduler or LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=":0")
    with Client(cluster) as client:
        reports = run(client, work, parameters)
    if not scheduler:
        cluster.close()
    write_table(reports, results / "table.csv")
    return 0 if all(report.get("solved") for _, report in reports) else 1


if __name__ == "__main__":
    sys.exit(main())
