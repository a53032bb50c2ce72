"""Proofs that no cavity can reach a goal, checked by a program that shares nothing with the filter:
the conditions against the model's own contact area, the integral over voxels that hold all of what
may be hollow, with distances by VTK; and where a body comes to rest by heights over a grid of
directions."""
import heapq
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


CORNERS = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]) / 2


class Voxels:
    """That hold all points of a model that keep a wall from its surface."""

    def __init__(self, vertices, faces, wall, along=36, splits=3):
        self.solid = moments(vertices, faces)
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        edge = (high - low).max() / along
        axes = [np.arange(a + edge / 2, b + edge / 2, edge) for a, b in zip(low, high)]
        x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        self.parts = []  # middles and edges
        for split in range(splits + 1):
            # A voxel with any point that keeps the wall has a middle that nearly does.
            depth = -signed_distances(vertices, faces, x) - wall
            reach = np.sqrt(3) / 2 * edge
            is_cut = np.abs(depth) < reach if split < splits else np.zeros(len(x), bool)
            self.parts.append((x[(depth >= -reach) & ~is_cut], edge))
            edge /= 2
            x = (x[is_cut][:, None] + edge * CORNERS).reshape(-1, 3)

    def bounds_positive_part(self, states):
        """At least the integral of the positive part of what hollowing out a point takes away.
        `states`: density and level of the contents, and w, which is linear. Between two levels the
        positive part is convex, so that it lies below the mean of its corners; so is the greatest
        of those of all parts that the levels cut a voxel into."""
        assert not any(w[4:10].any() for _, _, w in states)
        ends = [-np.inf, *sorted({level for _, level, _ in states} - {np.inf}), np.inf]
        total = 0
        for x, edge in self.parts:
            greatest = np.zeros((len(CORNERS), len(x)))
            for low, high in zip(ends, ends[1:]):
                u = sum((1 - density if high <= level else 1) * w for density, level, w in states)
                meets = (x[:, 2] + edge / 2 >= low) & (x[:, 2] - edge / 2 <= high)
                values = np.array([u[0] + (x[meets] + edge * c) @ u[1:4] for c in CORNERS])
                greatest[:, meets] = np.maximum(greatest[:, meets], values)
            total += greatest.mean(axis=0).sum() * edge ** 3
        return total

    def prove_positive(self, states):
        """Whether the sum of all w is positive for every body that is hollow where the wall allows
        it."""
        return sum(w[:10] @ self.solid + w[10] for _, _, w in states) > \
            self.bounds_positive_part(states)


