"""examples/pymeshlab_batch.py but for its calls of PyMeshLab, which Debian does not have."""
import contextlib
import csv
import importlib.util
import io
import os
import pathlib
import shutil
import tempfile
import unittest

import numpy as np

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "pymeshlab_batch.py"
specification = importlib.util.spec_from_file_location("pymeshlab_batch", EXAMPLE)
batch = importlib.util.module_from_spec(specification)
specification.loader.exec_module(batch)


class BatchExampleTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="massprops-")).resolve()
        self.addCleanup(shutil.rmtree, self.folder)
        self.addCleanup(os.chdir, os.getcwd())

    def models(self, *names):
        folder = self.folder / "models"
        folder.mkdir(exist_ok=True)
        for name in names:
            (folder / name).touch()
        return folder

    def run_batch(self, work, hollow, **more):
        table = self.folder / "report.csv"
        with contextlib.redirect_stdout(io.StringIO()) as said:
            refused = batch.run(work, hollow, table, **more)
        with open(table, newline="", encoding="utf-8") as file:
            return refused, list(csv.DictReader(file)), said.getvalue()

    def test_jobs_are_absolute_for_relative_folders(self):
        self.models("b.STL", "a.ply", "notes.txt")
        os.chdir(self.folder)
        work = batch.jobs(pathlib.Path("models"), pathlib.Path("out"))
        self.assertEqual(work, [(self.folder / "models" / "a.ply", self.folder / "out" / "a.stl"),
                                (self.folder / "models" / "b.STL", self.folder / "out" / "b.stl")])

    def test_models_that_differ_in_their_suffix_keep_results_of_their_own(self):
        work = batch.jobs(self.models("horse.ply", "Horse.stl", "cow.off"), self.folder / "out")
        self.assertEqual([target.name for _, target in work],
                         ["Horse.stl.stl", "cow.stl", "horse.ply.stl"])

    def test_the_folder_of_the_models_is_not_written_to(self):
        models = self.models("a.stl")
        (self.folder / "link").symlink_to(models)
        for results in (models, self.folder / "link", models / ".." / "models"):
            with self.subTest(results), self.assertRaisesRegex(batch.CannotBegin, "overwrite"):
                batch.jobs(models, results)

    def test_without_models_nothing_begins(self):
        for models in (self.models(), self.folder / "missing"):
            with self.subTest(models), self.assertRaises(batch.CannotBegin):
                batch.jobs(models, self.folder / "out")
            with contextlib.redirect_stderr(io.StringIO()) as said:
                self.assertEqual(batch.main(["x.so", str(models), str(self.folder / "out")]), 2)
            self.assertRegex(said.getvalue(), "no folder|no models")

    def test_a_model_that_fails_does_not_end_the_batch(self):
        """As MeshLab does, the failing one leaves another working folder behind."""
        self.models("a.ply", "b.ply", "c.ply")
        os.chdir(self.folder)
        seen = []

        def hollow(model, target):
            self.assertTrue(model.is_file())
            seen.append(target.name)
            if model.stem == "b":
                os.chdir("/")
                raise RuntimeError("Unable to open file: b.ply\nheader")
            return {"solved": True, "mass_before": 2.0, "mass_after": 1.0}

        refused, rows, said = self.run_batch(batch.jobs("models", "out"), hollow)
        self.assertEqual(refused, 1)
        self.assertEqual(seen, ["a.stl", "b.stl", "c.stl"])
        self.assertEqual([row["solved"] for row in rows], ["True", "", "True"])
        self.assertEqual(rows[1]["error"], "Unable to open file: b.ply header")
        self.assertIn("[2/3] b.ply: refused: Unable to open file: b.ply header\n", said)

    def test_the_table_is_complete_after_every_model(self):
        table = self.folder / "report.csv"
        lengths = []

        def hollow(model, _):
            if table.exists():
                with open(table, newline="", encoding="utf-8") as file:
                    lengths.append(len(list(csv.reader(file))))
            return {"solved": False, "mass_before": 2.0, "mass_after": 1.0, model.stem: 1}

        work = batch.jobs(self.models("a.ply", "b.ply", "c.ply"), self.folder / "out")
        _, rows, _ = self.run_batch(work, hollow)
        self.assertEqual(lengths, [2, 3])  # with the line of names
        self.assertEqual([row["b"] for row in rows], ["", "1", ""])

    def test_an_unknown_goal_is_one_sentence(self):
        class Unknown(Exception):
            pass

        def hollow(*_):
            raise Unknown("Enum 'stand' not found. Possible values are 'Stand'; 'Spin'; ")

        work = batch.jobs(self.models("a.ply", "b.ply"), self.folder / "out")
        with self.assertRaisesRegex(batch.CannotBegin, "'stand' not found.*'Stand'; 'Spin';$"):
            with contextlib.redirect_stdout(io.StringIO()):
                batch.run(work, hollow, self.folder / "report.csv", Unknown)

    def test_the_layers_that_bound_the_material(self):
        inner, outer = "cup inner offset surface", "cup outer offset surface"
        for labels, kept in ((["cup.ply"], [0]),  # nothing could be hollowed
                             (["cup.ply", inner], [0, 1]),
                             (["cup.ply", outer, inner], [1, 2]),
                             (["cup.ply", outer], [1]),  # the outer surface moved alone
                             (["cup.ply", outer, "cup cut open", "cup centre of mass and axis", inner],
                              [1, 4])):
            with self.subTest(labels):
                self.assertEqual(batch.bounding_layers(labels), kept)

    def test_points_and_tensors_become_columns(self):
        row = batch.row_of({"solved": True, "centre": np.array([1.0, 2.0, 3.0]),
                            "tensor": np.arange(9.0).reshape(3, 3)})
        self.assertEqual(row["solved"], True)
        self.assertEqual((row["centre_x"], row["centre_z"]), (1.0, 3.0))
        self.assertEqual((row["tensor_xy"], row["tensor_zx"]), (1.0, 6.0))

    def test_the_reason_is_what_the_filter_said(self):
        error = Exception("Failed to apply filter: f\nDetails: The surface is open.")
        self.assertEqual(batch.reason_of(error), "The surface is open.")
        self.assertEqual(batch.reason_of(MemoryError()), "MemoryError")


if __name__ == "__main__":
    unittest.main()
