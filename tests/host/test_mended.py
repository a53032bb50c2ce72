"""Inputs that are nearly good: they work, and the report says what was mended."""
import unittest

import numpy as np

import measure
from host import (HostTest, bounds_a_volume, changed_script, cube, layers_of, meshlabserver, read_ply,
                  report_in, script_of, write_ply)

SPIN = script_of("tilted_ellipsoid_top")


class MendedTest(HostTest):
    def mended(self, points, faces):
        report, (inner, _) = self.run_filter(write_ply(self.folder / "m.ply", points, faces), SPIN)
        self.assertGreater(len(inner), 0)
        return report

    def test_separate_triangles(self):
        points, faces = cube()
        whole = self.mended(points, faces)
        report = self.mended(points[faces.ravel()], np.arange(faces.size).reshape(-1, 3))
        self.assertEqual(whole["repairs"], "none")
        self.assertEqual(report["repairs"],
                         f"{faces.size - len(points)} duplicate vertices merged")
        self.assertEqual(report["merged_vertices"], faces.size - len(points))
        self.assertEqual(whole["merged_vertices"], 0)
        self.assertAlmostEqual(report["volume_before"], 1000.0, delta=1e-3)

    def test_two_bodies_are_one_job(self):
        points, faces = cube()
        report = self.mended(np.vstack([points, points + [20, 0, 0]]),
                             np.vstack([faces, faces + len(points)]))
        self.assertAlmostEqual(report["volume_before"], 2000.0, delta=1e-3)
        self.assertEqual(report["cavity_components"], 2)

    def test_an_existing_cavity_is_replaced(self):
        points, faces = cube()
        inside = 0.4 * (points - 5.0) + 5.0
        report = self.mended(np.vstack([points, inside]),
                             np.vstack([faces, faces[:, ::-1] + len(points)]))
        self.assertAlmostEqual(report["volume_before"], 1000.0 - 64.0, delta=1e-3)
        self.assertIn("1 existing cavity replaced", report["repairs"])
        self.assertEqual(report["replaced_cavities"], 1)

    def outer_and_inner(self, points, faces, **values):
        """Report, and the layers besides the input, which must be two."""
        mesh = write_ply(self.folder / "model.ply", points, faces)
        saved = self.folder / "saved.mlp"
        script = changed_script(SPIN, self.folder / "s.mlx", **values)
        status, log = meshlabserver("-i", mesh, "-w", saved, "-s", script)
        self.assertEqual(status, 0, log)
        names = [name for name, _ in layers_of(saved)]
        self.assertEqual(names, ["model_out.ply", "modelouteroffsetsurface_out.ply",
                                 "modelinneroffsetsurface_out.ply"])
        return report_in(log), [self.folder / name for name in names[1:]]

    def test_an_inside_out_model_gets_an_outer_layer_that_bounds_the_material(self):
        points, faces = cube()
        report, layers = self.outer_and_inner(points, faces[:, ::-1])
        self.assertEqual(report["flipped_components"], 1)
        self.assertEqual(bounds_a_volume(*layers), "")
        outer, inner = map(read_ply, layers)
        self.assertAlmostEqual(measure.body(*outer, 1.0)[0], 1000.0, delta=1e-3)
        material = measure.body(*outer, 1.0)[0] + measure.body(*inner, 1.0)[0]
        self.assertAlmostEqual(report["volume_after"] / material, 1.0, delta=1e-6)

    def test_one_inside_out_body_of_two_gets_an_outer_layer_of_both(self):
        points, faces = cube()
        report, layers = self.outer_and_inner(np.vstack([points, points + [20, 0, 0]]),
                                              np.vstack([faces, faces[:, ::-1] + len(points)]))
        self.assertEqual(report["flipped_components"], 1)
        self.assertEqual(bounds_a_volume(*layers), "")
        self.assertAlmostEqual(measure.body(*read_ply(layers[0]), 1.0)[0], 2000.0, delta=1e-3)

    def test_a_hole_is_closed_and_the_outer_surface_delivered(self):
        points, faces = cube()
        report, layers = self.outer_and_inner(points, faces[1:])
        self.assertEqual(report["repairs"], "1 hole closed")
        self.assertGreater(report["repair_distance"], 0.0)
        self.assertEqual(bounds_a_volume(*layers), "")
        self.assertAlmostEqual(measure.body(*read_ply(layers[0]), 1.0)[0], 1000.0, delta=5.0)

    def test_overlapping_bodies_are_united(self):
        points, faces = cube()
        report, layers = self.outer_and_inner(np.vstack([points, points + [5, 0.5, 0.25]]),
                                              np.vstack([faces, faces + len(points)]))
        self.assertIn("crossing faces united", report["repairs"])
        self.assertEqual(bounds_a_volume(*layers), "")
        overlap = 5.0 * 9.5 * 9.75
        self.assertAlmostEqual(measure.body(*read_ply(layers[0]), 1.0)[0], 2000.0 - overlap,
                               delta=0.1)

    def test_an_inside_out_open_surface_gets_an_outer_layer_that_is_as_open(self):
        points, faces = cube()
        walls = faces[points[faces][:, :, 2].min(axis=1) < 9.9]  # without its top
        report, layers = self.outer_and_inner(points, walls[:, ::-1], open_surface="true")
        self.assertEqual(report["openings"], 1)
        self.assertEqual(len(read_ply(layers[0])[1]), len(walls))
        self.assertEqual(bounds_a_volume(*layers), "")


if __name__ == "__main__":
    unittest.main()
