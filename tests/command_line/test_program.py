"""The program `massprops`: files in, files and report out."""
import json
import os
import pty
import re
import signal
import subprocess
import time
import unittest
import zipfile

import numpy as np

import measure
from host import (ROOT, SAMPLES, bounds_a_volume, changed_script, cube, meshlabserver, ply_elements,
                  script_of, write_ply)
from program import DENSITY, PROGRAM, ProgramTest, read, write

TOP = SAMPLES / "tilted_ellipsoid_top.ply"
PIECE = SAMPLES / "game_piece.ply"
LIGHT = ["--goal", "Mass", "--cavity-shape", "Offset surface"]


class FilesTest(ProgramTest):
    def test_the_masses_are_those_of_the_files(self):
        self.run_program(TOP, "--goal", "Spin", "--wall", "1.5", "-o", "cavity.ply", "--solid",
                         "hollow.stl", "--report", "report.json")
        self.assertEqual(self.files(), ["cavity.ply", "hollow.stl", "report.json"])
        report = json.loads((self.folder / "report.json").read_text())
        outer, inner = read(TOP), read(self.folder / "cavity.ply")
        mass, centre, inertia = measure.hollow_body(outer, inner, DENSITY)
        self.assertAlmostEqual(report["mass_after"] / mass, 1, delta=1e-6)
        np.testing.assert_allclose(report["center_of_mass_after"], centre, atol=1e-5)
        np.testing.assert_allclose(report["inertia_tensor_after"], inertia,
                                   atol=1e-5 * np.trace(inertia))
        self.assertTrue(report["solved"])
        self.assertEqual(report["goal"], "Spin")
        self.assertIsInstance(report["message"], str)

        solid = read(self.folder / "hollow.stl")
        self.assertTrue(measure.edges_match(solid[1]))
        self.assertAlmostEqual(measure.body(*solid, DENSITY / 1000)[0] / mass, 1, delta=1e-6)
        wall = measure.surface_distance(outer, inner)
        self.assertGreaterEqual(wall, 1.5 - 1e-6)
        quality = ply_elements(self.folder / "cavity.ply")["vertex"]["quality"]
        self.assertAlmostEqual(min(quality), wall, delta=1e-3)

    def test_the_drilled_body_and_its_plugs_are_files(self):
        report = self.report(PIECE, *LIGHT, "--drain-holes", "2", "--solid", "drilled.ply",
                             "--plugs", "plugs.ply")
        drilled, plugs = read(self.folder / "drilled.ply"), read(self.folder / "plugs.ply")
        for part in (drilled, plugs):
            self.assertTrue(measure.edges_match(part[1]))
        open_mass = measure.body(*drilled, DENSITY / 1000)[0]
        self.assertAlmostEqual(report["mass_open"] / open_mass, 1, delta=1e-6)
        self.assertAlmostEqual(
            report["mass_after"] / (open_mass + measure.body(*plugs, DENSITY / 1000)[0]), 1, delta=1e-6)

    def test_the_keys_are_the_documented_ones(self):
        report = self.report(PIECE, *LIGHT)
        documented = set(re.findall(r"`([a-z0-9_…]+)`", (ROOT / "docs/report.md").read_text()))
        endings = tuple(key[1:] for key in documented if key.startswith("…"))
        for key in report:
            self.assertTrue(key in documented or key.endswith(endings), key)

    def test_every_format_is_read_and_written(self):
        model = read(PIECE)
        wanted = measure.hollow_body(model, (np.zeros((0, 3)), np.zeros((0, 3), int)), DENSITY)[0]
        for suffix in (".ply", ".stl", ".obj", ".off", ".STL"):
            with self.subTest(suffix):
                path = self.folder / ("model" + suffix.lower())
                write(path, *model)
                path = path.rename(self.folder / ("model" + suffix))
                solid = self.folder / ("solid" + suffix.lower())
                report = self.report(path, *LIGHT, "--solid", solid)
                self.assertAlmostEqual(report["mass_before"] / wanted, 1, delta=1e-6)
                vertices, faces = read(solid)
                self.assertTrue(measure.edges_match(faces))
                # STL keeps single precision; the report's masses come from another frame.
                self.assertAlmostEqual(
                    measure.body(vertices, faces, DENSITY / 1000)[0] / report["mass_after"], 1,
                    delta=1e-6 if suffix.lower() == ".stl" else 1e-8)
                path.unlink()

    def test_double_precision_far_from_the_origin(self):
        vertices, faces = read(PIECE)
        moved = vertices + [1e5, -2e5, 3e5]
        path = self.folder / "far.obj"
        path.write_text("".join("v %r %r %r\n" % tuple(v) for v in moved.tolist())
                        + "".join("f %d %d %d\n" % tuple(f + 1) for f in faces))
        near, far = self.report(PIECE, *LIGHT), self.report(path, *LIGHT, "-o", "cavity.obj")
        self.assertAlmostEqual(far["mass_after"] / near["mass_after"], 1, delta=1e-3)
        inner = read(self.folder / "cavity.obj")
        wall = measure.surface_distance((vertices, faces), (inner[0] - [1e5, -2e5, 3e5], inner[1]))
        self.assertGreaterEqual(wall, far["min_wall"] - 1e-8)

    def test_the_cavity_is_meshlabs(self):
        script = changed_script(script_of("game_piece"), self.folder / "s.mlx")
        status, log = meshlabserver("-i", PIECE, "-o", self.folder / "theirs.ply", "-l", "x", "-s",
                                    script)
        self.assertEqual(status, 0, log)
        theirs = read(self.folder / "theirs.ply")
        wall = re.search(r'inner_lower_bound" value="([^"]+)', script.read_text()).group(1)
        mass = re.search(r'target_mass" value="([^"]+)', script.read_text()).group(1)
        filling = re.search(r'fill_density" value="([^"]+)', script.read_text()).group(1)
        self.run_program(PIECE, "--goal", "Mass", "--wall", wall, "--target-mass", mass,
                         "--fill-density", filling, "-o", "ours.stl")
        ours = read(self.folder / "ours.stl")
        np.testing.assert_array_equal(ours[0][ours[1]], theirs[0][theirs[1]])

    def test_a_project_for_the_slicer(self):
        self.run_program(PIECE, *LIGHT, "--print-file", "{name}.3mf")
        self.assertEqual(self.files(), ["game_piece.3mf"])
        with zipfile.ZipFile(self.folder / "game_piece.3mf") as project:
            self.assertIsNone(project.testzip())
            self.assertIn("3D/3dmodel.model", project.namelist())

    def test_the_answer_has_colours(self):
        self.run_program(PIECE, *LIGHT, "--answer", "answer.ply")
        vertex = ply_elements(self.folder / "answer.ply")["vertex"]
        colours = {tuple(int(vertex[c][i]) for c in ("red", "green", "blue"))
                   for i in range(len(vertex["x"]))}
        self.assertGreater(len(colours), 3)

    def test_an_open_surface_becomes_a_closed_solid(self):
        vertices, faces = cube(8, 40.0)
        opened = faces[vertices[faces][:, :, 2].min(axis=1) < 39.9]  # without its top
        model = write_ply(self.folder / "vase.ply", vertices, opened)
        self.run_program(model, *LIGHT, "--open-surface", "--solid", "shell.ply")
        self.assertTrue(measure.edges_match(read(self.folder / "shell.ply")[1]))
        self.assertEqual(bounds_a_volume(self.folder / "shell.ply"), "")

    def test_selected_faces_stay_solid(self):
        vertices, faces = read(TOP)
        upper = vertices[faces[:, 0], 2] > 10
        lines = write_ply(self.folder / "top.ply", vertices, faces).read_text().splitlines()
        lines.insert(lines.index("end_header"), "property int flags")
        first = len(lines) - len(faces)
        for i, isUpper in enumerate(upper):
            lines[first + i] += " 32" if isUpper else " 0"
        (self.folder / "top.ply").write_text("\n".join(lines) + "\n")
        arguments = ["top.ply", "--goal", "Spin", "--wall", "1.5", "-o", "cavity.ply",
                     "--keep-selected-solid", "--solid-depth", "5"]
        report = self.report(*arguments, status=None)
        apart = measure.surface_distance((vertices, faces[upper]), read(self.folder / "cavity.ply"))
        self.assertGreaterEqual(apart, 5 - 1e-6)
        self.assertAlmostEqual(report["solid_depth"], apart, delta=1e-6)
        _, error = self.run_program(TOP, *arguments[1:], status=2)
        self.assertIn("No face is selected", error)