class RollingBody:
    """The heights h(u) = max u·(v − c) of the centre of mass c over the ground, u pointing down, over
    the triangles of a grid of directions."""
    BARRIER = 5e-4
    UPRIGHT = np.radians(2)

    def __init__(self, vertices, frequency=40):
        self.vertices = vertices
        self.grid, self.triangles = icosphere(frequency)
        farthest = np.argmax(self.grid @ vertices.T, axis=1)
        self.support = np.einsum("ij,ij->i", self.grid, vertices[farthest])
        middles = self.grid[self.triangles].mean(axis=1)
        # For any vertex v, h is at least the least u·(v − c) of a triangle's corners, if positive.
        lowest = vertices[np.argmax(middles @ vertices.T, axis=1)]
        self.under = np.einsum("tki,ti->tk", self.grid[self.triangles], lowest)
        down = self.grid[:, 2] <= -np.cos(self.UPRIGHT)
        ends = self.grid[self.triangles]
        self.spacing = np.arccos((ends[:, 0] * ends[:, 1]).sum(axis=1)).max()
        near = -middles[:, 2] >= np.cos(self.UPRIGHT + self.spacing)
        self.is_upright = near | down[self.triangles].any(axis=1)
        self.neighbours = neighbours_of(self.triangles)
        self.first_at = np.zeros(len(self.grid), int)
        self.first_at[self.triangles.ravel()] = np.repeat(np.arange(len(self.triangles)), 3)

    def stays_off(self, low, high):
        """Whether for all centres in a box a body that is let go in some pose comes to rest off
        upright."""
        centre = (low + high) / 2
        heights = self.support - self.grid @ centre
        below = (self.under - self.grid[self.triangles] @ centre).min(axis=1)
        seen = np.zeros(len(below), bool)
        for rest in self.rests_at(heights):
            start = self.first_at[rest]
            if seen[start] or self.is_upright[start]:
                continue
            floods = self.floods_from(start, below)
            seen[floods[-1]] = True
            down = self.settled(self.grid[rest], centre)
            if any(self.is_walled(down, flooded, low, high) for flooded in floods):
                return True
        return False

    def settled(self, u, centre):
        """A direction near u with a low height: the middle of ever smaller rings."""
        arms = self.vertices - centre
        best, radius = np.max(arms @ u), self.spacing
        turns = np.linspace(0, 2 * np.pi, 8, endpoint=False)
        while radius > 1e-6:
            across = np.linalg.svd(u[None])[2][1:]
            around = u + radius * (np.outer(np.cos(turns), across[0]) +
                                   np.outer(np.sin(turns), across[1]))
            around /= np.linalg.norm(around, axis=1)[:, None]
            heights = np.max(arms @ around.T, axis=0)
            lowest = np.argmin(heights)
            if heights[lowest] < best:
                u, best = around[lowest], heights[lowest]
            else:
                radius /= 2
        return u

    def rests_at(self, heights):
        """Local minima on the grid off upright, the lowest first."""
        least = np.full(len(heights), np.inf)
        for i, j in ((0, 1), (1, 2), (2, 0)):
            a, b = self.triangles[:, i], self.triangles[:, j]
            np.minimum.at(least, a, heights[b])
            np.minimum.at(least, b, heights[a])
        is_off = ~np.isin(np.arange(len(heights)), self.triangles[self.is_upright])
        rests = np.flatnonzero((heights <= least) & is_off)
        return rests[np.argsort(heights[rests])]

    def floods_from(self, start, below):
        """Water rises from a triangle until it would reach upright: what is under water when it has
        crossed its highest pass, and in the end."""
        reached = np.zeros(len(below), bool)
        reached[start] = True
        queue, flooded, level, count = [(below[start], start)], [], -np.inf, 0
        while queue:
            height, t = heapq.heappop(queue)
            if self.is_upright[t]:
                break
            if height > level:
                level, count = height, len(flooded)
            flooded.append(t)
            for other in self.neighbours[t]:
                if not reached[other]:
                    reached[other] = True
                    heapq.heappush(queue, (below[other], other))
        return [flooded[:count], flooded] if count > 0 else [flooded]

    def is_walled(self, down, flooded, low, high):
        """Whether all around is higher than one pose, for all centres in the box; by the barrier
        where it is not upright itself."""
        inside = np.zeros(len(self.triangles), bool)
        inside[flooded] = True
        ring = ~inside & inside[self.neighbours].any(axis=1)
        barrier = np.where(self.is_upright[ring], 0.0, 1.001 * self.BARRIER)[:, None]
        rise = self.under[ring] - np.max(self.vertices @ down) - barrier
        slopes = self.grid[self.triangles[ring]] - down
        worst = slopes @ ((low + high) / 2) + np.abs(slopes) @ ((high - low) / 2)
        return (worst < rise).all()


def icosphere(frequency):
    """Points and outward triangles: those of an icosahedron, cut and blown up."""
    source = vtk.vtkPlatonicSolidSource()
    source.SetSolidTypeToIcosahedron()
    source.Update()
    corners = vtk_to_numpy(source.GetOutput().GetPoints().GetData()).astype(float)
    corners /= np.linalg.norm(corners, axis=1)[:, None]
    faces = vtk_to_numpy(source.GetOutput().GetPolys().GetData()).reshape(-1, 4)[:, 1:]
    points, triangles = [], []
    for a, b, c in corners[faces]:
        index = {}
        for i in range(frequency + 1):
            for j in range(frequency + 1 - i):
                index[i, j] = len(points)
                points.append((a * (frequency - i - j) + b * i + c * j) / frequency)
        for i in range(frequency):
            for j in range(frequency - i):
                triangles.append((index[i, j], index[i + 1, j], index[i, j + 1]))
                if i + j < frequency - 1:
                    triangles.append((index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]))
    points = np.array(points)
    points /= np.linalg.norm(points, axis=1)[:, None]
    _, first, same = np.unique(points.round(9), axis=0, return_index=True, return_inverse=True)
    return points[first], same.ravel()[np.array(triangles)]


