"""What touches the ground in a point is cut flat and stands; what stands well is left as it is."""
import unittest

import numpy as np

import measure
from host import (SAMPLES, HostTest, bounds_a_volume, changed_script, cube, layers_of, meshlabserver,
                  read_ply, report_in, script_of, write_ply, write_project)

STAND = script_of("box_on_corner")
RADIUS = 20.0


def ball():
    points, faces = cube(8, 2.0)
    points = points - 1.0
    return RADIUS * points / np.linalg.norm(points, axis=1)[:, None], faces


class FootTest(HostTest):
    def layers(self, mesh, **values):
        """Report, and the files of all layers with their matrices."""
        saved = self.folder / "saved.mlp"
        script = changed_script(STAND, self.folder / "s.mlx", **values)
        status, log = meshlabserver(*mesh, "-w", saved, "-s", script)
        self.assertEqual(status, 0, log)
        return report_in(log), [(self.folder / name, matrix) for name, matrix in layers_of(saved)]

    def test_a_ball_stands_on_its_foot(self):
        mesh = write_ply(self.folder / "model.ply", *ball())
        report, layers = self.layers(["-i", mesh], inner_lower_bound=0.8)
        files = [file for file, _ in layers]
        self.assertEqual([file.name for file in files],
                         ["model_out.ply", "modelouteroffsetsurface_out.ply",
                          "modelinneroffsetsurface_out.ply"])
        model, outer, inner = map(read_ply, files)
        self.assertEqual(bounds_a_volume(*files[1:]), "")
        np.testing.assert_allclose(model[0], read_ply(mesh)[0])  # the input stays

        low, ground = model[0][:, 2].min(), outer[0][:, 2].min()
        self.assertAlmostEqual(ground - low, report["foot_depth"], delta=1e-5)
        self.assertLessEqual(report["foot_depth"], 0.01 * 2 * RADIUS)
        foot = measure.convex_hull(outer[0][outer[0][:, 2] == ground][:, :2])  # in one plane, exactly
        following = np.roll(foot, -1, axis=0)
        area = (foot[:, 0] * following[:, 1] - foot[:, 1] * following[:, 0]).sum() / 2
        self.assertAlmostEqual(area / report["contact_area"], 1.0, delta=1e-4)
        diagonal = np.linalg.norm(np.ptp(model[0], axis=0))
        self.assertGreaterEqual(report["contact_inradius"], 0.01 * diagonal * (1 - 1e-4))

        self.assertTrue(report["solved"])
        _, centre, _ = measure.hollow_body(outer, inner, 1.24)
        edge = following - foot
        offset = centre[:2] - foot
        distance = ((edge[:, 0] * offset[:, 1] - edge[:, 1] * offset[:, 0])
                    / np.linalg.norm(edge, axis=1)).min()
        self.assertAlmostEqual(np.degrees(np.arctan2(distance, centre[2] - ground)),
                               report["tip_angle_after"], delta=1e-3)

    def test_of_a_layer_that_is_turned_it_is_flat_but_for_rounding(self):
        points, faces = ball()
        mesh = write_ply(self.folder / "model.ply", points, faces)
        angle = 0.7
        matrix = np.eye(4)
        matrix[1:3, 1:3] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        project = write_project(self.folder / "turned.mlp", mesh, matrix)
        report, layers = self.layers(["-p", project], inner_lower_bound=0.8)
        self.assertTrue(report["solved"])
        file, placed = layers[1]
        vertices, _ = read_ply(file)
        heights = (vertices @ placed[:3, :3].T + placed[:3, 3])[:, 2]
        lowest = heights[heights < heights.min() + 1e-4]
        self.assertGreater(len(lowest), 5)
        self.assertLess(np.ptp(lowest), 2e-5)  # the project's matrix has seven digits

    def test_never_is_refused_on_a_point_and_given_is_as_deep_as_said(self):
        mesh = write_ply(self.folder / "model.ply", *ball())
        script = changed_script(STAND, self.folder / "s.mlx", inner_lower_bound=0.8, foot=1)
        status, log = meshlabserver("-i", mesh, "-s", script)
        self.assertNotEqual(status, 0)
        self.assertIn("touches the ground only in a point", log)
        report, layers = self.layers(["-i", mesh], inner_lower_bound=0.8, foot=2, foot_depth=3)
        self.assertAlmostEqual(report["foot_depth"], 3.0, delta=0.15)
        self.assertEqual(bounds_a_volume(*[file for file, _ in layers[1:]]), "")

    def test_what_stands_well_is_the_same_byte_for_byte(self):
        deliveries = []
        for foot in (0, 1):
            inner = self.folder / f"inner{foot}.ply"
            script = changed_script(STAND, self.folder / "s.mlx", foot=foot)
            status, log = meshlabserver("-i", SAMPLES / "box_on_corner.ply", "-o", inner, "-l", "x",
                                        "-s", script)
            self.assertEqual(status, 0, log)
            self.assertEqual(report_in(log)["foot_depth"], 0.0)
            deliveries.append(inner.read_bytes())
        self.assertEqual(*deliveries)


if __name__ == "__main__":
    unittest.main()
