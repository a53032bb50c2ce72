"""Every sample mesh through the real meshlabserver: what comes out is printable, and every number
of the report follows from the written files."""
import shutil
import unittest

import numpy as np

import measure
from host import (BUILD_AXIS, SAMPLES, HostTest, ROOT, bounds_a_volume, changed_script, keep_delivered,
                  layers_of, meshlabserver, read_ply, report_in, script_of)
import xml.etree.ElementTree as xml


def parameter(script, name):
    return float(xml.parse(script).find(f".//Param[@name='{name}']").get("value"))


class SamplesTest(HostTest):
    def check(self, sample):
        project = self.folder / f"{sample}.3mf"
        script = changed_script(script_of(sample), self.folder / "print.mlx", print_file=project,
                                build_axis=BUILD_AXIS.get(sample, 0))
        mesh = SAMPLES / f"{sample}.ply"
        inner_file = self.folder / "inner.ply"
        moves = parameter(script, "outer_upper_bound") > 0
        if moves:
            # Layers are saved beside the copy.
            shutil.copy(mesh, self.folder / "model.ply")
            saved = self.folder / "saved.mlp"
            status, log = meshlabserver("-i", self.folder / "model.ply", "-w", saved, "-s", script)
            self.assertEqual(status, 0, log)
            outer_file, inner_file = (self.folder / name for name, _ in layers_of(saved)[1:])
        else:
            status, log = meshlabserver("-i", mesh, "-o", inner_file, "-l", "x", "-s", script)
            outer_file = mesh
        self.assertEqual(status, 0, log)
        keep_delivered(sample, log, project, inner_file, outer_file if moves else None)
        report = report_in(log)
        solid, outer, inner = read_ply(mesh), read_ply(outer_file), read_ply(inner_file)

        for vertices, faces in (outer, inner):
            self.assertTrue(measure.edges_match(faces), "closed and coherently oriented")
            self.assertEqual(len(np.unique(faces)), len(vertices), "compact")
        self.assertEqual(bounds_a_volume(outer_file, inner_file), "")

        # Nine digits are printed; outer and inner surface are exactly those of the files.
        density = parameter(script, "density")
        fill_density = parameter(script, "fill_density")
        reference = outer[0].mean(axis=0)
        nothing = (np.zeros((0, 3)), np.zeros((0, 3), int))
        both_ways = report["goal"] == "Stand empty and filled"
        bodies = {"before": measure.hollow_body(solid, nothing, density, reference=reference),
                  "after": measure.hollow_body(outer, inner, density,
                                               0.0 if both_ways else fill_density, reference)}
        volumes = {state: sum(measure.body(*part, 1.0)[0] for part in parts)
                   for state, parts in (("before", (solid,)), ("after", (outer, inner)))}
        size = np.linalg.norm(np.ptp(outer[0], axis=0))
        for state, (mass, centre, inertia) in bodies.items():
            self.assertAlmostEqual(report[f"mass_{state}"] / mass, 1.0, delta=1e-7)
            self.assertAlmostEqual(report[f"volume_{state}"] / volumes[state], 1.0, delta=1e-7)
            np.testing.assert_allclose(report[f"center_of_mass_{state}"], centre, atol=1e-7 * size)
            np.testing.assert_allclose(report[f"inertia_tensor_{state}"], inertia,
                                       atol=1e-7 * np.trace(inertia))
            with self.subTest(state):
                surface = solid if state == "before" else outer
                self.check_verdict(report, state, surface, mass, centre, inertia, size)
        if both_ways:
            _, filled, _ = measure.hollow_body(outer, inner, density, fill_density, reference)
            self.assertAlmostEqual(report["tip_angle_filled_after"],
                                   measure.tipping_angle(outer[0], filled), delta=1e-4)

        wall = measure.surface_distance(outer, inner)
        self.assertAlmostEqual(report["min_wall"] / wall, 1.0, delta=1e-5)
        # The host keeps parameters as floats.
        self.assertGreaterEqual(wall, float(np.float32(parameter(script, "inner_lower_bound"))))
        self.assertLessEqual(report["objective_after"], report["objective_before"])
        return report

    def check_verdict(self, report, state, outer, mass, centre, inertia, size):
        goal = report["goal"]
        if goal == "Stand":
            self.assertAlmostEqual(report[f"tip_angle_{state}"],
                                   measure.tipping_angle(outer[0], centre), delta=1e-4)
            self.assertEqual(report[f"stands_{state}"], report[f"tip_angle_{state}"] > 0)
        elif goal == "Stand empty and filled":
            self.assertAlmostEqual(report[f"tip_angle_empty_{state}"],
                                   measure.tipping_angle(outer[0], centre), delta=1e-4)
        elif goal in ("Spin", "Yo-yo"):
            offset, tilt, a, b = measure.spin_measures(outer[0], centre, inertia)
            self.assertAlmostEqual(report[f"axis_offset_{state}"], offset, delta=1e-6 * size)
            # The arccosine near 1 loses half of the digits.
            self.assertAlmostEqual(report[f"axis_tilt_{state}"], tilt, delta=1e-4)
            self.assertAlmostEqual(report[f"moment_ratio_a_{state}"], a, delta=1e-6)
            self.assertAlmostEqual(report[f"moment_ratio_b_{state}"], b, delta=1e-6)
            if goal == "Spin":
                speed = report[f"sleeping_speed_{state}"]
                # The root of twice the rounding, and a growth by the root of the missing thousandth.
                at = [measure.growth_of_top(outer[0][:, 2].min(), centre, inertia, mass, f * speed)
                      for f in (0.999, 1.001)]
                self.assertGreater(at[0], 1e-4)
                self.assertLess(at[1], 1e-6)
            if goal == "Yo-yo":
                z = outer[0][:, 2]
                self.assertAlmostEqual(report[f"middle_offset_{state}"],
                                       centre[2] - (z.min() + z.max()) / 2, delta=1e-6 * size)
        elif goal == "Hang":
            top = outer[0][outer[0][:, 2] > outer[0][:, 2].max() - 1e-4 * size]
            arm = centre - top.mean(axis=0)
            self.assertEqual(len(top), 1, "hangs from one vertex")
            self.assertAlmostEqual(report[f"hanging_angle_{state}"],
                                   np.degrees(np.arctan2(np.hypot(*arm[:2]), -arm[2])), delta=1e-4)
        elif goal == "Float" and report[f"floats_{state}"]:
            # What is below the water weighs as much as the body, and its middle is below c.
            self.assertAlmostEqual(report[f"heel_angle_{state}"], 0.0, delta=1e-3)
            level = outer[0][:, 2].min() + report[f"draught_{state}"]
            volume, buoyancy = measure.below(outer, level)
            self.assertAlmostEqual(volume / 1000.0 / mass, 1.0, delta=1e-3)
            np.testing.assert_allclose(buoyancy[:2], centre[:2], atol=1e-4 * size)

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

    def test_toy_dog_topples_over_its_forelegs_and_then_stands_on_four_feet(self):
        self.check_stands("toy_dog")

    def test_leaning_skittle_stands_with_a_moved_outer_surface(self):
        self.check_stands("leaning_skittle")

    def check_verdicts(self, sample, *verdicts):
        report = self.check(sample)
        self.assertTrue(report["solved"], report["message"])
        for verdict in verdicts:
            self.assertFalse(report[f"{verdict}_before"])
            self.assertTrue(report[f"{verdict}_after"])
        return report

    def test_uneven_yo_yo_sleeps_at_the_end_of_its_string(self):
        self.check_verdicts("uneven_yo_yo", "spins", "sleeps")

    def test_leaning_jar_stands_empty_and_filled(self):
        self.check_verdicts("leaning_jar", "stands_empty", "stands_filled")

    def test_roly_poly_comes_back_upright(self):
        report = self.check_verdicts("roly_poly", "rolls_upright")
        self.assertGreater(report["resting_faces_before"], 1)
        self.assertEqual(report["resting_faces_after"], 1)

    def test_bath_duck_sinks_and_then_floats_at_its_waterline(self):
        report = self.check_verdicts("bath_duck", "floats", "floats_upright")
        height = np.ptp(read_ply(SAMPLES / "bath_duck.ply")[0][:, 2])
        self.assertAlmostEqual(report["draught_after"] / height, 0.4, delta=1e-5)
        self.assertGreater(report["metacentric_height_after"], 0)

    def test_hanging_fish_hangs_upright_from_its_knob(self):
        report = self.check_verdicts("hanging_fish", "hangs_upright")
        self.assertGreater(report["hanging_angle_before"], 5)

    def test_game_piece_weighs_more_than_the_solid_with_shot_in_it(self):
        report = self.check_verdicts("game_piece", "weighs_target")
        self.assertAlmostEqual(report["mass_after"], 35.0, delta=1e-4)
        self.assertLess(report["mass_before"], 30.0)

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
