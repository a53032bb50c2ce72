"""The Python package: arrays in, arrays and a dictionary out."""
import inspect
import os
import pathlib
import pickle
import re
import signal
import threading
import time

import numpy as np
import pytest

import massprops
import measure
from host import ROOT, SAMPLES, cube, read_ply

LIGHT = {"goal": "Mass", "cavity_shape": "Offset surface"}


@pytest.fixture(scope="module")
def top():
    return read_ply(SAMPLES / "tilted_ellipsoid_top.ply")


@pytest.fixture(scope="module")
def piece():
    return read_ply(SAMPLES / "game_piece.ply")


@pytest.fixture(scope="module")
def spinning(top):
    return massprops.hollow(*top, goal="Spin", inner_lower_bound=1.5)


def test_the_report_is_about_the_arrays(top, spinning):
    mass, centre, inertia = measure.hollow_body(top, tuple(spinning.cavity), 1.24)
    report = spinning.report
    assert report["mass_after"] == pytest.approx(mass, rel=1e-9)
    np.testing.assert_allclose(report["center_of_mass_after"], centre, atol=1e-8)
    np.testing.assert_allclose(report["inertia_tensor_after"], inertia, atol=1e-7 * np.trace(inertia))
    assert report["solved"] is True and spinning.solved
    assert report["goal"] == "Spin" and isinstance(report["message"], str)
    assert report["inertia_tensor_after"].shape == (3, 3)


def test_the_wall(top, spinning):
    wall = measure.surface_distance(top, tuple(spinning.cavity))
    assert wall >= 1.5
    assert spinning.wall.shape == (len(spinning.cavity.vertices),)
    assert spinning.wall.min() == pytest.approx(wall, rel=1e-3)


def test_the_solid_is_closed(spinning):
    assert measure.edges_match(spinning.solid.faces)
    assert not spinning.outer_changed
    assert measure.body(*spinning.solid, 0.00124)[0] == pytest.approx(spinning.report["mass_after"])


def test_drain_holes_make_one_body_with_plugs(top, spinning):
    result = massprops.hollow(*top, goal="Spin", inner_lower_bound=1.5, drain_holes=2)
    assert spinning.drilled is None and spinning.plugs is None
    assert result.solid is result.drilled and measure.edges_match(result.drilled.faces)
    open_mass = measure.body(*result.drilled, 0.00124)[0]
    assert result.report["mass_open"] == pytest.approx(open_mass, rel=1e-6)
    assert result.report["mass_after"] == pytest.approx(
        open_mass + measure.body(*result.plugs, 0.00124)[0], rel=1e-6)
    assert result.solved


def test_same_input_same_bytes_with_any_number_of_threads(piece):
    runs = []
    for count in (1, 3):
        massprops.set_thread_count(count)
        runs.append(massprops.hollow(*piece, **LIGHT).cavity.vertices.tobytes())
    assert runs[0] == runs[1]
    massprops.set_thread_count(2)


def test_kinds_of_arrays(piece):
    vertices, faces = piece
    wanted = massprops.hollow(vertices, faces, **LIGHT).cavity.vertices
    for points, triangles in ((vertices.tolist(), faces.tolist()),
                              (np.asfortranarray(vertices), faces.astype(np.uint32)),
                              (vertices[::-1][::-1], faces.astype(np.int64))):
        np.testing.assert_array_equal(massprops.hollow(points, triangles, **LIGHT).cavity.vertices, wanted)


def test_lengths(piece):
    vertices = piece[0]
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    share = massprops.hollow(*piece, inner_lower_bound="2%", **LIGHT)
    length = massprops.hollow(*piece, inner_lower_bound=0.02 * diagonal, **LIGHT)
    assert share.report["min_wall"] == pytest.approx(length.report["min_wall"], rel=1e-9)
    assert share.report["min_wall"] >= 0.02 * diagonal * (1 - 1e-12)


def test_single_precision_is_what_a_file_of_floats_holds(piece):
    result = massprops.hollow(*piece, single_precision=True, **LIGHT)
    for mesh in (result.cavity, result.outer):
        np.testing.assert_array_equal(mesh.vertices, mesh.vertices.astype(np.float32))


