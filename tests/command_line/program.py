"""Runs the program `massprops` and reads what it wrote with code of its own."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest

import numpy as np

from host import SAMPLES, read_ply, write_ply

PROGRAM = os.environ["MASSPROPS_PROGRAM"]
DENSITY = 1.24


def read_stl(path):
    """Vertices and triangles of a binary STL file, corners at one place merged."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    rows = np.frombuffer(data, np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]),
                         count, 84)
    vertices, faces = np.unique(rows["v"].reshape(-1, 3), axis=0, return_inverse=True)
    return vertices.astype(float), faces.reshape(-1, 3)


def read_obj(path):
    words = [line.split() for line in path.read_text().splitlines()]
    vertices = [w[1:4] for w in words if w and w[0] == "v"]
    faces = [[int(x.split("/")[0]) - 1 for x in w[1:4]] for w in words if w and w[0] == "f"]
    return np.array(vertices, float), np.array(faces)


def read_off(path):
    words = path.read_text().split()
    assert words[0] == "OFF"
    vertices, faces = int(words[1]), int(words[2])
    numbers = np.array(words[4:4 + 3 * vertices], float).reshape(-1, 3)
    return numbers, np.array(words[4 + 3 * vertices:4 + 3 * vertices + 4 * faces],
                             int).reshape(-1, 4)[:, 1:]


READERS = {".stl": read_stl, ".obj": read_obj, ".off": read_off, ".ply": read_ply}


def read(path):
    return READERS[path.suffix](path)


def write_stl(path, vertices, faces):
    rows = np.zeros(len(faces), np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]))
    rows["v"] = vertices[faces]
    path.write_bytes(bytes(80) + struct.pack("<I", len(faces)) + rows.tobytes())
    return path


def write_text(path, vertices, faces):
    """OBJ or OFF."""
    isOff = path.suffix == ".off"
    lines = [f"OFF\n{len(vertices)} {len(faces)} 0"] if isOff else []
    lines += [("" if isOff else "v ") + "%.9g %.9g %.9g" % tuple(v) for v in vertices]
    lines += [("3 %d %d %d" % tuple(f)) if isOff else "f %d %d %d" % tuple(f + 1) for f in faces]
    path.write_text("\n".join(lines) + "\n")
    return path


def write(path, vertices, faces):
    writers = {".stl": write_stl, ".ply": write_ply}
    return writers.get(path.suffix, write_text)(path, vertices, faces)


class ProgramTest(unittest.TestCase):
    """Gives each test an empty folder `self.folder`."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="massprops-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *arguments, status=0):
        """Standard output and error of a run that must end with that status; None: hollowed."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], check=False, cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertIn(done.returncode, (0, 1) if status is None else (status,), done.stderr.decode() + done.stdout.decode())
        return done.stdout.decode(), done.stderr.decode()

    def files(self):
        return sorted(p.name for p in self.folder.iterdir())

    def report(self, *arguments, status=0):
        out, _ = self.run_program(*arguments, "--report", "-", status=status)
        return json.loads(out)