class EndingsTest(ProgramTest):
    def test_a_goal_that_is_missed(self):
        out, error = self.run_program(TOP, "--goal", "Spin", "--spin-speed", "10", "-o",
                                      "cavity.ply", status=1)
        self.assertEqual(self.files(), ["cavity.ply"])
        self.assertIn("NOT solved", out)
        self.assertEqual(error, "")

    def test_a_refused_model_leaves_everything_as_it_was(self):
        vertices, faces = cube()
        vase = write_ply(self.folder / "vase.ply", vertices,
                         faces[vertices[faces][:, :, 2].min(axis=1) < 9.9])
        (self.folder / "cavity.ply").write_text("of yesterday")
        out, error = self.run_program(vase, "-o", "cavity.ply", "--solid", "solid.stl", "--report",
                                      "report.json", status=2)
        self.assertEqual(out, "")
        self.assertIn("open_surface", error)
        self.assertEqual(self.files(), ["cavity.ply", "vase.ply"])
        self.assertEqual((self.folder / "cavity.ply").read_text(), "of yesterday")

    def test_mistakes_are_refused_with_a_sentence(self):
        damaged = self.folder / "damaged.ply"
        damaged.write_bytes(b"ply\nnothing")
        unended = self.folder / "unended.stl"
        unended.write_bytes(b"no mesh")
        mine = write_ply(self.folder / "mine.ply", *cube())
        for arguments, word in (
                ([], "model"),
                (["missing.stl"], "cannot be opened"),
                ([damaged], "cannot be read"),
                ([unended], "cannot be read"),
                ([ROOT / "README.md"], "no known format"),
                ([PIECE, "--goal", "Stnad"], "one of Stand, Spin"),
                ([PIECE, "--density", "light"], "give a number"),
                ([PIECE, "--density", "-1"], "density must be greater than 0"),
                ([PIECE, "--basis-k", "36.5"], "a whole number"),
                ([PIECE, "--wall", "1 mm"], "1.5%"),
                ([PIECE, "--wall"], "--wall"),
                ([PIECE, "--colour", "red"], "--colour"),
                ([PIECE, "--jobs", "0"], "--jobs"),
                ([PIECE, "-o", "cavity.3mf"], "no known format"),
                ([PIECE, "-o", "missing/cavity.ply"], "a folder that exists"),
                ([PIECE, "--print-file", "project.stl"], ".3mf"),
                ([PIECE, "-o", self.folder], "format"),
                ([mine, "-o", mine], "taken by"),
                ([PIECE, "-o", "a.ply", "--solid", "./a.ply"], "taken by"),
                ([PIECE, TOP, "-o", "a.ply"], "{name}")):
            with self.subTest(arguments):
                out, error = self.run_program(*arguments, status=2)
                self.assertIn(word, error)
                self.assertEqual(out, "")
                self.assertEqual(self.files(), ["damaged.ply", "mine.ply", "unended.stl"])

    def test_help_and_version(self):
        out, _ = self.run_program("--help")
        self.assertIn("--inner-lower-bound", out)
        self.assertRegex(self.run_program("--version")[0], r"^massprops \d+\.\d+\.\d+\n$")

    def test_lengths_in_percent_of_the_diagonal(self):
        for name, wall in (("a", []), ("b", ["--wall", "1%"])):
            self.run_program(PIECE, *LIGHT, *wall, "-o", name + ".ply")
        self.assertEqual((self.folder / "a.ply").read_bytes(),
                         (self.folder / "b.ply").read_bytes())

    def test_progress_is_for_terminals_only(self):
        _, error = self.run_program(PIECE, *LIGHT)
        self.assertEqual(error, "")
        mine, theirs = pty.openpty()
        with subprocess.Popen([PROGRAM, PIECE, *LIGHT], stdout=subprocess.PIPE,
                              stderr=theirs) as process:
            os.close(theirs)
            shown = b""
            try:
                while True:
                    shown += os.read(mine, 1000)
            except OSError:  # closed by the program's end
                pass
            out = process.stdout.read()
        os.close(mine)
        percent = [int(p) for p in re.findall(rb"(\d+) %", shown)]
        self.assertEqual(percent, sorted(percent))
        self.assertEqual(percent[-1], 100)
        self.assertIn(b"solved", out)


