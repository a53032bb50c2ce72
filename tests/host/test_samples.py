"""Every sample mesh through the real meshlabserver: what comes out is printable, and every number
of the report follows from the written files."""
import unittest

import numpy as np

import measure
from host import (SAMPLES, HostTest, ROOT, bounds_a_volume, meshlabserver, read_ply, report_in,
                  script_of)
import xml.etree.ElementTree as xml


def parameter(script, name):
    return float(xml.parse(script).find(f".//Param[@name='{name}']").get("value"))


class SamplesTest(HostTest):
    def check(self, sample):
        script = script_of(sample)
        mesh = SAMPLES / f"{sample}.ply"
        inner_file = self.folder / "inner.ply"
        status, log = meshlabserver("-i", mesh, "-o", inner_file, "-l", "x", "-s", script)
        self.assertEqual(status, 0, log)
        report = report_in(log)
        outer, inner = read_ply(mesh), read_ply(inner_file)

        for vertices, faces in (outer, inner):
            self.assertTrue(measure.edges_match(faces), "closed and coherently oriented")
            self.assertEqual(len(np.unique(faces)), len(vertices), "compact")
        self.assertEqual(bounds_a_volume(mesh, inner_file), "")

        # Nine digits are printed; outer and inner surface are exactly those of the files.
        density = parameter(script, "density")
        reference = outer[0].mean(axis=0)
        nothing = (np.zeros((0, 3)), np.zeros((0, 3), int))
        bodies = {"before": measure.hollow_body(outer, nothing, density, reference=reference),
                  "after": measure.hollow_body(outer, inner, density,
                                               parameter(script, "fill_density"), reference)}
        size = np.linalg.norm(np.ptp(outer[0], axis=0))
        for state, (mass, centre, inertia) in bodies.items():
            self.assertAlmostEqual(report[f"mass_{state}"] / mass, 1.0, delta=1e-7)
            self.assertAlmostEqual(report[f"volume_{state}"] * density / 1000 / mass, 1.0,
                                   delta=1e-7)
            np.testing.assert_allclose(report[f"center_of_mass_{state}"], centre, atol=1e-7 * size)
            np.testing.assert_allclose(report[f"inertia_tensor_{state}"], inertia,
                                       atol=1e-7 * np.trace(inertia))
            if report["goal"] == "Stand":
                self.assertAlmostEqual(report[f"tip_angle_{state}"],
                                       measure.tipping_angle(outer[0], centre), delta=1e-4)
                self.assertEqual(report[f"stands_{state}"], report[f"tip_angle_{state}"] > 0)
            else:
                offset, tilt, a, b = measure.spin_measures(outer[0], centre, inertia)
                self.assertAlmostEqual(report[f"axis_offset_{state}"], offset, delta=1e-6 * size)
                # The arccosine near 1 loses half of the digits.
                self.assertAlmostEqual(report[f"axis_tilt_{state}"], tilt, delta=1e-4)
                self.assertAlmostEqual(report[f"moment_ratio_a_{state}"], a, delta=1e-6)
                self.assertAlmostEqual(report[f"moment_ratio_b_{state}"], b, delta=1e-6)

        wall = measure.surface_distance(outer, inner)
        self.assertAlmostEqual(report["min_wall"] / wall, 1.0, delta=1e-5)
        self.assertGreater(wall, 0.99 * parameter(script, "inner_lower_bound"))
        self.assertLessEqual(report["objective_after"], report["objective_before"])
        return report

    def check_stands(self, sample):
        report = self.check(sample)
        self.assertFalse(report["stands_before"])
        self.assertTrue(report["solved"])
        self.assertGreater(report["tip_angle_after"], 0.0)

    def test_box_on_corner_topples_and_then_stands(self):
        self.check_stands("box_on_corner")

    def test_toy_dinosaur_topples_and_then_stands(self):
        self.check_stands("toy_dinosaur")

    def test_leaning_ring_topples_and_then_stands(self):
        self.check_stands("leaning_ring")

    def test_tilted_ellipsoid_top_wobbles_and_then_spins(self):
        report = self.check("tilted_ellipsoid_top")
        self.assertFalse(report["spins_before"])
        self.assertTrue(report["spins_after"])
        self.assertTrue(report["solved"])

    def test_leaning_egg_topples_whatever_the_cavity_and_the_report_says_so(self):
        report = self.check("leaning_egg")
        self.assertFalse(report["solved"])
        self.assertFalse(report["stands_after"])
        self.assertIn("missed", report["message"])

    def test_flattened_layers_make_one_stl_that_bounds_a_volume(self):
        mesh, inner, solid = (SAMPLES / "tilted_ellipsoid_top.ply", self.folder / "inner.ply",
                              self.folder / "solid.stl")
        status, log = meshlabserver("-i", mesh, "-o", inner, "-l", "x", "-s",
                                    script_of("tilted_ellipsoid_top"))
        self.assertEqual(status, 0, log)
        status, log = meshlabserver("-i", mesh, inner, "-o", solid, "-l", "x", "-s",
                                    ROOT / "scripts" / "flatten.mlx")
        self.assertEqual(status, 0, log)
        faces = len(read_ply(mesh)[1]) + len(read_ply(inner)[1])
        self.assertEqual(solid.stat().st_size, 84 + 50 * faces, "binary STL with all triangles")
        self.assertEqual(bounds_a_volume(solid), "")


if __name__ == "__main__":
    unittest.main()
