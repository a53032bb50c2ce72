#!/usr/bin/python3
"""Processor time over the number of triangles: a sample, every triangle in four again and again.

usage: growth.py [--repeat N] [--most TRIANGLES] <program> <sample.ply> <plot.svg>

Wall of 1 %, *Stand*; the surface is the same at every size. Prints a table and draws it.
"""
import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import tempfile

import numpy as np

FACE = np.dtype([("corners", "u1"), ("face", "<i4", 3)])


def read(path):
    """Vertices and triangles of a binary PLY file as the samples are: x, y, z as floats."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in head.decode().splitlines() if line.startswith("element")]
    vertices = np.frombuffer(body, "<f4", 3 * counts[0]).reshape(-1, 3)
    faces = np.frombuffer(body, FACE, counts[1], vertices.nbytes)["face"]
    return vertices.astype(float), faces


def write(path, vertices, faces):
    rows = np.zeros(len(faces), FACE)
    rows["corners"], rows["face"] = 3, faces
    path.write_bytes(
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\n"
        f"property float y\nproperty float z\nelement face {len(faces)}\n"
        "property list uchar int vertex_indices\nend_header\n".encode() +
        vertices.astype("<f4").tobytes() + rows.tobytes())


def subdivided(vertices, faces):
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), 1)
    edges, number = np.unique(edges, axis=0, return_inverse=True)
    a, b, c = len(vertices) + number.reshape(3, -1)
    corners = faces.T
    middles = vertices[edges].mean(1)
    return np.vstack([vertices, middles]), np.vstack(
        [np.stack(t, 1) for t in ((corners[0], a, c), (corners[1], b, a), (corners[2], c, b), (a, b, c))])


def run(program, model, folder):
    report = folder / "report.json"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, model, "--goal", "Stand", "--wall", "1%", "--report", report, "--quiet"],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, json.loads(
        report.read_text())


def plot(rows, path):
    """Both axes logarithmic; grey: as steep as what grows linearly."""
    def at(triangles, seconds):
        return 60 + 130 * np.log10(triangles / 1e3), 280 - 80 * np.log10(seconds / 0.1)

    def line(points, colour):
        return (f'<polyline fill="none" stroke="{colour}" stroke-width="2" points="' +
                " ".join(f"{x:.1f},{y:.1f}" for x, y in points) + '"/>')

    marks = [f'<text x="{at(10**k, 0.1)[0] - 12:.0f}" y="300">10{"³⁴⁵⁶"[k - 3]}</text>'
             for k in range(3, 7)]
    marks += [f'<text x="8" y="{at(1e3, s)[1] + 4:.0f}">{s:g} s</text>' for s in (0.1, 1, 10, 100)]
    last = rows[-1]
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="480" height="310" font-family="sans-serif" '
        'font-size="12">' + line([at(n, last[1] * n / last[0]) for n, _ in rows], "#bbb") +
        line([at(*row) for row in rows], "#26a") + "".join(marks) + "</svg>\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("sample", type=pathlib.Path)
    parser.add_argument("plot", type=pathlib.Path)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--most", type=int, default=3000000)
    options = parser.parse_args()
    vertices, faces = read(options.sample)
    rows = []
    print("| triangles | processor time, s | of it check and tree, s | gap |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        model = pathlib.Path(folder) / "model.ply"
        while len(faces) <= options.most:
            write(model, vertices, faces)
            runs = [run(options.program, model, pathlib.Path(folder)) for _ in range(options.repeat)]
            seconds = statistics.median(each[0] for each in runs)
            report = runs[-1][1]
            rows.append((len(faces), seconds))
            print(f"| {len(faces):,} | {seconds:.2f} | {report['seconds_check']:.2f} | "
                  f"{100 * report['gap_to_limit']:.2f} % |", flush=True)
            vertices, faces = subdivided(vertices, faces)
    plot(rows, options.plot)


if __name__ == "__main__":
    main()
