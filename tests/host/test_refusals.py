"""Inputs that cannot work: a sentence in the log, an exit status, and nothing written."""
import pathlib
import re
import tempfile
import unittest

import numpy as np

from host import ROOT, HostTest, changed_script, cube, meshlabserver, script_of, write_ply

SPIN = script_of("tilted_ellipsoid_top")


class RefusalsTest(HostTest):
    def refuse(self, mesh, sentence, filters=(), **values):
        """`mesh`: (vertices, faces), a file, or None for an empty document. Without `mend`, unless
        it is among the values."""
        values.setdefault("mend", "false")
        script = changed_script(SPIN, self.folder / "s.mlx", **values)
        inner = self.folder / "inner.ply"
        arguments = []
        if mesh is not None:
            file = mesh if not isinstance(mesh, tuple) else write_ply(self.folder / "m.ply", *mesh)
            arguments = ["-i", file, "-o", inner, "-l", "x"]
        saved = self.folder / "saved.mlp"
        status, log = meshlabserver(*arguments, "-w", saved, "-s", script)
        self.assertNotEqual(status, 0, log)
        self.assertNotIn(status, (134, 139), "no crash")
        # The sentence stands just before meshlabserver's own.
        lines = log.splitlines()
        said = lines[lines.index("Problem with filter: Mass Property Optimization") - 1]
        self.assertRegex(said, sentence)
        self.assertRegex(said, r"^[A-Za-z].*\.$", "a whole sentence")
        for name in filters:
            self.assertIn(name, said)
            # Versions differ in what they append to a name.
            self.assertTrue(any(f.startswith(name) for f in self.filters()), f"no filter {name}")
        self.assertEqual(bool(filters), " In PyMeshLab: " in said)
        for name in re.findall(r"[a-z_]+", said.partition(" In PyMeshLab: ")[2]):
            self.assertRegex(name, "^(meshing|compute|generate|apply|set)_", "a PyMeshLab filter")
        self.assertNotRegex(log, r"(?m)^[a-z_]+ = ", "no report")
        self.assertFalse(inner.exists())
        self.assertFalse(saved.exists())

    @classmethod
    def filters(cls):
        """Menu texts of all filters of this MeshLab."""
        if not hasattr(cls, "_filters"):
            with tempfile.TemporaryDirectory() as folder:
                dump = pathlib.Path(folder) / "filters.txt"
                meshlabserver("-d", dump)
                text = dump.read_text(errors="replace")
            cls._filters = set(re.findall(r"(?m)^\\section f\d+ (.*?) *$", text))
        return cls._filters

    def test_all_filters_that_sentences_name_have_a_name_in_python(self):
        """In the sources, for not every sentence can be provoked."""
        table = (ROOT / "filter_massprops" / "pymeshlab_names.cpp").read_text()
        known = dict(re.findall(r'\{"([^"]+)",\s*"([a-z_]+)"\}', table))
        self.assertGreater(len(known), 10)
        for menu in known:
            with self.subTest(menu):
                self.assertTrue(menu == "Mesh Boolean: Union"  # since 2021
                                or any(menu in f for f in self.filters()), "not in this MeshLab")
        named = 0
        for file in [*(ROOT / "core").rglob("*.cpp"), *(ROOT / "filter_massprops").glob("*.cpp")]:
            text = re.sub(r'"\s*"', "", file.read_text())
            for menu, rest in re.findall(
                    r"(Remeshing|Reconstruction|Repairing|Selection|Normals|Orientation|Smoothing|"
                    r"Mesh Layer) > ([^\"]{8,60})", text):
                if file.name == "pymeshlab_names.cpp":
                    continue
                named += 1
                with self.subTest(file=file.name, menu=menu, rest=rest):
                    self.assertTrue(any(rest.startswith(name) for name in known))
        self.assertGreater(named, 10)

    def test_no_layer(self):
        self.refuse(None, "no layer.*Import Mesh")

    def test_points_without_faces(self):
        points, _ = cube()
        self.refuse((points, np.zeros((0, 3), int)), "no faces",
                    ["Surface Reconstruction: Screened Poisson"])

    def test_a_hole(self):
        points, faces = cube()
        self.refuse((points, faces[1:]), "3 boundary edges.*open_surface", ["Close Holes"])

    def test_an_open_surface_that_cannot_be_a_shell(self):
        points, faces = cube()
        opened = faces[points[faces][:, :, 2].min(axis=1) < 9.9]  # without its top
        self.refuse((points, opened), "outer surface|stays where it is", ["Close Holes"],
                    basis_k=8, open_surface="true", outer_upper_bound=0.5)
        self.refuse((points, opened), "water would run in", ["Close Holes"], goal=5,
                    open_surface="true", water_level=1)

    def test_a_non_manifold_edge(self):
        points, faces = cube()
        a, b, _ = faces[0]
        points = np.vstack([points, [-5, -5, -5], [-6, -5, -5], [-5, -6, -5]])
        n = len(points)
        fin = [(a, b, n - 3), (b, a, n - 2), (a, n - 3, n - 1), (n - 3, b, n - 1),
               (b, n - 2, n - 1), (n - 2, a, n - 1)]
        self.refuse((points, np.vstack([faces, fin])), "non-manifold",
                    ["Repair non Manifold Edges"])

    def test_a_non_manifold_vertex(self):
        points, faces = cube()
        far = points + 10.0
        corner = int(np.argmin(np.abs(points).sum(1)))
        opposite = int(np.argmin(np.abs(points - 10.0).sum(1)))
        other = faces + len(points)
        other[other == corner + len(points)] = opposite
        self.refuse((np.vstack([points, far]), np.vstack([faces, other])), "non-manifold vert",
                    ["Repair non Manifold Vertices by splitting"])

    def test_incoherent_orientation(self):
        points, faces = cube()
        faces[7] = faces[7][::-1]
        self.refuse((points, faces), "orient", ["Re-Orient all faces"])

    def test_a_surface_that_crosses_itself(self):
        points, faces = cube()
        # One inner vertex of the bottom is pulled through the top.
        vertex = int(np.argmin(np.linalg.norm(points - [5, 5, 0], axis=1)))
        points[vertex] = [5, 5, 15]
        self.refuse((points, faces), "cross", ["Select Self Intersecting Faces"])

    def test_a_vase_is_not_mended(self):
        points, faces = cube()
        opened = faces[points[faces][:, :, 2].min(axis=1) < 9.9]  # without its top
        self.refuse((points, opened), "1 opening .*open_surface", ["Close Holes"], mend="true")

    def test_more_basis_functions_than_vertices(self):
        self.refuse(cube(), "basis_k is 20000.*vertices", ["Subdivision Surfaces: Midpoint"], basis_k=20000)

    def test_no_basis_function(self):
        self.refuse(cube(), "basis_k is 0", basis_k=0)

    def test_lower_above_upper_outer_bound(self):
        self.refuse(cube(), "outer_lower_bound.*outer_upper_bound", basis_k=8,
                    outer_lower_bound=2, outer_upper_bound=1)

    def test_lower_above_upper_inner_bound(self):
        self.refuse(cube(), "inner_lower_bound", basis_k=8, inner_lower_bound=100)

    def test_inner_upper_bound_above_one(self):
        self.refuse(cube(), "inner_upper_bound", basis_k=8, inner_upper_bound=1.5)

    def test_negative_lengths(self):
        for name in ("inner_lower_bound", "outer_lower_bound", "outer_upper_bound"):
            with self.subTest(name):
                self.refuse(cube(), name, basis_k=8, **{name: -1})

    def test_negative_radius(self):
        self.refuse(cube(), "radius_x", basis_k=8, radius_x=-1, radius_y=2)

    def test_densities(self):
        self.refuse(cube(), "density", basis_k=8, density=-1)
        self.refuse(cube(), "density", basis_k=8, density=0)
        self.refuse(cube(), "fill_density", basis_k=8, fill_density=-1)
        self.refuse(cube(), "density", basis_k=8, density="nan")

    def test_negative_weight(self):
        for i in range(1, 7):
            with self.subTest(i):
                self.refuse(cube(), "opt_weight", basis_k=8, **{f"opt_weight_{i}": -1})

    def test_parameters_of_single_goals(self):
        spin, store, floats, hang, mass = 1, 3, 5, 6, 7
        self.refuse(cube(), "spin_speed", goal=spin, spin_speed=0)
        self.refuse(cube(), "needs fill_density", goal=store)
        self.refuse(cube(), "water_level", goal=floats, water_level=0)
        self.refuse(cube(), "water_level", goal=floats, water_level=1.5)
        self.refuse(cube(), "water_density", goal=floats, water_density=0)
        self.refuse(cube(), "target_mass", goal=mass, target_mass=-1)
        self.refuse(cube(), "pivot lies", goal=hang, use_pivot="true", pivot_x=1e6)

    def test_infill_of_the_cavity(self):
        self.refuse(cube(), "cavity_infill", basis_k=8, cavity_infill=-0.1)
        self.refuse(cube(), "cavity_infill", basis_k=8, cavity_infill=1)
        self.refuse(cube(), "cannot be filled", basis_k=8, cavity_infill=0.1, fill_density=1)

    def test_a_project_is_written_whole_or_not_at_all(self):
        self.refuse(cube(), "cannot be written", basis_k=8,
                    print_file=self.folder / "missing" / "a.3mf")
        self.refuse(cube(), "must end in .3mf", basis_k=8, print_file=self.folder / "a.stl")
        project = self.folder / "a.3mf"
        project.write_text("old")
        self.refuse(cube(), "basis_k", basis_k=0, print_file=project)
        self.assertEqual(project.read_text(), "old")
        self.assertEqual([f.name for f in self.folder.glob("a.3mf*")], ["a.3mf"])

    def test_what_stays_solid(self):
        self.refuse(cube(), "No face is selected", keep_selected_solid="true")
        self.refuse(cube(), "solid_depth", solid_depth=-1, basis_k=8)

    def test_drain_holes(self):
        self.refuse(cube(), "drain_holes", drain_holes=-1, basis_k=8)
        self.refuse(cube(), "drain_diameter", drain_holes=1, drain_diameter=0.2, basis_k=8)
        self.refuse(cube(), "drain_diameter", drain_holes=1, drain_diameter=50, basis_k=8)
        self.refuse(cube(), "fill_density", drain_holes=1, fill_density=1, basis_k=8)

    def test_entries_that_do_not_exist(self):
        self.refuse(cube(), "'goal' is entry 9", goal=9)
        self.refuse(cube(), "'up_axis' is entry -1", up_axis=-1)


if __name__ == "__main__":
    unittest.main()