def neighbours_of(triangles):
    """The three triangles that share an edge with each."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                    triangles[:, [2, 0]]]), axis=1)
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort(edges.T)
    assert (edges[order[::2]] == edges[order[1::2]]).all()
    other = np.empty(len(edges), int)
    other[order[::2]], other[order[1::2]] = owner[order[1::2]], owner[order[::2]]
    return other.reshape(3, -1).T


class ProofsTest(HostTest):
    def check_proof(self, sample, script, share):
        model = read_ply(SAMPLES / f"{sample}.ply")
        wall = share * np.linalg.norm(np.ptp(model[0], axis=0))
        values = {"inner_lower_bound": wall, "outer_lower_bound": 0, "outer_upper_bound": 0}
        report, _ = self.run_filter(SAMPLES / f"{sample}.ply", script_of(script), **values)
        self.assertTrue(report["certified"], report["message"])
        self.assertIn("No cavity of any shape that keeps this wall can reach it",
                      report["message"])
        origin, length = report["certificate_origin"], report["certificate_length"]
        vertices = (model[0] - origin) / length
        polygon = measure.contact_polygon(vertices)
        states = []
        for filling, functional, conditions in zip(report["certificate_fillings"].split("; "),
                                                   report["certificate_functional"].split("; "),
                                                   report["certificate_conditions"].split(" | ")):
            w = np.zeros(11)
            for term in conditions.split("; "):
                multiplier, row = term.split(" x ")
                row = np.array(row.split(), dtype=float)
                self.assertGreater(float(multiplier), 0)
                # u·S − h m ≤ 0 with a direction u and at least the area's extent h along it.
                self.assertAlmostEqual(np.linalg.norm(row[1:3]), 1, delta=1e-9)
                self.assertGreaterEqual(-row[0], (polygon @ row[1:3]).max() - 1e-6)
                self.assertFalse(row[3:].any())
                w += float(multiplier) * row
            np.testing.assert_allclose(np.array(functional.split(), dtype=float), w, atol=1e-12)
            states.append((*map(float, filling.split()), w))
        self.assertTrue(Voxels(vertices, model[1], wall / length).prove_positive(states))
        return states

    def test_no_cavity_makes_the_egg_and_the_skittle_stand(self):
        for sample in ("leaning_egg", "leaning_skittle"):
            states = self.check_proof(sample, sample, 0.03)
            self.assertEqual([state[:2] for state in states], [(0, np.inf)])

    def test_no_cavity_makes_the_egg_a_container(self):
        states = self.check_proof("leaning_egg", "leaning_jar", 0.02)
        self.assertTrue(any(density > 0 for density, _, _ in states))

    def test_no_cavity_gives_the_roly_poly_with_a_thick_wall_one_resting_face(self):
        sample = SAMPLES / "roly_poly.ply"
        model = read_ply(sample)
        wall = 0.02 * np.linalg.norm(np.ptp(model[0], axis=0))
        report, _ = self.run_filter(sample, script_of("roly_poly"), inner_lower_bound=wall)
        self.assertTrue(report["certified"], report["message"])
        self.assertIn("No cavity of any shape that keeps this wall can reach it", report["message"])
        length = report["certificate_length"]
        vertices = (model[0] - report["certificate_origin"]) / length
        voxels = Voxels(vertices, model[1], wall / length)
        normals, limits = [], []
        while f"certificate_functional_{len(limits) + 1}" in report:
            text = report[f"certificate_functional_{len(limits) + 1}"]
            w = np.array(text.split(), dtype=float)
            # t m − u·S with a unit vector u: no centre of mass is beyond t.
            self.assertAlmostEqual(np.linalg.norm(w[1:4]), 1, delta=1e-9)
            self.assertFalse(w[4:].any())
            self.assertTrue(voxels.prove_positive([(0, np.inf, w)]))
            normals.append(-w[1:4])
            limits.append(w[0])
        self.assertGreater(len(limits), 0)
        self.check_no_centre_rolls_upright(vertices, np.array(normals), np.array(limits))

    def check_no_centre_rolls_upright(self, vertices, normals, limits):
        """All centres within the half-spaces, in boxes: each is outside, or leaves a pose from which
        the body does not come back, or is cut in two."""
        body = RollingBody(vertices)
        boxes = [(vertices.min(axis=0), vertices.max(axis=0))]
        looked_at = 0
        while boxes:
            low, high = boxes.pop()
            nearest = normals @ (low + high) / 2 - np.abs(normals) @ (high - low) / 2
            if (nearest > limits).any():
                continue
            looked_at += 1
            self.assertLess(looked_at, 3000, f"not settled: {low}, {high}")
            if body.stays_off(low, high):
                continue
            axis = np.argmax(high - low)
            for side in range(2):
                half = [low.copy(), high.copy()]
                half[1 - side][axis] = (low[axis] + high[axis]) / 2
                boxes.append(tuple(half))


if __name__ == "__main__":
    unittest.main()
