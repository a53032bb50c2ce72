"""Inputs that are nearly good: they work, and the report says what was mended."""
import unittest

import numpy as np

from host import HostTest, cube, script_of, write_ply

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


if __name__ == "__main__":
    unittest.main()
