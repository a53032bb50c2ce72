"""Proofs that no cavity can reach a goal, checked by a program that shares nothing with the filter:
the conditions against the model's own contact area, the integral over voxels that hold all of what
may be hollow, with distances by VTK."""
import unittest

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

import measure
from host import SAMPLES, HostTest, read_ply, script_of


def signed_distances(vertices, faces, points):
    """Negative inside."""
    surface = vtk.vtkPolyData()
    coordinates = vtk.vtkPoints()
    coordinates.SetData(numpy_to_vtk(np.ascontiguousarray(vertices, dtype=float), deep=True))
    cells = np.hstack([np.full((len(faces), 1), 3), faces]).astype(np.int64).ravel()
    triangles = vtk.vtkCellArray()
    triangles.SetCells(len(faces), numpy_to_vtkIdTypeArray(cells, deep=True))
    surface.SetPoints(coordinates)
    surface.SetPolys(triangles)
    distance = vtk.vtkImplicitPolyDataDistance()
    distance.SetInput(surface)
    values = vtk.vtkDoubleArray()
    distance.FunctionValue(numpy_to_vtk(np.ascontiguousarray(points), deep=True), values)
    return vtk_to_numpy(values)


def moments(vertices, faces):
    mass, first, second = measure.body(vertices, faces, 1.0)
    return np.array([mass, *first, second[0, 0], second[1, 1], second[2, 2], second[0, 1],
                     second[1, 2], second[2, 0]])


class ProofsTest(HostTest):
    def check_integral(self, vertices, faces, wall, w):
        """Whether w is positive for every body that is hollow where the wall allows it."""
        along = 72
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        edge = (high - low).max() / along
        axes = [np.arange(a + edge / 2, b + edge / 2, edge) for a, b in zip(low, high)]
        x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        # A voxel with any point that keeps the wall has a middle that nearly does.
        x = x[-signed_distances(vertices, faces, x) >= wall - np.sqrt(3) / 2 * edge]
        corners = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]) / 2
        self.assertFalse(w[4:10].any())  # linear: its positive part is convex, below its corners' mean
        values = [np.maximum(0, w[0] + (x + edge * c) @ w[1:4]) for c in corners]
        integral = np.mean(values, axis=0).sum() * edge ** 3
        self.assertGreater(w[:10] @ moments(vertices, faces) + w[10], integral)

    def test_no_cavity_makes_the_egg_and_the_skittle_stand(self):
        for sample in ("leaning_egg", "leaning_skittle"):
            model = read_ply(SAMPLES / f"{sample}.ply")
            diagonal = np.linalg.norm(np.ptp(model[0], axis=0))
            wall = 0.03 * diagonal
            script = {"inner_lower_bound": wall, "outer_lower_bound": 0, "outer_upper_bound": 0}
            report, _ = self.run_filter(SAMPLES / f"{sample}.ply", script_of(sample), **script)
            self.assertTrue(report["certified"], report["message"])
            self.assertIn("No cavity of any shape that keeps this wall can reach it",
                          report["message"])
            origin, length = report["certificate_origin"], report["certificate_length"]
            vertices = (model[0] - origin) / length
            polygon = measure.contact_polygon(vertices)
            w = np.zeros(11)
            for term in report["certificate_conditions"].split("; "):
                share, row = term.split(" x ")
                row = np.array(row.split(), dtype=float)
                self.assertGreater(float(share), 0)
                # u·S − h m ≤ 0 with a direction u and at least the area's extent h along it.
                self.assertAlmostEqual(np.linalg.norm(row[1:3]), 1, delta=1e-9)
                self.assertGreaterEqual(-row[0], (polygon @ row[1:3]).max() - 1e-6)
                self.assertFalse(row[3:].any())
                w += float(share) * row
            functional = np.array(report["certificate_functional"].split(), dtype=float)
            np.testing.assert_allclose(functional, w, atol=1e-12)
            self.check_integral(vertices, model[1], wall / length, w)


if __name__ == "__main__":
    unittest.main()
