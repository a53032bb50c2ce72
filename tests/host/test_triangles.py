"""The triangles that a body is given in, their unit and their place do not matter."""
import unittest

import numpy as np

from host import HostTest, bounds_a_volume, cube, script_of, write_ply

STAND = script_of("box_on_corner")
OFFSET_SURFACE = 1


def sheared(points):
    """A cube that leans, so that there is something to gain."""
    return points @ np.array([[1, 0, 0], [0, 1, 0], [0.3, 0, 1]])


class TrianglesTest(HostTest):
    def hollowed(self, n, goal, scale=1.0, shift=(0, 0, 0), **values):
        """Report on a leaning cube of n×n squares a side, whose cavity must be valid."""
        points, faces = cube(n)
        points = sheared(points) * scale + shift
        wall = 0.2 * scale
        mesh = write_ply(self.folder / "m.ply", points, faces)
        report, (inner, inner_faces) = self.run_filter(mesh, STAND, goal=goal,
                                                       inner_lower_bound=wall, **values)
        self.assertEqual(bounds_a_volume(mesh, self.folder / "inner.ply"), "")
        self.assertGreater(len(inner_faces), 0)
        self.assertGreaterEqual(report["min_wall"], wall)
        return report

    def test_twelve_triangles_serve_every_kind_of_goal(self):
        for goal, key in ((0, "tip_angle"), (1, "axis_tilt"), (5, "heel_angle"), (7, "mass")):
            for shape in (0, OFFSET_SURFACE):
                with self.subTest(goal=goal, shape=shape):
                    report = self.hollowed(1, goal, cavity_shape=shape)
                    self.assertLess(report["gap_to_limit"], 0.1)
                    self.assertIn(key + "_after", report)

    def test_many_triangles_lead_to_the_same_verdict(self):
        for goal, key in ((0, "tip_angle"), (7, "mass")):
            few, many = (self.hollowed(n, goal) for n in (1, 30))
            gain = abs(few[key + "_after"] - few[key + "_before"])
            self.assertLess(abs(few[key + "_after"] - many[key + "_after"]), 0.02 * gain)

    def test_any_unit_serves(self):
        shares = [report["volume_after"] / report["volume_before"]
                  for report in (self.hollowed(1, 7, scale) for scale in (1e-3, 1.0, 1e6))]
        self.assertLess(max(shares) - min(shares), 0.02 * (1 - max(shares)))

    def test_coordinates_too_coarse_for_the_wall_are_named(self):
        near = self.hollowed(1, 7)
        far = self.hollowed(1, 7, shift=(1e5, 0, 0))
        self.assertLess(near["rounding_step"], 0.01 * 0.2)
        self.assertNotIn("stored in steps", near["message"])
        # Floats at 100,000.
        self.assertAlmostEqual(far["rounding_step"], 2.0 ** -7, delta=0.1 * 2.0 ** -7)
        self.assertIn("stored in steps", far["message"])
        self.assertIn("Transform: Translate, Center", far["message"])


if __name__ == "__main__":
    unittest.main()
