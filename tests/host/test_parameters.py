"""Each parameter acts as its tooltip says, seen in the files and reports of real runs."""
import re
import unittest
import zipfile

import numpy as np

import measure
from host import (SAMPLES, HostTest, changed_script, layers_of, meshlabserver, read_ply, report_in,
                  script_of, shutil, write_ply)

TOP = SAMPLES / "tilted_ellipsoid_top.ply"
SPIN = script_of("tilted_ellipsoid_top")
DUCK = SAMPLES / "bath_duck.ply"
STAND_GOAL, SPIN_GOAL, YO_YO_GOAL, HANG_GOAL = 0, 1, 2, 6
AUTOMATIC, OFFSET_SURFACE, BEST_POSSIBLE = 0, 1, 2


def cotangent_energy(vertices, faces, values):
    """Dirichlet energy of a function that is linear on each triangle."""
    energy = 0.0
    a, b, c = vertices[faces].transpose(1, 0, 2)
    area2 = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    for k in range(3):
        i, j, o = faces[:, k], faces[:, (k + 1) % 3], faces[:, (k + 2) % 3]
        u, v = vertices[i] - vertices[o], vertices[j] - vertices[o]
        energy += ((u * v).sum(1) / area2 * (values[i] - values[j]) ** 2).sum() / 2
    return energy


