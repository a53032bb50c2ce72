"""Runs the filter in the real meshlabserver and reads what it wrote."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as xml

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "sample_meshes"
FILTER = "Mass Property Optimization"
SCRIPTS = {"box_on_corner": "stand.mlx", "tilted_ellipsoid_top": "spin.mlx"}
# How samples are printed, where that is not how they are used.
BUILD_AXIS = {"hanging_fish": 2}
# All samples everywhere, or of what takes long only those that differ in kind.
IS_THOROUGH = os.environ.get("MASSPROPS_TEST_THOROUGHLY", "") == "ON"


def script_of(sample):
    return SAMPLES / SCRIPTS.get(sample, sample + ".mlx")


def changed_script(template, path, **values):
    """Writes the script `template` to `path` with other values for some parameters."""
    tree = xml.parse(template)
    for name, value in values.items():
        (parameter,) = tree.findall(f".//Param[@name='{name}']")
        parameter.set("value", str(value))
    path.write_text("<!DOCTYPE FilterScript>\n" + xml.tostring(tree.getroot(), encoding="unicode"))
    return path


def host_folder():
    """A folder with copies of MeshLab's programs that load our plugin, and where its libraries are."""
    done = subprocess.run([ROOT / "scripts" / "meshlabserver.sh", "--host-folder"], check=True,
                          stdout=subprocess.PIPE)
    return [pathlib.Path(line) for line in done.stdout.decode().splitlines()]


def meshlabserver(*arguments):
    """Exit status and standard output."""
    done = subprocess.run([ROOT / "scripts" / "meshlabserver.sh", *map(str, arguments)],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    return done.returncode, done.stdout.decode()


def report_in(log):
    """The report's values: bool, float, array or text."""
    report = {}
    for key, value in re.findall(r"^([a-z][a-z0-9_]*) = (.*)$", log, re.MULTILINE):
        if value in ("true", "false"):
            report[key] = value == "true"
        elif value.startswith("(("):
            report[key] = np.fromstring(re.sub(r"[()]", "", value), sep=",").reshape(3, 3)
        elif re.fullmatch(r"\([-+0-9.e, ]*\)", value):
            report[key] = np.fromstring(value.strip("()"), sep=",")
        else:
            try:
                report[key] = float(value)
            except ValueError:
                report[key] = value
    return report


PLY_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
             "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int32": "i4",
             "uint32": "u4", "float32": "f4", "float64": "f8"}


def ply_elements(path):
    """The properties of vertices and faces of a PLY file, ASCII or little-endian, by name."""
    data = pathlib.Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    elements = []
    binary = False
    for line in data[:end].decode().splitlines():
        words = line.split()
        if words[0] == "format":
            binary = words[1] == "binary_little_endian"
        elif words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    result = {}
    rest = data[end:]
    if not binary:
        lines = rest.decode().splitlines()
    for name, count, properties in elements:
        if name == "face":
            assert properties[0][0] == "list", "a list of vertices comes first"
            fields = [("n", PLY_TYPES[properties[0][1]]),
                      ("v", PLY_TYPES[properties[0][2]], 3)]
            fields += [(p[1], PLY_TYPES[p[0]]) for p in properties[1:]]
        else:
            fields = [(p[1], PLY_TYPES[p[0]]) for p in properties]
        if binary:
            dtype = np.dtype([(f[0], "<" + f[1], *f[2:]) for f in fields])
            result[name] = np.frombuffer(rest, dtype, count)
            rest = rest[count * dtype.itemsize:]
        else:
            rows = np.array([line.split() for line in lines[:count]], dtype=float)
            lines = lines[count:]
            result[name] = ({"n": rows[:, 0], "v": rows[:, 1:4].astype(int)} if name == "face"
                            else {f[0]: rows[:, i] for i, f in enumerate(fields)})
    return result


def colours_of(path):
    """Red, green and blue of the vertices of a PLY file, n×3, 0…255."""
    vertex = ply_elements(path)["vertex"]
    return np.stack([np.asarray(vertex[name], int) for name in ("red", "green", "blue")], axis=1)


def read_ply(path):
    """Vertices n×3 (float64) and triangles m×3 of a PLY file."""
    result = ply_elements(path)
    vertex = result["vertex"]
    vertices = np.stack([np.asarray(vertex[axis], float) for axis in "xyz"], axis=1)
    faces = np.asarray(result["face"]["v"], int) if "face" in result else np.zeros((0, 3), int)
    return vertices, faces