def test_faces_that_stay_solid(top):
    vertices, faces = top
    upper = vertices[faces[:, 0], 2] > 10
    for kept in (upper, np.flatnonzero(upper)):
        result = massprops.hollow(vertices, faces, keep_solid=kept, solid_depth=5, goal="Spin",
                                  inner_lower_bound=1.5)
        apart = measure.surface_distance((vertices, faces[upper]), tuple(result.cavity))
        assert apart >= 5 - 1e-9
        assert result.report["solid_depth"] == pytest.approx(apart)


def test_pictures(piece):
    pictures = massprops.hollow(*piece, pictures=True, **LIGHT).pictures
    assert pictures[0].name == "cut open"
    for picture in pictures:
        assert picture.colours.shape == picture.vertices.shape
        assert picture.colours.dtype == np.uint8


def test_progress_and_other_threads(top):
    seen, ticks, ended = [], [], threading.Event()

    def tick():
        while not ended.wait(0.001):
            ticks.append(time.monotonic())

    other = threading.Thread(target=tick)
    other.start()
    massprops.hollow(*top, goal="Spin", progress=lambda percent, stage: seen.append((percent, stage)))
    ended.set()
    other.join()
    assert [p for p, _ in seen] == sorted(p for p, _ in seen)
    assert seen[-1] == (100, "Done")
    assert len(ticks) > 10, "the interpreter's lock is released"


def test_an_exception_of_the_callback_ends_the_run(top):
    class Enough(Exception):
        pass

    def stop(percent, _):
        if percent > 20:
            raise Enough("now")

    with pytest.raises(Enough, match="now"):
        massprops.hollow(*top, goal="Spin", progress=stop)


@pytest.mark.parametrize("stage", ["Checking the model", "Coarse copies", "Optimization", "Report"])
def test_what_the_callback_raises_is_what_the_run_raises(piece, stage):
    """Whatever its kind: none of it is taken for a failure of the stage."""
    for kind in (ValueError, MemoryError, KeyboardInterrupt):
        stages = []

        def stop(_, present):
            stages.append(present)
            if present == stage:
                raise kind("now")

        with pytest.raises(kind, match="now"):
            massprops.hollow(*piece, progress=stop, **LIGHT)
        assert stages.count(stage) == 1 and stages[-1] == stage


def test_ctrl_c_ends_a_run(piece):
    model = massprops.Model(*piece)
    at_once = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
    at_once.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            model.hollow(goal="Stand")
    at_once.join()
    assert model.hollow(**LIGHT).solved, "the model is as good as new"


def same(result, wanted):
    np.testing.assert_array_equal(result.cavity.vertices, wanted.cavity.vertices)
    np.testing.assert_array_equal(result.cavity.faces, wanted.cavity.faces)
    np.testing.assert_array_equal(result.outer.vertices, wanted.outer.vertices)
    for key, value in wanted.report.items():
        if not key.startswith("seconds_"):
            np.testing.assert_equal(result.report[key], value, key)


def test_runs_on_one_model_are_those_on_fresh_ones(piece):
    vertices, faces = piece
    model = massprops.Model(vertices, faces)
    wishes = ({"goal": "Stand"}, {"goal": "Mass"}, {"goal": "Mass", "inner_lower_bound": "2%"}, LIGHT,
              {**LIGHT, "inner_lower_bound": "2%"}, {"goal": "Stand"})
    for wish in wishes:
        same(model.hollow(**wish), massprops.hollow(vertices, faces, **wish))
    floats = massprops.Model(vertices, faces, single_precision=True)
    same(floats.hollow(**LIGHT), massprops.hollow(vertices, faces, single_precision=True, **LIGHT))


