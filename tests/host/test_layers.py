"""What happens to the document: new layers, the untouched input, transformations."""
import unittest

import numpy as np

import measure
from host import (SAMPLES, HostTest, bounds_a_volume, changed_script, colours_of, layers_of, meshlabserver,
                  ply_elements, read_ply, report_in, script_of, shutil, write_ply, write_project)

TOP = SAMPLES / "tilted_ellipsoid_top.ply"
SPIN = script_of("tilted_ellipsoid_top")


def place(matrix, vertices):
    return vertices @ matrix[:3, :3].T + matrix[:3, 3]


class LayersTest(HostTest):
    def project(self, mesh_or_project, *scripts):
        """Runs scripts on a copy of a mesh or on a project; layers that the saved project has."""
        saved = self.folder / "saved.mlp"
        source = ["-p" if mesh_or_project.suffix == ".mlp" else "-i", mesh_or_project]
        for script in scripts:
            source += ["-s", script]
        status, log = meshlabserver(*source, "-w", saved)
        self.assertEqual(status, 0, log)
        return layers_of(saved), report_in(log)

    def mesh(self, name="model.ply"):
        return shutil.copy(TOP, self.folder / name)

    def test_the_result_is_one_new_last_layer_named_after_the_input(self):
        layers, _ = self.project(self.mesh(), SPIN)
        self.assertEqual([name for name, _ in layers],
                         ["model_out.ply", "modelinneroffsetsurface_out.ply"])

    def test_a_moved_outer_surface_is_a_layer_before_the_inner_one(self):
        script = changed_script(SPIN, self.folder / "s.mlx", outer_upper_bound=1)
        layers, _ = self.project(self.mesh(), script)
        names = [name for name, _ in layers]
        self.assertEqual(names, ["model_out.ply", "modelouteroffsetsurface_out.ply",
                                 "modelinneroffsetsurface_out.ply"])
        self.assertEqual(bounds_a_volume(self.folder / names[1], self.folder / names[2]), "")

    def test_the_answer_is_shown_by_three_layers_before_the_cavity(self):
        script = changed_script(script_of("toy_dinosaur"), self.folder / "s.mlx",
                                show_layers="true", cavity_shape=1)
        mesh = shutil.copy(SAMPLES / "toy_dinosaur.ply", self.folder / "model.ply")
        layers, report = self.project(mesh, script)
        names = [name for name, _ in layers]
        self.assertEqual(names, ["model_out.ply", "modelcutopen_out.ply",
                                 "modelcentreofmassandcontactarea_out.ply",
                                 "modelskeletonandcorrespondences_out.ply",
                                 "modelinneroffsetsurface_out.ply"])
        outer, cut, marks, skeleton, inner = (read_ply(self.folder / name) for name in names)
        for _, matrix in layers[1:]:
            np.testing.assert_array_equal(matrix, layers[0][1])
        size = np.linalg.norm(np.ptp(outer[0], axis=0))
        before, after = report["center_of_mass_before"], report["center_of_mass_after"]

        # The section lies in the vertical plane through both centres of mass; one side is left.
        across = np.cross(before - after, [0, 0, 1])
        across /= np.linalg.norm(across)
        side = (cut[0] - after) @ across
        self.assertLess(min(side.max(), -side.min()), 1e-5 * size)
        on_plane = np.abs(side[cut[1]]).max(axis=1) < 1e-5 * size
        a, b, c = cut[0][cut[1][on_plane]].transpose(1, 0, 2)
        section = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        self.assertAlmostEqual(section, measure.section_area(outer, after, across)
                               - measure.section_area(inner, after, across), delta=1e-3 * section)

        # Balls about the centres, red and green, and lines on the ground round the feet.
        red, green, blue = (marks[0][colours_of(self.folder / names[2])[:, channel] > 120]
                            for channel in (0, 1, 2))
        for centre, ball in ((before, red), (after, green)):
            distance = np.linalg.norm(ball - centre, axis=1)
            on_ball = distance < 0.0155 * size
            self.assertGreater(on_ball.sum(), 200)
            np.testing.assert_allclose(ball[on_ball].mean(axis=0), centre, atol=1e-3 * size)
        self.assertLess(np.abs(blue[:, 2] - outer[0][:, 2].min()).max(), 0.004 * size)
        hull = measure.contact_polygon(outer[0])
        for corner in hull:
            self.assertLess(np.linalg.norm(blue[:, :2] - corner, axis=1).min(), 0.004 * size)

        # Lines from the model's surface, all over it, to curves inside of it.
        red, _, blue = colours_of(self.folder / names[3]).T
        curves, lines = skeleton[0][red > blue], skeleton[0][red < blue]
        self.assertEqual(len(curves) + len(lines), len(skeleton[0]))
        triangles = outer[0][outer[1]].transpose(1, 0, 2)
        depth = np.array([measure.point_triangle_distances(np.broadcast_to(p, triangles[0].shape),
                                                           *triangles).min() for p in curves[::97]])
        self.assertGreater(np.median(depth), 0.03 * size)
        # Of each line's twelve corners the first lie at the surface, the next at the skeleton.
        starts, ends = lines[0::12], lines[1::12]
        for start, end in list(zip(starts, ends))[::25]:
            p = np.broadcast_to(start, triangles[0].shape)
            self.assertLess(measure.point_triangle_distances(p, *triangles).min(), 0.001 * size)
            self.assertLess(np.linalg.norm(curves - end, axis=1).min(), 0.004 * size)
        for vertex in outer[0][::50]:
            self.assertLess(np.linalg.norm(starts - vertex, axis=1).min(), 0.06 * size)

    def test_the_drilled_body_and_its_plugs_are_layers_before_the_cavity(self):
        script = changed_script(SPIN, self.folder / "s.mlx", drain_holes=2)
        layers, report = self.project(self.mesh(), script)
        names = [name for name, _ in layers]
        self.assertEqual(names, ["model_out.ply", "modelwithdrainholes_out.ply",
                                 "modelplugs_out.ply", "modelinneroffsetsurface_out.ply"])
        for _, matrix in layers[1:]:
            np.testing.assert_array_equal(matrix, layers[0][1])
        outer, drilled, plugs, inner = (read_ply(self.folder / name) for name in names)
        self.assertTrue(report["solved"])
        holes = int(report["drain_holes"])
        self.assertGreaterEqual(holes, 2)

        # One closed body that does not cross itself, with a handle for each hole but the first.
        for i, euler in ((1, 4 - 2 * holes), (2, 2 * holes), (0, 2), (3, 2)):
            points, faces = read_ply(self.folder / names[i])
            self.assertEqual(len(points) - len(faces) // 2, euler, names[i])
        self.assertEqual(bounds_a_volume(self.folder / names[1]), "")
        self.assertEqual(bounds_a_volume(self.folder / names[2]), "")
        self.assertEqual(bounds_a_volume(self.folder / names[0], self.folder / names[3]), "")
        apart = measure.surface_distance(drilled, plugs)
        self.assertAlmostEqual(apart, report["plug_clearance"], delta=0.01)

        # What the report weighs is what these triangles enclose.
        density = 1.24 / 1000.0
        for parts, state in (([drilled], "open"), ([drilled, plugs], "after")):
            mass, centre, inertia = measure.mass_properties(
                [measure.body(*part, density) for part in parts])
            self.assertAlmostEqual(mass, report["mass_" + state], delta=1e-5 * mass)
            np.testing.assert_allclose(centre, report["center_of_mass_" + state], atol=1e-4)
            np.testing.assert_allclose(inertia, report["inertia_tensor_" + state],
                                       atol=1e-4 * np.abs(inertia).max())
        solid, _, _ = measure.hollow_body(outer, inner, 1.24)
        self.assertLess(report["mass_open"], report["mass_after"])
        self.assertLess(report["mass_after"], solid)

        # A hole is as wide as wished: a rod of the diameter goes through.
        for i in range(holes):
            rim = report[f"drain_hole_{i + 1}"]
            near = drilled[0][np.linalg.norm(drilled[0] - rim, axis=1) < 8]
            self.assertGreater(np.linalg.norm(near - rim, axis=1).min(), 0.98 * 3.5 / 2)

    def test_the_vertex_quality_is_the_wall_at_each_vertex(self):
        inner = self.folder / "inner.ply"
        status, log = meshlabserver("-i", TOP, "-o", inner, "-m", "vq", "-s", SPIN)
        self.assertEqual(status, 0, log)
        quality = ply_elements(inner)["vertex"]["quality"]
        points, (vertices, faces) = read_ply(inner)[0], read_ply(TOP)
        a, b, c = vertices[faces].transpose(1, 0, 2)
        for point, wall in list(zip(points, quality))[::7]:
            p = np.broadcast_to(point, a.shape)
            nearest = measure.point_triangle_distances(p, a, b, c).min()
            self.assertAlmostEqual(wall / nearest, 1.0, delta=1e-5)

    def test_the_input_layer_is_saved_as_if_the_filter_had_not_run(self):
        (before, *_), _ = self.project(self.mesh())
        untouched = (self.folder / before[0]).read_bytes()
        (after, *_), _ = self.project(self.mesh(), SPIN)
        self.assertEqual((self.folder / after[0]).read_bytes(), untouched)
        np.testing.assert_array_equal(after[1], before[1])

    def test_two_runs_give_the_same_bytes(self):
        surfaces = []
        for name in ("a", "b"):
            inner = self.folder / f"{name}.ply"
            status, log = meshlabserver("-i", TOP, "-o", inner, "-l", "x", "-s", SPIN)
            self.assertEqual(status, 0, log)
            surfaces.append(inner.read_bytes())
        self.assertEqual(*surfaces)

    def test_a_cavity_is_not_taken_for_a_model(self):
        """After a run it is the current layer, so that a second one would hollow it."""
        saved = self.folder / "saved.mlp"
        status, log = meshlabserver("-i", self.mesh(), "-w", saved, "-s", SPIN, "-s", SPIN)
        self.assertNotEqual(status, 0, log)
        self.assertIn("The current layer is a cavity", log)
        self.assertFalse(saved.exists())

    def test_stages_are_announced(self):
        status, log = meshlabserver("-i", TOP, "-s", SPIN)
        self.assertEqual(status, 0)
        for word in ("skeleton", "basis", "Optimization", "Report"):
            self.assertRegex(log, f"(?m)^[A-Z]?[A-Za-z, ]*{word}[A-Za-z, ]*$")

    def test_an_open_surface_becomes_one_closed_shell(self):
        """A leaning vase: with its inside it is a solid that stands, a wall thick but at the rim."""
        rings, around = 31, 48
        t = np.linspace(0, 1, rings)
        angle = np.arange(around) * 2 * np.pi / around
        radius = 10 + 16 * np.sin(np.pi / 2 * t)
        wall = np.stack([radius[:, None] * np.cos(angle) + 20 * t[:, None],
                         radius[:, None] * np.sin(angle), 80 * t[:, None] + 0 * angle],
                        axis=2).reshape(-1, 3)
        index = np.arange(rings * around).reshape(rings, around)
        a, b = index[:-1], index[1:]
        faces = [np.stack([a, np.roll(a, -1, 1), np.roll(b, -1, 1)], 2),
                 np.stack([a, np.roll(b, -1, 1), b], 2)]
        foot = np.stack([np.full(around, rings * around), np.roll(index[0], -1), index[0]], 1)
        faces = np.concatenate([f.reshape(-1, 3) for f in faces] + [foot])
        mesh = write_ply(self.folder / "vase.ply", np.vstack([wall, [0, 0, 0]]), faces)
        script = changed_script(script_of("leaning_ring"), self.folder / "s.mlx",
                                open_surface="true", inner_lower_bound=1)
        layers, report = self.project(mesh, script)
        names = [name for name, _ in layers]
        self.assertEqual(names, ["vase_out.ply", "vaseinneroffsetsurface_out.ply"])
        self.assertEqual(report["openings"], 1)
        self.assertFalse(report["stands_before"])
        self.assertTrue(report["solved"], report["message"])

        self.assertEqual(bounds_a_volume(*(self.folder / name for name in names)), "")
        outer, inner = (read_ply(self.folder / name) for name in names)
        np.testing.assert_array_equal(outer[0], read_ply(mesh)[0].astype(np.float32))
        mass, centre, _ = measure.hollow_body(outer, inner, 1.24, reference=outer[0].mean(axis=0))
        self.assertAlmostEqual(report["mass_after"] / mass, 1.0, delta=1e-6)
        np.testing.assert_allclose(report["center_of_mass_after"], centre, atol=1e-4)
        self.assertAlmostEqual(report["tip_angle_after"], measure.tipping_angle(outer[0], centre),
                               delta=1e-3)
        # The strip ends in the rim's very points.
        on_rim = outer[0][np.isclose(outer[0][:, 2], 80)]
        shared = {tuple(p) for p in inner[0]} & {tuple(p) for p in outer[0]}
        self.assertEqual(shared, {tuple(p) for p in on_rim})
        rest = inner[1][~np.isin(inner[1], [i for i, p in enumerate(inner[0])
                                            if tuple(p) in shared]).any(axis=1)]
        self.assertGreaterEqual(measure.surface_distance(outer, (inner[0], rest)), 1)

    def placed(self, matrix):
        """Runs on a layer with that matrix; checks that the new layer shares it, that both bound a
        volume in the layer's coordinates, and that the report speaks about the world."""
        mesh = self.mesh()
        project = write_project(self.folder / "placed.mlp", mesh, matrix)
        layers, report = self.project(project, SPIN)
        (outer_name, outer_matrix), (inner_name, inner_matrix) = layers
        np.testing.assert_allclose(outer_matrix, matrix, atol=1e-5)
        np.testing.assert_array_equal(inner_matrix, outer_matrix)
        files = [self.folder / outer_name, self.folder / inner_name]
        self.assertEqual(bounds_a_volume(*files), "")
        surfaces = [read_ply(file) for file in files]
        if np.linalg.det(matrix) < 0:
            surfaces = [(v, f[:, ::-1]) for v, f in surfaces]
        world = [(place(outer_matrix, v), f) for v, f in surfaces]
        reference = world[0][0].mean(axis=0)
        mass, centre, inertia = measure.hollow_body(*world, 1.24, reference=reference)
        size = np.linalg.norm(np.ptp(world[0][0], axis=0))
        # The project file keeps about seven digits of the matrix.
        self.assertAlmostEqual(report["mass_after"] / mass, 1.0, delta=1e-5)
        np.testing.assert_allclose(report["center_of_mass_after"], centre, atol=1e-5 * size)
        np.testing.assert_allclose(report["inertia_tensor_after"], inertia,
                                   atol=1e-5 * np.trace(inertia))
        return report

    def test_a_moved_turned_and_scaled_layer_is_optimised_where_it_is(self):
        angle = 0.3
        matrix = np.eye(4)
        matrix[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        matrix[:3, :3] *= 1.5
        matrix[:3, 3] = [40, -25, 10]
        self.assertTrue(self.placed(matrix)["spins_after"])

    def test_a_mirrored_layer_keeps_its_orientation(self):
        self.assertTrue(self.placed(np.diag([-1.0, 1.0, 1.0, 1.0]))["spins_after"])

    def test_the_up_axis_is_an_axis_of_the_world(self):
        """Layer lies on its side, its matrix puts it upright."""
        vertices, faces = read_ply(TOP)
        mesh = write_ply(self.folder / "lying.ply", vertices[:, [2, 0, 1]], faces)
        matrix = np.zeros((4, 4))
        matrix[[2, 0, 1, 3], [0, 1, 2, 3]] = 1
        project = write_project(self.folder / "placed.mlp", mesh, matrix)
        _, lying = self.project(project, SPIN)
        _, upright = self.project(self.mesh(), SPIN)
        self.assertAlmostEqual(lying["axis_tilt_before"], upright["axis_tilt_before"], delta=1e-4)

    def test_a_singular_matrix_is_refused(self):
        project = write_project(self.folder / "flat.mlp", self.mesh(),
                                np.diag([1.0, 1.0, 0.0, 1.0]))
        saved = self.folder / "saved.mlp"
        status, log = meshlabserver("-p", project, "-s", SPIN, "-w", saved)
        self.assertNotEqual(status, 0)
        self.assertIn("Matrix: Reset Current Matrix", log)
        self.assertFalse(saved.exists())


if __name__ == "__main__":
    unittest.main()
