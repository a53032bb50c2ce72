"""The examples: one model with meshio, and a batch by Dask on this machine and on a cluster."""
import csv
import os
import pathlib
import shutil
import subprocess
import sys

import meshio
import numpy as np
import pytest

import measure
from host import ROOT, SAMPLES, cube, write_ply

EXAMPLES = ROOT / "examples"
PIECE = SAMPLES / "game_piece.ply"
LIGHT = ["--goal", "Mass", "--cavity_shape", "Offset surface"]


def run(example, *words, status=0):
    done = subprocess.run([sys.executable, EXAMPLES / example, *map(str, words)], check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert done.returncode == status, done.stderr.decode()[-3000:] + done.stdout.decode()
    return done.stdout.decode(), done.stderr.decode()


def mass_of(path):
    mesh = meshio.read(path)
    vertices, place = np.unique(mesh.points, axis=0, return_inverse=True)
    faces = place.reshape(-1)[mesh.cells_dict["triangle"]]
    assert measure.edges_match(faces)
    return measure.body(vertices.astype(float), faces, 0.00124)[0]


def test_one_model(tmp_path):
    solid = tmp_path / "hollow.stl"
    said, _ = run("hollow_with_meshio.py", PIECE, solid, "--goal", "Mass", "--wall", "1.5%")
    mass = float(said.split("-> ")[1].split(" g")[0])
    assert mass_of(solid) == pytest.approx(mass, abs=0.06)
    vase = write_ply(tmp_path / "vase.ply", cube()[0], cube()[1][:-16])
    _, error = run("hollow_with_meshio.py", vase, tmp_path / "no.stl", status=2)
    assert "open" in error
    assert not (tmp_path / "no.stl").exists()


@pytest.fixture
def models(tmp_path):
    folder = tmp_path / "models"
    folder.mkdir()
    for name in "abd":
        shutil.copy(PIECE, folder / f"{name}.ply")
    (folder / "c.stl").write_bytes(b"no mesh")
    (folder / "notes.txt").write_text("no model")
    return folder


def table(results):
    with open(results / "table.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check(results, models):
    rows = table(results)
    assert [row["model"] for row in rows] == ["a.ply", "b.ply", "c.stl", "d.ply"]
    assert [row["solved"] for row in rows] == ["True", "True", "", "True"]
    assert rows[2]["refused"]
    for row in rows:
        if row["model"] != "c.stl":
            solid = results / (pathlib.Path(row["model"]).stem + ".stl")
            assert mass_of(solid) == pytest.approx(float(row["mass_after"]), rel=1e-6)
    assert not list(results.glob("*.part*")) and not (results / "c.stl").exists()
    assert len(list(models.iterdir())) == 5


def test_a_batch_on_this_machine_can_be_resumed(models, tmp_path):
    results = tmp_path / "hollowed"
    said, _ = run("batch_with_dask.py", models, results, "--workers", 2, *LIGHT, status=1)
    assert "4 models, 0 of them done before" in said
    check(results, models)
    first = (results / "table.csv").read_bytes()
    (results / "b.json").unlink()  # as if interrupted before b
    written = (results / "a.stl").stat().st_mtime_ns
    said, _ = run("batch_with_dask.py", models, results, "--workers", 2, *LIGHT, status=1)
    assert "4 models, 3 of them done before" in said
    assert (results / "a.stl").stat().st_mtime_ns == written
    check(results, models)
    assert sum(a != b for a, b in zip(first.splitlines(), (results / "table.csv").read_bytes().splitlines())) \
        <= 1, "times alone differ, of b"
    said, _ = run("batch_with_dask.py", models, results, "--workers", 2, *LIGHT, "--density", "2", status=1)
    assert "4 models, 0 of them done before" in said


def test_a_batch_on_a_cluster(models, tmp_path):
    processes = []
    try:
        address = tmp_path / "scheduler.json"
        command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard",
                   "--host", "127.0.0.1", "--scheduler-file", str(address)]
        with open(tmp_path / "log", "wb") as log:
            processes.append(subprocess.Popen(command, stdout=log, stderr=log))
            for _ in range(2):
                processes.append(subprocess.Popen(
                    [sys.executable, "-m", "distributed.cli.dask_worker", "--nthreads", "1", "--no-dashboard",
                     "--scheduler-file", str(address), "--local-directory", str(tmp_path)],
                    stdout=log, stderr=log))
        for _ in range(600):
            if address.exists() and address.stat().st_size > 0:
                break
            __import__("time").sleep(0.1)
        scheduler = __import__("json").loads(address.read_text())["address"]
        run("batch_with_dask.py", models, tmp_path / "out", "--scheduler", scheduler, *LIGHT, status=1)
        check(tmp_path / "out", models)
    finally:
        for process in reversed(processes):
            process.terminate()
        for process in processes:
            process.wait(30)


def test_nothing_to_do(tmp_path):
    _, error = run("batch_with_dask.py", tmp_path / "missing", tmp_path / "out", status=2)
    assert "no models" in error