def test_a_model_keeps_what_it_was_given(piece):
    vertices, faces = piece[0].copy(), piece[1].copy()
    model = massprops.Model(vertices, faces)
    vertices *= 2.0
    faces[:] = 0
    result = model.hollow(**LIGHT)
    same(result, massprops.hollow(*piece, **LIGHT))
    with pytest.raises(massprops.InvalidInput, match="density"):
        model.hollow(density=-1)
    with pytest.raises(TypeError, match="is it 'inner_lower_bound'"):
        model.hollow(inner_lowerbound=1)
    with pytest.raises(massprops.InvalidInput, match="indices of vertices"):
        massprops.Model(vertices, [[0, 1, 10**6]])


def test_runs_of_several_threads_wait_for_each_other(piece):
    model = massprops.Model(*piece)
    results = []
    threads = [threading.Thread(target=lambda wall=wall: results.append(
        (wall, model.hollow(inner_lower_bound=wall, **LIGHT)))) for wall in ("1%", "2%", "1%")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for wall, result in results:
        same(result, massprops.hollow(*piece, inner_lower_bound=wall, **LIGHT))


@pytest.mark.parametrize("change, sentence", [
    ({"density": -1}, "density must be greater than 0"),
    ({"density": "light"}, "give a number"),
    ({"density": [1]}, "'density' cannot be"),
    ({"goal": "Stnad"}, "one of Stand, Spin"),
    ({"goal": 99}, "entries 0 to"),
    ({"basis_k": 36.5}, "'basis_k' cannot be 36.5"),
    ({"mend": "maybe"}, "true or false"),
    ({"keep_solid": []}, "keep_solid must be"),
    ({"keep_solid": [10**6]}, "keep_solid must be"),
    ({"vertices": np.zeros((3, 2))}, "3 coordinates"),
    ({"vertices": [["a"] * 3]}, "must be numbers"),
    ({"faces": np.zeros((3, 4), int)}, "cut larger faces"),
    ({"faces": np.zeros((3, 3))}, "whole numbers"),
    ({"faces": [[0, 1, 10**6]]}, "indices of vertices"),
    ({"faces": []}, "faces"),
])
def test_refusals(piece, change, sentence):
    arguments = {"vertices": piece[0], "faces": piece[1], **LIGHT, **change}
    with pytest.raises(massprops.InvalidInput, match=re.escape(sentence)):
        massprops.hollow(**arguments)


def test_an_open_surface_is_refused_or_a_shell():
    vertices, faces = cube(8, 40.0)
    opened = faces[vertices[faces][:, :, 2].min(axis=1) < 39.9]
    with pytest.raises(ValueError, match="open_surface"):
        massprops.hollow(vertices, opened)
    assert massprops.hollow(vertices, opened, open_surface=True, **LIGHT).report["solved"]


def test_unknown_parameters_are_mistakes(piece):
    with pytest.raises(TypeError, match="is it 'inner_lower_bound'"):
        massprops.hollow(*piece, inner_lowerbound=1)
    with pytest.raises(TypeError, match="'keep_solid' here"):
        massprops.hollow(*piece, keep_selected_solid=True)


def test_results_travel_between_processes(spinning):
    again = pickle.loads(pickle.dumps(spinning))
    np.testing.assert_array_equal(again.cavity.vertices, spinning.cavity.vertices)
    assert again.report["message"] == spinning.report["message"]


def test_help_and_hints_have_every_parameter():
    documented = (ROOT / "docs" / "parameters.md").read_text(encoding="utf-8")
    stub = (pathlib.Path(massprops.__file__).parent / "__init__.pyi").read_text()
    compile(stub, "__init__.pyi", "exec")
    for row in massprops.parameters():
        assert f"    {row['name']}: {row['type']} = " in inspect.getdoc(massprops.hollow).replace(
            "\n", "\n    ")
        assert f"    {row['name']}: {row['type']} | None" in stub
        assert f"`{row['name']}`" in documented
    for name in massprops.__all__:
        assert re.search(rf"\b{name}\b", stub), name
        assert getattr(massprops, name).__doc__


def test_the_keys_are_the_documented_ones(spinning):
    documented = set(re.findall(r"`([a-z0-9_…]+)`", (ROOT / "docs/report.md").read_text()))
    endings = tuple(key[1:] for key in documented if key.startswith("…"))
    for key in spinning.report:
        assert key in documented or key.endswith(endings), key