class ParametersTest(HostTest):
    @classmethod
    def setUpClass(cls):
        cls.outer = read_ply(TOP)
        cls.diagonal = np.linalg.norm(np.ptp(cls.outer[0], axis=0))

    results = {}

    def top(self, **values):
        """As `run_filter`, of the top; what several tests look at is run once."""
        asked = tuple(sorted(values.items()))
        if asked not in self.results:
            self.results[asked] = self.run_filter(TOP, SPIN, **values)
        report, inner = self.results[asked]
        return dict(report), inner

    def both_surfaces(self, **values):
        """Report, moved outer surface and inner surface."""
        mesh = shutil.copy(TOP, self.folder / "model.ply")
        script = changed_script(SPIN, self.folder / "s.mlx", **values)
        saved = self.folder / "saved.mlp"
        status, log = meshlabserver("-i", mesh, "-w", saved, "-s", script)
        self.assertEqual(status, 0, log)
        layers = layers_of(saved)
        self.assertEqual(len(layers), 3)
        return report_in(log), *(read_ply(self.folder / name) for name, _ in layers[1:])

    def test_goal(self):
        stand, _ = self.top(goal=STAND_GOAL)
        spin, _ = self.top(goal=SPIN_GOAL)
        self.assertIn("tip_angle_after", stand)
        self.assertNotIn("axis_tilt_after", stand)
        self.assertIn("axis_tilt_after", spin)
        self.assertNotIn("tip_angle_after", spin)
        self.assertLess(stand["center_of_mass_after"][2], spin["center_of_mass_after"][2])

    def test_cavity_shape(self):
        gaps = {}
        for shape, words in ((OFFSET_SURFACE, "offset surface: as asked for"),
                             (BEST_POSSIBLE, "best possible: as asked for"),
                             (AUTOMATIC, "best possible: the surface is closed and stays")):
            report, (vertices, faces) = self.top(cavity_shape=shape)
            self.assertTrue(report["cavity_shape"].startswith(words), report["cavity_shape"])
            self.assertTrue(report["solved"], report["message"])
            wall = measure.surface_distance(self.outer, (vertices, faces))
            self.assertGreaterEqual(wall, report["min_wall"] - 1e-6)
            gaps[shape] = report["gap_to_limit"]
        self.assertGreater(gaps[OFFSET_SURFACE], 1.5 * gaps[BEST_POSSIBLE])
        self.assertLess(gaps[BEST_POSSIBLE], 0.015)
        self.assertLess(gaps[AUTOMATIC], 0.015)

    def test_basis_k_more_functions_shape_finer_detail(self):
        _, (few, _) = self.top(cavity_shape=OFFSET_SURFACE, basis_k=6)
        _, (many, _) = self.top(cavity_shape=OFFSET_SURFACE, basis_k=60)

        def roughness(inner):
            # A few vertices may be solid: not every one of the model has its own in the cavity.
            ways = inner[np.newaxis] - self.outer[0][:, np.newaxis]
            offset = np.linalg.norm(ways, axis=2).min(axis=1)
            return cotangent_energy(*self.outer, offset) / np.var(offset)

        self.assertGreater(roughness(many), 1.2 * roughness(few))

    def test_radii_make_the_contact_area_an_ellipse(self):
        report, _ = self.top(goal=STAND_GOAL, radius_x=9, radius_y=4)
        centre = report["center_of_mass_before"]
        ground = np.append(measure.polygon_centroid(measure.contact_polygon(self.outer[0])),
                           self.outer[0][:, 2].min())
        x, y, height = centre - ground
        angle = np.linspace(0, 2 * np.pi, 200001)
        distance = np.hypot(9 * np.cos(angle), 4 * np.sin(angle)) - x * np.cos(angle) - \
            y * np.sin(angle)
        tip = np.degrees(np.arctan2(distance, height).min())
        self.assertAlmostEqual(report["tip_angle_before"], tip, delta=1e-4)
        turned, _ = self.top(goal=STAND_GOAL, radius_x=4, radius_y=9)
        self.assertGreater(abs(turned["tip_angle_before"] - tip), 0.01)

    def test_inner_lower_bound_is_the_least_wall(self):
        thin, _ = self.top(inner_lower_bound=1)
        thick, inner = self.top(inner_lower_bound=3)
        wall = measure.surface_distance(self.outer, inner)
        self.assertGreaterEqual(wall, 3)
        self.assertGreater(thick["mass_after"], thin["mass_after"])
        self.assertLess(thin["min_wall"], 3)

    def test_inner_upper_bound_limits_the_depth(self):
        _, (near, _) = self.top(cavity_shape=OFFSET_SURFACE, inner_upper_bound=0.4)
        _, (far, _) = self.top(cavity_shape=OFFSET_SURFACE, inner_upper_bound=0.9)

        def depth(inner):
            return max(np.linalg.norm(self.outer[0] - y, axis=1).min() for y in inner)

        # What is deepest ran to the skeleton, and is rounded off.
        self.assertGreater(depth(far), 1.1 * depth(near))

    def test_selected_faces_stay_solid_to_a_depth(self):
        select = ('<filter name="Conditional Face Selection"><Param type="RichString" '
                  'name="condSelect" value="(z0 &gt; 10)"/></filter>')
        points, faces = self.outer
        upper = faces[points[faces[:, 0], 2] > 10]
        self.assertGreater(len(upper), 20)
        free, cavity = self.top()
        self.assertNotIn("solid_depth", free)
        reached = measure.surface_distance((points, upper), cavity)
        for depth, least in ((5, 5), (0, 4 * 1.5)):
            script = changed_script(SPIN, self.folder / "select.mlx", keep_selected_solid="true",
                                    inner_lower_bound=1.5, solid_depth=depth)
            text = script.read_text()
            place = text.index("<filter ")
            script.write_text(text[:place] + select + text[place:])
            status, log = meshlabserver("-i", TOP, "-o", self.folder / "c.ply", "-s", script)
            self.assertEqual(status, 0, log)
            cavity = read_ply(self.folder / "c.ply")
            apart = measure.surface_distance((points, upper), cavity)
            self.assertGreaterEqual(apart, least - 1e-5)
            self.assertAlmostEqual(report_in(log)["solid_depth"], apart, delta=1e-5)
            self.assertLess(reached, apart)

    def test_outer_bounds_are_the_range_of_the_displacement(self):
        _, (moved, faces), _ = self.both_surfaces(outer_lower_bound=0.3, outer_upper_bound=0.9)
        np.testing.assert_array_equal(faces, self.outer[1])
        displacement = np.linalg.norm(moved - self.outer[0], axis=1)
        ground = self.outer[0][:, 2].min()
        # Near the ground the surface moves less, so as not to go through it.
        free = self.outer[0][:, 2] > ground + 0.9
        # Coordinates are stored in single precision.
        self.assertGreater(displacement[free].min(), 0.3 - 1e-4)
        self.assertLess(displacement.max(), 0.9 + 1e-4)
        self.assertGreater(np.ptp(displacement[free]), 0.05)
        self.assertGreater(moved[:, 2].min(), ground - 1e-4)

    def test_opt_weight_1_saves_material(self):
        without, _ = self.top(opt_weight_1=0)
        heavy, _ = self.top(opt_weight_1=100)
        self.assertLess(heavy["volume_after"], 0.98 * without["volume_after"])

    def test_opt_weight_2_lowers_the_centre_of_mass(self):
        without, _ = self.top(opt_weight_2=0)
        heavy, _ = self.top(opt_weight_2=100)

        def height(report):  # the term itself: (m/m_solid) c_z
            return (report["mass_after"] / report["mass_before"]
                    * (report["center_of_mass_after"][2] - self.outer[0][:, 2].min()))

        self.assertLess(height(heavy), 0.98 * height(without))

    def test_opt_weight_3_turns_the_moments_of_inertia(self):
        without, _ = self.top(opt_weight_3=0)
        heavy, _ = self.top(opt_weight_3=100)

        def ratio(report):
            return report["moment_ratio_a_after"]**-2 + report["moment_ratio_b_after"]**-2

        self.assertLess(ratio(heavy), ratio(without))

    def test_opt_weight_4_smooths_the_offsets(self):
        _, free = self.top(cavity_shape=OFFSET_SURFACE, opt_weight_4=0)
        _, smooth = self.top(cavity_shape=OFFSET_SURFACE, opt_weight_4=0.03)

        def energy(inner):
            # Of how deep the cavity is, for where it ends it has vertices of its own.
            away = np.linalg.norm(inner[0][:, None] - self.outer[0][None], axis=2).min(1)
            return cotangent_energy(*inner, away)

        self.assertLess(energy(smooth), 0.9 * energy(free))

    def test_opt_weight_5_keeps_the_constraints(self):
        without, _ = self.top(opt_weight_5=0)
        kept, _ = self.top(opt_weight_5=1)
        self.assertGreater(without["max_constraint_violation"],
                           100 * kept["max_constraint_violation"])
        self.assertFalse(without["solved"])

    def test_opt_weight_6_holds_the_outer_surface(self):
        _, (free, _), _ = self.both_surfaces(outer_upper_bound=2, opt_weight_6=0)
        _, (held, _), _ = self.both_surfaces(outer_upper_bound=2, opt_weight_6=10000)

        def mean_square(outer):
            return ((outer - self.outer[0])**2).sum(axis=1).mean()

        self.assertLess(mean_square(held), 0.7 * mean_square(free))

    def test_up_axis_each_entry_turns_the_model_upright(self):
        """The top, turned so that an axis points up, behaves as the upright one."""
        upright, _ = self.top()
        turns = {0: np.eye(3),                                         # +Z
                 1: np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0]]),       # +Y
                 2: np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])}       # +X
        vertices, faces = self.outer
        for axis in range(6):
            turn = turns[axis % 3]
            if axis >= 3:  # half a turn about a horizontal axis: up becomes down
                turn = turn @ np.diag([1, -1, -1])
            self.assertAlmostEqual(np.linalg.det(turn), 1)
            with self.subTest(axis):
                mesh = write_ply(self.folder / "turned.ply", vertices @ turn.T, faces)
                report, _ = self.run_filter(mesh, SPIN, up_axis=axis)
                for key in ("axis_offset_before", "axis_tilt_before", "moment_ratio_a_before"):
                    self.assertAlmostEqual(report[key], upright[key], delta=1e-4)
                self.assertTrue(report["spins_after"])

    def test_density_scales_masses_and_nothing_else(self):
        single, (inner, _) = self.top(density=1.24)
        double, (same, _) = self.top(density=2.48)
        self.assertAlmostEqual(double["mass_after"] / single["mass_after"], 2, delta=1e-4)
        self.assertLess(np.abs(inner - same).max(), 1e-3 * self.diagonal)

    def test_fill_density_fills_the_cavity(self):
        report, inner = self.top(fill_density=0.8)
        mass, centre, inertia = measure.hollow_body(self.outer, inner, 1.24, 0.8)
        self.assertAlmostEqual(report["mass_after"] / mass, 1, delta=1e-6)
        np.testing.assert_allclose(report["center_of_mass_after"], centre, atol=1e-5)
        np.testing.assert_allclose(report["inertia_tensor_after"], inertia,
                                   atol=1e-5 * np.trace(inertia))
        empty, _ = self.top(fill_density=0)
        self.assertGreater(report["mass_after"], 1.05 * empty["mass_after"])

    def test_cavity_infill_weighs_its_share_of_the_material(self):
        report, inner = self.top(cavity_infill=0.1)
        mass, centre, _ = measure.hollow_body(self.outer, inner, 1.24, 0.124)
        self.assertAlmostEqual(report["mass_after"] / mass, 1, delta=1e-6)
        np.testing.assert_allclose(report["center_of_mass_after"], centre, atol=1e-5)
        self.assertIn("10 %", report["print_as"])
        filled, (same, _) = self.top(fill_density=0.124)
        np.testing.assert_allclose(filled["center_of_mass_after"], centre, atol=1e-4)
        self.assertLess(np.abs(inner[0] - same).max(), 1e-3 * self.diagonal)

    def test_print_file_is_written_with_the_build_axis_up(self):
        extent = np.ptp(self.outer[0], axis=0)
        for build_axis, up in ((0, 2), (3, 0)):
            project = self.folder / "top.3mf"
            report, _ = self.top(print_file=project, build_axis=build_axis)
            with zipfile.ZipFile(project) as archive:
                self.assertIsNone(archive.testzip())
                model = archive.read("3D/3dmodel.model").decode()
                written = report_in(archive.read("Metadata/report.txt").decode())
            z = [float(value) for value in re.findall(r'<vertex [^>]* z="([^"]*)"', model)]
            self.assertAlmostEqual(min(z), 0, delta=1e-4)
            self.assertAlmostEqual(max(z[:len(self.outer[0])]), extent[up], delta=1e-3)
            self.assertEqual(written["mass_after"], report["mass_after"])
            self.assertAlmostEqual(report["print_mass"] / report["mass_after"], 1, delta=1e-6)
            first = project.read_bytes()
            project.unlink()
            self.run_filter(TOP, SPIN, print_file=project, build_axis=build_axis)
            self.assertEqual(project.read_bytes(), first, "the same bytes")

    def test_the_pivot_is_what_the_model_turns_about(self):
        pivot = {"pivot_x": 4, "pivot_y": -3, "pivot_z": 60}
        ignored, _ = self.top(goal=HANG_GOAL, **pivot)
        given, _ = self.top(goal=HANG_GOAL, use_pivot="true", **pivot)
        arm = given["center_of_mass_before"] - [4, -3, 60]
        self.assertAlmostEqual(given["hanging_angle_before"],
                               np.degrees(np.arctan2(np.hypot(*arm[:2]), -arm[2])), delta=1e-4)
        self.assertNotAlmostEqual(ignored["hanging_angle_before"], given["hanging_angle_before"],
                                  delta=1)
        spin, _ = self.top(use_pivot="true", pivot_x=0.5, pivot_y=0, pivot_z=0)
        self.assertAlmostEqual(spin["axis_offset_before"],
                               np.hypot(*(spin["center_of_mass_before"][:2] - [0.5, 0])),
                               delta=1e-4)
        yo_yo, _ = self.top(goal=YO_YO_GOAL, use_pivot="true", pivot_z=20)
        self.assertAlmostEqual(yo_yo["middle_offset_before"],
                               yo_yo["center_of_mass_before"][2] - 20, delta=1e-4)

    def test_spin_speed_is_what_the_hand_gives(self):
        report, _ = self.top()
        self.assertTrue(report["spins_after"])
        speed = report["sleeping_speed_after"]
        slow, _ = self.top(spin_speed=0.95 * speed)
        self.assertFalse(slow["spins_after"])
        self.assertIn(f"{np.ceil(speed):.0f} rpm", slow["message"])
        self.assertAlmostEqual(slow["sleeping_speed_after"], speed, delta=1e-6 * speed)
        fast, _ = self.top(spin_speed=1.05 * speed)
        self.assertTrue(fast["spins_after"])

    def test_water_level_is_the_waterline(self):
        height = np.ptp(read_ply(DUCK)[0][:, 2])
        for level in (0.3, 0.6):
            report, _ = self.run_filter(DUCK, script_of("bath_duck"), water_level=level)
            self.assertTrue(report["solved"], report["message"])
            self.assertAlmostEqual(report["draught_after"], level * height, delta=1e-3 * height)
        neutral, _ = self.run_filter(DUCK, script_of("bath_duck"), water_level=1)
        self.assertTrue(neutral["solved"], neutral["message"])
        self.assertAlmostEqual(neutral["reserve_buoyancy_after"], 0, delta=1e-5)

    def test_water_density_is_that_of_the_displaced_liquid(self):
        fresh, _ = self.run_filter(DUCK, script_of("bath_duck"), water_density=1)
        heavy, _ = self.run_filter(DUCK, script_of("bath_duck"), water_density=1.2)
        self.assertAlmostEqual(heavy["mass_after"] / fresh["mass_after"], 1.2, delta=1e-5)

    def test_target_mass_is_the_mass(self):
        piece, script = SAMPLES / "game_piece.ply", script_of("game_piece")
        report, _ = self.run_filter(piece, script, target_mass=15, fill_density=0)
        self.assertAlmostEqual(report["mass_after"], 15, delta=1e-4)
        light, _ = self.run_filter(piece, script, target_mass=0, fill_density=0)
        self.assertLess(light["mass_after"], 12)


if __name__ == "__main__":
    unittest.main()