def write_ply(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\nproperty float x\n"
                   f"property float y\nproperty float z\nelement face {len(faces)}\n"
                   "property list uchar int vertex_indices\nend_header\n")
        for point in vertices:
            file.write("%.9g %.9g %.9g\n" % tuple(point))
        for face in faces:
            file.write("3 %d %d %d\n" % tuple(face))
    return path


def write_project(path, mesh, matrix):
    """A MeshLab project with one layer that has a transformation."""
    rows = "".join(" ".join(repr(float(x)) for x in row) + " \n" for row in matrix)
    path.write_text("<!DOCTYPE MeshLabDocument>\n<MeshLabProject>\n <MeshGroup>\n"
                    f'  <MLMesh label="{mesh.name}" filename="{mesh.name}">\n'
                    f"   <MLMatrix44>\n{rows}</MLMatrix44>\n  </MLMesh>\n </MeshGroup>\n"
                    " <RasterGroup/>\n</MeshLabProject>\n")
    return path


def layers_of(project):
    """File name and matrix of each layer of a project, in order."""
    text = project.read_text()
    text = text[text.index("<MeshLabProject>"):]
    return [(mesh.get("filename"),
             np.array(mesh.find("MLMatrix44").text.split(), float).reshape(4, 4))
            for mesh in xml.fromstring(text).iter("MLMesh")]


def delivered_folder():
    """Where what the filter delivered is left for other tests, or None."""
    if "MASSPROPS_DELIVERED" not in os.environ:
        return None
    folder = pathlib.Path(os.environ["MASSPROPS_DELIVERED"])
    folder.mkdir(exist_ok=True)
    return folder


def keep_delivered(sample, log, project, inner, moved_outer=None):
    """Leaves what the filter delivered in the folder that other tests read it from, if there is one."""
    folder = delivered_folder()
    if folder is None:
        return
    shutil.copy(project, folder / f"{sample}.3mf")
    (folder / f"{sample}_report.txt").write_text(log)
    shutil.copy(inner, folder / f"{sample}_inner.ply")
    outer = folder / f"{sample}_outer.ply"
    outer.unlink(missing_ok=True)
    if moved_outer:
        shutil.copy(moved_outer, outer)


def bounds_a_volume(*files):
    """Empty when all files together bound a printable solid, else what is wrong."""
    done = subprocess.run([os.environ["MASSPROPS_BOUNDS_A_VOLUME"], *map(str, files)],
                          stdout=subprocess.PIPE, check=False)
    return "" if done.returncode == 0 else done.stdout.decode().strip() or "the check crashed"


def refined(vertices, faces):
    """Every triangle cut into four."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, number = np.unique(edges, axis=0, return_inverse=True)
    a, b, c = faces.T
    ab, bc, ca = len(vertices) + number.reshape(3, -1)
    quarters = [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
    return (np.concatenate([vertices, vertices[edges].mean(axis=1)]),
            np.concatenate([np.stack(corners, axis=1) for corners in quarters]))


def cube(n=4, size=10.0):
    """A cube of n×n squares a side, each cut into two triangles."""
    points, faces = [], []
    ticks = range(n + 1)
    index = {}

    def at(p):
        if p not in index:
            index[p] = len(points)
            points.append(np.array(p) * size / n)
        return index[p]

    for axis in range(3):
        for side in (0, n):
            def corner(i, j):
                p = [0, 0, 0]
                p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, i, j
                return at(tuple(p))
            for i in ticks[:-1]:
                for j in ticks[:-1]:
                    a, b = corner(i, j), corner(i + 1, j)
                    c, d = corner(i + 1, j + 1), corner(i, j + 1)
                    pair = [(a, b, c), (a, c, d)]
                    faces += pair if side else [f[::-1] for f in pair]
    return np.array(points), np.array(faces)


class HostTest(unittest.TestCase):
    """Gives each test its own empty folder `self.folder`."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="massprops-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_filter(self, mesh, template, *more, **values):
        """Report and inner surface (vertices, faces) of a run that must succeed."""
        script = changed_script(template, self.folder / "changed.mlx", **values)
        inner = self.folder / "inner.ply"
        inner.unlink(missing_ok=True)
        status, log = meshlabserver("-i", mesh, *more, "-o", inner, "-l", "x", "-s", script)
        self.assertEqual(status, 0, log)
        return report_in(log), read_ply(inner)