class EndedTest(ProgramTest):
    """By a signal, in the midst of a run."""

    def start(self, *arguments, **how):
        """Until it has begun to make its files."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, **how)
        while process.poll() is None and not list(self.folder.glob(".massprops.part*")):
            time.sleep(0.001)
        return process

    def test_nothing_is_left(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.start(PIECE, "--goal", "Stand", "-o", "cavity.ply", "--report", "report.json",
                            "--print-file", "project.3mf") as process:
                process.send_signal(number)
                process.communicate()
                self.assertEqual(process.returncode, -number)
            self.assertEqual(self.files(), [])

    def test_who_starts_it_may_ignore_hang_ups(self):
        ignoring = lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)
        with self.start(PIECE, *LIGHT, "-o", "cavity.ply", preexec_fn=ignoring) as process:
            process.send_signal(signal.SIGHUP)
            process.communicate()
            self.assertEqual(process.returncode, 0)
        self.assertEqual(self.files(), ["cavity.ply"])

    def test_no_model_goes_on_without_the_others(self):
        process = self.start(PIECE, TOP, *LIGHT, "--jobs", "2", "-o", "{name}.ply")
        process.terminate()
        process.communicate()  # until the last of its children has closed its output
        self.assertEqual(process.returncode, -signal.SIGTERM)
        self.assertEqual(self.files(), [])

    def test_what_a_killed_one_has_left_is_not_delivered(self):
        write(self.folder / "cube.ply", *cube())
        stale = ("mkdir .massprops.part$$ && cp cube.ply .massprops.part$$/cavity.ply && "
                 'exec "$0" cube.ply --inner-lower-bound 45% -o cavity.ply')
        subprocess.run(["/bin/sh", "-c", stale, PROGRAM], check=False, cwd=self.folder,
                       stdout=subprocess.PIPE)
        self.assertFalse((self.folder / "cavity.ply").exists())


class ManyModelsTest(ProgramTest):
    def test_the_end_is_seen_by_who_was_started_deaf_to_it(self):
        deaf = lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN)
        done = subprocess.run([PROGRAM, PIECE, TOP, *LIGHT, "--jobs", "2"], check=False, timeout=3000,
                              stdout=subprocess.PIPE, preexec_fn=deaf)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(len(done.stdout.splitlines()), 2)

    def test_a_bad_model_stops_no_other(self):
        vertices, faces = read(PIECE)
        for name in ("a", "c", "d"):
            write(self.folder / (name + ".stl"), vertices, faces)
        (self.folder / "b.stl").write_bytes(b"no mesh")
        models = [name + ".stl" for name in "abcd"]
        (self.folder / "out").mkdir()
        out, error = self.run_program(*models, *LIGHT, "--jobs", "2", "-o", "out/{name}.ply",
                                      "--report", "out/{name}.json", status=2)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                         ["a.json", "a.ply", "c.json", "c.ply", "d.json", "d.ply"])
        self.assertEqual(sorted(line.split(":")[0] for line in out.splitlines()),
                         ["a.stl", "c.stl", "d.stl"])
        self.assertRegex(error, r"^massprops: b\.stl: .*\n$")
        # Neither the number of jobs nor that of threads changes a byte.
        self.run_program("a.stl", *LIGHT, "-o", "alone.ply")
        for name in "acd":
            self.assertEqual((self.folder / "out" / (name + ".ply")).read_bytes(),
                             (self.folder / "alone.ply").read_bytes())

    def test_missed_goals_among_several(self):
        (self.folder / "cube.ply").write_bytes(write_ply(self.folder / "c.ply", *cube()).read_bytes())
        out, _ = self.run_program(TOP, PIECE, *LIGHT, status=0)
        self.assertEqual(len(out.splitlines()), 2)
        out, _ = self.run_program(TOP, "cube.ply", "--goal", "Spin", "--spin-speed", "10",
                                  "--quiet", status=1)
        self.assertEqual(out, "")


if __name__ == "__main__":
    unittest.main()
